//! The same states in the shipped scenes, which have other coordinates and constraints: bodies with angles and joints.

use crate::linearize::closed_forms::crank_angle;
use crate::linearize::models::{model, values};
use crate::linearize::reference::{Reference, distance, spectrum};
use crate::scenes::{Ready, shipped};
use holonom::initial::{Stability, assemble, equilibrium};
use holonom::linearize::{Chart, Complex, Kind, State, Variation, at_rest};

/// Methods that are exact at an equilibrium, without a root of their own near the values here.
const EXACT: [&str; 8] = [
    "mcs",
    "rcs",
    "rcs:form=index2",
    "rcs:form=index1",
    "rcs:form=ggl,solver=gsvd",
    "rcs:solver=qz",
    "baumgarte:alpha=7,beta=30",
    "force_projection:alpha=7,beta=30",
];

fn start(scene: &Ready) -> State {
    let (q, v) = scene.0.start();
    State { t: 0.0, q: q.to_vec(), v: v.to_vec() }
}

fn pair(im: f64) -> [Complex<f64>; 2] {
    [Complex::new(0.0, im), Complex::new(0.0, -im)]
}

/// All exact methods at the equilibrium beside the start. 1e-9: the equilibrium is known to rounding times the condition
/// of its equations.
fn at_equilibrium(name: &str, set: &[(&str, f64)], known: &[Complex<f64>]) {
    let scene = shipped(name, set);
    let state = at_rest(&scene.0, &start(&scene)).unwrap().state;
    let mut variation = state.variation(&scene.0).unwrap();
    assert!(variation.point.is_equilibrium, "{name}");
    for method in EXACT {
        let off = distance(&values(&model(&mut variation, method, None), Kind::Physical), known);
        println!("{name} {method}: {off:.1e}");
        assert!(off < 1e-9, "{name} {method}: {off:e}");
    }
}

#[test]
fn equilibria_of_two_masses_and_of_the_rhombus() {
    at_equilibrium("two_mass", &[], &pair(5.0));
    let im = (25.0f64 - 1.0 / 16.0).sqrt();
    at_equilibrium("two_mass", &[("c1", 2.0)], &[Complex::new(-0.25, im), Complex::new(-0.25, -im)]);
    at_equilibrium("four_bar_spring", &[("p0", 1.5)], &pair(4.269426190953534));
    at_equilibrium("four_bar_spring", &[("p0", 1.9), ("l0", 1.2)], &pair(5.67328934055621));
}

#[test]
fn the_double_pendulum_hangs() {
    let roots = [2.0 - 2f64.sqrt(), 2.0 + 2f64.sqrt()].map(|factor| (9.81 * factor).sqrt());
    assert!((roots[0] - 2.3971994).abs() < 1e-7 && (roots[1] - 5.7873513).abs() < 1e-7);
    let known: Vec<_> = roots.into_iter().flat_map(pair).collect();
    at_equilibrium("double_pendulum", &[("theta1_0", 0.1), ("theta2_0", -0.1)], &known);
}

/// Angles of the IVP test set as parameters of the scene.
const ANGLES: [&str; 7] = ["beta0", "Theta0", "gamma0", "Phi0", "delta0", "Omega0", "epsilon0"];

#[test]
fn equilibria_of_the_squeezer() {
    let near: Vec<f64> =
        Reference::read("andrews_E1").vector("q").iter().map(|q| (q * 100.0).round() / 100.0).collect();
    let set: Vec<_> = ANGLES.into_iter().zip(near).collect();
    at_equilibrium("andrews", &set, &pair(424.561770726283));
    // Near the start of the scene, a little below a full turn.
    let rate = 477.911263953425;
    at_equilibrium("andrews", &[("beta0", -0.12)], &[rate.into(), (-rate).into()]);
    for (set, beta, stability) in [
        (set.as_slice(), 3.2842086559639533, Stability::Stable),
        (&[("beta0", -0.12)], 6.15862162029083, Stability::Unstable),
    ] {
        let scene = shipped("andrews", set);
        let found = equilibrium(scene.system(), 0.0, scene.0.start()).unwrap();
        let angle = scene.system().facts().names.q.iter().position(|name| name == "K1.angle").unwrap();
        let turns = (found.q[angle] - beta) / std::f64::consts::TAU;
        assert!((turns - turns.round()).abs() < 1e-12, "{beta}: {}", found.q[angle]);
        assert_eq!(found.stability, stability);
    }
}

