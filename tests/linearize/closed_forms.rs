//! Linear models whose eigenvalues have a formula.

use crate::linearize::models::{model, values};
use crate::linearize::reference::distance;
use crate::linearize::systems::{FourBar, TwoMass};
use holonom::linearize::{Chart, Complex, Kind, State, Variation, transition};
use holonom::math::Scalar;
use holonom::system::Equations;
use std::f64::consts::TAU;

const GRAVITY: f64 = 9.81;

fn pair(re: f64, im: f64) -> [Complex<f64>; 2] {
    [Complex::new(re, im), Complex::new(re, -im)]
}

#[test]
fn two_masses_with_a_damper() {
    let mut variation = Variation::new(&TwoMass { c1: 2.0 }, 0.0, &[0.0, 1.0], &[0.0; 2]).unwrap();
    let known = pair(-0.25, (25.0f64 - 1.0 / 16.0).sqrt());
    for method in ["mcs", "rcs", "rcs:form=index1", "baumgarte", "force_projection", "baumgarte:projected=yes"] {
        let found = model(&mut variation, method, None);
        let off = distance(&values(&found, Kind::Physical), &known);
        // A matrix of four rows with entries of 100: 1e-14, a little more beside a defective pair.
        assert!(off < 1e-12, "{method}: {off:e}");
    }
}

/// A rhombus at crank angle p: one degree of freedom, whose equation is (5/3) p'' + c1 sin(p/2)^2 p' + V'(p) = 0.
#[test]
fn the_rhombus_at_any_state_has_the_equation_of_its_crank_angle() {
    for (p, rate, c1) in [(1.1, 2.5, 0.0), (1.1, 2.5, 0.5), (0.4, -3.0, 2.0), (2.3, 0.0, 1.0), (1.9, 10.0, 0.0)] {
        let system = FourBar { l0: 2f64.sqrt(), c1 };
        let (q, v) = rhombus(p, rate);
        let mut variation = Variation::new(&system, 0.0, &q, &v).unwrap();
        // The crank angle is the arc length, in the metric of the kinetic energy, up to a factor: the intrinsic chart.
        let found = model(&mut variation, "mcs", Some(Chart::Intrinsic));
        let [stiffness, damping] = crank_angle(p, rate, c1);
        let root = Complex::new(damping * damping / 4.0 - stiffness, 0.0).sqrt();
        let known = [root - damping / 2.0, -root - damping / 2.0];
        let off = distance(&values(&found, Kind::Physical), &known);
        assert!(off < 1e-11, "{p} {rate} {c1}: {off:e}");
    }
}

/// (C, D), the velocities.
pub fn rhombus(p: f64, rate: f64) -> ([f64; 4], [f64; 4]) {
    let (sin, cos) = p.sin_cos();
    ([cos, sin, 1.0 + cos, sin], [-sin * rate, cos * rate, -sin * rate, cos * rate])
}

/// K and C over the inertia 5/3, l0 = sqrt 2.
pub fn crank_angle(p: f64, rate: f64, c1: f64) -> [f64; 2] {
    let (sin, cos) = (0.5 * p).sin_cos();
    let stretch = 2.0 * cos - 2f64.sqrt();
    let bend = -2.0 * GRAVITY * p.sin() + 100.0 * sin * sin - 100.0 * stretch * 0.5 * cos;
    [(bend + c1 * sin * cos * rate) / (5.0 / 3.0), c1 * sin * sin / (5.0 / 3.0)]
}

/// A unit mass on a unit rod about a point, in space.
pub struct Spherical;

impl Equations for Spherical {
    fn size(&self) -> (usize, usize) {
        (3, 1)
    }
    fn mass<S: Scalar>(&self, _: S, _: &[S], mass: &mut [S]) {
        mass.fill(S::zero());
        (0..3).for_each(|i| mass[4 * i] = S::one());
    }
    fn force<S: Scalar>(&self, _: S, _: &[S], _: &[S], f: &mut [S]) {
        f.copy_from_slice(&[S::zero(), S::zero(), S::constant(-GRAVITY)]);
    }
    fn phi<S: Scalar>(&self, _: S, q: &[S], phi: &mut [S]) {
        phi[0] = (q[0].square() + q[1].square() + q[2].square() - 1.0) * 0.5;
    }
}

/// Circling at 60 degrees, where omega^2 = g / (l cos 60).
fn circling() -> (State, f64) {
    let (sin, cos) = (TAU / 6.0).sin_cos();
    let omega = (GRAVITY / cos).sqrt();
    (State { t: 0.0, q: vec![sin, 0.0, -cos], v: vec![0.0, omega * sin, 0.0] }, omega)
}

/// The frozen intrinsic operator sees g cos 60 both ways, and the curvature of the sphere, v^2 = omega^2 sin^2, across the
/// motion. It says nothing about stability: see the next test.
#[test]
fn the_conical_pendulum_in_the_intrinsic_chart() {
    let (State { t, q, v }, omega) = circling();
    let mut variation = Variation::new(&Spherical, t, &q, &v).unwrap();
    let found = model(&mut variation, "mcs", Some(Chart::Intrinsic));
    let known: Vec<_> = [omega, (GRAVITY / 2.0).sqrt()].into_iter().flat_map(|w| pair(0.0, w)).collect();
    let off = distance(&values(&found, Kind::Physical), &known);
    assert!(off < 1e-12, "{off:e}");
}

/// Over a turn small changes come back times exp(+-i w T), w = omega sqrt(1 + 3 cos(60)^2) = 5.8596/s, and times 1 twice:
/// along the orbit, and to orbits beside it that take another time.
#[test]
fn the_conical_pendulum_has_its_floquet_multipliers() {
    let (state, omega) = circling();
    let period = TAU / omega;
    let chart = Chart::parse("q1,q2");
    let found = transition(&Spherical, &state, &chart, &[period]).unwrap();
    let multipliers = found[0].matrix(&Spherical, &chart).unwrap().complex_eigenvalues();
    let w = omega * 1.75f64.sqrt();
    assert!((w - 5.859607495387).abs() < 1e-11);
    let known = [Complex::from_polar(1.0, w * period), Complex::from_polar(1.0, -w * period), 1.0.into(), 1.0.into()];
    let off = distance(multipliers.as_slice(), &known);
    // The double 1 is defective and spreads as the root of what the integration leaves, 1e-11.
    assert!(off < 1e-4, "{multipliers}");
    let nearest = multipliers.iter().map(|x| (x - known[0]).norm()).fold(f64::INFINITY, f64::min);
    assert!(nearest < 1e-9, "{nearest:e}: {multipliers}");
}
