//! Types of the fields and arguments of runs, linear models and studies, which a program seldom names.

pub use crate::analysis::{Drift, DriftLevel, EnergyBalance, Extremes, Recorder, Series, Singularity};
pub use crate::body::MarkerId;
#[doc(inline)]
pub use crate::error::{Failure, Input as InputError};
pub use crate::force::InputKind;
pub use crate::formulation::Statistics;
pub use crate::initial::Assembly;
pub use crate::linearize::{
    Along, At, Branch, Chart, Complex, Floquet, Kind, LinearizationPoint, Loci, LociPoint, LociVariable, Lyapunov,
    Mode, Operating, Reference, Sensitivity, Threshold, ThresholdKind, Transition, Variants, Variation,
    frequency_response, lyapunov,
};
pub use crate::math::eigen::ComplexMatrix;
pub use crate::math::expression::{ParameterError, Parameters};
pub use crate::run::MarkerFrame;
pub use crate::simulate::{Span, Start, Stop};
pub use crate::study::{
    Axis, Filling, Filter, Measure, Motion, Recommendation, Recorded, Sample, StabilizedRun, StressCell, StressLimits,
    StressStatus, Stressed, StudyRow, Subject, TradeoffCell, TradeoffDrift, TradeoffOutcome, TradeoffPlan, Triple,
    WorkPrecision, grid,
};
pub use crate::system::Excitation;
pub use crate::trajectory::Trajectory;
pub use crate::validate::{
    Direction, EventPassage, PerturbationSequence, Settings, SpanCheck, Verdict, validate_along,
};
