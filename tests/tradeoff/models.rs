//! What models cost.

use crate::common::readings;
use crate::scenes::model;
use holonom::prepared::{Model, Overrides};
use holonom::study::work_precision::models::{ModelCost, ModelCosts, Variant, compare};

fn variant(name: &str, set: &[(&str, f64)], until: f64) -> Variant {
    let set = set.iter().map(|(name, value)| (name.to_string(), (*value).into())).collect();
    let overrides = Overrides { set, until: Some(until), ..Overrides::default() };
    Variant {
        name: name.to_string(),
        prepared: Model::load_with(&model(name), &overrides).unwrap(),
        source: Some((model(name), overrides)),
    }
}

fn costs(variants: &[Variant], outputs: &[&str]) -> ModelCosts {
    let outputs: Vec<String> = outputs.iter().map(|name| name.to_string()).collect();
    compare(variants, &outputs, 1, readings(600_000), |_, _| ()).unwrap()
}

/// Rods without mass against rods as bodies: the wheel moves alike to a per cent, the rods' forces to a few.
#[test]
fn rods_without_mass_are_cheaper_and_nearly_as_good() {
    let variants = ["five_link_suspension", "five_link_suspension_rods"].map(|name| variant(name, &[], 0.6));
    let costs = costs(&variants, &["wheel_travel", "rod4_force"]);
    assert_eq!(costs.richest, 1);
    let [massless, bodies] = &costs.models[..] else { panic!() };
    assert_eq!((massless.velocities, bodies.velocities), (7, 37));
    assert!(bodies.outputs.iter().all(|output| output.max == 0.0));
    let [travel, force] = &massless.outputs[..] else { panic!() };
    assert!(travel.max > 1e-4 && travel.max < 0.02 && travel.rms < travel.max, "{travel:?}");
    assert!(force.max > travel.rms && force.max < 0.05, "{force:?}");
    // 7 coordinates against 37, and fewer steps: the rods' own oscillations are gone.
    let work = |model: &ModelCost| model.statistics.rhs_evaluations * model.velocities as u64;
    assert!(5 * work(massless) < work(bodies), "{} {}", work(massless), work(bodies));
    assert!(massless.seconds().unwrap() > 0.0 && bodies.seconds().unwrap() > 0.0);
    assert!(massless.numerical_error.unwrap() < 1e-5);
}

/// The deflection over 2, 4 and 8 elements tends to that of 16.
#[test]
fn more_elements_come_nearer_to_the_richest() {
    let of = |n: f64| variant("flexible_slider_crank_fe", &[("n", n)], 0.01);
    let variants = [2.0, 4.0, 8.0, 16.0].map(of);
    let costs = costs(&variants, &["deflection"]);
    assert_eq!(costs.richest, 3);
    let errors: Vec<f64> = costs.models.iter().map(|model| model.error().unwrap()).collect();
    // Of order four: a factor of 16 asymptotically, less where two elements are still coarse.
    assert!(errors[0] > 5.0 * errors[1] && errors[1] > 8.0 * errors[2] && errors[2] > 0.0, "{errors:?}");
    // Twice the mesh of the richest changes it by less than a half of what the next poorer one is off.
    let (uncertainty, output) = costs.uncertainty().unwrap();
    assert_eq!(costs.finer.velocities, Some(2 * costs.models[3].velocities - 7), "{:?}", costs.finer);
    assert!(output == "deflection" && uncertainty < 0.5 * errors[2] && uncertainty > 0.0, "{uncertainty} {errors:?}");
}

/// A rod of one element: with two its outputs change by per cents.
#[test]
fn a_richest_model_that_is_poor_is_found_out() {
    let variants =
        [variant("flexible_slider_crank_fe", &[("n", 1.0)], 0.01), variant("flexible_slider_crank_rigid", &[], 0.01)];
    let costs = costs(&variants, &[]);
    assert!(costs.uncertainty().unwrap().0 > 0.01, "{:?}", costs.finer);
}

#[test]
fn models_without_common_outputs_are_refused() {
    let variants = ["five_link_suspension", "two_mass"].map(|name| variant(name, &[], 0.1));
    let camber = ["camber".to_string()];
    let error = compare(&variants, &camber, 1, readings(1), |_, _| ()).err().unwrap().to_string();
    assert!(error.contains("none of the outputs to compare"), "{error}");
    let error = compare(&variants[..1], &[], 1, readings(1), |_, _| ()).err().unwrap().to_string();
    assert!(error.contains("only one model"), "{error}");
}
