//! A few modes by sparse methods against all modes of dense ones.

use crate::linearize::reference::distance;
use holonom::linearize::{Chart, Complex, Linear, LinearModel, Matrix, State, Variation, at_rest, modal};
use holonom::method_spec::MethodSpec;
use holonom::prepared::{Model, Overrides};
use holonom::scene::{Scene, generate};
use nalgebra::DMatrix;
use std::path::Path;

type C = Complex<f64>;

fn prepared(name: &str, set: &[(&str, f64)]) -> Model {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("models").join(format!("{name}.json"));
    let set = set.iter().map(|(name, value)| (name.to_string(), (*value).into())).collect();
    Model::load_with(&path, &Overrides { set, ..Overrides::default() }).unwrap()
}

/// LociVariable gravity.
fn hanging_chain(links: usize) -> Model {
    let mut scene = generate::flexible_chain(links);
    scene["gravity"] = serde_json::json!([9.81, 0]);
    Model::new(Scene::parse(&scene.to_string(), &[]).unwrap(), &Overrides::default()).unwrap()
}

fn start(prepared: &Model) -> State {
    let (q, v) = prepared.start();
    State { t: prepared.start_time(), q: q.to_vec(), v: v.to_vec() }
}

fn rest(prepared: &Model) -> State {
    at_rest(prepared, &start(prepared)).unwrap().state
}

fn dense(variation: &mut Variation) -> LinearModel {
    variation.linearize(&Linear { method: MethodSpec::named("mcs"), chart: Some(Chart::Frozen) }).unwrap()
}

/// Those with im >= 0, the double zeros of rigid bodies left out, which are known to the root of rounding.
fn upper(model: &LinearModel, largest: f64) -> Vec<C> {
    let values = model.modes.iter().map(|mode| mode.value);
    values.filter(|value| value.im >= 0.0 && value.norm() > 1e-7 * largest).collect()
}

fn nearest(mut all: Vec<C>, shift: C, count: usize) -> Vec<C> {
    all.sort_by(|a, b| (a - shift).norm().total_cmp(&(b - shift).norm()));
    all.truncate(count);
    all
}

fn response(model: &LinearModel, s: C) -> DMatrix<C> {
    let complex = |matrix: &Matrix| matrix.map(C::from);
    let size = model.a.nrows();
    let states = DMatrix::<C>::identity(size, size) * s - complex(&model.a);
    complex(&model.c) * states.lu().solve(&complex(&model.b)).unwrap() + complex(&model.d)
}

/// Of all outputs to all inputs.
fn gap(a: &LinearModel, b: &LinearModel, s: C) -> f64 {
    let a = response(a, s);
    let b = response(b, s);
    (&a - &b).norm() / b.norm().max(f64::MIN_POSITIVE)
}

/// The `count` modes at `shift` are the nearest of all.
fn check(prepared: &Model, state: &State, count: usize, shift: f64) {
    let mut variation = state.variation(prepared).unwrap();
    let shift = C::new(0.0, shift);
    let model =
        modal(&mut variation, count, shift).unwrap_or_else(|error| panic!("{} {count}: {error}", prepared.name));
    let full = dense(&mut variation);
    let largest = full.modes.iter().map(|mode| mode.value.norm()).fold(0.0, f64::max);
    let found = upper(&model, largest);
    let all = upper(&full, largest);
    let off = if found.is_empty() { 0.0 } else { distance(&found, &nearest(all.clone(), shift, found.len())) };
    println!("{} {count} modes at {shift}: {off:e}", prepared.name);
    assert!(off < 1e-8, "{} {count} modes at {shift}: {off:e} {found:?} {all:?}", prepared.name);
    let a = &model.a;
    let pairs = model.modes.iter().filter(|mode| mode.value.im != 0.0).count();
    let of_inputs: usize = model.orders.iter().sum();
    assert!(model.modes.len() + of_inputs == a.nrows() && model.states.len() == a.nrows() && pairs % 2 == 0);
    assert!(model.modes.iter().all(|mode| (mode.energy.iter().sum::<f64>() - 1.0).abs() < 1e-9));
}

