//! A model as its equations of motion.

use super::Model;
use crate::body::Energy;
use crate::error::Result;
use crate::forward::forward;
use crate::math::Rate;
use crate::system::{
    Dimensions, Feed, LeviCivita, MechanicalSystem, Need, OperatingPoint, OutputTangent, Prescribed, Road, Scratch,
    Spin, Structure, SwitchFacts, SystemFacts, Tangent, Terms,
};
use nalgebra::DMatrix;
use std::borrow::Cow;

/// Every method that takes a system takes a model of a scene.
impl MechanicalSystem for Model {
    forward! { .mechanism.system() =>
        fn dimensions(&self) -> Dimensions;
        fn facts(&self) -> Cow<'_, SystemFacts>;
        fn switches(&self) -> SwitchFacts<'_>;
        fn check(&self, t: f64, q: &[f64], v: &[f64]) -> Result<()>;
        fn evaluate(&self, t: f64, q: &[f64], v: &[f64], need: Need, terms: &mut Terms, scratch: &mut Scratch);
        fn structure(&self) -> Structure;
        fn tangent(&self, at: OperatingPoint, tangent: &mut Tangent, scratch: &mut Scratch) -> bool;
        fn acceleration_gradient(&self, at: OperatingPoint, values: &mut [f64], scratch: &mut Scratch) -> bool;
        fn bracket(&self, v: &[f64], x: &[f64], out: &mut [f64]);
        fn levi_civita(&self, at: OperatingPoint, connection: &mut LeviCivita, scratch: &mut Scratch) -> bool;
        fn rate(&self, q: &[f64], v: &[f64], qdot: &mut [f64]);
        fn prescribed_spin(&self, t: f64) -> Option<Spin>;
        fn normalize(&self, q: &mut [f64]);
        fn energy(&self, t: f64, q: &[f64], v: &[f64], scratch: &mut Scratch) -> Option<Energy>;
        fn outputs(&self, at: OperatingPoint, out: &mut [f64], scratch: &mut Scratch);
        fn output_tangent(&self, at: OperatingPoint, tangent: &mut OutputTangent, scratch: &mut Scratch) -> bool;
        fn input_forces(&self, t: f64, q: &[f64], v: &[f64], f: &mut DMatrix<f64>, scratch: &mut Scratch);
        fn input_rate_forces(&self, t: f64, q: &[f64], v: &[f64], f: &mut DMatrix<f64>, scratch: &mut Scratch);
        fn input_values(&self, at: OperatingPoint, out: &mut [f64], scratch: &mut Scratch);
        fn switching(&self, at: OperatingPoint, out: &mut [Rate], scratch: &mut Scratch);
        fn feeds(&self, t: f64, q: &[f64], v: &[f64], scratch: &mut Scratch) -> Vec<Feed>;
        fn roads(&self, t: f64, q: &[f64], v: &[f64], scratch: &mut Scratch) -> Vec<Road>;
        fn write_gaps(&self, q: &[f64], out: &mut [[f64; 3]]);
        fn deformations(&self, q: &[f64], out: &mut [f64]);
        fn spins(&self, q: &[f64], v: &[f64], out: &mut [f64]);
        fn prescribed(&self, t: f64) -> Vec<Prescribed>;
    }
}
