//! Own equations from the energies: M, f and the power follow from T and V.

use super::Equations;
use super::passes::fixed;
use crate::error::{Error, Result};
use crate::math::{Dual, Rate, Scalar};
use crate::tolerances;

/// Coordinates of which the derivatives come from one evaluation of an energy.
const WIDTH: usize = 6;

/// Coordinates up to which an evaluation takes its numbers from the stack.
const FEW: usize = 8;

/// A number and its rate along one direction, with the derivatives of both along [`WIDTH`] others.
type Mixed<S> = Dual<Dual<S, 1>, WIDTH>;

/// A mechanism by its kinetic energy T, its potential energy V and phi. With L = T - V,
///
/// ```text
/// d/dt(dL/dv) - dL/dq + G^T lambda = Q
/// M = d^2 T/dv^2
/// f = Q + dL/dq - (d^2 T/dv dq) v - d^2 T/dv dt
/// ```
///
/// follow by dual numbers, f with all Coriolis and centrifugal terms. G, gamma and second derivatives follow as those
/// of [`Equations`], which every `Lagrangian` is: all formulations, integrators and linear models take it. Up to six
/// coordinates an evaluation takes T n times for M and twice for f, over numbers of seven to fourteen values:
/// [`Equations`] with M and f written by hand are faster.
///
/// ```
/// use holonom::system::{Lagrangian, Scalar};
///
/// /// Two unit masses on unit rods, by the angles of the rods to the vertical.
/// struct DoublePendulum;
///
/// impl Lagrangian for DoublePendulum {
///     fn size(&self) -> (usize, usize) {
///         (2, 0)
///     }
///     fn kinetic<S: Scalar>(&self, _t: S, q: &[S], v: &[S]) -> S {
///         v[0].square() + v[1].square() * 0.5 + v[0] * v[1] * (q[0] - q[1]).cos()
///     }
///     fn potential<S: Scalar>(&self, _t: S, q: &[S]) -> S {
///         (q[0].cos() * 2.0 + q[1].cos()) * -9.81
///     }
/// }
/// ```
pub trait Lagrangian: Send + Sync + 'static {
    /// (n, n_c): coordinates, which are also the velocities, and constraints.
    fn size(&self) -> (usize, usize);
    /// T, J: a polynomial of degree two in v, at most.
    fn kinetic<S: Scalar>(&self, t: S, q: &[S], v: &[S]) -> S;
    /// V, J. Default: zero.
    fn potential<S: Scalar>(&self, _t: S, _q: &[S]) -> S {
        S::zero()
    }
    /// Q, n: the generalized forces without a potential, such as dampers and motors; zero on entry.
    fn force<S: Scalar>(&self, _t: S, _q: &[S], _v: &[S], _f: &mut [S]) {}
    /// phi, n_c. Default: there is none.
    fn phi<S: Scalar>(&self, _t: S, _q: &[S], _phi: &mut [S]) {}
    /// Names of the outputs. Default: none.
    fn output_names(&self) -> Vec<String> {
        Vec::new()
    }
    /// The outputs, in the order of their names.
    fn outputs<S: Scalar>(&self, _t: S, _q: &[S], _v: &[S], _out: &mut [S]) {}
    /// Names of the inputs, which change the forces. Default: none.
    fn input_names(&self) -> Vec<String> {
        Vec::new()
    }
    /// dQ/du, n x n_u, row by row; zero on entry.
    fn input_forces<S: Scalar>(&self, _t: S, _q: &[S], _forces: &mut [S]) {}
}

impl<L: Lagrangian> Equations for L {
    fn size(&self) -> (usize, usize) {
        Lagrangian::size(self)
    }

    /// Column j from the rates of dT/dv along v_j, at v = 0.
    fn mass<S: Scalar>(&self, t: S, q: &[S], mass: &mut [S]) {
        let n = q.len();
        let zero = S::zero();
        let t = mixed(t, zero);
        let at_rest = |_| mixed(zero, zero);
        state(
            n,
            |i| mixed(q[i], zero),
            at_rest,
            |q, v| {
                for j in 0..n {
                    v[j].re.eps[0] = S::one();
                    for first in (j / WIDTH * WIDTH..n).step_by(WIDTH) {
                        let energy = along(v, first, |v| self.kinetic(t, q, v));
                        for (i, momentum) in (first..n).zip(&energy.eps) {
                            mass[i * n + j] = momentum.eps[0];
                            mass[j * n + i] = momentum.eps[0];
                        }
                    }
                    v[j].re.eps[0] = zero;
                }
            },
        );
    }

    fn force<S: Scalar>(&self, t: S, q: &[S], v: &[S], f: &mut [S]) {
        f.fill(S::zero());
        Lagrangian::force(self, t, q, v, f);
        let n = q.len();
        let blocks = || (0..n).step_by(WIDTH);
        // d/dt(dT/dv) along the motion at v' = 0.
        let time = mixed(t, S::one());
        state(
            n,
            |i| mixed(q[i], v[i]),
            |i| mixed(v[i], S::zero()),
            |q, v| {
                for first in blocks() {
                    let energy = along(v, first, |v| self.kinetic(time, q, v));
                    f[first..].iter_mut().zip(&energy.eps).for_each(|(f, momentum)| *f -= momentum.eps[0]);
                }
            },
        );
        let t = Dual::fixed(t);
        state(
            n,
            |i| Dual::fixed(q[i]),
            |i| Dual::fixed(v[i]),
            |q, v| {
                for first in blocks() {
                    let energy = along(q, first, |q| self.kinetic(t, q, v) - Lagrangian::potential(self, t, q));
                    f[first..].iter_mut().zip(&energy.eps).for_each(|(f, slope)| *f += *slope);
                }
            },
        );
    }

