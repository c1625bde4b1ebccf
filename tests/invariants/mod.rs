//! Random mechanisms keep under every method what mechanics says that they keep.

mod methods;
mod momentum;
mod promises;
mod recipes;

use crate::scenes::{Ready, Run, dop853, parse};
use holonom::analysis::{Record, Recorder};
use holonom::method_spec::MethodSpec;
use holonom::simulate::{Method, Span, simulate};
use methods::{Tried, all};
use momentum::momentum;
use rayon::prelude::*;
use recipes::{Displacement, floating, recipe, reversed};
use serde_json::Value;

const END: f64 = 0.25;
const SPAN: Span = Span { start: 0.0, end: END, output_step: 0.05 };

fn run(ready: &Ready, method: &Method) -> Result<Record, String> {
    let mut recorder = Recorder::new(ready.system());
    let outcome = simulate(ready.system(), method, SPAN, ready.0.start(), &mut recorder).map_err(|e| e.to_string())?;
    match outcome.failure {
        Some(failure) => Err(format!("{failure:?}")),
        None => Ok(recorder.finish()),
    }
}

/// Largest differences of q and v over all rows.
fn difference(ready: &Ready, a: &Record, b: &Record) -> f64 {
    let n = ready.system().dimensions();
    let rows = a.trajectory.rows.iter().zip(&b.trajectory.rows);
    let off = |(a, b): (&Vec<f64>, &Vec<f64>)| {
        a[1..1 + n.q + n.v].iter().zip(&b[1..]).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
    };
    rows.map(off).fold(0.0, f64::max)
}

/// What the error of a fixed step is at most where its order is what it promises: half the step leaves 2^-p of it, so that it is
/// 2^p/(2^p - 1) of what halving changes; a twentieth for the next order, and what fast swings make of the reference's error.
/// None where steps are chosen or constraints are soft, whose error is no power of the step.
fn most_by_order(tried: &Tried, ready: &Ready, record: &Record) -> Option<f64> {
    let step = tried.method.step.filter(|_| !promises::is_soft(tried))?;
    let halved = run(ready, &Method { step: Some(0.5 * step), ..tried.method.clone() }).ok()?;
    let rest = 0.5f64.powi(tried.entry.order as i32);
    Some(1.05 / (1.0 - rest) * difference(ready, record, &halved) + 1e-8)
}

/// What is wrong with one method on one mechanism.
fn fault(tried: &Tried, ready: &Ready, reference: &Record) -> Option<String> {
    let record = match run(ready, &tried.method) {
        Ok(record) => record,
        Err(reason) => return (!promises::is_known(&reason)).then_some(reason),
    };
    if record.trajectory.rows.iter().flatten().any(|x| !x.is_finite()) {
        return Some("rows that are not finite".to_string());
    }
    let ([motion, energy], [position, velocity]) = (promises::accuracy(tried), promises::drift(tried));
    let error = difference(ready, &record, reference);
    let found = [
        ("motion", error, most_by_order(tried, ready, &record).unwrap_or(motion)),
        ("energy", record.energy.map_or(f64::NAN, |energy| energy.relative_max_error.unwrap()), energy),
        ("position drift", record.drift.position.relative_max, position),
        ("velocity drift", record.drift.velocity.relative_max, velocity),
        ("quaternion norm", norms(&record), 1e-13),
    ];
    let broken = found.iter().filter(|(_, value, most)| value > most || value.is_nan());
    let told: Vec<String> = broken.map(|(name, value, most)| format!("{name} {value:.1e} above {most:.0e}")).collect();
    (!told.is_empty()).then(|| told.join(", "))
}

/// How far quaternions are from norm 1: they are made so after every step, and at rows.
fn norms(record: &Record) -> f64 {
    let starts = record.trajectory.headings();
    let starts = starts.iter().enumerate().filter(|(_, name)| name.ends_with(".qw")).map(|(i, _)| i);
    let rows = &record.trajectory.rows;
    let norm = |i: usize, row: &Vec<f64>| row[i..i + 4].iter().map(|p| p * p).sum::<f64>().sqrt();
    starts.flat_map(|i| rows.iter().map(move |row| (norm(i, row) - 1.0).abs())).fold(0.0, f64::max)
}

fn every_method_keeps_its_promises(numbers: impl Iterator<Item = u64>) {
    for number in numbers {
        let ready = recipe(number).scene();
        let reference = run(&ready, &tight(1e-12)).unwrap();
        let check = |tried: &Tried| fault(tried, &ready, &reference).map(|fault| format!("{}: {fault}", tried.name()));
        let faults: Vec<String> = all().par_iter().filter_map(check).collect();
        assert!(faults.is_empty(), "mechanism {number}, {:?}:\n{}", recipe(number), faults.join("\n"));
    }
}

/// A loop in the plane, and one in space.
#[test]
fn every_method_keeps_its_promises_on_two_mechanisms() {
    assert!(all().len() > 280);
    every_method_keeps_its_promises(2..4);
}

#[test]
#[ignore = "takes minutes"]
fn every_method_keeps_its_promises_on_more_mechanisms() {
    every_method_keeps_its_promises((0..2).chain(4..24));
}

/// Exact on the constraints, and so accurate that the other way to see a scene shows.
fn tight(tolerance: f64) -> Method {
    Method { projection: MethodSpec::named("exact"), ..dop853(tolerance) }
}

