//! Error bars against true errors: `cargo bench --bench error_bars`, an hour and a half. `-- N SEED` makes N cases from
//! another seed.
//!
//! Each case is a shipped scene with parameters moved by up to a fifth, a part of its span, a method that goes with it,
//! and a tolerance of 1e-3 to 1e-11 or a fixed step. The bars of `simulate --check-error` are compared with the largest
//! difference of the rows from an accurate run, `radau_iia` on `ggl` at 1e-12. That is confirmed by `dop853` at 1e-13,
//! or by diffsol where it is stiff: an output counts where both differ by less than a tenth of its error. Runs that
//! fail or take more than ten seconds are no cases.

use cpu_time::ThreadTime;
use holonom::analysis::Recorder;
use holonom::formulation::Statistics;
use holonom::method_spec::MethodSpec;
use holonom::prepared::{Model, Overrides};
use holonom::scene::Automatic;
use holonom::simulate::{Leg, Method, Span, Stop};
use holonom::study::{Completed, ErrorBars};
use holonom::trajectory::Trajectory;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

const AUTOMATIC: &str = "auto";
const METHODS: [(&str, &str, &str); 24] = [
    ("index1", "dop853", "manifold"),
    ("index1", "dop853", "manifold"),
    ("index1", "dop853", "position"),
    ("index1", "dopri5", "manifold"),
    ("index1", "adams", "manifold"),
    ("index2", "phem56", "manifold"),
    ("index1", "tsit45", "exact"),
    ("baumgarte", "dopri5", "none"),
    ("null_space", "dop853", "manifold"),
    ("ggl", "radau_iia", "none"),
    ("index3", "radau_iia", "none"),
    ("index2", "radau_iia", "none"),
    ("ggl", "bdf", "none"),
    ("index1", "bdf", "none"),
    ("ggl", "diffsol", "none"),
    ("ggl", "esdirk34", "none"),
    ("ggl", "tr_bdf2", "none"),
    ("index3", "generalized_alpha", "none"),
    ("ggl", "generalized_alpha", "none"),
    ("index1", "rk4", "manifold"),
    ("index1", "heun", "manifold"),
    ("index3", "rattle", "none"),
    (AUTOMATIC, AUTOMATIC, AUTOMATIC),
    (AUTOMATIC, AUTOMATIC, AUTOMATIC),
];
const FIXED: [&str; 3] = ["rk4", "heun", "rattle"];
const ROWS: f64 = 50.0;
/// CPU time of a run, and of an accurate one, s.
const LIMITS: [f64; 2] = [10.0, 30.0];
/// Round-off of an output, of its largest value: smaller errors count as this.
const ROUND_OFF: f64 = 1e-14;

struct Run {
    trajectory: Trajectory,
    statistics: Statistics,
    legs: Vec<Leg>,
}

fn run(prepared: &Model, method: &Method, span: Span, limit: f64) -> Option<Run> {
    let begun = ThreadTime::now();
    let stop = || too_slow(begun.elapsed().as_secs_f64() > limit);
    let mut recorder = Recorder::new(prepared.system()).with_stop(stop);
    let (outcome, legs) = prepared.simulate(method, span, &mut recorder).ok()?;
    let trajectory = recorder.finish().trajectory;
    outcome.failure.is_none().then_some(Run { trajectory, statistics: outcome.statistics, legs })
}

fn too_slow(is_over: bool) -> Option<Stop> {
    is_over.then(|| Stop { reason: "it is too slow".to_string(), hint: String::new() })
}

/// A scene with other parameters, a part of its span and a method.
struct Case {
    scene: String,
    prepared: Model,
    span: Span,
    label: String,
}

fn case(paths: &[PathBuf], random: &mut fastrand::Rng) -> Option<Case> {
    let path = &paths[random.usize(..paths.len())];
    let (formulation, integrator, projection) = METHODS[random.usize(..METHODS.len())];
    let rtol = 10f64.powf(-3.0 - 8.0 * random.f64());
    let part = 10f64.powf(-1.5 * random.f64());
    let steps = 10f64.powf(2.0 + 2.0 * random.f64());
    let moved = [(); 2].map(|()| (random.f64(), 0.8 + 0.4 * random.f64()));
    let base = Model::load_with(path, &Overrides::default()).ok()?;
    let whole = base.span().ok()?;
    let end = whole.start + part * (whole.end - whole.start);
    let span = Span { start: whole.start, end, output_step: (end - whole.start) / ROWS };
    let parameters: Vec<(String, f64)> =
        base.parameters.iter().map(|(name, value)| (name.to_string(), value)).collect();
    let mut overrides = Overrides { rtol: Some(rtol), ..Overrides::default() };
    for (place, factor) in moved.into_iter().filter(|_| !parameters.is_empty()) {
        let (name, value) = &parameters[(place * parameters.len() as f64) as usize];
        // Small whole numbers are counts.
        if value.fract() != 0.0 || *value > 30.0 {
            overrides.set.push((name.clone(), (value * factor).into()));
        }
    }
    if integrator == AUTOMATIC {
        overrides.method = Some(Automatic::Auto);
    } else {
        overrides.formulation = Some(MethodSpec::named(formulation));
        overrides.integrator = Some(MethodSpec::named(integrator));
        overrides.projection = Some(MethodSpec::named(projection));
        overrides.step = FIXED.contains(&integrator).then(|| (end - whole.start) / steps);
    }
    let prepared = Model::load_with(path, &overrides).ok()?;
    let scene = path.file_stem().map_or(String::new(), |stem| stem.to_string_lossy().into_owned());
    Some(Case { scene, prepared, span, label: integrator.to_string() })
}