/// Moving, the intrinsic chart does not depend on the coordinates, nor do those of an angle that both have.
#[test]
fn moving_rhombus() {
    let reference = Reference::read("four_bar_N1");
    let scene = shipped("four_bar_spring", &[("p0", 1.1), ("w0", 2.5)]);
    let mut variation = start(&scene).variation(&scene.0).unwrap();
    let charts = reference.0["charts"].as_array().unwrap();
    // The centre of the crank is half of C.
    let known = [
        ("intrinsic", &reference.0["covariant"]["eigenvalues"]),
        ("crank.angle", &reference.0["covariant"]["eigenvalues"]),
        ("crank.x", &charts.iter().find(|c| c["independent_coordinates"][0] == "xC").unwrap()["eigenvalues"]),
        ("crank.y", &charts.iter().find(|c| c["independent_coordinates"][0] == "yC").unwrap()["eigenvalues"]),
    ];
    for (chart, known) in known {
        for method in ["mcs", "baumgarte:projected=yes", "force_projection:projected=yes"] {
            let found = model(&mut variation, method, Some(Chart::parse(chart)));
            let off = distance(&values(&found, Kind::Physical), &spectrum(known));
            println!("{chart} {method}: {off:.1e}");
            assert!(off < 1e-9, "{chart} {method}: {off:e}");
        }
    }
}

#[test]
fn rhombus_by_its_crank_angle() {
    for (p, rate, c1) in [(1.1, 2.5, 0.5), (0.7, -4.0, 3.0), (2.0, 6.0, 0.0)] {
        let scene = shipped("four_bar_spring", &[("p0", p), ("w0", rate), ("c1", c1)]);
        let mut variation = start(&scene).variation(&scene.0).unwrap();
        let found = model(&mut variation, "mcs", Some(Chart::parse("crank.angle")));
        let [stiffness, damping] = crank_angle(p, rate, c1);
        let off = [found.a[(0, 0)], found.a[(0, 1)] - 1.0, found.a[(1, 0)] + stiffness, found.a[(1, 1)] + damping];
        // Entries of the order of 10 to 100.
        assert!(off.iter().all(|x| x.abs() < 1e-10), "{p} {rate} {c1}: {off:?}");
    }
}

#[test]
fn moving_squeezer() {
    let reference = Reference::read("andrews_t010");
    let set: Vec<_> = ANGLES.into_iter().zip(reference.vector("q")).collect();
    let scene = shipped("andrews", &set);
    let system = scene.system();
    let (q, v) = scene.0.start();
    let mut v = v.to_vec();
    let angle = system.facts().names.v.iter().position(|name| name.starts_with("K1.angle") || name == "K1.w").unwrap();
    v[angle] = reference.vector("v")[0];
    let moving = assemble(system, 0.0, (q, &v), &["K1.angle".to_string()]).unwrap();
    let mut variation = Variation::new(system, 0.0, &moving.q, &moving.v).unwrap();
    let beta = &reference.0["charts"].as_array().unwrap()[0];
    assert_eq!(beta["independent_coordinates"][0], "beta");
    for (chart, known) in [("intrinsic", &reference.0["covariant"]["eigenvalues"]), ("K1.angle", &beta["eigenvalues"])]
    {
        let found = values(&model(&mut variation, "mcs", Some(Chart::parse(chart))), Kind::Physical);
        let off = distance(&found, &spectrum(known));
        println!("{chart}: {off:.1e}");
        assert!(off < 1e-9, "{chart}: {off:e}");
    }
}
