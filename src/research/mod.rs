//! Unstable: what the rest of the crate is made of. Its names and types change without notice.
//!
//! The stable interface is the other modules of the crate. A program that needs more takes it from here, as in
//! `use holonom::research::methods::Integrator`, and pins the version.
//!
//! | module | what is there |
//! |---|---|
//! | [`methods`] | traits of own integrators, formulations and projections |
//! | [`systems`] | the trait that solvers see, for systems with their own derivatives |
//! | [`results`] | types of fields and arguments that a program seldom names |
//!
//! The modules of the layers below are here, too, as in `use holonom::research::initial::assemble`. Their pages are
//! shown by
//!
//! ```text
//! RUSTDOCFLAGS="--cfg research" cargo doc --no-deps --open
//! ```
//!
//! # The way of the data
//!
//! ```text
//! scene.json -> Scene -> Model -> MechanicalSystem -> Formulation -> Integrator (+ Projection) -> Trajectory, drift
//!                                                                               -> Linear model -> Validation
//! ```
//!
//! # Layers
//!
//! Each layer uses only those above it in this list.
//!
//! | module | what is there | add one |
//! |---|---|---|
//! | `error`, `math`, `method_spec` | errors with place and remedy; dual and Taylor numbers, expressions, saddle-point solver; methods by name | |
//! | `body` | rigid bodies and point masses, their frames at markers | a file and a line in `body::registry`, or from outside |
//! | `joint`, `force` | constraints and wrenches over frames | a file and a line in the registry, or from outside |
//! | `scene` | the JSON format, its checks and its schema; scenes built in code | |
//! | `import` | scenes from URDF and MJCF (feature `urdf`) | |
//! | `system` | `system::MechanicalSystem`, which solvers see; own equations by `system::Equations` or `system::Lagrangian` | implement it |
//! | `formulation` | what is integrated: index 1, Baumgarte, invariant manifold, penalty, null space ... | a file and a line |
//! | `projection` | what is done after a step: post-stabilization, coordinate projection | a file and a line |
//! | `initial` | consistent q, v, then v' and lambda; static equilibrium | |
//! | `integrator` | one file a method | a file and a line |
//! | `simulate`, `trajectory`, `prepared` | the only time loop; its rows; a scene made ready | |
//! | `sweep` | a scene assembled at many values of a parameter | |
//! | `analysis` | what is seen of a state or of one run: rank and redundancy, singular states, drift, energy | |
//! | `run` | `run::Run`: a motion that one holds, steps, drives by inputs and ends at events | |
//! | `linearize` | linear models at a state, by every method; state-transition matrix, loci | a file and a line in `linearize::registry` |
//! | `validate` | linear models against perturbed simulations | |
//! | `study` | many simulations of one scene: drift under stabilizations, speed for accuracy (`study::work_precision`), maps over stress parameters (`study::stress`), variants with recorded numbers (`study::variants`) | a stress parameter: an entry in `study::stress::registry` |
//! | `simplify` | the least model of a scene that keeps a promise | a file and a line in `simplify::registry`, or from outside |
//! | `tolerances` | thresholds that several files share, with what they decide, their unit, reason and test | |
//! | `plot`, `report`, `view` | figures, files and text, the page that shows a motion | |
//! | `cli` | the command line | one file a subcommand |
//! | `python` | the compiled part of the Python package in `src/python` (feature `python`) | |
//!
//! # Packages
//!
//! | package | what it does here |
//! |---|---|
//! | nalgebra | small and dense matrices: linear models, transition matrices, assembly |
//! | faer | factorizations: sparse and dense LU of implicit methods, L D L^T where L fills, QR; eigenvalues |
//! | diffsol | the integrators `tr_bdf2`, `esdirk34`, `tsit45` and `diffsol`; the second opinion on references |
//! | plotters | figures: charts, axes, meshes, elements of series, maps and legends, colour maps |
//! | serde_json | scenes, results, checkpoints |
//!
//! Own code stands in the place of a package where that was measured to be better:
//!
//! | own code | in the place of | reason |
//! |---|---|---|
//! | L D L^T of the saddle-point matrix, `math::kkt` | L D L^T and LU of faer | dense, of size 16: 0.43 us for 0.48 and 1.0 us; sparse, of size 1000: 14 us for 22 and 71 us. It also finds dependent rows |
//! | `bdf` | BDF of diffsol | 0.4 to 0.6 times the time at equal errors of 1e-5 and 1e-6 on chains of 10 and 100 links: `cargo bench --bench implicit` |
//! | Krylov-Schur method, `math::eigen` | `partial_eigen` of faer | that gives vectors only, which coincide where an eigenvalue is defective |
//! | recording backend of figures, `plot` | backends of plotters | these draw lines without antialiasing, at whole pixels, and SVG files two to seven times as large |
//! | palette of GIF files, `files` | GIF backend of plotters | one palette serves all frames, of which only the differences are written |
//! | sparse LU, `integrator::diffsol` | `FaerSparseLU` of diffsol | that panics on a matrix without factors; this is faer's, too, and reports it |

pub mod methods;
pub mod results;
pub mod systems;

#[cfg(feature = "urdf")]
#[cfg_attr(research, doc(inline))]
pub use crate::import;
#[cfg_attr(research, doc(inline))]
pub use crate::{
    analysis, body, force, formulation, initial, integrator, joint, linearize, math, method_spec, plot, prepared,
    projection, report, scene, simplify, simulate, sweep, tolerances, trajectory, validate,
};
