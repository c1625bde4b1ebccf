//! `holonom drift SCENE`

use super::common::{Common, MethodOptions, Output};
use super::interrupt;
use crate::error::{Error, Failure, Result, clock};
use crate::formulation::Choice;
use crate::integrator;
use crate::measure::{Drift, EnergyBalance, Record, Recorder, Singularity};
use crate::plot::{AxisSpec, Figure, Panel, Series};
use crate::report::{Folder, Table, cell, envelope, table};
use crate::simulate::{Method, Outcome, simulate};
use crate::study::Study;
use rayon::prelude::*;
use serde::Serialize;
use std::process::ExitCode;
use std::time::Instant;

#[derive(clap::Args)]
#[command(mut_arg("formulation", |arg| arg.hide(true)), mut_arg("projection", |arg| arg.hide(true)))]
pub struct Args {
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    output: Output,
}

/// One stabilization's run.
#[derive(Serialize)]
struct Row {
    method: String,
    formulation: Choice,
    projection: Choice,
    status: &'static str,
    failure: Option<Failure>,
    drift: Drift,
    energy: Option<EnergyBalance>,
    singularity: Singularity,
    steps: u64,
    rhs_evaluations: u64,
    factorizations: u64,
    wall_seconds: f64,
    #[serde(skip)]
    record: Record,
}

pub fn run(args: Args) -> Result<ExitCode> {
    refuse_stabilization(&args.common.method)?;
    let study = load(&args.common)?;
    args.common.span(&study)?;
    let first = compared(&study, 1.0)?;
    let mut folder = args.output.folder(&study.name)?;
    let bar = args.common.talk.progress(first.len() as u64, "drift");
    let (formulation, projection) = &first[0];
    let plain = one(&study, formulation, projection, &folder)?;
    bar.inc(1);
    let step = study.method.step.unwrap_or(mean_step(&study, &plain)?);
    let others: Vec<Row> = compared(&study, step)?
        .into_par_iter()
        .skip(1)
        .map(|(formulation, projection)| {
            let row = one(&study, &formulation, &projection, &folder);
            bar.inc(1);
            row
        })
        .collect::<Result<_>>()?;
    bar.finish_and_clear();
    let rows: Vec<Row> = [plain].into_iter().chain(others).collect();
    folder.write("drift.csv", &table_file(&rows)?)?;
    args.output.figure(&mut folder, "drift", figure(&study.name, &rows))?;
    folder.write_json("drift.json", &rows)?;
    let written = folder.finish()?;
    args.common.talk.print(&rows, || text(&study, &rows))?;
    args.common.talk.tell_files(&written)?;
    match fatal(&rows) {
        Some(failure) => Err(failure.clone().into()),
        None => Ok(ExitCode::SUCCESS),
    }
}

/// All of them are compared.
fn refuse_stabilization(method: &MethodOptions) -> Result<()> {
    let given = [("--formulation", &method.formulation), ("--projection", &method.projection)];
    match given.into_iter().find(|(_, choice)| choice.is_some()) {
        None => Ok(()),
        Some((option, _)) => {
            Err(Error::input("`drift` compares every formulation and projection that the integrator goes with")
                .under(option)
                .hint("leave it out; `simulate` runs one of them, and writes its drift.csv"))
        }
    }
}

/// The scene; with an integrator of the command line on the first formulation that goes with it, since all do not depend on
/// the scene's own.
fn load(common: &Common) -> Result<Study> {
    let mut overrides = common.method.overrides(&common.scene, common.choice.method);
    if let Some(entry) = overrides.integrator.as_ref().and_then(|choice| integrator::find(choice).ok()) {
        overrides.formulation = entry.accepts().next().map(Choice::named);
        overrides.projection = Some(Choice::named("none"));
    }
    common.talk.load(&common.scene.path, &overrides)?.settled()
}

