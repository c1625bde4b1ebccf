//! A mechanism of either dimension.

use crate::body::MarkerTable;
use crate::scene::AnyModel;
use crate::system::{MechanicalSystem, Mechanism};

/// A mechanism in the plane or in space.
pub enum AnyMechanism {
    /// A mechanism in the plane.
    Planar(Mechanism<2>),
    /// A mechanism in space.
    Spatial(Mechanism<3>),
}

/// Evaluates an expression for the mechanism, which has another type in the plane than in space.
macro_rules! in_either {
    ($mechanism:expr, $name:ident => $value:expr) => {
        match $mechanism {
            $crate::prepared::AnyMechanism::Planar($name) => $value,
            $crate::prepared::AnyMechanism::Spatial($name) => $value,
        }
    };
}

pub(crate) use in_either;

impl AnyMechanism {
    /// Mechanism of a model.
    pub fn new(model: AnyModel) -> Self {
        match model {
            AnyModel::Planar(model) => AnyMechanism::Planar(Mechanism::new(model)),
            AnyModel::Spatial(model) => AnyMechanism::Spatial(Mechanism::new(model)),
        }
    }

    /// Mechanisms of the models that hold joint coordinates of the start, and their rates.
    pub(crate) fn held(models: [Option<Box<AnyModel>>; 2]) -> [Option<AnyMechanism>; 2] {
        models.map(|model| model.map(|model| AnyMechanism::new(*model)))
    }

    /// The mechanism as the solvers see it.
    pub fn system(&self) -> &dyn MechanicalSystem {
        in_either!(self, mechanism => mechanism)
    }

    /// Its markers.
    pub fn markers(&self) -> &MarkerTable {
        in_either!(self, mechanism => &mechanism.model().markers)
    }

    /// 2 in the plane, 3 in space.
    pub fn dimension(&self) -> usize {
        if matches!(self, AnyMechanism::Planar(_)) { 2 } else { 3 }
    }
}