#[test]
fn the_modes_are_the_nearest_of_all() {
    let at_rest = ["five_link_suspension_rods", "quarter_car", "parallelogram_redundant", "bricard", "andrews"];
    let more = ["right_angle_cantilever", "flexible_four_bar", "full_axle", "pid_arm", "hydraulic_boom"];
    for name in at_rest.into_iter().chain(more) {
        let prepared = prepared(name, &[]);
        let at = rest(&prepared);
        for (count, shift) in [(1, 0.0), (3, 0.0), (3, 50.0), (12, 0.0)] {
            check(&prepared, &at, count, shift);
        }
    }
    for count in [1, 5, 20] {
        let prepared = hanging_chain(10);
        let at = rest(&prepared);
        check(&prepared, &at, count, 0.0);
        check(&prepared, &at, count, 300.0);
    }
}

/// Also where the frozen pencil has a term of its own for moving rotations.
#[test]
fn the_frozen_modes_of_moving_states() {
    for name in [
        "spinning_top",
        "flexible_slider_crank_fe",
        "flexible_four_bar",
        "double_pendulum",
        "andrews",
        "bricard",
        "pid_arm",
    ] {
        let prepared = prepared(name, &[]);
        let at = prepared.states_at(&[prepared.start_time() + 0.003]).unwrap().remove(0);
        check(&prepared, &at, 3, 40.0);
        check(&prepared, &at, 200, 0.0);
    }
}

/// Three double zeros without vectors of their own.
#[test]
fn a_free_beam_has_rigid_modes() {
    let prepared = prepared("flying_spaghetti", &[("force", 0.0), ("torque", 0.0)]);
    for count in [2, 3, 5, 30] {
        check(&prepared, &start(&prepared), count, 0.0);
    }
    let mut variation = start(&prepared).variation(&prepared).unwrap();
    let model = modal(&mut variation, 3, C::ZERO).unwrap();
    assert_eq!(model.states, ["shared1", "shared2", "shared3", "shared4", "shared5", "shared6"]);
    assert!((&model.a * &model.a).amax() < 1e-10, "{}", model.a);
}

/// With all modes at every frequency; with a few at low ones, since D makes up for the rest.
#[test]
fn the_response_is_that_of_all_modes() {
    for (name, moving) in
        [("quarter_car", false), ("andrews", true), ("five_link_suspension_rods", false), ("hydraulic_boom", false)]
    {
        let prepared = prepared(name, &[]);
        let at = if moving { start(&prepared) } else { rest(&prepared) };
        let mut variation = at.variation(&prepared).unwrap();
        let full = dense(&mut variation);
        let all = modal(&mut variation, 1000, C::ZERO).unwrap();
        let one = modal(&mut variation, 1, C::ZERO).unwrap();
        let slow = one.modes[0].value.norm();
        for s in [1e-3, 0.3, 1.0, 7.0, 100.0].map(|part| C::new(0.0, part * slow)) {
            let off = gap(&all, &full, s);
            assert!(off < 1e-9, "{name} {s}: {off:e}");
        }
        let off = [0.0, 1e-2].map(|part| gap(&one, &full, C::new(0.0, part * slow)));
        println!("{name}: {off:?}");
        // To second order for pairs, to first for real eigenvalues.
        let order = if one.modes[0].value.im == 0.0 { 1 } else { 2 };
        assert!(off[0] < 1e-9 && off[1] < 1e-2f64.powi(order), "{name}: {off:?}");
    }
}

#[test]
fn what_cannot_be_had_is_told() {
    let prepared = prepared("quarter_car", &[]);
    let mut variation = start(&prepared).variation(&prepared).unwrap();
    let error =
        |count: usize, shift: C, variation: &mut Variation| modal(variation, count, shift).unwrap_err().to_string();
    assert!(error(0, C::ZERO, &mut variation).contains("at modes"));
    assert!(error(1, C::new(f64::NAN, 0.0), &mut variation).contains("at shift"));
    assert_eq!(modal(&mut variation, usize::MAX / 4, C::ZERO).unwrap().modes.len(), 4);
    let shaft = self::prepared("universal_shaft", &[]);
    let mut variation = start(&shaft).variation(&shaft).unwrap();
    assert!(error(1, C::ZERO, &mut variation).contains("no degree of freedom"));
}
