//! The command line: one file for each subcommand.

mod bode;
pub mod caller;
mod check;
pub(crate) mod common;
mod completions;
mod drift;
mod generate;
mod guide;
mod import;
pub(crate) mod interrupt;
mod kinematics;
mod linear;
mod linearize;
mod loci;
mod methods;
mod models;
mod plot;
mod reference;
mod restart;
pub(crate) mod run;
mod simplify;
mod simulate;
mod stress;
mod study;
mod talk;
pub mod terminal;
mod tradeoff;
mod transition;
mod validate;
mod view;

use crate::clock;
use crate::error::{Error, Result};
use caller::set_words;
use clap::{CommandFactory, Parser, Subcommand};
use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;
use std::sync::OnceLock;
use terminal::{Captured, captured};

/// Simulates mechanisms as differential-algebraic equations and measures how far every method drifts off the
/// constraints.
#[derive(Parser)]
#[command(
    name = "holonom",
    version = version(),
    about,
    max_term_width = 110,
    arg_required_else_help = true,
    after_help = "Guide: holonom guide. Keys of scenes: holonom reference. Methods: holonom methods. Examples: holonom COMMAND --help"
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// The model: coordinates, constraints, rank, redundancy, consistency, conditioning
    Check(check::Args),
    /// Integrate: trajectory, drift and energy, with figures
    Simulate(simulate::Args),
    /// The same scene under every stabilization: drift against time, one table, one figure
    ///
    /// The integrator is that of the scene or of the command line. It is run with every formulation and projection that it
    /// accepts, so --formulation and --projection are refused.
    Drift(drift::Args),
    /// Speed for accuracy: what every method costs for the digits it gives, and which to choose
    ///
    /// A grid of methods and tolerances against a tight reference whose own error is told by a second method; medians of
    /// CPU time over interleaved repeats. With --variants: what a richer model of the same mechanism costs and gives.
    Tradeoff(tradeoff::Args),
    /// Position curves: the scene assembled at many values of a parameter, such as camber over wheel travel
    ///
    /// It begins at the scene's own value of the parameter and goes outwards, each state from its neighbour, at the scene's
    /// start time. It finds the end of the travel. Multipliers and reactions are those of the equations of motion at that
    /// state, with the accelerations there.
    Kinematics(kinematics::Args),
    /// The earlier name of `kinematics`
    #[command(hide = true)]
    Sweep(kinematics::Args),
    /// The mechanism itself: at one time, at several in one figure, or in motion
    Plot(plot::Args),
    /// One page for a browser: the mechanism in motion to turn around, its outputs, drift and modes
    View(view::Args),
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
    /// Growth of small changes along the motion: Floquet multipliers of a period, Lyapunov exponents
    Transition(transition::Args),
    /// Maps over extremes: steps, gains, masses, stiffness, tolerances, speeds, sizes, times, start errors
    Stress(stress::Args),
    /// The least model and the cheapest method that keep the watched outputs within a bound, as a scene
    ///
    /// The scene is the full model. The effect of each change is estimated from one run of it. Then the simplified model is
    /// run on the same motion, and the effect is measured. Changes: beams with fewer elements or modes or rigid, links and
    /// branches without mass, bodies at rest, stiff springs and bushings, redundant joints, forces that hardly do any work.
    Simplify(simplify::Args),
    /// Print a scalable scene
    Generate(generate::Args),
    /// A scene from a robot in URDF or a model in MJCF, loops closed by joints named here
    ///
    /// Links become rigid bodies. Links that fixed joints hold together become one. Joints stand at zero, in MJCF at `ref`.
    /// Equalities of MJCF are soft there and exact constraints here. Its motors become inputs. Standard error lists all that
    /// the scene leaves out, such as limits, contacts and meshes, and all that looks wrong in the file.
    Import(import::Args),
    /// Many variants of the scene: a grid, a sample or a list of parameters, one row of recorded numbers each
    ///
    /// The scene is read once. Variants run on all cores, and their rows do not depend on the number of cores. Only the
    /// recorded numbers are computed and written. A variant that fails is a row that says why.
    Study(study::Args),
    /// Formulations, integrators and projections: what goes with what, proven orders, what each is for
    Methods(methods::Args),
    /// The scene format: keys, types of elements, measures, units and expressions
    Reference(reference::Args),
    /// A chapter of the guide, or the list of chapters
    Guide(guide::Args),
    /// The scenes of a folder with their tags and what they are
    Models(models::Args),
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

