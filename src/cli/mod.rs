//! The command line: one file for each subcommand.

mod bode;
mod check;
mod common;
mod completions;
mod drift;
mod generate;
mod import;
mod interrupt;
mod linear;
mod linearize;
mod loci;
mod methods;
mod plot;
mod reference;
mod restart;
mod schema;
mod simplify;
mod simulate;
mod stress;
mod sweep;
mod terminal;
mod tradeoff;
mod transition;
mod validate;

use crate::clock;
use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Simulates mechanisms as differential-algebraic equations and measures how far every method drifts off the
/// constraints.
#[derive(Parser)]
#[command(
    name = "holonom",
    version,
    about,
    max_term_width = 110,
    arg_required_else_help = true,
    after_help = "What a scene may say: holonom reference. Methods: holonom methods. Examples: holonom COMMAND --help"
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// What is modelled: coordinates, constraints, rank, redundancy, consistency, conditioning
    Check(check::Args),
    /// Integrate: trajectory, drift and energy, with figures
    Simulate(simulate::Args),
    /// The same scene under every stabilization: drift against time, one table, one figure
    ///
    /// By the integrator of the scene or of the command line: every stabilization of index 1 for those that take vector fields,
    /// and all other formulations and projections that it goes with. So --formulation and --projection are refused.
    Drift(drift::Args),
    /// Speed for accuracy: what every method costs for the digits it gives, and which to choose
    ///
    /// A grid of methods and tolerances against a tight reference whose own error is told by a second method; medians of
    /// CPU time over interleaved repeats. With --variants: what a richer model of the same mechanism costs and gives.
    Tradeoff(tradeoff::Args),
    /// Position curves: the scene assembled at many values of a parameter, such as camber over wheel travel
    ///
    /// From the scene's own value of the parameter outwards, each state from its neighbour, at the scene's start time.
    /// Where the mechanism cannot be moved on, the end of its travel is found. Multipliers and reactions are those of the
    /// equations of motion at that state, with the accelerations there.
    Sweep(sweep::Args),
    /// The mechanism itself: at one time, at several in one figure, or in motion
    Plot(plot::Args),
    /// Linear models (A, B, C, D) at states of the motion, by every approach, with their eigenvalues
    Linearize(linearize::Args),
    /// Eigenvalues along the motion, or over a parameter: each mode followed, with figures
    ///
    /// Modes are followed by their shapes and values, so that those which cross keep their names. Off equilibrium the
    /// eigenvalues are those of the linear model frozen at each state, and belong to its chart.
    Loci(loci::Args),
    /// Frequency response between named inputs and outputs at a state of the motion
    Bode(bode::Args),
    /// Linear models against simulations of small perturbations: observed order, horizon and a verdict
    ///
    /// The exit code is 1 where the verdict is that a model is wrong, and standard error says of which state. The chart is
    /// by default that of `linearize`; a moving one is carried along the motion.
    Validate(validate::Args),
    /// How small changes grow along the motion: Floquet multipliers of a period, Lyapunov exponents
    Transition(transition::Args),
    /// Maps over extremes: steps, gains, masses, stiffness, tolerances, speeds, sizes, times, start errors
    Stress(stress::Args),
    /// The least model and the cheapest method that keep the watched outputs within a bound, as a scene
    ///
    /// The scene is the richest model. What a change does is estimated from one run of it, then measured: the model with all
    /// that was left out is run whole on the same motion. Beams with fewer elements or modes or rigid, links, sliders
    /// and branches without mass, bodies at rest, stiff springs and bushings, redundant joints, forces that hardly do any work.
    Simplify(simplify::Args),
    /// Print a scalable scene
    Generate(generate::Args),
    /// A scene from a robot in URDF, loops closed by joints named here
    ///
    /// Links become rigid bodies, what fixed joints hold together one; joints stand at zero. What the scene leaves out, such as
    /// limits and meshes, is said on standard error.
    Import(import::Args),
    /// Formulations, integrators and projections: what goes with what, proven orders, what each is for
    Methods(methods::Args),
    /// What a scene may say: its keys, types of elements, measures, units and expressions
    Reference(reference::Args),
    /// Print the JSON Schema of a scene
    #[command(after_help = "Examples:
  holonom schema
  holonom schema > scene.schema.json")]
    Schema,
    /// Print what completes commands and options in a shell
    Completions(completions::Completions),
    /// Manual pages
    Man(completions::Man),
}

/// Set to `readings` by tests, this variable of the environment lets budgets count readings of the clock.
const CLOCK: &str = "HOLONOM_CLOCK";

/// Runs the command line and returns the exit code: 0 done, 1 the run failed, 2 bad input.
pub fn run() -> ExitCode {
    let command = Cli::parse().command;
    interrupt::listen();
    if std::env::var_os(CLOCK).is_some_and(|clock| clock == "readings") {
        clock::count_readings();
    }
    let result = match command {
        Command::Check(args) => check::run(args),
        Command::Simulate(args) => simulate::run(args),
        Command::Drift(args) => drift::run(args),
        Command::Tradeoff(args) => tradeoff::run(args),
        Command::Sweep(args) => sweep::run(args),
        Command::Plot(args) => plot::run(args),
        Command::Linearize(args) => linearize::run(args),
        Command::Loci(args) => loci::run(args),
        Command::Bode(args) => bode::run(args),
        Command::Validate(args) => validate::run(args),
        Command::Transition(args) => transition::run(args),
        Command::Stress(args) => stress::run(args),
        Command::Simplify(args) => simplify::run(args),
        Command::Generate(args) => generate::run(args),
        Command::Import(args) => import::run(args),
        Command::Methods(args) => methods::run(args),
        Command::Reference(args) => reference::run(args),
        Command::Schema => schema::run(),
        Command::Completions(args) => completions::completions(args),
        Command::Man(args) => completions::man(args),
    };
    match result {
        Ok(code) => code,
        Err(error) => {
            terminal::tell(format!("error: {error}"));
            ExitCode::from(error.exit_code())
        }
    }
}
