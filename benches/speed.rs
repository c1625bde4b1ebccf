//! What an evaluation, a solution and a run cost: `cargo bench`. Single thread.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use holonom::formulation::{Choice, Dynamics};
use holonom::measure::Recorder;
use holonom::scene::{Scene, generate};
use holonom::simulate::{Method, Observation, Outcome, Sink, Span, simulate};
use holonom::study::{Overrides, Study};
use holonom::system::Need;
use std::path::Path;
use std::time::Duration;

/// A sink that keeps nothing.
struct Nothing;

impl Sink for Nothing {
    fn accepted(&mut self, _: &Observation) {}
    fn row(&mut self, _: &Observation) {}
}

fn shipped(name: &str) -> Study {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("models").join(name);
    Study::load(&path, &Default::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn n_four_bar(n: usize) -> Study {
    let text = generate::n_four_bar(n).to_string();
    let scene = Scene::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}"));
    Study::new(scene, &Default::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn run(study: &Study, method: &Method, end: f64) -> Outcome {
    let span = Span { start: 0.0, end, output_step: end };
    let outcome = simulate(study.system(), method, span, study.start(), &mut Nothing);
    let outcome = outcome.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(outcome.failure, None, "a run that fails early costs little");
    outcome
}

/// M, f, phi, phi', gamma and G, and the saddle-point solution, at the start.
fn evaluation(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("evaluation");
    for (name, study) in [("andrews", shipped("andrews.json")), ("spinning_top", shipped("spinning_top.json"))] {
        let mut dynamics = Dynamics::new(study.system());
        let (q, v) = study.start();
        group.bench_function(BenchmarkId::new("terms", name), |bencher| {
            bencher.iter(|| dynamics.evaluate(0.0, q, v, Need::DYNAMICS));
        });
        group.bench_function(BenchmarkId::new("saddle_point", name), |bencher| {
            bencher.iter(|| {
                let factored = dynamics.factor();
                let (f, gamma) = (dynamics.terms.f.clone(), dynamics.terms.gamma.clone());
                dynamics.vdot.copy_from_slice(&f);
                dynamics.lambda.copy_from_slice(&gamma);
                (factored, dynamics.kkt.solve(&mut dynamics.vdot, &mut dynamics.lambda).is_ok())
            });
        });
        group.bench_function(BenchmarkId::new("v' and lambda", name), |bencher| {
            bencher.iter(|| dynamics.solve(0.0, q, v, |_, _| 0.0));
        });
    }
}

/// The seven angles of Andrews' mechanism at t = 0.03 s, from a binary128 computation.
const ANDREWS: [f64; 7] = [
    15.810771195153707,
    -15.756371058411839,
    0.0408222401196458,
    -0.5347301163420796,
    0.524409965879954,
    0.5347301163420796,
    1.048080741041938,
];

/// Correct digits in the worst of the seven angles.
fn digits(study: &Study, method: &Method) -> f64 {
    let mut recorder = Recorder::new(study.system());
    let span = Span { start: 0.0, end: 0.03, output_step: 0.03 };
    let run = simulate(study.system(), method, span, study.start(), &mut recorder);
    run.unwrap_or_else(|error| panic!("{error}"));
    let trajectory = recorder.finish().trajectory;
    let row = trajectory.rows.last().map_or(&[][..], Vec::as_slice);
    let angles = trajectory.row_outputs(row);
    let worst = angles.iter().zip(ANDREWS).map(|(a, b)| ((a - b) / b).abs()).fold(0.0, f64::max);
    -worst.log10()
}

/// Andrews' mechanism and the heavy top end to end; digits and evaluations are printed first.
fn end_to_end(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("end to end");
    let andrews = shipped("andrews.json");
    for tolerance in [1e-7, 1e-8, 1e-9, 1e-10] {
        for integrator in ["dopri5", "dop853"] {
            let method = Method {
                integrator: Choice::named(integrator),
                rtol: tolerance,
                atol: tolerance,
                step: None,
                ..andrews.method.clone()
            };
            let statistics = run(&andrews, &method, 0.03).statistics;
            println!(
                "andrews, {integrator} at {tolerance:e}: {:.1} digits, {} steps, {} rejected, {} evaluations",
                digits(&andrews, &method),
                statistics.steps,
                statistics.rejected,
                statistics.rhs_evaluations
            );
            let id = BenchmarkId::new(format!("andrews {integrator}"), format!("{tolerance:e}"));
            group.bench_function(id, |bencher| bencher.iter(|| run(&andrews, &method, 0.03)));
        }
    }
    let top = shipped("spinning_top.json");
    group.bench_function("spinning_top, 1 s", |bencher| bencher.iter(|| run(&top, &top.method, 1.0)));
}

/// One step of rk4 with projection on N four-bar linkages: O(N).
fn growth(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("n_four_bar, rk4 step");
    group.measurement_time(Duration::from_secs(3)).sample_size(20);
    for n in [1, 10, 100, 1000] {
        let study = n_four_bar(n);
        let method = Method { integrator: Choice::named("rk4"), step: Some(1e-4), ..Method::default() };
        group.throughput(Throughput::Elements(n as u64));
        // Twenty steps a run, so that setting up counts little.
        group.bench_function(BenchmarkId::new("20 steps", n), |bencher| {
            bencher.iter(|| run(&study, &method, 20e-4));
        });
    }
}

/// Stiff by its dampers, or oscillating fast at rest: what implicit methods are for, against dop853 at one tolerance.
fn stiff(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("stiff");
    group.measurement_time(Duration::from_secs(3)).sample_size(10);
    let strut = Overrides { set: vec![("c_strut".to_string(), 2e5.into())], ..Overrides::default() };
    for (name, end, overrides) in [("flyball_governor", 1.0, Overrides::default()), ("quarter_car", 2.0, strut)] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("models").join(format!("{name}.json"));
        let study = Study::load(&path, &overrides).unwrap_or_else(|error| panic!("{error}"));
        for names in [["index1", "dop853", "manifold"], ["ggl", "radau_iia", "none"], ["ggl", "bdf", "none"]] {
            let [formulation, integrator, projection] = names.map(Choice::named);
            let method = Method { formulation, integrator, projection, rtol: 1e-6, atol: 1e-6, step: None };
            println!("{name}, {}: {:?}", names[1], run(&study, &method, end).statistics);
            group
                .bench_function(BenchmarkId::new(name, names[1]), |bencher| bencher.iter(|| run(&study, &method, end)));
        }
    }
}

/// Five steps of implicit methods on chains: O(N).
fn implicit_growth(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("chain, five implicit steps");
    group.measurement_time(Duration::from_secs(3)).sample_size(10);
    for n in [20, 200, 2000] {
        let scene = Scene::parse(&generate::chain(n).to_string(), &[]).unwrap_or_else(|error| panic!("{error}"));
        let study = Study::new(scene, &Default::default()).unwrap_or_else(|error| panic!("{error}"));
        group.throughput(Throughput::Elements(n as u64));
        for integrator in ["radau_iia", "generalized_alpha"] {
            let (formulation, projection) = (Choice::named("ggl"), Choice::named("none"));
            let integrator_ = Choice::named(integrator);
            let method =
                Method { formulation, integrator: integrator_, projection, step: Some(1e-4), ..Method::default() };
            group
                .bench_function(BenchmarkId::new(integrator, n), |bencher| bencher.iter(|| run(&study, &method, 5e-4)));
        }
    }
}

criterion_group!(benches, evaluation, end_to_end, growth, stiff, implicit_growth);
criterion_main!(benches);