/// The number of threads, as rayon reads it.
const THREADS: &str = "RAYON_NUM_THREADS";
/// More threads than any machine has cores.
const MOST_THREADS: usize = 1024;

/// Set to `readings` by tests, this variable of the environment lets budgets count readings of the clock.
const CLOCK: &str = "HOLONOM_CLOCK";

fn version() -> &'static str {
    static VERSION: OnceLock<String> = OnceLock::new();
    let features = [
        ("figures", cfg!(feature = "figures")),
        ("npz", cfg!(feature = "npz")),
        ("urdf", cfg!(feature = "urdf")),
        ("view", cfg!(feature = "view")),
    ];
    VERSION.get_or_init(|| {
        let names: Vec<&str> = features.iter().filter(|(_, is_built)| *is_built).map(|(name, _)| *name).collect();
        format!("{} (features: cli {})", env!("CARGO_PKG_VERSION"), names.join(" "))
    })
}

/// Runs the command of these words, the program first, and returns the exit code: 0 done, 1 the run failed, 2 bad input.
pub fn run(words: impl IntoIterator<Item = OsString>) -> ExitCode {
    let command = Cli::parse_from(words).command;
    interrupt::listen();
    if std::env::var_os(CLOCK).is_some_and(|clock| clock == "readings") {
        clock::count_readings();
    }
    execute(command).unwrap_or_else(|error| {
        terminal::tell(format!("error: {error:#}"));
        ExitCode::from(error.exit_code())
    })
}

/// Executes the command of these words, the program first, and keeps what it would print. Results go to `folder`, unless
/// the words name another one.
///
/// # Errors
/// Words that the command does not know; a request for help, whose text is the error.
pub fn call(words: &[String], folder: &Path) -> Result<(Result<ExitCode>, Captured), clap::Error> {
    let program = Cli::command();
    let command = words.get(1).and_then(|name| program.find_subcommand(name));
    let has = |option: &str| command.is_some_and(|it| it.get_arguments().any(|known| known.get_long() == Some(option)));
    let mut all: Vec<OsString> = words.iter().map(OsString::from).collect();
    all.extend(has("json").then(|| "--json".into()));
    if has("figures") && !words.iter().any(|word| word == "-o") {
        all.extend(["-o".into(), folder.as_os_str().to_owned()]);
    }
    let command = Cli::try_parse_from(all)?.command;
    set_words(words);
    Ok(captured(|| execute(command)))
}

fn execute(command: Command) -> Result<ExitCode> {
    refuse_threads()?;
    match command {
        Command::Check(args) => check::run(args),
        Command::Simulate(args) => simulate::run(args),
        Command::Drift(args) => drift::run(args),
        Command::Tradeoff(args) => tradeoff::run(args),
        Command::Kinematics(args) => kinematics::run(args),
        Command::Sweep(args) => {
            terminal::tell("note: `sweep` is now called `kinematics`; `study` simulates variants");
            kinematics::run(args)
        }
        Command::Plot(args) => plot::run(args),
        Command::View(args) => view::run(args),
        Command::Linearize(args) => done(linearize::run(args)),
        Command::Loci(args) => loci::run(args),
        Command::Bode(args) => done(bode::run(args)),
        Command::Validate(args) => validate::run(args),
        Command::Transition(args) => done(transition::run(args)),
        Command::Stress(args) => stress::run(args),
        Command::Study(args) => study::run(args),
        Command::Simplify(args) => simplify::run(args),
        Command::Generate(args) => done(generate::run(args)),
        Command::Import(args) => done(import::run(args)),
        Command::Methods(args) => done(methods::run(args)),
        Command::Reference(args) => done(reference::run(args)),
        Command::Guide(args) => done(guide::run(args)),
        Command::Models(args) => done(models::run(args)),
        Command::Schema => done(reference::schema()),
        Command::Completions(args) => done(completions::completions(args)),
        Command::Man(args) => done(completions::man(args)),
    }
}

fn done(result: Result<()>) -> Result<ExitCode> {
    result.map(|()| ExitCode::SUCCESS)
}

/// Refuses a number of threads whose memory and start alone take longer than most runs.
fn refuse_threads() -> Result<()> {
    let asked = std::env::var(THREADS).ok().and_then(|count| count.trim().parse::<usize>().ok());
    match asked.filter(|count| *count > MOST_THREADS) {
        None => Ok(()),
        Some(count) => {
            Err(Error::input(format!("{THREADS} asks for {count} threads, but at most {MOST_THREADS} are started"))
                .hint("give the number of cores, or leave it out"))
        }
    }
}
