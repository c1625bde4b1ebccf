//! Motions whose transition matrices have a formula.

use super::{carried, models};
use crate::linearize::closed_forms::Spherical;
use crate::linearize::reference::distance;
use crate::scenes::parse;
use holonom::linearize::{Changes, Complex, Matrix, State};
use holonom::math::Scalar;
use holonom::system::Equations;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const GRAVITY: f64 = 9.81;

/// A unit mass about a centre of attraction 1/r^2, in the plane.
struct Satellite;

impl Equations for Satellite {
    fn size(&self) -> (usize, usize) {
        (2, 0)
    }
    fn mass<S: Scalar>(&self, _: S, _: &[S], mass: &mut [S]) {
        mass.copy_from_slice(&[S::one(), S::zero(), S::zero(), S::one()]);
    }
    fn force<S: Scalar>(&self, _: S, q: &[S], _: &[S], f: &mut [S]) {
        let distance = (q[0].square() + q[1].square()).sqrt();
        let cube = distance.square() * distance;
        f.copy_from_slice(&[-(q[0] / cube), -(q[1] / cube)]);
    }
    fn phi<S: Scalar>(&self, _: S, _: &[S], _: &mut [S]) {}
}

/// Clohessy and Wiltshire, J. Aerospace Sci. 27 (1960) 653-658: x away from the centre, y along the orbit, in axes that
/// turn at n. Over a period only y changes: by -12 pi x - 6 pi/n y'.
#[test]
fn a_circular_orbit_has_the_transition_of_clohessy_and_wiltshire() {
    let radius = 1.3;
    let n = 0.674_660_014_851_560_9_f64;
    let start = State { t: 0.0, q: vec![radius, 0.0], v: vec![0.0, n * radius] };
    for part in [0.25, 0.6, 1.0] {
        let angle = TAU * part;
        let (s, c) = angle.sin_cos();
        let found = models(&Satellite, &start, "intrinsic", (angle / n, 13));
        // The states at the start of a unit of dx, dy, dx', dy' in inertial axes.
        let unit = Matrix::identity(4, 4);
        let all = Changes { q: unit.rows(0, 2).clone_owned(), v: unit.rows(2, 2).clone_owned() };
        let first = found.models[0].frame.as_ref().unwrap().coordinates.states_of(&all);
        let Changes { q, v } = carried(&found);
        let mut inertial = Matrix::zeros(4, 4);
        inertial.rows_mut(0, 2).copy_from(&(q * &first));
        inertial.rows_mut(2, 2).copy_from(&(v * &first));
        #[rustfmt::skip]
        let relative = Matrix::from_row_slice(4, 4, &[
            4.0 - 3.0 * c, 0.0, s / n, 2.0 / n * (1.0 - c),
            6.0 * (s - angle), 1.0, -2.0 / n * (1.0 - c), (4.0 * s - 3.0 * angle) / n,
            3.0 * n * s, 0.0, c, 2.0 * s,
            -6.0 * n * (1.0 - c), 0.0, -2.0 * s, 4.0 * c - 3.0,
        ]);
        // Inertial velocities are those of the turning axes and n x r, all in axes turned by the angle.
        let mut to_inertial = Matrix::identity(4, 4);
        (to_inertial[(2, 1)], to_inertial[(3, 0)]) = (-n, n);
        let mut turned = Matrix::zeros(4, 4);
        for i in [0, 2] {
            turned.view_mut((i, i), (2, 2)).copy_from_slice(&[c, s, -s, c]);
        }
        let known = turned * &to_inertial * relative * to_inertial.try_inverse().unwrap();
        let off = (&inertial - &known).amax() / known.amax();
        assert!(off < 1e-10, "{part}: {off:e}\n{inertial}{known}");
        assert!(found.measured.iter().all(|measured| measured.error < 1e-8), "{:?}", found.measured);
    }
}

/// A unit mass on a unit rod in the plane.
pub struct Pendulum;