/// One stabilization that fails is a result; all of them, or one that was interrupted, are a failed run.
fn fatal(rows: &[Row]) -> Option<&Failure> {
    let failures: Vec<&Failure> = rows.iter().filter_map(|row| row.failure.as_ref()).collect();
    let interrupted = failures.iter().find(|failure| failure.reason == interrupt::REASON);
    interrupted.or(failures.last().filter(|_| failures.len() == rows.len())).copied()
}

/// The stabilizations that the integrator of the scene, or of the command line, goes with.
fn compared(study: &Study, step: f64) -> Result<Vec<(Choice, Choice)>> {
    let accepted = |(formulation, projection): &(Choice, Choice)| of(study, formulation, projection).check().is_ok();
    let all: Vec<_> = stabilizations(step).into_iter().filter(accepted).collect();
    if all.len() > 1 {
        return Ok(all);
    }
    let Method { integrator, formulation, .. } = &study.method;
    let because = study.chosen_because.as_ref().map_or(String::new(), |because| format!("; auto: {because}"));
    let message = format!("{integrator} goes with {formulation} alone: there is nothing to compare{because}");
    let path = if study.chosen_because.is_some() { "--method" } else { "simulation.integrator" };
    Err(Error::input(message).under(path).hint("name another, as in --integrator dop853 or --integrator radau_iia"))
}

fn of(study: &Study, formulation: &Choice, projection: &Choice) -> Method {
    Method { formulation: formulation.clone(), projection: projection.clone(), ..study.method.clone() }
}

/// Every stabilization, the least first, with gains that go with steps of size `step`: alpha = beta = 1/step is the pair
/// (2/h, 1/h^2).
fn stabilizations(step: f64) -> Vec<(Choice, Choice)> {
    let gain = crate::report::significant(1.0 / step, 3);
    let gained =
        |name: &str, keys: &[&str]| keys.iter().fold(Choice::named(name), |choice, key| choice.with(key, &gain));
    let sweeps = Choice::named("manifold").with("sweeps", "2");
    let index1 = || Choice::named("index1");
    let none = || Choice::named("none");
    let other = |formulation: &str, projection: &str| (Choice::named(formulation), Choice::named(projection));
    vec![
        (index1(), none()),
        (Choice::named("baumgarte"), none()),
        (gained("baumgarte", &["alpha", "beta"]), none()),
        (gained("invariant_manifold", &["gamma"]), none()),
        (index1(), Choice::named("position")),
        (index1(), Choice::named("velocity")),
        (index1(), Choice::named("manifold")),
        (index1(), sweeps),
        (index1(), Choice::named("full")),
        (index1(), Choice::named("exact")),
        other("index2", "none"),
        other("index2", "position"),
        other("index3", "none"),
        other("index3", "velocity"),
        other("ggl", "none"),
        other("stabilized_index1", "none"),
    ]
}

fn one(study: &Study, formulation: &Choice, projection: &Choice, folder: &Folder) -> Result<Row> {
    let method = of(study, formulation, projection);
    let mut recorder = Recorder::new(study.system()).with_stop(|| interrupt::stop(folder));
    let clock = Instant::now();
    let Outcome { statistics, failure, .. } =
        simulate(study.system(), &method, study.span()?, study.start(), &mut recorder)?;
    let wall_seconds = clock.elapsed().as_secs_f64();
    let mut record = recorder.finish();
    // Of the motion only the times are shown, and there are many records.
    record.trajectory.rows.iter_mut().for_each(|row| *row = vec![row[0]]);
    Ok(Row {
        method: match (formulation.name.as_str(), projection.name.as_str()) {
            ("index1", "none") => formulation.to_string(),
            ("index1", _) => projection.to_string(),
            (_, "none") => formulation.to_string(),
            _ => format!("{formulation} + {projection}"),
        },
        formulation: formulation.clone(),
        projection: projection.clone(),
        status: if failure.is_some() { "failed" } else { "completed" },
        failure,
        drift: record.drift.clone(),
        energy: record.energy,
        singularity: record.singularity.clone(),
        steps: statistics.steps,
        rhs_evaluations: statistics.rhs_evaluations,
        factorizations: statistics.factorizations,
        wall_seconds,
        record,
    })
}

