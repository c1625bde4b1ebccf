//! Mechanisms as differential-algebraic equations: simulated, their constraint drift measured, linearized at any state.
//!
//! # Three programs
//!
//! Longer forms of these are examples of Cargo: `cargo run --example state_feedback`, `compared_methods`, `many_runs`.
//!
//! A scene is read, changed and linearized. It then runs under feedback from that linear model; `lqr` is the user's own.
//!
//! ```
//! use holonom::linear::Matrix;
//! use holonom::prelude::*;
//!
//! # fn lqr(a: &Matrix, b: &Matrix) -> Matrix { Matrix::zeros(b.ncols(), a.nrows()) }
//! let crane = Model::load("tests/examples/crane.json")?.set("load", 120.0)?;
//! let model = crane.linearize_at(0.8, &Linear::in_coordinates(["trolley.x", "rope.angle"]))?;
//! let k = lqr(&model.a, &model.b);
//! let reference = model.state.clone();
//! let mut run = crane.run().input("drive", every(0.01, move |x| -(&k * x.minus(&reference))[0]));
//! run.to(1.0)?;
//! println!("{:.3e}", run.record().output("trolley_x")?.last());
//! # Ok::<(), Error>(())
//! ```
//!
//! Methods are compared on own equations. M, f and phi are given; all derivatives follow.
//!
//! ```
//! use holonom::prelude::*;
//!
//! struct Pendulum;
//!
//! impl Equations for Pendulum {
//!     fn size(&self) -> (usize, usize) {
//!         (2, 1)
//!     }
//!     fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
//!         mass.copy_from_slice(&[1.0, 0.0, 0.0, 1.0].map(S::constant));
//!     }
//!     fn force<S: Scalar>(&self, _t: S, _q: &[S], _v: &[S], f: &mut [S]) {
//!         f.copy_from_slice(&[0.0, -9.81].map(S::constant));
//!     }
//!     fn phi<S: Scalar>(&self, _t: S, q: &[S], phi: &mut [S]) {
//!         phi[0] = (q[0].square() + q[1].square()).sqrt() - 1.0;
//!     }
//!     fn potential(&self, _t: f64, q: &[f64]) -> Option<f64> {
//!         Some(9.81 * q[1])
//!     }
//! }
//!
//! let start = ([1.0, 0.0], [0.0, 0.0]);
//! for method in ["index1 + dop853 + manifold", "ggl + radau_iia", "baumgarte + dop853"] {
//!     let record = simulate(&Pendulum, method, &start, 0.0..1.0)?.record;
//!     println!("{method}: {:.1e} m, {:.1e}", record.drift.position.max, record.energy_error());
//! }
//! # Ok::<(), Error>(())
//! ```
//!
//! A scene runs for many values of a parameter on all cores, each run to an event or to the end.
//!
//! ```
//! use holonom::prelude::*;
//!
//! let suspensions = Family::load("tests/examples/suspension.json")?;
//! let peaks: Vec<f64> = suspensions.each("k", linspace(1e4, 5e4, 8), |car| {
//!     let mut run = car.run();
//!     run.until(|s| s.output("gap") - 0.01, 0.5)?; // End::Event(t) or End::Reached
//!     Ok(run.record().output("force")?.max_abs())
//! })?;
//! assert_eq!(peaks.len(), 8);
//! # Ok::<(), Error>(())
//! ```
//!
//! # Modules
//!
//! | module | what is there |
//! |---|---|
//! | [`prelude`] | names that most programs need |
//! | [`run`] | scenes read and run: models, families, inputs, events, records, checkpoints |
//! | [`system`] | own equations by M, f and phi, or by energies |
//! | [`linear`] | linear models at a state or along a motion, their modes, loci and check by simulation |
//! | [`parts`] | own joints, forces and bodies; scenes built in code |
//! | [`methods`] | formulations, integrators and projections by name |
//! | [`study`] | drift under stabilizations, speed for accuracy, stress maps, variants |
//! | [`error`] | errors with place and remedy |
//! | [`guide`] | chapters that explain how to model, simulate, linearize and judge results |
//! | [`research`] | own methods, systems in full, and all that the crate is made of. It is unstable |
//!
//! [`guide::rust`] has an example of each.
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
//! Features, both on by default: `cli`, the module of that name and the program; `figures`, PNG and GIF beside SVG. `cli`
//! includes `view`, the page that shows a motion; `npz`, NumPy's archives, and `urdf`, the module `import`. `python` is
//! for maturin, which builds the package.

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// Derivatives of products and quotients are sums of products: that is no slip.
#![allow(clippy::suspicious_arithmetic_impl)]

// Hidden modules are no part of the stable interface; `research` lists them. The program and the tests use them by these paths.
#[cfg(feature = "python")]
mod abandoned;
#[doc(hidden)]
pub mod analysis;
#[doc(hidden)]
pub mod body;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
#[doc(hidden)]
pub mod clock;

pub mod error;
#[doc(hidden)]
pub mod files;
#[doc(hidden)]
pub mod force;
#[doc(hidden)]
pub mod formulation;
mod forward;
pub mod guide;
#[cfg(feature = "urdf")]
#[doc(hidden)]
pub mod import;
#[doc(hidden)]
pub mod initial;
#[doc(hidden)]
pub mod integrator;
#[doc(hidden)]
pub mod joint;
pub mod linear;
#[doc(hidden)]
pub mod linearize;
#[doc(hidden)]
pub mod math;
#[doc(hidden)]
pub mod method_spec;
pub mod methods;
mod modes;
pub mod parts;
#[doc(hidden)]
pub mod plot;
#[doc(hidden)]
pub mod prepared;
#[doc(hidden)]
pub mod projection;
#[cfg(feature = "python")]
mod python;
#[doc(hidden)]
pub mod report;
pub mod research;
pub mod run;
#[doc(hidden)]
pub mod scene;
#[doc(hidden)]
pub mod simplify;
#[doc(hidden)]
pub mod simulate;
pub mod study;
#[doc(hidden)]
pub mod sweep;
pub mod system;
#[doc(hidden)]
pub mod tolerances;
#[doc(hidden)]
pub mod trajectory;
#[doc(hidden)]
pub mod validate;
#[cfg(feature = "view")]
#[doc(hidden)]
pub mod view;

pub use error::{Error, Result};

pub use {nalgebra, rayon, schemars, serde};

/// Names that most programs need: `use holonom::prelude::*`.
pub mod prelude {
    #[doc(no_inline)]
    pub use crate::linear::{Linear, LinearModel};
    #[doc(no_inline)]
    pub use crate::methods::Method;
    #[doc(no_inline)]
    pub use crate::run::{End, Family, Model, Moment, every, linspace, simulate};
    #[doc(no_inline)]
    pub use crate::system::{Equations, Lagrangian, Scalar};
    #[doc(no_inline)]
    pub use crate::{Error, Result};
}