/// An accurate run, and one that confirms it.
fn truth(case: &Case, path: &Path) -> Option<[Run; 2]> {
    let with = |formulation: &str, integrator: &str, projection: &str, rtol: f64| {
        let set = case.prepared.parameters.iter().map(|(name, value)| (name.to_string(), value.into())).collect();
        let mut prepared = Model::load_with(path, &Overrides { set, ..Overrides::default() }).ok()?;
        let [formulation, integrator, projection] = [formulation, integrator, projection].map(MethodSpec::named);
        let atol = rtol * case.prepared.method.atol / case.prepared.method.rtol;
        let method = Method { formulation, integrator, projection, rtol, atol, step: None };
        prepared.is_automatic = false;
        run(&prepared, &method, case.span, LIMITS[1])
    };
    let accurate = with("ggl", "radau_iia", "none", 1e-12)?;
    let other = with("index1", "dop853", "manifold", 1e-13).or_else(|| with("ggl", "diffsol", "none", 1e-10))?;
    Some([accurate, other])
}

/// Largest difference of a watched quantity over the times that both runs have once.
fn difference(a: &Trajectory, b: &Trajectory, column: usize) -> f64 {
    let rows = |run: &Trajectory| -> Vec<(f64, f64)> {
        run.times().zip(run.watched()).map(|(t, values)| (t, values[column])).collect()
    };
    let a = rows(a);
    let b = rows(b);
    let mut most = 0.0f64;
    for (t, value) in &a {
        let mut others = b.iter().filter(|(time, _)| time == t);
        if let (Some((_, other)), None) = (others.next(), others.next()) {
            most = most.max((value - other).abs());
        }
    }
    most
}

/// What was found of the outputs of one method.
#[derive(Default)]
struct Found {
    cases: usize,
    held_cases: usize,
    outputs: usize,
    held: usize,
    widths: Vec<f64>,
    works: Vec<f64>,
}

impl Found {
    fn add(&mut self, work: f64, outputs: &[(f64, f64)]) {
        self.cases += 1;
        self.works.push(work);
        let held = outputs.iter().filter(|(bar, error)| bar >= error).count();
        self.held_cases += usize::from(held == outputs.len());
        self.outputs += outputs.len();
        self.held += held;
        self.widths.extend(outputs.iter().map(|(bar, error)| bar / error));
    }

    fn print(&mut self, name: &str) {
        let percent = |part: usize, all: usize| 100.0 * part as f64 / all.max(1) as f64;
        let median = |values: &mut Vec<f64>| {
            values.sort_by(f64::total_cmp);
            values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
        };
        println!(
            "{name:<20} {:>6} {:>8} {:>8.1} {:>8.1} {:>10.1} {:>8.2}",
            self.cases,
            self.outputs,
            percent(self.held, self.outputs),
            percent(self.held_cases, self.cases),
            median(&mut self.widths),
            median(&mut self.works)
        );
    }
}

fn measure(case: &Case, path: &Path) -> Option<(f64, Vec<(f64, f64)>)> {
    let first = run(&case.prepared, &case.prepared.method, case.span, LIMITS[0])?;
    let Run { trajectory, legs, statistics, .. } = &first;
    let completed = Completed { span: case.span, trajectory, legs, statistics: *statistics };
    let begun = std::time::Instant::now();
    let stop = || too_slow(begun.elapsed().as_secs_f64() > 3.0 * LIMITS[1]);
    let bars = ErrorBars::of(&case.prepared, completed, (&|_| (), &stop));
    if bars.failure.is_some() {
        println!("{} by {}: no bar: {:?}", case.scene, case.prepared.method.triple(), bars.failure);
    }
    let [accurate, other] = truth(case, path)?;
    let mut outputs = Vec::new();
    for (column, (name, bar)) in bars.outputs.iter().enumerate() {
        let size = accurate.trajectory.watched().map(|row| row[column].abs()).fold(0.0, f64::max);
        let error = difference(&first.trajectory, &accurate.trajectory, column);
        let is_known = difference(&accurate.trajectory, &other.trajectory, column) < 0.1 * error;
        if !is_known {
            continue;
        }
        let error = error.max(ROUND_OFF * size);
        let holds = bar.max >= error;
        if !holds {
            println!(
                "{} by {}, rtol {:.1e}: `{name}` is off by {error:.1e}, bar {:.1e}",
                case.scene,
                case.prepared.method.triple(),
                case.prepared.method.rtol,
                bar.max
            );
        }
        outputs.push((bar.max, error));
    }
    (!outputs.is_empty()).then_some((bars.work, outputs))
}

fn main() {
    let mut numbers = std::env::args().skip(1).filter_map(|text| text.parse::<u64>().ok());
    let wanted = numbers.next().unwrap_or(1000);
    let seed = numbers.next().unwrap_or(1);
    let mut random = fastrand::Rng::with_seed(seed);
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let entries = std::fs::read_dir(&folder).into_iter().flatten().filter_map(|entry| Some(entry.ok()?.path()));
    let mut paths: Vec<PathBuf> =
        entries.filter(|path| path.extension().is_some_and(|ending| ending == "json")).collect();
    paths.retain(|path| !path.ends_with("scene.schema.json"));
    paths.sort();
    let mut all = Found::default();
    let mut found: BTreeMap<String, Found> = BTreeMap::new();
    while (all.cases as u64) < wanted {
        let Some(case) = case(&paths, &mut random) else { continue };
        let path = folder.join(format!("{}.json", case.scene));
        let Some((work, outputs)) = measure(&case, &path) else { continue };
        all.add(work, &outputs);
        found.entry(case.label.clone()).or_default().add(work, &outputs);
    }
    println!("\nmethod                cases  outputs  held, %  cases, %  width     work");
    for (name, found) in &mut found {
        found.print(name);
    }
    all.print("all");
}
