//! Implicit methods that choose their steps, error against CPU time: `cargo bench --bench implicit`. With names, these
//! scenes alone.
//!
//! The error is that of the coordinates over the rows, relative to the largest of them, against `radau_iia` at 1e-11.
//! The last table compares CPU times at equal errors, interpolated between the tolerances.

mod common;

use common::{Case, least_times};
use holonom::analysis::Recorder;
use holonom::method_spec::MethodSpec;
use holonom::prepared::{Model, Overrides};
use holonom::scene::{Scene, generate};
use holonom::simulate::{Method, Span, simulate};
use std::path::Path;

const METHODS: [&str; 5] = ["bdf", "diffsol:method=bdf", "esdirk34", "tr_bdf2", "radau_iia"];
const TOLERANCES: [f64; 4] = [1e-3, 1e-4, 1e-6, 1e-8];
const ROWS: f64 = 50.0;

struct Study {
    name: String,
    prepared: Model,
    end: f64,
}

/// A run of a method at one tolerance.
struct Measured {
    method: &'static str,
    error: f64,
    cpu: f64,
}

fn shipped(name: &str, set: &[(&str, f64)], end: f64) -> Study {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("models").join(format!("{name}.json"));
    let set = set.iter().map(|(name, value)| (name.to_string(), (*value).into())).collect();
    let overrides = Overrides { set, ..Overrides::default() };
    let prepared = Model::load_with(&path, &overrides).unwrap_or_else(|error| panic!("{error}"));
    Study { name: name.to_string(), prepared, end }
}

fn generated(name: &str, scene: &serde_json::Value, end: f64) -> Study {
    let prepared = Scene::parse(&scene.to_string(), &[]).and_then(|scene| Model::new(scene, &Default::default()));
    Study { name: name.to_string(), prepared: prepared.unwrap_or_else(|error| panic!("{error}")), end }
}

fn studies() -> Vec<Study> {
    vec![
        generated("chain of 10", &generate::chain(10), 0.6),
        generated("chain of 100", &generate::chain(100), 0.3),
        generated("chain of 1000", &generate::chain(1000), 0.03),
        generated("n_four_bar of 10", &generate::n_four_bar(10), 1.0),
        shipped("flexible_slider_crank_fe", &[], 0.02),
        shipped("quarter_car", &[("c_strut", 2e5)], 2.0),
        shipped("spin_up_beam", &[], 2.0),
        shipped("right_angle_cantilever", &[], 1.0),
    ]
}

fn method(integrator: &str, tolerance: f64) -> Method {
    let integrator = MethodSpec::parse(integrator).unwrap_or_default();
    let [formulation, projection] = ["ggl", "none"].map(MethodSpec::named);
    Method { formulation, integrator, projection, rtol: tolerance, atol: tolerance, step: None }
}

/// The coordinates of all rows, the number of steps and the evaluations; `None` where the run fails.
fn run(study: &Study, method: &Method) -> Option<(Vec<f64>, u64, u64)> {
    let system = study.prepared.system();
    let mut recorder = Recorder::new(system);
    let span = Span { start: 0.0, end: study.end, output_step: study.end / ROWS };
    let outcome = simulate(system, method, span, study.prepared.start(), &mut recorder).ok()?;
    if let Some(failure) = outcome.failure {
        println!("  {}: {} at {} s", method.integrator, failure.reason, failure.t);
        return None;
    }
    let rows = recorder.finish().trajectory.rows;
    let n = system.dimensions().q;
    let q = rows.iter().flat_map(|row| row[1..=n].to_vec()).collect();
    Some((q, outcome.statistics.steps, outcome.statistics.rhs_evaluations))
}

fn measure(study: &Study) -> Vec<Measured> {
    println!("\n{:<26} {:>8} {:>10} {:>8} {:>9} {:>10}", study.name, "rtol", "error", "steps", "evaluat.", "CPU ms");
    let Some((reference, ..)) = run(study, &method("radau_iia", 1e-11)) else { return Vec::new() };
    let largest = reference.iter().fold(0.0f64, |largest, q| largest.max(q.abs()));
    let mut measured = Vec::new();
    for tolerance in TOLERANCES {
        let done = METHODS.map(|name| (name, run(study, &method(name, tolerance))));
        let done: Vec<_> = done.into_iter().filter_map(|(name, run)| Some((name, run?))).collect();
        let case = |name: &str| -> Case {
            let method = method(name, tolerance);
            (name.to_string(), Box::new(move || drop(run(study, &method))))
        };
        let times = least_times(&mut done.iter().map(|(name, _)| case(name)).collect::<Vec<Case>>());
        for ((name, (q, steps, evaluations)), cpu) in done.into_iter().zip(times) {
            let error = q.iter().zip(&reference).fold(0.0f64, |most, (q, exact)| most.max((q - exact).abs())) / largest;
            println!("  {name:<24} {tolerance:>8.0e} {error:>10.1e} {steps:>8} {evaluations:>9} {:>10.2}", 1e3 * cpu);
            measured.push(Measured { method: name, error, cpu });
        }
    }
    measured
}

/// CPU time of a method at an error, between its measurements on logarithmic scales.
fn cpu_at(measured: &[Measured], method: &str, error: f64) -> Option<f64> {
    let mut points: Vec<(f64, f64)> =
        measured.iter().filter(|run| run.method == method).map(|run| (run.error.ln(), run.cpu.ln())).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let at = error.ln();
    let pair = points.windows(2).find(|pair| pair[0].0 <= at && at <= pair[1].0)?;
    let part = (at - pair[0].0) / (pair[1].0 - pair[0].0);
    Some((pair[0].1 + part * (pair[1].1 - pair[0].1)).exp())
}

fn main() {
    let asked: Vec<String> = std::env::args().skip(1).filter(|name| !name.starts_with("--")).collect();
    let mut table = Vec::new();
    for study in studies() {
        if !asked.is_empty() && !asked.iter().any(|name| study.name.contains(name)) {
            continue;
        }
        let measured = measure(&study);
        for error in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7] {
            let times = METHODS.map(|method| cpu_at(&measured, method, error));
            table.push((study.name.clone(), error, times));
        }
    }
    print!("\nCPU time over that of bdf{:>12}", "error");
    METHODS.iter().for_each(|method| print!(" {method:>20}"));
    for (name, error, times) in table {
        let Some(own) = times[0] else { continue };
        print!("\n{name:<26} {error:>10.0e}");
        times.iter().for_each(|time| match time {
            Some(time) => print!(" {:>20.2}", time / own),
            None => print!(" {:>20}", "-"),
        });
    }
    println!();
}
