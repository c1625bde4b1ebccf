//! Mechanisms as differential-algebraic equations: simulated, their constraint drift measured, linearized at any state.
//!
//! # Equations
//!
//! ```text
//! q' = N(q) v                          n_q coordinates, n_v velocities; N = I except for quaternions
//! M(q) v' + G(q,t)^T lambda = f(t,q,v)
//! phi(q,t) = 0                         n_c holonomic constraints
//! phi' = G v + phi_t = 0
//! phi'' = G v' - gamma = 0             gamma: what is left of phi'' at v' = 0, with its sign turned
//! A(q,t) v + a(q,t) = 0                nonholonomic rows, the last ones of G and phi'
//! xi' = r(t,q,v,xi)                    states of controllers, filters and actuators, the last ones of v; f may depend on xi
//! ```
//!
//! SI units, angles in radians. `lambda` is signed so that `-G^T lambda` is the generalized force of the joints: the
//! multiplier of a massless rod is its tension. `index` means the differential index and nothing else.
//!
//! | code | meaning | code | meaning |
//! |---|---|---|---|
//! | `q, v, vdot` | coordinates, velocities, accelerations | `mass`, `f` | mass matrix; all forces but the reactions |
//! | `lambda` | multipliers | `phi, g, gamma` | as above |
//! | `u`, `y` | inputs, which add to f, to what a driver prescribes or to a road; outputs | | |
//! | `l` | d(G v + phi_t)/dq along the directions of v | `h, rtol, atol` | step, tolerances |
//!
//! # The way of the data
//!
//! ```text
//! scene.json -> Scene -> Model -> MechanicalSystem -> Formulation -> Integrator (+ Projection) -> Trajectory, drift
//!                                                                               -> Linear model -> Validation
//! ```
//!
//! # Map
//!
//! Each layer uses only those above it in this list.
//!
//! | module | what is there | add one |
//! |---|---|---|
//! | [`error`], [`math`], [`method_spec`] | errors with place and remedy; dual and Taylor numbers, expressions, saddle-point solver; methods by name | |
//! | [`body`] | rigid bodies and point masses, their frames at markers | a file and a line in [`body::registry`], or from outside |
//! | [`joint`], [`force`] | constraints and wrenches over frames | a file and a line in the registry, or from outside |
//! | [`scene`] | the JSON format, its checks and its schema; scenes built in code | |
//! | `import` | scenes from URDF and MJCF (feature `urdf`) | |
//! | [`system`] | [`system::MechanicalSystem`], which solvers see; own equations by [`system::Equations`] or [`system::Lagrangian`] | implement it |
//! | [`formulation`] | what is integrated: index 1, Baumgarte, invariant manifold, penalty, null space ... | a file and a line |
//! | [`projection`] | what is done after a step: post-stabilization, coordinate projection | a file and a line |
//! | [`initial`] | consistent q, v, then v' and lambda; static equilibrium | |
//! | [`integrator`] | one file a method | a file and a line |
//! | [`simulate`], [`trajectory`], [`prepared`] | the only time loop; its rows; a scene made ready | |
//! | [`sweep`] | a scene assembled at many values of a parameter | |
//! | [`analysis`] | what is seen of a state or of one run: rank and redundancy, singular states, drift, energy | |
//! | [`run`] | [`run::Run`]: a motion that one holds, steps, drives by inputs and ends at events | |
//! | [`linearize`] | linear models at a state, by every method; state-transition matrix, loci | a file and a line in [`linearize::registry`] |
//! | [`validate`] | linear models against perturbed simulations | |
//! | [`study`] | many simulations of one scene: drift under stabilizations, speed for accuracy ([`study::work_precision`]), maps over stress parameters ([`study::stress`]), variants with recorded numbers ([`study::variants`]) | a stress parameter: an entry in [`study::stress::registry`] |
//! | [`simplify`] | the least model of a scene that keeps a promise | a file and a line in [`simplify::registry`], or from outside |
//! | [`tolerances`] | thresholds that several files share, with what they decide, their unit, reason and test | |
//! | [`plot`], [`report`], [`view`] | figures, files and text, the page that shows a motion | |
//! | [`cli`] | the command line | one file a subcommand |
//! | `python` | the compiled part of the Python package in `src/python` (feature `python`) | |
//!
//! Features, both on by default: `cli`, the module of that name and the program; `figures`, PNG and GIF beside SVG. `cli`
//! includes `view`, the page that shows a motion; `npz`, NumPy's archives, and `urdf`, the module `import`. `python` is
//! for maturin, which builds the package.
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
//! | L D L^T of the saddle-point matrix, [`math::kkt`] | L D L^T and LU of faer | dense, of size 16: 0.43 us for 0.48 and 1.0 us; sparse, of size 1000: 14 us for 22 and 71 us. It also finds dependent rows |
//! | `bdf` | BDF of diffsol | 0.4 to 0.6 times the time at equal errors of 1e-5 and 1e-6 on chains of 10 and 100 links: `cargo bench --bench implicit` |
//! | Krylov-Schur method, `math::eigen` | `partial_eigen` of faer | that gives vectors only, which coincide where an eigenvalue is defective |
//! | recording backend of figures, `plot` | backends of plotters | these draw lines without antialiasing, at whole pixels, and SVG files two to seven times as large |
//! | palette of GIF files, `files` | GIF backend of plotters | one palette serves all frames, of which only the differences are written |
//! | sparse LU, `integrator::diffsol` | `FaerSparseLU` of diffsol | that panics on a matrix without factors; this is faer's, too, and reports it |
//!
//! # Own parts
//!
//! All that has a registry may come from outside the crate. Examples to copy, run by the tests, are in `tests/examples`:
//!
//! | own | by | example |
//! |---|---|---|
//! | equations | [`system::Equations`], or [`system::MechanicalSystem`] in full | `own_equations.rs` |
//! | energies | [`system::Lagrangian`] | `own_lagrangian.rs` |
//! | joint | [`joint::JointSpec`], [`joint::JointKernel`], [`scene::Elements::with_joint`] | `own_joint.rs` |
//! | force | [`force::ForceSpec`], [`force::ForceKernel`], [`scene::Elements::with_force`] | `own_force.rs` |
//! | body | [`body::BodySpec`], [`body::BodyKernel`], [`scene::Elements::with_body`] | `own_body.rs` |
//! | integrator | [`integrator::Entry`] and its [`spec`](method_spec::Listed::spec) in a [`simulate::Method`] | `own_integrator.rs`, `own_tableau.rs` |
//! | formulation | [`formulation::Entry`] likewise | `own_formulation.rs` |
//! | projection | [`projection::Entry`] likewise | `own_projection.rs` |
//! | simplification | [`simplify::Candidate`] in the list that [`simplify::simplify`](fn@simplify::simplify) takes | `own_simplification.rs` |
//!
//! Beside them: a scene built in code by [`scene::SceneBuilder`] (`scene_in_code.rs`), and a linear model (`linear_model.rs`).
//!
//! # Example
//!
//! ```
//! use holonom::prelude::*;
//!
//! let model = Model::parse(r#"{
//!     "name": "pendulum", "dimension": 2, "gravity": [0, -9.81],
//!     "ground": { "markers": { "O": [0, 0] } },
//!     "bodies": [{ "name": "bob", "type": "point_mass", "mass": 1, "initial": { "position": [1, 0] } }],
//!     "joints": [{ "name": "rod", "type": "distance", "between": ["ground.O", "bob"], "length": 1 }],
//!     "simulation": { "t_end": 1, "integrator": "dop853", "rtol": 1e-10, "atol": 1e-10 }
//! }"#)?;
//! let mut run = model.run();
//! run.to(1.0)?;
//! assert!(run.record().drift.position.max < 1e-14);
//! # Ok::<(), holonom::Error>(())
//! ```

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// Derivatives of products and quotients are sums of products: that is no slip.
#![allow(clippy::suspicious_arithmetic_impl)]