impl Equations for Pendulum {
    fn size(&self) -> (usize, usize) {
        (2, 1)
    }
    fn mass<S: Scalar>(&self, _: S, _: &[S], mass: &mut [S]) {
        mass.copy_from_slice(&[S::one(), S::zero(), S::zero(), S::one()]);
    }
    fn force<S: Scalar>(&self, _: S, _: &[S], _: &[S], f: &mut [S]) {
        f.copy_from_slice(&[S::zero(), S::constant(-GRAVITY)]);
    }
    fn phi<S: Scalar>(&self, _: S, q: &[S], phi: &mut [S]) {
        phi[0] = (q[0].square() + q[1].square() - 1.0) * 0.5;
    }
}

/// At rest at an angle.
pub fn released(angle: f64) -> State {
    State { t: 0.0, q: vec![angle.sin(), -angle.cos()], v: vec![0.0; 2] }
}

/// In (theta, theta') the monodromy from (a, 0) is [[1, 0], [g/l sin a dT/da, 1]], and the intrinsic coordinate is the
/// arc l theta. Numbers by elliptic functions, for a = 1.5.
#[test]
fn a_pendulum_has_its_transition_matrices() {
    let start = released(1.5);
    let period = 2.330_986_782_141_291;
    let found = models(&Pendulum, &start, "intrinsic", (period, 9));
    let near = |phi: &Matrix, known: [f64; 4]| (phi - Matrix::from_row_slice(2, 2, &known)).amax();
    let off = near(&found.whole().unwrap(), [1.0, 0.0, 4.899_555_044_572_052, 1.0]);
    assert!(off < 1e-9, "{off:e}");
    assert!((found.closure.as_ref().unwrap()[(0, 0)] - 1.0).abs() < 1e-12);
    let quarter = models(&Pendulum, &start, "intrinsic", (0.25, 4)).whole().unwrap();
    let known = [0.963_164_965_768_070_7, 0.245_903_214_296_972_8, -0.412_181_153_247_199_93, 0.933_010_814_847_550_2];
    assert!(near(&quarter, known) < 1e-11, "{quarter}");
    let four = models(&Pendulum, &start, "intrinsic", (4.0, 30)).whole().unwrap();
    let known = [-3.807_604_935_105_062, -0.423_113_136_548_449_2, -0.601_319_377_019_415, -0.329_452_805_388_345];
    assert!(near(&four, known) < 1e-10, "{four}");
}

/// A(t) of the pendulum in its arc is [[0, 1], [-g/l cos theta, 0]], and the mean of two points is off by h^2/8 A''.
#[test]
fn a_pendulum_has_its_a_along_the_motion() {
    let found = models(&Pendulum, &released(2.0), "intrinsic", (2.0, 21));
    for model in &found.models {
        let known = GRAVITY * model.point.q[1];
        assert!((model.a[(1, 0)] - known).abs() < 1e-10 && model.a[(0, 1)] == 1.0, "{}", model.a);
        assert!(model.a[(0, 0)].abs() + model.a[(1, 1)].abs() < 1e-12, "{}", model.a);
    }
    let error =
        |found: &holonom::linearize::Along| found.deviations.iter().find(|found| found.of == "A").unwrap().error;
    let finer = models(&Pendulum, &released(2.0), "intrinsic", (2.0, 41));
    let ratio = error(&found) / error(&finer);
    assert!((ratio - 4.0).abs() < 0.3, "{ratio}");
    assert!(found.measured.iter().all(|measured| measured.error < 1e-9), "{:?}", found.measured);
}

/// Of many intervals some are measured, evenly spread: the error is still h^2/8 A''.
#[test]
fn a_long_motion_is_measured_in_parts() {
    let [few, many] = [101, 501].map(|count| models(&Pendulum, &released(2.0), "intrinsic", (2.0, count)));
    let ratio = few.deviations[0].error / many.deviations[0].error;
    assert!((ratio / 25.0 - 1.0).abs() < 0.02 && many.models.len() == 501, "{ratio}");
    assert!((few.deviations[0].t - many.deviations[0].t).abs() < 0.03, "{:?} {:?}", few.deviations, many.deviations);
    assert!((few.whole().unwrap() - many.whole().unwrap()).amax() < 1e-10);
}

