//! Large displacements against exact and published results.

use crate::absolute_beam::shooting::Rod;
use crate::absolute_beam::statics::{equilibrium, place};
use crate::scenes::{Ready, model, parse};
use holonom::prepared::{Model, Overrides};
use holonom::scene::Scene;
use nalgebra::Vector3;
use std::f64::consts::FRAC_PI_4;

/// A cantilever of length 1 with EI = 1 and a force along y at its tip, in the plane; axial strain is 1e-7 at most.
fn elastica(elements: usize, force: f64) -> Ready {
    parse(&format!(
        r#"{{ "name": "elastica", "dimension": 2, "ground": {{ "markers": {{ "wall": [0, 0] }} }},
        "bodies": [ {{ "name": "rod", "type": "flexible_beam", "frame": "absolute", "length": 1, "elements": {elements},
            "stiffness": {{ "EA": 1e8, "EI": 1 }}, "inertia": {{ "rhoA": 1 }}, "markers": {{ "root": [0, 0], "tip": [1, 0] }} }} ],
        "joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.wall", "rod.root"] }} ],
        "forces": [ {{ "name": "load", "type": "applied_force", "at": "rod.tip", "force": [0, "{force}*t"] }} ] }}"#
    ))
}

/// The tip of the inextensible elastica.
fn exact(force: f64) -> [f64; 2] {
    let [x, y, _] = Rod::slender(1.0, [1.0; 3]).tip([0.0, force, 0.0]);
    [x, y]
}

/// K. Mattiasson, Numerical results from large deflection beam and frame problems analysed by means of elliptic
/// integrals, Int. J. Numer. Meth. Engng. 17 (1981) 145-153, table I: force, shortening and deflection of the tip.
const MATTIASSON: [(f64, f64, f64); 4] =
    [(1.0, 0.05643, 0.30172), (2.0, 0.16064, 0.49346), (4.0, 0.32894, 0.66996), (10.0, 0.55500, 0.81061)];

#[test]
fn the_reference_is_that_of_the_tables() {
    for (force, shortening, deflection) in MATTIASSON {
        let [x, y] = exact(force);
        // Tables are rounded to five digits.
        assert!((1.0 - x - shortening).abs() < 6e-6 && (y - deflection).abs() < 6e-6, "{force}: {x} {y}");
    }
}

#[test]
fn a_cantilever_under_a_tip_force_converges_with_the_fourth_power() {
    for (force, coarse) in [(1.0, 1e-5), (4.0, 2e-4), (10.0, 1.5e-3)] {
        let [x, y] = exact(force);
        let error = |elements: usize| {
            let rod = elastica(elements, force);
            let q = equilibrium(&rod, 20);
            let tip = place(&rod, &q, "rod.tip");
            (tip[0] - x).hypot(tip[1] - y)
        };
        let errors = [4, 8, 16].map(error);
        println!("elastica, force {force}: {errors:?}");
        assert!(errors[0] < coarse, "{force}: {errors:?}");
        // 16 for order 4; 2 rad over four elements are still short of it, axial strain leaves 1e-8.
        let ratios = [errors[0] / errors[1], errors[1] / errors[2]];
        assert!(ratios.iter().all(|ratio| (14.0..17.0).contains(ratio)), "{force}: {errors:?}");
    }
}

/// Where a shipped cantilever has its tip under its whole load, with this many elements.
fn tip(name: &str, beam: &str, elements: usize, parameters: &[(&str, f64)]) -> [f64; 3] {
    let text =
        std::fs::read_to_string(model(name)).unwrap().replace("\"elements\": 8", &format!("\"elements\": {elements}"));
    let set: Vec<_> =
        parameters.iter().chain(&[("t_load", 1.0)]).map(|(name, x)| (name.to_string(), (*x).into())).collect();
    let scene = Scene::parse(&text, &set).unwrap_or_else(|error| panic!("{error}"));
    let ready = Ready(Model::new(scene, &Overrides::default()).unwrap_or_else(|error| panic!("{error}")));
    place(&ready, &equilibrium(&ready, 10), &format!("{beam}.tip"))
}

fn gap(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

/// Bathe's bend: the elements turn about axes that are not those of the section, and converge with the second power.
#[test]
fn bathes_bend_converges_to_its_shooting() {
    let bend = Rod {
        length: 100.0 * FRAC_PI_4,
        forces: Vector3::new(1e7, 5e6 / 1.2, 5e6 / 1.2),
        moments: Vector3::repeat(1e7 / 12.0),
        curvature: Vector3::new(0.0, 0.0, 0.01),
    };
    for load in [300.0, 450.0, 600.0] {
        let exact = bend.tip([0.0, 0.0, load]);
        let errors = [4, 8, 16, 32].map(|elements| gap(tip("bathe_bend", "bend", elements, &[("load", load)]), exact));
        println!("Bathe's bend, {load}: {exact:.5?} {errors:?}");
        let orders = [0, 1, 2].map(|i| (errors[i] / errors[i + 1]).log2());
        assert!(orders.iter().all(|order| (order - 2.0).abs() < 0.12), "{load}: {orders:?}");
        assert!(errors[3] < 1.4e-3, "{load}: {errors:?}");
    }
}

/// The Princeton beam: bent in one plane as the elastica, with the fourth power; bent both ways and twisted by it with the
/// second.
#[test]
fn princeton_beam_converges_to_its_shooting() {
    let blade = Rod::rectangle(0.508, [12.3777e-3, 3.2024e-3], [71.7e9, 0.31]);
    for (load, degrees) in
        [4.448, 8.896, 13.345].into_iter().flat_map(|load| [0.0f64, 30.0, 60.0, 90.0].map(|d| (load, d)))
    {
        let loading = degrees.to_radians();
        let exact = blade.tip([0.0, load * loading.cos(), load * loading.sin()]);
        let errors = [4, 8, 16].map(|elements| {
            gap(tip("princeton_beam", "blade", elements, &[("load", load), ("loading", loading)]), exact)
        });
        println!("Princeton beam, {load} at {degrees}: {exact:.6?} {errors:?}");
        assert!(errors[2] < 2.5e-5, "{load} at {degrees}: {errors:?}");
        if degrees % 90.0 == 0.0 {
            assert!(errors[2] < 4e-8, "{load} at {degrees}: {errors:?}");
        } else {
            let orders = [0, 1].map(|i| (errors[i] / errors[i + 1]).log2());
            assert!(orders.iter().all(|order| (order - 2.0).abs() < 0.05), "{load} at {degrees}: {orders:?}");
        }
    }
}
