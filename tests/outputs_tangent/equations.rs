//! Own equations with outputs and an input.

use crate::outputs_tangent::compare::check;
use holonom::math::Scalar;
use holonom::system::{Equations, OperatingPoint, MechanicalSystem, OutputTangent, Scratch};
use nalgebra::DMatrix;

/// A chain of point masses on a line, the last one pushed; more coordinates than one pass of derivatives has.
struct Chain;

const COUNT: usize = 8;

impl Equations for Chain {
    fn size(&self) -> (usize, usize) {
        (COUNT, 1)
    }
    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        let identity = |i: usize| if i.is_multiple_of(COUNT + 1) { S::one() } else { S::zero() };
        mass.iter_mut().enumerate().for_each(|(i, entry)| *entry = identity(i));
    }
    fn force<S: Scalar>(&self, _t: S, q: &[S], _v: &[S], f: &mut [S]) {
        f.iter_mut().zip(q).for_each(|(f, &q)| *f = -q);
    }
    fn phi<S: Scalar>(&self, _t: S, q: &[S], phi: &mut [S]) {
        phi[0] = q[0] - q[1];
    }
    fn output_names(&self) -> Vec<String> {
        ["product", "power"].map(String::from).to_vec()
    }
    fn outputs<S: Scalar>(&self, t: S, q: &[S], v: &[S], out: &mut [S]) {
        out[0] = q[0] * q[COUNT - 1] * t + v[2].sin();
        out[1] = q.iter().zip(v).fold(S::zero(), |sum, (&q, &v)| sum + q.square() * v);
    }
    fn input_names(&self) -> Vec<String> {
        vec!["push".to_string()]
    }
    fn input_forces<S: Scalar>(&self, _t: S, q: &[S], forces: &mut [S]) {
        forces[COUNT - 1] = q[0].cos();
    }
}

/// The same without outputs and inputs.
struct Silent;

impl Equations for Silent {
    fn size(&self) -> (usize, usize) {
        (1, 0)
    }
    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass[0] = S::one();
    }
    fn force<S: Scalar>(&self, _t: S, _q: &[S], _v: &[S], f: &mut [S]) {
        f[0] = S::one();
    }
    fn phi<S: Scalar>(&self, _t: S, _q: &[S], _phi: &mut [S]) {}
}

#[test]
fn own_outputs_and_inputs() {
    let system: &dyn MechanicalSystem = &Chain;
    let q: Vec<f64> = (0..COUNT).map(|i| (1.0 + i as f64).sin()).collect();
    let v: Vec<f64> = (0..COUNT).map(|i| (3.0 + 2.0 * i as f64).cos()).collect();
    let at = OperatingPoint { t: 0.7, q: &q, v: &v, vdot: &v, lambda: &[0.3] };
    // Sums of a few numbers near one.
    check(system, at, 1e-11, "chain");
    assert_eq!(system.facts().outputs[1].name, "power");
    assert_eq!(system.facts().inputs[0].name, "push");
    let mut f = DMatrix::from_element(COUNT, 1, 7.0);
    system.input_forces(0.7, &q, &v, &mut f, &mut Scratch::default());
    assert_eq!(f[(COUNT - 1, 0)], q[0].cos());
    assert!(f.rows(0, COUNT - 1).iter().all(|entry| *entry == 0.0));
}

#[test]
fn without_outputs_there_is_nothing_to_derive() {
    let system: &dyn MechanicalSystem = &Silent;
    let at = OperatingPoint { t: 0.0, q: &[0.0], v: &[0.0], vdot: &[0.0], lambda: &[] };
    assert!(system.output_tangent(at, &mut OutputTangent::new(0, 1, 0, 0), &mut Scratch::default()));
    assert!(system.facts().inputs.is_empty());
}
