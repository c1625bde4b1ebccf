//! What linear models cost: `cargo bench --bench linearize`. Single thread.

#[path = "../tests/common/equations/mod.rs"]
mod equations;

mod common;

use equations::andrews::Andrews;
use holonom::formulation::Dynamics;
use holonom::linearize::{
    Chart, Complex, Linear, LinearModel, Matrix, State, Variation, at_rest, minimal, modal, registry,
};
use holonom::math::eigen::eigen;
use holonom::method_spec::MethodSpec;
use holonom::prepared::{Model, Overrides};
use holonom::scene::{Scene, generate};
use holonom::system::{MechanicalSystem, Need};
use serde_json::{Value, json};
use std::path::Path;
use std::time::Instant;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// The least CPU time of a call, s.
fn seconds(call: impl FnMut()) -> f64 {
    common::least_times(&mut [(String::new(), Box::new(call))])[0]
}

fn shipped(name: &str) -> Model {
    let path = Path::new(ROOT).join("models").join(format!("{name}.json"));
    Model::load_with(&path, &Overrides::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn at(prepared: &Model, t: f64) -> State {
    prepared.states_at(&[t]).unwrap_or_else(|error| panic!("{error}")).remove(0)
}

/// The state of a reference with 7 angles, and its eigenvalues in the chart of beta.
fn seven_angles() -> (State, Vec<Complex<f64>>) {
    let text = std::fs::read_to_string(Path::new(ROOT).join("tests/data/linear_andrews_t010.json")).unwrap();
    let data: Value = serde_json::from_str(&text).unwrap();
    let number = |value: &Value| value.as_str().unwrap().parse::<f64>().unwrap();
    let list = |value: &Value| value.as_array().unwrap().iter().map(number).collect::<Vec<f64>>();
    let beta = data["charts"].as_array().unwrap().iter().find(|c| c["independent_coordinates"] == json!(["beta"]));
    let values = beta.unwrap()["eigenvalues"].as_array().unwrap().iter();
    let values = values.map(|pair| Complex::new(number(&pair[0]), number(&pair[1]))).collect();
    (State { t: 0.0, q: list(&data["q"]), v: list(&data["v"]) }, values)
}

/// Andrews' mechanism at t = 0.01 s: evaluation, K, C, Gd, Gdd, the chart and (A, B, C, D), in memory used again.
fn andrews() {
    println!("Andrews' mechanism at 0.01 s (us)       matrices   with eigenvalues");
    let prepared = shipped("andrews");
    let (state, (angles, _)) = (at(&prepared, 0.01), seven_angles());
    let cases: [(&str, &dyn MechanicalSystem, &State, &str); 2] =
        [("scene, 21 coordinates", prepared.system(), &state, "K1.angle"), ("7 angles", &Andrews, &angles, "q1")];
    for (name, system, state, coordinate) in cases {
        let mut variation = Variation::new(system, state.t, &state.q, &state.v).unwrap();
        let charts = [Chart::Intrinsic, Chart::MassOrthogonal, Chart::Frozen, Chart::parse(coordinate)];
        for chart in charts {
            let mut model = |with_values: bool| {
                variation.operate_at(state.t, &state.q, &state.v).unwrap_or_else(|error| panic!("{error}"));
                let model = minimal(&mut variation, &chart);
                if let (true, Ok(model)) = (with_values, &model) {
                    std::hint::black_box(eigen(&model.built.a).unwrap());
                }
                model.is_ok()
            };
            if !model(true) {
                continue;
            }
            let [matrices, values] = [false, true].map(|with| 1e6 * seconds(|| assert!(model(with))));
            println!("  {:<36} {matrices:>10.1} {values:>18.1}", format!("{name}, {chart:?}"));
        }
        let mut dynamics = Dynamics::new(system);
        let solve = 1e6 * seconds(|| dynamics.solve(state.t, &state.q, &state.v, |_, _| 0.0).ok().unwrap());
        println!("  {:<36} {solve:>10.1}", format!("{name}, v' and lambda alone"));
    }
}

/// Models along motions in memory used again, in the preferred chart.
fn along_motions() {
    println!("\n800 models along a motion                    ms");
    for name in ["andrews", "five_link_suspension", "five_link_suspension_rods", "flexible_slider_crank"] {
        let prepared = shipped(name);
        let end = prepared.span().unwrap_or_else(|error| panic!("{error}")).end;
        let times: Vec<f64> = (1..=800).map(|i| end * f64::from(i) / 800.0).collect();
        let all = prepared.states_at(&times).unwrap_or_else(|error| panic!("{error}"));
        let mut variation = all[0].variation(&prepared).unwrap();
        let chart = Chart::preferred(&mut variation);
        let time = seconds(|| {
            for state in &all {
                variation.operate_at(state.t, &state.q, &state.v).unwrap_or_else(|error| panic!("{error}"));
                std::hint::black_box(minimal(&mut variation, &chart).unwrap());
            }
        });
        println!("  {name:<36} {:>10.1}", 1e3 * time);
    }
}

/// v' of the independent coordinate `z` of the 7 angles at (z, z'), by Newton's method on the constraints.
fn acceleration(dynamics: &mut Dynamics, start: &State, z: [f64; 2]) -> f64 {
    let n = start.q.len();
    let rows = dynamics.lambda.len();
    let mut q = start.q.clone();
    let still = vec![0.0; start.v.len()];
    let mut system = |q: &[f64], last: f64| {
        dynamics.evaluate(start.t, q, &still, Need::G | Need::CONSTRAINTS);
        let mut matrix = Matrix::zeros(n, n);
        dynamics.structure.g.entries.iter().zip(&dynamics.terms.g).for_each(|(&place, g)| matrix[place] += g);
        matrix[(rows, 0)] = 1.0;
        let right = dynamics.terms.phi.iter().map(|phi| -phi).chain([last]);
        (matrix.lu(), nalgebra::DVector::from_iterator(n, right))
    };
    for _ in 0..4 {
        let (lu, right) = system(&q, z[0] - q[0]);
        let step = lu.solve(&right).unwrap();
        q.iter_mut().zip(step.iter()).for_each(|(q, step)| *q += step);
        if step.amax() < 1e-14 {
            break;
        }
    }
    let (lu, mut right) = system(&q, z[1]);
    right.rows_mut(0, rows).fill(0.0);
    let v = lu.solve(&right).unwrap();
    dynamics.solve(start.t, &q, v.as_slice(), |_, _| 0.0).ok().unwrap();
    dynamics.vdot[0]
}

/// A of the 7 angles by central differences against exact derivatives: time, and the worse eigenvalue.
fn differences() {
    let (state, reference) = seven_angles();
    let error = |a: &Matrix| {
        let found = a.complex_eigenvalues();
        let off = |known: &Complex<f64>| {
            found.iter().map(|x| (x - known).norm() / known.norm()).fold(f64::INFINITY, f64::min)
        };
        reference.iter().map(off).fold(0.0, f64::max)
    };
    let mut dynamics = Dynamics::new(&Andrews);
    let centre = [state.q[0], state.v[0]];
    println!("\n7 angles, chart of beta                       us   error of eigenvalues");
    let mut variation = Variation::new(&Andrews, state.t, &state.q, &state.v).unwrap();
    let mut exact = Matrix::zeros(2, 2);
    let time = seconds(|| {
        variation.move_to(state.t, &state.q, &state.v).ok().unwrap();
        exact = minimal(&mut variation, &Chart::parse("q1")).unwrap().built.a;
    });
    println!("  {:<36} {:>10.1} {:>14.1e}", "exact derivatives, with B, C, D", 1e6 * time, error(&exact));
    for step in [1e-4, 1e-5, 1e-6, 1e-7] {
        let mut a = Matrix::from_row_slice(2, 2, &[0.0, 1.0, 0.0, 0.0]);
        let time = seconds(|| {
            for (i, scale) in [1.0, centre[1].abs()].into_iter().enumerate() {
                let h = step * scale;
                let moved = |sign: f64| [0, 1].map(|k| centre[k] + if k == i { sign * h } else { 0.0 });
                let [up, down] = [1.0, -1.0].map(|sign| acceleration(&mut dynamics, &state, moved(sign)));
                a[(1, i)] = (up - down) / (2.0 * h);
            }
        });
        println!("  {:<36} {:>10.1} {:>14.1e}", format!("differences, step {step:e}"), 1e6 * time, error(&a));
    }
}

/// A chain of elastic beams that hangs along gravity.
fn hanging(links: usize) -> Model {
    let mut scene = generate::flexible_chain(links);
    scene["gravity"] = json!([9.81, 0]);
    let scene = Scene::parse(&scene.to_string(), &[]);
    scene.and_then(|scene| Model::new(scene, &Overrides::default())).unwrap_or_else(|error| panic!("{error}"))
}

/// Twenty modes of chains, against all modes by minimal coordinates, and against the number of links.
fn chains() {
    println!("\nhanging chain, velocities       20 modes (ms)   all by mcs (ms)   largest difference");
    for (links, with_all) in [(7, true), (13, true), (27, true), (67, false), (267, false), (667, false)] {
        let prepared = hanging(links);
        let (q, v) = prepared.start();
        let rest = at_rest(&prepared, &State { t: 0.0, q: q.to_vec(), v: v.to_vec() });
        let mut variation =
            rest.and_then(|rest| rest.state.variation(&prepared)).unwrap_or_else(|error| panic!("{error}"));
        let few = || Complex::new(0.0, 0.0);
        let mut found: Option<LinearModel> = None;
        let time = 1e3 * seconds(|| found = Some(modal(&mut variation, 20, few()).unwrap_or_else(|e| panic!("{e}"))));
        let values: Vec<Complex<f64>> =
            found.iter().flat_map(|model| model.modes.iter().map(|mode| mode.value)).collect();
        print!("  {:<28} {time:>14.1}", variation.velocities());
        if !with_all {
            println!("   {} modes from {:.4} to {:.4} rad/s", values.len() / 2, values[0].norm(), values[39].norm());
            continue;
        }
        let request = Linear { method: MethodSpec::named("mcs"), chart: Some(Chart::MassOrthogonal) };
        let clock = Instant::now();
        let all = variation.linearize(&request).unwrap();
        let dense = 1e3 * clock.elapsed().as_secs_f64();
        let off = |value: &Complex<f64>| {
            let distances = all.modes.iter().map(|mode| (mode.value - value).norm() / value.norm());
            distances.fold(f64::INFINITY, f64::min)
        };
        let off = values.iter().map(off).fold(0.0, f64::max);
        println!(" {dense:>17.1} {off:>20.1e}");
    }
}

/// Every method, matrices and eigenvalues.
fn methods() {
    println!("\nall methods, matrices + eigenvalues (us)");
    for (name, t) in [("four_bar_spring", 0.1), ("andrews", 0.01), ("five_link_suspension_rods", 0.0)] {
        let prepared = shipped(name);
        let mut variation = at(&prepared, t).variation(&prepared).unwrap();
        for entry in registry() {
            let request = Linear { method: MethodSpec::named(entry.name), chart: None };
            let Ok(model) = variation.linearize(&request) else { continue };
            let costs = (0..20).filter_map(|_| variation.linearize(&request).ok()).map(|model| model.cost);
            let least = costs.fold([f64::INFINITY; 2], |[a, b], c| [a.min(c.assembly_seconds), b.min(c.eigen_seconds)]);
            let [matrices, values] = least.map(|s| 1e6 * s);
            println!("  {name:<28} {:<22} {:>4} states {matrices:>10.1} {values:>10.1}", entry.name, model.cost.size);
        }
    }
}

fn main() {
    andrews();
    along_motions();
    differences();
    chains();
    methods();
}