fn mean_step(study: &Study, plain: &Row) -> Result<f64> {
    let span = study.span()?;
    Ok((span.end - span.start) / plain.steps.max(1) as f64)
}

fn text(study: &Study, rows: &[Row]) -> String {
    let Method { integrator, rtol, atol, step, .. } = &study.method;
    let accuracy = match step {
        Some(step) => format!("step {} s", clock(*step)),
        None => format!("rtol {rtol:e}, atol {atol:e}"),
    };
    let mut table =
        Table::new(&["", "max |φ|", "max |φ′|", "final |φ|", "final |φ′|", "energy error", "steps", "rhs", "ms"]);
    for row in rows {
        let Drift { position, velocity, .. } = &row.drift;
        let drift = [position.max, velocity.max, position.last, velocity.last].map(|value| format!("{value:.2e}"));
        let energy = row.energy.map_or("-".to_string(), |energy| format!("{:.2e}", energy.max_error));
        let work = [row.steps.to_string(), row.rhs_evaluations.to_string(), format!("{:.2}", 1e3 * row.wall_seconds)];
        table.row([row.method.clone()].into_iter().chain(drift).chain([energy]).chain(work));
    }
    let because = study.chosen_because.as_ref().map_or(String::new(), |because| format!("  auto: {because}\n"));
    let text = format!("{}: drift with {integrator}, {accuracy}\n{because}\n{table}", study.name);
    let failures = rows.iter().filter_map(|row| Some((&row.method, row.failure.as_ref()?)));
    let lines =
        failures.map(|(method, failure)| format!("\n  {method} FAILED at t = {:.4e} s: {}", failure.t, failure.reason));
    let left = rows.iter().filter_map(|row| Some((&row.method, row.record.singularity.left()?)));
    let jumps = left.map(|(method, at)| {
        let t = at.t;
        format!("\n  {method} left its branch: its velocity jumped at the singular state of t = {t:.6} s")
    });
    let lines: String = lines.chain(jumps).collect();
    text + &lines + if lines.is_empty() { "" } else { "\n" }
}

/// `t`, then |phi| and |phi'| of every method; empty where a run had ended.
fn table_file(rows: &[Row]) -> Result<Vec<u8>> {
    let names = rows.iter().flat_map(|row| [format!("position {}", row.method), format!("velocity {}", row.method)]);
    let longest = rows.iter().map(|row| row.record.drift_rows.len()).max().unwrap_or(0);
    let line = |i: usize| {
        let t = rows.iter().find_map(|row| row.record.trajectory.times().nth(i)).unwrap_or(0.0);
        let levels = rows.iter().flat_map(|row| match row.record.drift_rows.get(i) {
            Some([position, velocity, _]) => [cell(*position), cell(*velocity)],
            None => [String::new(), String::new()],
        });
        [cell(t)].into_iter().chain(levels).collect()
    };
    table(["t".to_string()].into_iter().chain(names), (0..longest).map(line))
}

/// Points of a curve, each the largest drift of its window.
const WINDOWS: usize = 60;

impl Row {
    /// The method, short enough for a legend.
    fn label(&self) -> String {
        self.method
            .replace("alpha", "α")
            .replace("beta", "β")
            .replace("gamma", "γ")
            .replace(':', " ")
            .replace(',', ", ")
    }
}

fn figure(name: &str, rows: &[Row]) -> Option<Figure> {
    let panel = |level: usize, label: &str| {
        rows.iter().fold(Panel::new("time (s)", AxisSpec::from(label).log()), |panel, row| {
            let times = row.record.trajectory.times();
            let points = times.zip(&row.record.drift_rows).map(|(t, levels)| (t, levels[level]));
            let curve = envelope(points, row.record.drift_rows.len(), WINDOWS);
            panel.series(Series::line(row.label(), curve))
        })
    };
    let figure = Figure::new().title(format!("{name}: drift under every stabilization"));
    Some(figure.panel(panel(0, "position drift |φ| (m, rad)")).panel(panel(1, "velocity drift |φ′| (m/s, rad/s)")))
}