#[test]
fn what_floats_keeps_its_momenta() {
    for number in 0..12 {
        let scene = floating(number);
        let ready = parse(&scene.to_string());
        // Errors of a step of 1e-10, and of fourth order.
        let hem4 = Method { step: Some(5e-4), ..named("index2", "hem4") };
        for (method, most) in [(tight(1e-10), 1e-7), (hem4, 1e-5)] {
            let run = ready.run(&method, SPAN);
            let momenta: Vec<Vec<f64>> = (0..run.times().len()).map(|row| momentum(&scene, &run, row)).collect();
            let size = momenta[0].iter().fold(0.0, |size: f64, x| size.max(x.abs()));
            assert!(size > 0.1, "mechanism {number} stands still");
            let linear = scene["dimension"].as_u64().unwrap() as usize;
            for now in &momenta {
                let off: Vec<f64> = now.iter().zip(&momenta[0]).map(|(now, start)| (now - start).abs()).collect();
                // Linear ones to round-off, since all methods keep sums of coordinates; angular ones to the tolerance.
                assert!(off[..linear].iter().all(|off| *off < 1e-11), "mechanism {number}: {off:?}");
                assert!(off[linear..].iter().all(|off| *off < most), "mechanism {number}: {off:?} with {method:?}");
            }
        }
    }
}

fn named(formulation: &str, integrator: &str) -> Method {
    Method {
        formulation: MethodSpec::named(formulation),
        integrator: MethodSpec::named(integrator),
        projection: MethodSpec::named("none"),
        ..Method::default()
    }
}

/// All columns of one run stand in the other, whatever their order.
fn assert_same(number: u64, one: &Run, other: &Run, most: f64) {
    for name in one.record.trajectory.headings() {
        let pairs = one.column(name).into_iter().zip(other.column(name));
        let off = pairs.fold(0.0, |off: f64, (a, b)| off.max((a - b).abs() / (1.0 + a.abs())));
        assert!(off <= most, "mechanism {number}: {name} is off by {off:e}");
    }
}

#[test]
fn the_order_of_a_scene_means_nothing() {
    for number in 0..12 {
        let scene = recipe(number).json();
        // Multipliers of rows that are stated twice are of least norm in either order.
        let [one, other] =
            [scene.clone(), reversed(scene)].map(|scene| parse(&scene.to_string()).run(&tight(1e-11), SPAN));
        // The error of a step grows by the swings to some thousand times.
        assert_same(number, &one, &other, 1e-7);
    }
}

#[test]
fn a_displaced_scene_moves_alike() {
    let displacement = Displacement { angle: 0.7, shift: [3.0, -2.0, 1.5] };
    for number in 0..12 {
        let scene = recipe(number).json();
        let recipe = recipe(number);
        let moved = displacement.scene(scene.clone());
        let [here, there] = [&scene, &moved].map(|scene| parse(&scene.to_string()).run(&tight(1e-11), SPAN));
        for body in (0..recipe.rods).map(|i| format!("rod{i}")) {
            let points = |run: &Run| -> Vec<Vec<f64>> {
                let axes = ["x", "y", "z"][..recipe.dimension].iter();
                let columns: Vec<Vec<f64>> = axes.map(|axis| run.column(&format!("{body}.{axis}"))).collect();
                (0..columns[0].len()).map(|row| columns.iter().map(|column| column[row]).collect()).collect()
            };
            for (here, there) in points(&here).iter().zip(points(&there)) {
                let off = scenes_apart(&displacement.moved(here), &there);
                assert!(off < 1e-7, "mechanism {number}: {body} is off by {off:e}");
            }
        }
    }
}

fn scenes_apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |off: f64, (a, b)| off.max((a - b).abs()))
}

/// Symmetric: with velocities turned round it goes back where it came from, whatever its error.
#[test]
fn rattle_goes_back() {
    for number in (0..12).step_by(2) {
        let ready = parse(&undamped(recipe(number).json()).to_string());
        let method = Method { step: Some(1e-3), ..named("index3", "rattle") };
        let there = ready.run(&method, SPAN).outcome;
        let back: Vec<f64> = there.v.iter().map(|v| -v).collect();
        let mut recorder = Recorder::new(ready.system());
        let home = simulate(ready.system(), &method, SPAN, (&there.q, &back), &mut recorder).unwrap();
        let off = scenes_apart(&home.q, ready.0.start().0);
        // Newton's tolerance of each step, grown by the swings; the error of the method is a thousand times that.
        assert!(off < 1e-8, "mechanism {number}: {off:e}");
    }
}

fn undamped(mut scene: Value) -> Value {
    scene["forces"].as_array_mut().unwrap().iter_mut().for_each(|spring| spring["damping"] = 0.into());
    scene
}

#[test]
fn every_method_repeats_itself_bit_by_bit() {
    for number in [2, 5] {
        let ready = recipe(number).scene();
        let differs = |tried: &Tried| {
            let runs = [(); 2].map(|()| run(&ready, &tried.method).map(|record| record.trajectory.rows));
            (runs[0] != runs[1]).then(|| tried.name())
        };
        let names: Vec<String> =
            all().par_iter().filter(|tried| tried.method.projection.name == "none").filter_map(differs).collect();
        assert!(names.is_empty(), "mechanism {number}: {names:?}");
    }
}
