//! Motions through thresholds of their forces: the saltation of small changes.

use super::{off_whole, times};
use crate::linearize::reference::distance;
use crate::scenes::{Ready, parse};
use holonom::linearize::{Chart, Complex, Matrix, State, along, transition};
use std::f64::consts::{FRAC_PI_2, TAU};

fn mass(force: &str) -> Ready {
    parse(&format!(
        r#"{{ "name": "mass", "dimension": 2,
             "bodies": [{{ "name": "m", "type": "rigid", "mass": 1, "free": ["x"], "markers": {{ "P": [0, 0] }} }}],
             "forces": [{{ "name": "f", "type": "applied_force", "at": "m", "force": ["{force}", 0] }}],
             "simulation": {{ "t_end": 20 }} }}"#
    ))
}

fn at(t: f64, x: f64, speed: f64) -> State {
    State { t, q: vec![x], v: vec![speed] }
}

/// The transition over a span in (x, x'): the chart of one coordinate with unit mass.
fn over(scene: &Ready, start: &State, end: f64) -> Matrix {
    let chart = Chart::parse("m.x");
    transition(scene.system(), start, &chart, &[end]).unwrap()[0].matrix(scene.system(), &chart).unwrap()
}

/// Den Hartog's motion x = X cos(W t) at its turning points, with dry friction: m x'' + k x + f sign(x') = F cos(W t + p).
/// Without the saltation the determinant is 1.
#[test]
fn dry_friction_has_the_monodromy_of_den_hartog() {
    let speed = 0.7;
    let phase = 0.183_752_253_019_160_88;
    let scene = mass("cos(0.7*t) - m.x - 0.2*sign(m.x')");
    // At the largest x the force has the phase p, and x' becomes negative: from just before.
    let before = -1e-3;
    let amplitude = 1.927_774_517_939_996_4;
    let start = back(&scene, phase / speed, amplitude, before);
    let period = TAU / speed;
    let found = over(&scene, &start, start.t + period);
    let values = found.complex_eigenvalues();
    let known = [
        Complex::new(-0.583_088_991_930_000_8, 0.288_451_224_973_985_3),
        Complex::new(-0.583_088_991_930_000_8, -0.288_451_224_973_985_3),
    ];
    assert!(distance(values.as_slice(), &known) < 1e-8, "{values}");
    assert!((found.determinant() - 0.423_196_881_698_937_25).abs() < 1e-9, "{}", found.determinant());
    let models =
        along(scene.system(), &start, Some(&Chart::parse("m.x")), &times(&start, start.t + period, 12), |_| {});
    let off = off_whole(scene.system(), &start, "m.x", &models.unwrap());
    assert!(off < 1e-10, "{off:e}");
}

/// The state a little before the largest x: there x'' + x - 0.2 = cos(0.7 t) holds back to the last turning point.
fn back(scene: &Ready, t: f64, x: f64, ahead: f64) -> State {
    // Particular solution c cos(0.7 t) + 0.2 - 2 * 0.2 for x' > 0: x'' = cos - x - 0.2.
    let c = 1.0 / (1.0 - 0.49);
    let own = |t: f64| [c * (0.7 * t).cos() - 0.2, -0.7 * c * (0.7 * t).sin()];
    let [p, rate] = own(t);
    let (sin, cos) = ahead.sin_cos();
    let [z, w] = [x - p, -rate];
    let [now, speed] = own(t + ahead);
    let state = at(t + ahead, now + z * cos + w * sin, speed - z * sin + w * cos);
    assert!(state.v[0] > 0.0 && scene.0.name == "mass");
    state
}

/// A mass on a one-sided spring that lifts off once a period: f does not jump, and S is the identity.
#[test]
fn a_mass_that_lifts_off_has_its_multipliers() {
    let scene = mass("10*cos(30*t) - 8*m.x' - 9.81 - 2000*min(m.x, 0)");
    // Flight from lift-off: x'' = 10 cos(30 t) - 8 x' - 9.81, a little after it.
    let lift = at(0.010_909_225_945_672_679, 0.0, 0.841_482_002_615_584_1);
    let after = flight(&lift, 0.01);
    let found = over(&scene, &after, after.t + TAU / 30.0);
    let values = found.complex_eigenvalues();
    let known = [
        Complex::new(-0.264_595_972_027_835_3, 0.342_345_599_732_151_1),
        Complex::new(-0.264_595_972_027_835_3, -0.342_345_599_732_151_1),
    ];
    assert!(distance(values.as_slice(), &known) < 1e-8, "{values}");
    assert!((found.determinant() - (-TAU * 8.0 / 30.0).exp()).abs() < 1e-10);
}

/// x'' = 10 cos(30 t) - 8 x' - 9.81: particular solution a cos(30 t) + b sin(30 t) - 9.81/8 t, then c + d exp(-8 t).
fn flight(start: &State, duration: f64) -> State {
    let (w, c) = (30.0f64, 8.0f64);
    let size = 10.0 / (w * (w * w + c * c).sqrt());
    let lag = (w / c).atan() + FRAC_PI_2;
    // The response of x'' + c x' to 10 cos(w t) is size cos(w t - lag), lag = 90 degrees + atan(w/c).
    let own = |t: f64| [size * (w * t - lag).cos() - 9.81 / c * t, -size * w * (w * t - lag).sin() - 9.81 / c];
    let [x, v] = own(start.t);
    let d = -(start.v[0] - v) / c;
    let level = start.q[0] - x - d;
    let t = start.t + duration;
    let [x, v] = own(t);
    let decay = (-c * duration).exp();
    at(t, x + level + d * decay, v - c * d * decay)
}