    fn phi<S: Scalar>(&self, t: S, q: &[S], phi: &mut [S]) {
        Lagrangian::phi(self, t, q, phi);
    }

    fn potential(&self, t: f64, q: &[f64]) -> Option<f64> {
        Some(Lagrangian::potential(self, t, q))
    }

    /// Let T = T2 + T1 + T0 by degrees in v. Then d(T2 - T0 + V)/dt = Q v - dL/dt at fixed q and v, without the
    /// reactions; the energy that is reported is T2 + V.
    fn power(&self, t: f64, q: &[f64], v: &[f64]) -> f64 {
        let n = q.len();
        let work = numbers(
            n,
            |_| 0.0,
            |f| {
                Lagrangian::force(self, t, q, v, f);
                f.iter().zip(v).map(|(f, v)| f * v).sum::<f64>()
            },
        );
        let time = Rate { re: t, eps: [1.0] };
        let lagrangian =
            |q: &mut [Rate], v: &mut [Rate]| self.kinetic(time, q, v) - Lagrangian::potential(self, time, q);
        let lagrangian = state(n, |i| Rate::fixed(q[i]), |i| Rate::fixed(v[i]), lagrangian);
        let moving = |i: usize| Rate { re: q[i], eps: [v[i]] };
        let at_rest = state(n, moving, |_| Rate::fixed(0.0), |q, v| self.kinetic(time, q, v));
        work - lagrangian.eps[0] + at_rest.eps[0]
    }

    /// T is of degree two in v if dT/dv is linear, here from rest through velocities of one and more.
    fn check(&self, t: f64, q: &[f64], _v: &[f64]) -> Result<()> {
        let n = q.len();
        let q = fixed(q);
        let momenta = |speed: f64| -> Vec<f64> {
            let mut v = fixed(&(0..n).map(|i| speed * (1.0 + i as f64 / n as f64)).collect::<Vec<_>>());
            let energy = |first| along(&mut v, first, |v| self.kinetic(Dual::fixed(t), &q, v));
            (0..n).step_by(WIDTH).map(energy).flat_map(|energy| energy.eps).take(n).collect()
        };
        let at_rest = momenta(0.0);
        let once = momenta(1.0);
        let twice = momenta(2.0);
        for i in 0..n {
            let bend = twice[i] - 2.0 * once[i] + at_rest[i];
            if bend.abs() > tolerances::ROOT_OF_ROUND_OFF * (twice[i].abs() + once[i].abs() + at_rest[i].abs()) {
                let message = format!(
                    "the kinetic energy is not quadratic in the velocities: its degree in v{} is higher",
                    i + 1
                );
                return Err(Error::input(message).hint("T = v^T M(q, t) v/2 + b(q, t)^T v + c(q, t) is possible"));
            }
        }
        Ok(())
    }

    fn output_names(&self) -> Vec<String> {
        Lagrangian::output_names(self)
    }

    fn outputs<S: Scalar>(&self, t: S, q: &[S], v: &[S], out: &mut [S]) {
        Lagrangian::outputs(self, t, q, v, out);
    }

    fn input_names(&self) -> Vec<String> {
        Lagrangian::input_names(self)
    }

    fn input_forces<S: Scalar>(&self, t: S, q: &[S], forces: &mut [S]) {
        Lagrangian::input_forces(self, t, q, forces);
    }
}

fn mixed<S: Scalar>(value: S, rate: S) -> Mixed<S> {
    Dual::fixed(Dual { re: value, eps: [rate] })
}

/// A function with its derivatives along the entries of `x` from `first` on.
fn along<S: Scalar>(
    x: &mut [Dual<S, WIDTH>],
    first: usize,
    function: impl FnOnce(&[Dual<S, WIDTH>]) -> Dual<S, WIDTH>,
) -> Dual<S, WIDTH> {
    x[first..].iter_mut().take(WIDTH).enumerate().for_each(|(k, x)| x.eps[k] = S::one());
    let value = function(x);
    x[first..].iter_mut().take(WIDTH).for_each(|x| x.eps = [S::zero(); WIDTH]);
    value
}

/// Calls `see` with q and v over another scalar.
fn state<T: Copy, R>(
    n: usize,
    q: impl Fn(usize) -> T,
    v: impl Fn(usize) -> T,
    see: impl FnOnce(&mut [T], &mut [T]) -> R,
) -> R {
    numbers(n, q, |q| numbers(n, v, |v| see(q, v)))
}

/// Calls `see` with `n` numbers.
fn numbers<T: Copy, R>(n: usize, number: impl Fn(usize) -> T, see: impl FnOnce(&mut [T]) -> R) -> R {
    if n == 0 || n > FEW {
        return see(&mut (0..n).map(number).collect::<Vec<T>>());
    }
    see(&mut std::array::from_fn::<T, FEW, _>(|i| number(i.min(n - 1)))[..n])
}