/// A pendulum hung on a support that moves as A cos(W t): theta'' + (g - A W^2 cos(W t))/l theta = 0.
fn shaken(amplitude: f64, speed: f64) -> String {
    format!(
        r#"{{
            "name": "shaken", "dimension": 2, "gravity": [0, -9.81],
            "ground": {{ "markers": {{ "O": [0, 0] }} }},
            "bodies": [
                {{ "name": "base", "type": "rigid", "mass": 1, "free": ["y"], "markers": {{ "P": [0, 0] }},
                   "initial": {{ "position": [0, {amplitude}] }} }},
                {{ "name": "bob", "type": "point_mass", "mass": 1, "initial": {{ "position": [0, {amplitude} - 1] }} }}
            ],
            "joints": [
                {{ "name": "shaker", "type": "driver", "between": ["ground.O", "base.P"], "coordinate": "y",
                   "value": "{amplitude}*cos({speed}*t)" }},
                {{ "name": "rod", "type": "distance", "between": ["base.P", "bob"], "length": 1 }}
            ],
            "simulation": {{ "t_end": 5 }}
        }}"#
    )
    .replace(&format!("[0, {amplitude} - 1]"), &format!("[0, {}]", amplitude - 1.0))
}

/// Mathieu's equation, numbers by its series.
#[test]
fn a_shaken_pendulum_has_the_monodromy_of_mathieu() {
    for (amplitude, speed, known) in [
        (0.1, 6.0, [-1.036_494_553_106_304_1, -0.144_140_586_990_187_72, -0.515_614_374_625_076_8]),
        (0.1, 6.5, [-1.045_492_516_630_294, -0.068_067_210_955_255_3, -1.367_098_798_725_659]),
        (0.05, 3.2, [0.990_936_578_870_783_5, -0.043_751_661_596_454_64, 0.412_434_545_282_038]),
    ] {
        let scene = parse(&shaken(amplitude, speed));
        let (q, v) = scene.0.start();
        let start = State { t: 0.0, q: q.to_vec(), v: v.to_vec() };
        let found = models(scene.system(), &start, "intrinsic", (TAU / speed, 7)).whole().unwrap();
        let [a, b, c] = known;
        let off = (&found - Matrix::from_row_slice(2, 2, &[a, b, c, a])).amax();
        assert!(off < 1e-9, "{amplitude} {speed}: {off:e} {found}");
    }
}

/// A conical pendulum at cos(angle) = 1/4: over a turn parallel axes on the sphere turn by 2 pi cos(angle), a right
/// angle. Its multipliers are 1, 1 and exp(+-i w T) with w^2 = W^2 (1 + 3 cos^2).
#[test]
fn the_axes_of_a_conical_pendulum_close_by_a_right_angle() {
    let cos = 0.25f64;
    let sin = (1.0 - cos * cos).sqrt();
    let speed = (GRAVITY / cos).sqrt();
    let start = State { t: 0.0, q: vec![sin, 0.0, -cos], v: vec![0.0, speed * sin, 0.0] };
    let period = TAU / speed;
    let found = models(&Spherical, &start, "intrinsic", (period, 17));
    let closure = found.closure.as_ref().unwrap();
    let angle = closure[(1, 0)].atan2(closure[(0, 0)]).abs();
    assert!((angle - FRAC_PI_2).abs() < 1e-9, "{closure}");
    let mut turned = Matrix::zeros(4, 4);
    turned.view_mut((0, 0), (2, 2)).copy_from(closure);
    turned.view_mut((2, 2), (2, 2)).copy_from(closure);
    let values = (turned * found.whole().unwrap()).complex_eigenvalues();
    let w = speed * (1.0 + 3.0 * cos * cos).sqrt();
    let known = [Complex::from_polar(1.0, w * period), Complex::from_polar(1.0, -w * period), 1.0.into(), 1.0.into()];
    // The double multiplier 1 is defective: the root of the integration's error.
    assert!(distance(values.as_slice(), &known) < 1e-5, "{values}");
    // The frozen A does not change along a steady motion in parallel axes but for their turning against it.
    assert!(found.measured.iter().all(|measured| measured.error < 1e-8), "{:?}", found.measured);
    assert!(angle < PI);
}
