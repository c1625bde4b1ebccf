//! A pendulum of unit mass and length with a motor of first order at its pivot, in Cartesian coordinates with the
//! current as a state:
//!
//! ```text
//! x'' = -x lambda - K i y,   y'' = -g - y lambda + K i x,   0 = (x^2 + y^2 - 1)/2
//! i' = (U sin 2 t - R i - S i^3 - K w)/L,   w = x y' - y x'
//! ```

use holonom::system::{
    Column, Dimensions, MechanicalSystem, Need, OperatingPoint, Scratch, SystemFacts, Tangent, Terms,
};
use std::borrow::Cow;

/// Its state is counted in so many A.
pub struct Motor {
    pub unit: f64,
}

pub const MOTOR: Motor = Motor { unit: 1.0 };

const GRAVITY: f64 = 9.81;
/// N m/A
const K: f64 = 1.0;
const L: f64 = 0.5;
const R: f64 = 1.0;
const S: f64 = 0.1;
const U: f64 = 4.0;

/// i' at the speed w.
fn rate(t: f64, w: f64, i: f64) -> f64 {
    (U * (2.0 * t).sin() - R * i - S * i.powi(3) - K * w) / L
}

impl MechanicalSystem for Motor {
    fn dimensions(&self) -> Dimensions {
        Dimensions { q: 2, v: 3, lambda: 1, states: 1, ..Dimensions::default() }
    }

    fn facts(&self) -> Cow<'_, SystemFacts> {
        let works = vec![Column { name: "work of the motor".to_string(), unit: "J".to_string() }];
        Cow::Owned(SystemFacts { works, ..SystemFacts::new(self.dimensions()) })
    }

    fn evaluate(&self, t: f64, q: &[f64], v: &[f64], _: Need, terms: &mut Terms, _: &mut Scratch) {
        let (&[x, y], &[vx, vy, xi]) = (q, v) else { return };
        let i = self.unit * xi;
        let mass = self.structure().mass;
        mass.entries.iter().zip(&mut terms.mass).for_each(|((i, j), mass)| *mass = f64::from(u8::from(i == j)));
        let w = x * vy - y * vx;
        terms.f.copy_from_slice(&[-K * i * y, K * i * x - GRAVITY, rate(t, w, i) / self.unit]);
        terms.power = K * i * w;
        terms.powers[0] = terms.power;
        terms.phi[0] = 0.5 * (x * x + y * y - 1.0);
        terms.phi_dot[0] = x * vx + y * vy;
        terms.gamma[0] = -(vx * vx + vy * vy);
        terms.g.copy_from_slice(&[x, y, 0.0]);
        terms.l.copy_from_slice(&[vx, vy, 0.0]);
    }

    fn tangent(&self, at: OperatingPoint, tangent: &mut Tangent, _: &mut Scratch) -> bool {
        let (&[x, y], &[vx, vy, xi], &[lambda]) = (at.q, at.v, at.lambda) else { return false };
        let i = self.unit * xi;
        let k = [[lambda, K * i, 0.0], [-K * i, lambda, 0.0], [K * vy / L, -K * vx / L, 0.0]];
        let c = [[0.0, 0.0, K * y], [0.0, 0.0, -K * x], [-K * y / L, K * x / L, (R + 3.0 * S * i * i) / L]];
        for (place, &(row, column)) in self.structure().tangent.entries.iter().enumerate() {
            let unit = |of: usize| if of == 2 { self.unit } else { 1.0 };
            tangent.k[place] = k[row][column] / unit(row);
            tangent.c[place] = c[row][column] * unit(column) / unit(row);
        }
        true
    }
}

/// The angle from the lowest position, its rate and the current at the start.
const START: [f64; 3] = [0.8, 0.3, 0.4];

/// q, v with the current, and lambda at an angle: r'' . r = -w^2 and |r| = 1 give lambda = f . r + w^2; then the work
/// of the motor, which is the change of the pendulum's energy.
fn row(t: f64, [angle, w, i]: [f64; 3]) -> Vec<f64> {
    let (sin, cos) = angle.sin_cos();
    vec![t, sin, -cos, w * cos, w * sin, i, GRAVITY * cos + w * w, energy(angle, w) - energy(START[0], START[1])]
}

fn energy(angle: f64, w: f64) -> f64 {
    0.5 * w * w - GRAVITY * angle.cos()
}

/// q and v at the start.
pub fn start() -> ([f64; 2], [f64; 3]) {
    let row = row(0.0, START);
    ([row[1], row[2]], [row[3], row[4], row[5]])
}

/// Rows at these times, by the classical Runge-Kutta method in the angle: steps of 5e-5 s leave 1e-14, which is
/// round-off.
pub fn exact(times: &[f64]) -> Vec<Vec<f64>> {
    let field = |t: f64, [angle, w, i]: [f64; 3]| [w, K * i - GRAVITY * angle.sin(), rate(t, w, i)];
    let ahead = |y: [f64; 3], h: f64, k: [f64; 3]| std::array::from_fn(|j| y[j] + h * k[j]);
    let mut t = 0.0;
    let mut y = START;
    let mut at = |end: &f64| {
        let began = t;
        let steps = ((end - t) / 5e-5).ceil();
        let h = if steps > 0.0 { (end - t) / steps } else { 0.0 };
        for step in 0..steps as usize {
            t = began + step as f64 * h;
            let a = field(t, y);
            let b = field(t + 0.5 * h, ahead(y, 0.5 * h, a));
            let c = field(t + 0.5 * h, ahead(y, 0.5 * h, b));
            let d = field(t + h, ahead(y, h, c));
            y = std::array::from_fn(|j| y[j] + h / 6.0 * (a[j] + 2.0 * (b[j] + c[j]) + d[j]));
        }
        t = *end;
        row(t, y)
    };
    times.iter().map(&mut at).collect()
}
