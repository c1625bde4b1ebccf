//! Rods at rest by shooting, to 1e-10 of their length: the equations of E. Reissner, On finite deformations of
//! space-curved beams, Z. Angew. Math. Phys. 32 (1981) 734-744, and J. C. Simo, A finite strain beam formulation. The
//! three-dimensional dynamic problem. Part I, Comput. Methods Appl. Mech. Engrg. 49 (1985) 55-70, as they are.

use nalgebra::{Matrix3, Quaternion, SVector, UnitQuaternion, Vector3};
use std::f64::consts::PI;

/// Clamped at the origin, where it points along x; relaxed along a line of constant curvature.
pub struct Rod {
    pub length: f64,
    /// EA and GA along y and z, N; infinite where there is no strain.
    pub forces: Vector3<f64>,
    /// GJ and EI about y and z, N m^2.
    pub moments: Vector3<f64>,
    /// In the axes of the section, 1/m.
    pub curvature: Vector3<f64>,
}

/// Position, quaternion and moment of a section, in the axes of the world.
type State = SVector<f64, 10>;

/// Runge-Kutta steps of order 4: a turn of 2 rad over all of them is wrong by (2/400)^4/120 of it each.
const STEPS: usize = 400;
/// Steps in which a load grows.
const LOADS: usize = 8;

pub fn position(state: &State) -> Vector3<f64> {
    state.fixed_rows::<3>(0).into()
}

pub fn moment(state: &State) -> Vector3<f64> {
    state.fixed_rows::<3>(7).into()
}

impl Rod {
    /// Straight, without strain along it or across.
    pub fn slender(length: f64, moments: [f64; 3]) -> Self {
        Rod { length, forces: Vector3::repeat(f64::INFINITY), moments: moments.into(), curvature: Vector3::zeros() }
    }

    /// A rectangle, wide along y: J = h w^3/3 (1 - 192 w/(pi^5 h) (tanh(pi h/2 w) + tanh(3 pi h/2 w)/3^5 + ...)), shear by
    /// 5/6 of the area. Source: S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, 1970, article 109.
    pub fn rectangle(length: f64, [h, w]: [f64; 2], [e, nu]: [f64; 2]) -> Self {
        let term = |n: f64| (n * PI * h / (2.0 * w)).tanh() / n.powi(5);
        let sum: f64 = (0..20).map(|k| term(f64::from(2 * k + 1))).sum();
        let g = e / (2.0 * (1.0 + nu));
        let j = h * w.powi(3) / 3.0 * (1.0 - 192.0 * w / (PI.powi(5) * h) * sum);
        let shear = 5.0 / 6.0 * g * h * w;
        let moments = Vector3::new(g * j, e * h * w.powi(3) / 12.0, e * w * h.powi(3) / 12.0);
        Rod { length, forces: Vector3::new(e * h * w, shear, shear), moments, curvature: Vector3::zeros() }
    }

    /// r' = R (e_x + n/C_n), R' = R (k_0 + m/C_m)~ with n and m in the axes of the section, and m' = -r' x n.
    fn rate(&self, state: &State, force: &Vector3<f64>) -> State {
        let quaternion = Quaternion::new(state[3], state[4], state[5], state[6]);
        let axes = UnitQuaternion::from_quaternion(quaternion);
        let along = axes * (Vector3::x() + axes.inverse_transform_vector(force).component_div(&self.forces));
        let turn = self.curvature + axes.inverse_transform_vector(&moment(state)).component_div(&self.moments);
        let turned = quaternion * Quaternion::from_imag(turn) * 0.5;
        let bent = force.cross(&along);
        State::from_column_slice(&[
            along.x, along.y, along.z, turned.w, turned.i, turned.j, turned.k, bent.x, bent.y, bent.z,
        ])
    }

    /// The tip from what the clamp carries; the force is the same in all sections.
    pub fn end(&self, force: &Vector3<f64>, at_clamp: &Vector3<f64>) -> State {
        let h = self.length / STEPS as f64;
        let mut state = State::zeros();
        state[3] = 1.0;
        state.fixed_rows_mut::<3>(7).copy_from(at_clamp);
        for _ in 0..STEPS {
            let k1 = self.rate(&state, force);
            let k2 = self.rate(&(state + k1 * (h / 2.0)), force);
            let k3 = self.rate(&(state + k2 * (h / 2.0)), force);
            let k4 = self.rate(&(state + k3 * h), force);
            state += (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0);
        }
        state
    }

    /// The moment at the clamp with which the tip carries none.
    fn at_clamp(&self, force: &Vector3<f64>) -> Vector3<f64> {
        let size = force.norm() * self.length;
        (1..=LOADS).fold(Vector3::zeros(), |guess, step| {
            let force = force * (step as f64 / LOADS as f64);
            solve(guess, size, |at_clamp| moment(&self.end(&force, at_clamp)) / size)
        })
    }

    /// Where the tip is under a force that keeps its direction.
    pub fn tip(&self, force: [f64; 3]) -> [f64; 3] {
        let force = force.into();
        position(&self.end(&force, &self.at_clamp(&force))).into()
    }

    /// Changes its sign where the rod buckles: then the tip carries no moment in neighbouring states, too.
    pub fn stability(&self, force: [f64; 3]) -> f64 {
        let force = force.into();
        jacobian(&self.at_clamp(&force), self.moments.min() / self.length, |m| moment(&self.end(&force, m)))
            .determinant()
    }
}

/// By central differences over 1e-4 of the size of x: right to 1e-8.
fn jacobian(x: &Vector3<f64>, size: f64, f: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Matrix3<f64> {
    let column = |i: usize| {
        let change = Vector3::ith(i, 1e-4 * size);
        (f(&(x + change)) - f(&(x - change))) / (2e-4 * size)
    };
    Matrix3::from_columns(&[column(0), column(1), column(2)])
}

/// f(x) = 0 by Newton's method, x of `size` and f of size one.
pub fn solve(guess: Vector3<f64>, size: f64, f: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Vector3<f64> {
    let mut x = guess;
    for _ in 0..20 {
        let residual = f(&x);
        if residual.amax() < 1e-12 {
            return x;
        }
        x -= jacobian(&x, size, &f).lu().solve(&residual).expect("a rod that does not buckle");
    }
    panic!("no rod at rest beside {guess}")
}

#[test]
fn a_rod_rolled_into_an_arc_and_a_helix() {
    let rod = Rod { curvature: Vector3::new(0.3, 0.0, 1.0), ..Rod::slender(2.0, [1.0; 3]) };
    // A helix of curvature k and torsion t: r^2 = k^2 + t^2, radius k/r^2, pitch t/r over the length.
    let k = 1.0f64;
    let t = 0.3f64;
    let r = k.hypot(t);
    let radius = k / (r * r);
    let end = position(&rod.end(&Vector3::zeros(), &Vector3::zeros()));
    let axis = Vector3::new(t, 0.0, k) / r;
    let rise = end.dot(&axis);
    let chord = (end - axis * rise).norm();
    assert!((rise - 2.0 * t / r).abs() < 1e-11 && (chord - 2.0 * radius * r.sin()).abs() < 1e-11, "{end}");
}
