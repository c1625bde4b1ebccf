//! Linear models at any state of a trajectory.

mod against;
mod along;
mod amplification;
mod changes;
mod chart;
mod comparison;
mod coordinates;
mod curve;
mod displacement;
mod entry;
mod excited;
mod floquet;
#[doc(hidden)]
pub mod flow;
mod found;
mod frequency;
mod independent;
mod input_states;
mod kink;
mod least_norm;
mod lift;
mod lyapunov;
mod matching;
mod matrix;
mod method;
mod minimal;
mod model;
mod perturbation;
mod point;
mod recurrence;
mod reduction;
mod redundant;
mod reference;
mod response;
mod shown;
mod singular;
mod slopes;
mod sparse;
mod spectrum;
mod states;
mod steady;
mod survey;
mod thresholds;
mod tracking;
mod transition;
mod unconstrained;
mod units;
mod variants;
mod variation;
mod visible;

#[doc(hidden)]
pub use against::{Against, against, both};
pub(crate) use against::{Fate, branch_places};
pub(crate) use along::CarriedChart;
pub use along::{Along, Deviation, MeasuredA, along, within};
#[doc(hidden)]
pub use amplification::amplified;
#[doc(hidden)]
pub use changes::Changes;
pub(crate) use changes::{beside, directions_of};
pub use chart::Chart;
#[doc(hidden)]
pub use comparison::{Comparison, compare};
#[doc(hidden)]
pub use coordinates::{Coordinates, parallel};
#[doc(hidden)]
pub use entry::LinearMatrices;
pub use entry::{Linear, LinearizationMethod};
#[doc(hidden)]
pub use floquet::Defect;
pub use floquet::{Floquet, floquet};
#[doc(hidden)]
pub use frequency::Resonances;
pub use frequency::frequency_response;
pub(crate) use kink::changed_parts;
#[doc(hidden)]
pub use kink::kinks;
use lift::Lift;
pub use lyapunov::{Lyapunov, lyapunov};
pub use matrix::Matrix;
pub(crate) use method::refuse_large;
pub use method::{linearize, registry};
#[doc(hidden)]
pub use minimal::{Minimal, minimal};
pub(crate) use model::ModePair;
pub use model::{Complex, Cost, Kind, LinearModel, Mode, ModelFrame, Reduction};
#[doc(hidden)]
pub use model::{are_conjugate, damping, frequency, pairs};
use perturbation::Perturbation;
pub use point::LinearizationPoint;
pub use reference::Reference;
pub use response::Response;
pub use slopes::Slope;
pub use sparse::modal;
pub(crate) use states::tighten;
pub use states::{State, states};
#[doc(hidden)]
pub use states::{states_of, within_run};
pub use steady::{Operating, at_rest};
#[doc(hidden)]
pub use survey::{Gap, Reached};
pub use survey::{Loci, LociVariable, loci_along, loci_over};
pub use thresholds::{Threshold, ThresholdKind};
#[doc(hidden)]
pub use tracking::track;
pub use tracking::{Branch, LociPoint};
pub use transition::{Transition, transition};
pub use units::Units;
#[doc(hidden)]
pub use variants::Variants;
pub use variants::{At, Sensitivity};
pub use variation::Variation;
pub(crate) use visible::visible;
#[doc(hidden)]
pub use visible::{amplitude, seen};
