//! The state of a linear model as the reference of a controller.

use super::changes::directions_of;
use super::{Coordinates, LinearizationPoint, Matrix};
use crate::run::Moment;
use crate::system::MechanicalSystem;
use nalgebra::DVector;

/// The operating point of a linear model, from which [`Moment::minus`] measures the states x of the model.
#[derive(Clone, Debug, Default)]
pub struct Reference {
    q: Vec<f64>,
    v: Vec<f64>,
    /// dq along the velocity directions of a unit of each coordinate, n_v x n_q.
    directions: Matrix,
    /// B and T of the chart: z = B dq, y = B (dv - T z). Without a chart z = dq and y = dv.
    b: Matrix,
    tilt: Matrix,
}

impl Reference {
    pub(super) fn new(
        system: &dyn MechanicalSystem,
        point: &LinearizationPoint,
        coordinates: Option<&Coordinates>,
    ) -> Self {
        let n = system.dimensions();
        let (b, tilt) = coordinates.map_or_else(
            || (Matrix::identity(n.v, n.v), Matrix::zeros(n.v, n.moving())),
            |coordinates| (coordinates.b.clone(), coordinates.tilt.clone()),
        );
        let directions = directions_of(system, &point.q);
        Reference { q: point.q.clone(), v: point.v.clone(), directions, b, tilt }
    }
}

impl Moment {
    /// The states x = (z, y) of a linear model: the change from its operating point in its coordinates. The states of
    /// inputs are not among them. Of quaternions the change is right to first order.
    pub fn minus(&self, reference: &Reference) -> DVector<f64> {
        let Reference { q, v, directions, b, tilt } = reference;
        let change =
            |now: &[f64], then: &[f64]| DVector::from_iterator(now.len(), now.iter().zip(then).map(|(a, b)| a - b));
        let z = b.rows(0, tilt.ncols()) * (directions * change(&self.q, q));
        let y = b * (change(&self.v, v) - tilt * &z);
        DVector::from_iterator(z.len() + y.len(), z.iter().chain(y.iter()).copied())
    }
}
