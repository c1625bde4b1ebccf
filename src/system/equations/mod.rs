//! Equations of a user, written once over any scalar.

mod check;
mod christoffel;
mod jet;
mod lagrangian;
mod passes;

pub use lagrangian::Lagrangian;

use super::{
    Column, Dimensions, Energy, LeviCivita, MechanicalSystem, Need, OperatingPoint, OutputTangent, Scratch,
    SystemFacts, Tangent, Terms,
};
use crate::error::Result;
use crate::math::{Dual, Regime, Scalar};
use christoffel::christoffel;
use nalgebra::DMatrix;
use passes::{EquationsMemory, SeededEquations, curvature, fixed, output_slopes, tangent_of, write_terms};
use std::borrow::Cow;

/// A mechanism by its M, f and phi. G, phi', gamma and L follow by dual and Taylor numbers, so nothing is derived by
/// hand: phi is evaluated once over numbers that carry phi', gamma, phi_t and seven columns of G (up to three coordinates:
/// three), and again for each eight columns more. Where both are needed, [`Scalar::sin_cos`] is cheaper than sine and
/// cosine.
///
/// Coordinates are called `q1, q2, ..`, velocities `v1, v2, ..` and multipliers `lambda1, lambda2, ..`.
///
/// ```
/// use holonom::system::{Equations, Scalar};
///
/// /// Pendulum of unit mass and length in Cartesian coordinates.
/// struct Pendulum;
///
/// impl Equations for Pendulum {
///     fn size(&self) -> (usize, usize) {
///         (2, 1)
///     }
///     fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
///         mass.copy_from_slice(&[S::one(), S::zero(), S::zero(), S::one()]);
///     }
///     fn force<S: Scalar>(&self, _t: S, _q: &[S], _v: &[S], f: &mut [S]) {
///         f.copy_from_slice(&[S::zero(), S::constant(-9.81)]);
///     }
///     fn phi<S: Scalar>(&self, _t: S, q: &[S], phi: &mut [S]) {
///         phi[0] = (q[0].square() + q[1].square() - 1.0) * 0.5;
///     }
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no equations of motion",
    label = "no equations of motion",
    note = "implement `holonom::system::Equations` (M, f and phi), `holonom::system::Lagrangian` (T, V and phi) or \
            `holonom::research::systems::MechanicalSystem` (all terms)"
)]
pub trait Equations: Send + Sync + 'static {
    /// (n, n_c): coordinates, which are also the velocities, and constraints.
    fn size(&self) -> (usize, usize);
    /// M, n x n, row by row, both triangles.
    fn mass<S: Scalar>(&self, t: S, q: &[S], mass: &mut [S]);
    /// f, n: all forces but the reactions, velocity-dependent inertia forces included.
    fn force<S: Scalar>(&self, t: S, q: &[S], v: &[S], f: &mut [S]);
    /// phi, n_c.
    fn phi<S: Scalar>(&self, t: S, q: &[S], phi: &mut [S]);
    /// Potential energy, J, of the forces that have one. Where it is given, the energy balance is reported.
    fn potential(&self, _t: f64, _q: &[f64]) -> Option<f64> {
        None
    }
    /// Power, W, that the energy balance counts as supplied: that of the forces without a potential, such as dampers and
    /// motors, and the partial derivative of the potential with respect to t. Default: 0.
    fn power(&self, _t: f64, _q: &[f64], _v: &[f64]) -> f64 {
        0.0
    }
    /// Refuses a start, or parameters with which nothing can be computed; asked once before a run, an assembly or a
    /// linear model. Default: nothing is refused.
    ///
    /// # Errors
    /// Such a start: [`Error::input`](crate::Error::input).
    fn check(&self, _t: f64, _q: &[f64], _v: &[f64]) -> Result<()> {
        Ok(())
    }
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
    /// df/du, n x n_u, row by row; zero on entry.
    fn input_forces<S: Scalar>(&self, _t: S, _q: &[S], _forces: &mut [S]) {}
}

