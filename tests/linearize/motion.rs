//! The state-transition matrix along motions: orders, invariants, Floquet multipliers, Lyapunov exponents.

use crate::linearize::closed_forms::Spherical;
use crate::linearize::reference::{Reference, distance};
use crate::linearize::systems::{DoublePendulum, system};
use holonom::linearize::{Chart, Complex, Matrix, State, Variation, floquet, lyapunov, minimal, transition};
use holonom::math::Scalar;
use holonom::math::eigen::expm;
use holonom::system::Equations;

fn state(label: &str) -> State {
    let reference = Reference::read(label);
    State { t: 0.0, q: reference.vector("q"), v: reference.vector("v") }
}

/// The slope of |X(h) - exp(A h)| over halved steps. X(h) = exp(A h) - A' h^2/2 + ..., in constant charts.
fn order(label: &str, chart: &Chart, least: f64) -> f64 {
    let system = system(label);
    let start = state(label);
    let mut variation = Variation::new(system.as_ref(), 0.0, &start.q, &start.v).unwrap();
    let model = minimal(&mut variation, chart).unwrap();
    let measured = Chart::MassOrthogonal.at(&mut variation).unwrap();
    let rate = model.built.a.amax().sqrt();
    let steps: Vec<f64> = [1.0, 2.0, 4.0].iter().map(|x| least * x / rate).collect();
    let found = transition(system.as_ref(), &start, &Chart::MassOrthogonal, &steps).unwrap();
    let scale = |x: Matrix| {
        Matrix::from_fn(x.nrows(), x.ncols(), |i, j| {
            let k = x.nrows() / 2;
            x[(i, j)] * if i >= k { 1.0 / rate } else { 1.0 } * if j >= k { rate } else { 1.0 }
        })
    };
    let error = |i: usize| {
        let x = measured.states_of(&found[i].changes);
        scale(x - expm(&(&model.built.a * steps[i])).unwrap()).norm()
    };
    (error(2) / error(1)).log2().min((error(1) / error(0)).log2())
}

/// An exact A in a constant chart is off by h^2; the plain projection, which forgets that the basis moves, by h.
#[test]
fn frozen_exponential_is_of_second_order_in_constant_charts() {
    for label in ["four_bar_N1", "double_pendulum_N1", "andrews_t010"] {
        let exact = order(label, &Chart::MassOrthogonal, 1e-3);
        // Steps of 1e-3 of the period leave 1 % of the next power.
        assert!((exact - 2.0).abs() < 0.05, "{label}: {exact}");
    }
    // Without forces of velocity, or with such in proportion to M, the projection is that of the chart.
    let plain = order("andrews_t010", &Chart::Frozen, 1e-5);
    assert!((plain - 1.0).abs() < 0.05, "{plain}");
}

/// Liouville: det X = exp(int tr A dt), which is 1 without damping and exp(-0.1 * 2 * t) with drag 0.1 on each of two
/// degrees of freedom, in canonical states; a change of basis at both ends has the same effect for motions that return.
#[test]
fn volumes_shrink_with_the_damping() {
    let start = state("double_pendulum_N1");
    let found = lyapunov(&DoublePendulum, &start, 20.0, 0.25, |_| {}).unwrap();
    let sum: f64 = found.last().iter().sum();
    // Bounded by the change of the volume of the basis over 20 s.
    assert!((sum + 0.2).abs() < 0.2, "{:?}", found.last());
}

/// Two unit masses on unit rods without drag.
struct Undamped;

impl Equations for Undamped {
    fn size(&self) -> (usize, usize) {
        (4, 2)
    }
    fn mass<S: Scalar>(&self, t: S, q: &[S], mass: &mut [S]) {
        DoublePendulum.mass(t, q, mass);
    }
    fn force<S: Scalar>(&self, _: S, _: &[S], _: &[S], f: &mut [S]) {
        (0..4).for_each(|i| f[i] = S::constant(if i % 2 == 1 { -9.81 } else { 0.0 }));
    }
    fn phi<S: Scalar>(&self, t: S, q: &[S], phi: &mut [S]) {
        DoublePendulum.phi(t, q, phi);
    }
}

/// Released level, the double pendulum is chaotic: exponents come in pairs +-, two of them zero.
#[test]
fn a_double_pendulum_is_chaotic() {
    let start = State { t: 0.0, q: vec![1.0, 0.0, 2.0, 0.0], v: vec![0.0; 4] };
    let found = lyapunov(&Undamped, &start, 100.0, 0.2, |_| {}).unwrap();
    let e = found.last();
    assert!(e[0] > 0.5, "{e:?}");
    // Finite-time exponents of a Hamiltonian system pair up to the turning of the basis, some units over the time.
    assert!((e[0] + e[3]).abs() < 0.1 && e[1].abs() < 0.2 && e[2].abs() < 0.2, "{e:?}");
}

/// The conical pendulum at 60 degrees turns at sqrt(g / (l cos 60)); beside its own motion it swings at 5.859607495387 rad/s
/// (theory page), so its multipliers over a turn are 1, 1 and exp(+-i 5.8596 T).
#[test]
fn a_conical_pendulum_has_its_multipliers() {
    let angle = std::f64::consts::PI / 3.0;
    let turn = (9.81 / angle.cos()).sqrt();
    let radius = angle.sin();
    let height = -angle.cos();
    let start = State { t: 0.0, q: vec![radius, 0.0, height], v: vec![0.0, radius * turn, 0.0] };
    let period = std::f64::consts::TAU / turn;
    let found = floquet(&Spherical, &start, period).unwrap();
    let swing = Complex::from_polar(1.0, 5.859607495387 * period);
    let expected = [Complex::from(1.0), Complex::from(1.0), swing, swing.conj()];
    // The double multiplier 1 is defective: the root of the integration's error, 1e-11.
    let off = distance(&found.multipliers, &expected);
    assert!(off < 1e-5, "{off:e} {:?}", found.multipliers);
    let nearest = found.multipliers.iter().map(|m| (m - swing).norm()).fold(f64::INFINITY, f64::min);
    assert!(nearest < 1e-9, "{nearest:e}");
    assert!(found.is_stable(1e-5));
    // An orbit beside it takes another time, so that the way between both grows like t.
    let defects = found.defects(1e-5).unwrap();
    assert_eq!(defects.iter().map(|defect| (defect.count, defect.vectors)).collect::<Vec<_>>(), [(2, 1)]);
    assert!((defects[0].multiplier - Complex::from(1.0)).norm() < 1e-9, "{defects:?}");
    let wrong = floquet(&Spherical, &start, 0.9 * period).unwrap_err().to_string();
    assert!(wrong.contains("not its period"), "{wrong}");
}

/// A pendulum turned upside down has a multiplier outside the unit circle: exp(sqrt(g/l) T) over any time, as at rest every
/// time is a period.
#[test]
fn an_upright_pendulum_is_unstable() {
    let start = State { t: 0.0, q: vec![0.0, 0.0, 1.0], v: vec![0.0; 3] };
    let found = floquet(&Spherical, &start, 0.5).unwrap();
    let grows = (9.81f64.sqrt() * 0.5).exp();
    assert!((found.multipliers[0].re / grows - 1.0).abs() < 1e-10, "{:?}", found.multipliers);
    assert!(!found.is_stable(1e-3));
}