// Modules and items hidden from the documentation are no part of the interface: the program and the crate's own tests see them.
pub mod analysis;
pub mod body;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
#[doc(hidden)]
pub mod clock;

pub mod error;
#[doc(hidden)]
pub mod files;
pub mod force;
pub mod formulation;
mod forward;
pub mod guide;
#[cfg(feature = "urdf")]
pub mod import;
pub mod initial;
pub mod integrator;
pub mod joint;
pub mod linearize;
pub mod math;
pub mod method_spec;
mod modes;
#[doc(hidden)]
pub mod plot;
pub mod prepared;
pub mod projection;
#[cfg(feature = "python")]
mod python;
#[doc(hidden)]
pub mod report;
pub mod run;
pub mod scene;
pub mod simplify;
pub mod simulate;
pub mod study;
pub mod sweep;
pub mod system;
#[doc(hidden)]
pub mod tolerances;
pub mod trajectory;
pub mod validate;
#[cfg(feature = "view")]
#[doc(hidden)]
pub mod view;

pub use error::{Error, Result};

/// What most programs need: `use holonom::prelude::*`.
pub mod prelude {
    pub use crate::analysis::{Record, Recorder};
    pub use crate::linearize::{Chart, Linear, LinearModel, State, linearize};
    pub use crate::math::Scalar;
    pub use crate::method_spec::{Listed, MethodSpec};
    pub use crate::prepared::{Family, Model, Overrides, linspace};
    pub use crate::run::{End, Moment, Run, every, simulate};
    pub use crate::scene::{Elements, Scene, SceneBuilder};
    pub use crate::simulate::{Method, Span};
    pub use crate::system::{Equations, Lagrangian, MechanicalSystem};
    pub use crate::validate::{Settings, validate};
    pub use crate::{Error, Result};
}