impl<E: Equations> MechanicalSystem for E {
    fn dimensions(&self) -> Dimensions {
        let (n, m) = self.size();
        Dimensions { q: n, v: n, lambda: m, ..Dimensions::default() }
    }

    fn facts(&self) -> Cow<'_, SystemFacts> {
        let named = |names: Vec<String>| names.into_iter().map(|name| Column { name, unit: String::new() }).collect();
        let outputs = named(self.output_names());
        let inputs = named(self.input_names());
        Cow::Owned(SystemFacts { outputs, inputs, ..SystemFacts::new(self.dimensions()) })
    }

    fn check(&self, t: f64, q: &[f64], v: &[f64]) -> Result<()> {
        check::symmetry(self, t, q)?;
        Equations::check(self, t, q, v)
    }

    fn evaluate(&self, t: f64, q: &[f64], v: &[f64], need: Need, terms: &mut Terms, scratch: &mut Scratch) {
        let inputs = std::mem::take(&mut scratch.inputs);
        let at = OperatingPoint { t, q, v, vdot: &[], lambda: &[] };
        let fill = |memory: &mut EquationsMemory, _: Regime| write_terms(self, at, need, &inputs, memory, terms);
        scratch.with(|| EquationsMemory::of(self), fill);
        scratch.inputs = inputs;
    }

    fn tangent(&self, at: OperatingPoint, tangent: &mut Tangent, scratch: &mut Scratch) -> bool {
        let (n, m) = self.size();
        scratch.with(
            || EquationsMemory::of(self),
            |memory, _| tangent_of(self, at, memory.varied.get_or_insert_with(|| SeededEquations::new(n, m)), tangent),
        );
        true
    }

    fn acceleration_gradient(&self, at: OperatingPoint, values: &mut [f64], scratch: &mut Scratch) -> bool {
        let write = |memory: &mut EquationsMemory, _: Regime| {
            curvature(self, at, memory, |place, slope| values[place] = slope.dd)
        };
        scratch.with(|| EquationsMemory::of(self), write);
        true
    }

    fn levi_civita(&self, at: OperatingPoint, connection: &mut LeviCivita, _scratch: &mut Scratch) -> bool {
        christoffel(self, at, connection);
        true
    }

    fn energy(&self, t: f64, q: &[f64], v: &[f64], scratch: &mut Scratch) -> Option<Energy> {
        let potential = self.potential(t, q)?;
        let (n, _) = self.size();
        let kinetic = |memory: &mut EquationsMemory, _: Regime| {
            self.mass(t, q, &mut memory.mass);
            let row = |i: usize| memory.mass[i * n..(i + 1) * n].iter().zip(v).map(|(m, v)| m * v).sum::<f64>();
            0.5 * (0..n).map(|i| v[i] * row(i)).sum::<f64>()
        };
        Some(Energy { kinetic: scratch.with(|| EquationsMemory::of(self), kinetic), potential })
    }

    fn outputs(&self, at: OperatingPoint, out: &mut [f64], _scratch: &mut Scratch) {
        Equations::outputs(self, at.t, at.q, at.v, out);
    }

    fn output_tangent(&self, at: OperatingPoint, tangent: &mut OutputTangent, _scratch: &mut Scratch) -> bool {
        tangent.clear();
        let t = Dual::fixed(at.t);
        let q = fixed(at.q);
        let v = fixed(at.v);
        output_slopes(at.q, |q, out| Equations::outputs(self, t, q, &v, out), &mut tangent.q);
        output_slopes(at.v, |v, out| Equations::outputs(self, t, &q, v, out), &mut tangent.v);
        true
    }

    fn input_forces(&self, t: f64, q: &[f64], _v: &[f64], f: &mut DMatrix<f64>, _scratch: &mut Scratch) {
        let mut forces = vec![0.0; f.len()];
        Equations::input_forces(self, t, q, &mut forces);
        f.copy_from(&DMatrix::from_row_slice(f.nrows(), f.ncols(), &forces));
    }
}
