//! Options and functions that the subcommands share.

pub use super::terminal::{print, tell};

use super::terminal::visible;
use crate::error::{Error, Result, Warning};
use crate::math::expression::{Number, Parameters, constant};
use crate::math::memory::refuse_rows;
use crate::method_spec::{Listed, MethodSpec};
use crate::prepared::{Overrides, PreparedScene};
use crate::report::{Answer, Folder, Format, Origin, Written, write_whole};
use crate::scene::Automatic;
use crate::simulate::Span;
use crate::system::Dimensions;
use crate::trajectory::recorded;
use crate::{formulation, integrator, projection};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

/// The scene and how to solve it.
#[derive(Args)]
pub struct Common {
    #[command(flatten)]
    pub scene: SceneOptions,
    /// Start at rest, from the static equilibrium that belongs to the scene's start
    #[arg(long)]
    pub equilibrium: bool,
    #[command(flatten)]
    pub spec: AutoOption,
    #[command(flatten)]
    pub method: MethodOptions,
    #[command(flatten)]
    pub talk: Talk,
}

/// Which scene.
#[derive(Args)]
pub struct SceneOptions {
    /// Scene file (JSON)
    #[arg(value_name = "SCENE")]
    pub path: PathBuf,
    /// Replace a parameter of the scene: a number, or an expression such as pi/2 or 2*l
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub set: Vec<(String, Number)>,
}

/// Heading of the options that change the scene's settings.
const OWN: &str = "In the place of the scene's own settings";

/// Leaves the method to the program.
#[derive(Args)]
pub struct AutoOption {
    /// auto: formulation, integrator and projection by trials along the motion
    #[arg(long, help_heading = OWN, value_name = "auto", value_parser = automatic,
          conflicts_with_all = ["formulation", "integrator", "projection", "step"])]
    pub method: Option<Automatic>,
}

/// How to solve it.
#[derive(Args)]
pub struct MethodOptions {
    /// Formulation, such as index1 or baumgarte:alpha=5,beta=5
    #[arg(long, help_heading = OWN, long_help = names("Formulation, with options as in \
          baumgarte:alpha=5,beta=5", formulation::registry()))]
    pub formulation: Option<MethodSpec>,
    /// Integrator, such as dop853
    #[arg(long, help_heading = OWN, long_help = names("Integrator", integrator::registry()))]
    pub integrator: Option<MethodSpec>,
    /// Projection after each step, such as manifold:sweeps=2
    #[arg(long, help_heading = OWN, long_help = names("Projection after each step, with options as \
          in manifold:sweeps=2", projection::registry()))]
    pub projection: Option<MethodSpec>,
    /// Relative tolerance, asked of the motion: steps are controlled by tighter ones
    #[arg(long, help_heading = OWN, value_parser = positive, allow_negative_numbers = true)]
    pub rtol: Option<f64>,
    /// Absolute tolerance, likewise
    #[arg(long, help_heading = OWN, value_parser = positive, allow_negative_numbers = true)]
    pub atol: Option<f64>,
    /// Fixed step, s; 0 for steps that the integrator chooses
    #[arg(long, help_heading = OWN, value_name = "H", value_parser = not_negative, allow_negative_numbers = true)]
    pub step: Option<f64>,
    /// Steps that the integrator chooses, in the place of a fixed step of the scene
    #[arg(long, help_heading = OWN, conflicts_with = "step")]
    pub adaptive: bool,
    /// End time, s
    #[arg(long, help_heading = OWN, value_name = "T", value_parser = number, allow_negative_numbers = true)]
    pub until: Option<f64>,
    /// Distance of the rows of the trajectory, s
    #[arg(long, help_heading = OWN, value_name = "DT", value_parser = positive, allow_negative_numbers = true)]
    pub output_step: Option<f64>,
}

/// What is printed.
#[derive(Args)]
pub struct Talk {
    /// Print the result as JSON on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors, and JSON where that is asked for
    #[arg(long)]
    pub quiet: bool,
    /// Warnings so far.
    #[arg(skip)]
    said: RefCell<Vec<Warning>>,
}

/// Where results go.
#[derive(Args)]
pub struct Output {
    /// Folder for the results (default: out/NAME)
    #[arg(short, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Format of the figures
    #[arg(long, value_enum, default_value_t = Format::Svg)]
    pub figures: Format,
}

/// Returns the help on an option with all that it can name.
fn names<E: Listed>(what: &str, registry: &[E]) -> String {
    let names: Vec<&str> = registry.iter().map(E::name).collect();
    format!("{what}. One of {}. `holonom methods` lists the accepted combinations", names.join(", "))
}

fn automatic(text: &str) -> Result<Automatic, String> {
    let help = "it can be `auto`; name methods by --formulation, --integrator and --projection";
    if text == "auto" { Ok(Automatic::Auto) } else { Err(help.to_string()) }
}

pub fn number(text: &str) -> Result<f64, String> {
    match constant(text) {
        Some(value) if value.is_finite() => Ok(value),
        _ if has_unit(text) => {
            Err(format!("`{text}` has a unit; write the number alone, in units of the SI, times in s"))
        }
        _ => Err(format!("`{text}` is not a finite number")),
    }
}

/// True for a number with letters behind it, such as `20s`.
fn has_unit(text: &str) -> bool {
    let number = text.trim_end_matches(char::is_alphabetic).trim_end();
    number.len() < text.len() && constant(number).is_some()
}

pub fn positive(text: &str) -> Result<f64, String> {
    number(text).and_then(|value| if value > 0.0 { Ok(value) } else { Err("it must be above zero".to_string()) })
}

pub fn not_negative(text: &str) -> Result<f64, String> {
    number(text).and_then(|value| if value >= 0.0 { Ok(value) } else { Err("it must not be below zero".to_string()) })
}

/// Reads a time with its unit, s by default.
pub fn duration(text: &str) -> Result<Duration, String> {
    let split = text.find(|c: char| c.is_alphabetic()).unwrap_or(text.len());
    let (value, unit) = text.split_at(split);
    let unit = match unit.trim() {
        "" | "s" => 1.0,
        "ms" => 1e-3,
        "min" | "m" => 60.0,
        "h" => 3600.0,
        other => return Err(format!("`{other}` is no unit of time; write 60s, 5min or 1h")),
    };
    let seconds = unit * positive(value)?;
    Duration::try_from_secs_f64(seconds).map_err(|_| "that is too long".to_string())
}

pub fn assignment(text: &str) -> Result<(String, Number), String> {
    let number = |text: &str| text.trim().parse().map_or_else(|_| Number::from(text), Number::Value);
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() && !value.trim().is_empty() => {
            Ok((name.trim().to_string(), number(value)))
        }
        _ => Err("write NAME=VALUE, as in --set k1=200".to_string()),
    }
}

/// Refuses a parameter that is set twice, since only one value can count.
fn refuse_twice(set: &[(String, Number)]) -> Result<()> {
    let is_known = |i: usize| set[..i].iter().any(|(name, _)| *name == set[i].0);
    match (0..set.len()).find(|i| is_known(*i)) {
        None => Ok(()),
        Some(i) => Err(Error::input(format!("the parameter `{}` is set twice", crate::error::excerpt(&set[i].0)))
            .under("--set")
            .hint("give each parameter one value")),
    }
}

/// Attributes an error in a parameter to the option that set it, in the place of `--set`.
pub fn set_by(error: Error, option: &str) -> Error {
    error.changed(|input| {
        if input.path == "--set" {
            input.path = option.to_string();
        }
    })
}

impl Common {
    pub fn load(&self) -> Result<PreparedScene> {
        self.talk.load(&self.scene.path, &self.overrides())
    }

    /// Returns the changes of the scene's settings.
    pub fn overrides(&self) -> Overrides {
        Overrides { equilibrium: self.equilibrium, ..self.method.overrides(&self.scene, self.spec.method) }
    }

    /// Returns the time span, if its rows fit into memory.
    pub fn span(&self, prepared: &PreparedScene) -> Result<Span> {
        let Dimensions { q, v, lambda, .. } = prepared.system().dimensions();
        self.span_with(prepared, 1 + q + v + lambda + recorded(prepared.system()).len(), true)
    }

    /// Returns the time span, if its rows with this number of columns fit into memory, or into a file where they are
    /// not kept.
    pub fn span_with(&self, prepared: &PreparedScene, columns: usize, is_kept: bool) -> Result<Span> {
        let span = prepared.span().map_err(|error| error.in_file(&self.scene.path))?;
        refuse_rows((span.end - span.start) / span.output_step + 1.0, columns, is_kept)
            .map_err(|error| error.under("--output-step").hint("give a larger one, or an earlier end with --until"))?;
        Ok(span)
    }
}

impl MethodOptions {
    /// Returns the changes of the scene's settings; `method` is given if the program chooses it.
    pub fn overrides(&self, scene: &SceneOptions, method: Option<Automatic>) -> Overrides {
        let MethodOptions { rtol, atol, until, output_step, .. } = *self;
        let step = self.step.or(self.adaptive.then_some(0.0));
        let formulation = self.formulation.clone();
        let integrator = self.integrator.clone();
        let projection = self.projection.clone();
        let set = scene.set.clone();
        let rest = Overrides::default();
        Overrides { set, method, formulation, integrator, projection, rtol, atol, step, until, output_step, ..rest }
    }
}

impl Talk {
    /// Loads the scene, with warnings about its start.
    pub fn load(&self, path: &Path, overrides: &Overrides) -> Result<PreparedScene> {
        refuse_twice(&overrides.set)?;
        let prepared = PreparedScene::load(path, overrides)?;
        self.warn(&prepared.doubts);
        Ok(prepared)
    }

    /// Prints a text of one of several results as it comes, unless JSON is requested or nothing.
    pub fn say(&self, text: &str) -> Result<()> {
        if self.json || self.quiet { Ok(()) } else { print(text) }
    }

    /// Moves the files into place, tells what they replace, prints the result, and names the files.
    pub fn conclude(&self, folder: Folder, json: &impl serde::Serialize, text: impl FnOnce() -> String) -> Result<()> {
        let written = folder.finish()?;
        written.note().filter(|_| !self.quiet).iter().for_each(tell);
        self.print(json, text)?;
        self.tell_files(&written)
    }

    pub fn print(&self, json: &impl serde::Serialize, text: impl FnOnce() -> String) -> Result<()> {
        if self.json || !self.quiet { print_result(self.json, json, text) } else { Ok(()) }
    }

    /// Returns the origin of a result: the command line, the scene's parameters and method, and the warnings so far.
    pub fn origin(&self, prepared: &PreparedScene) -> Origin {
        Origin { simulation: Some(prepared.method.clone()), ..self.origin_of(&prepared.parameters) }
    }

    /// Returns the origin of a result of several methods, or of none.
    pub fn origin_of(&self, parameters: &Parameters) -> Origin {
        Origin { command: command_line(), ..Origin::new(parameters, self.said.borrow().clone()) }
    }

    /// Writes an answer with its JSON as `STEM.json`, moves all files into place, prints it and names the files.
    pub fn publish(
        &self,
        mut folder: Folder,
        stem: &str,
        origin: impl Into<Option<Origin>>,
        answer: &impl Answer,
    ) -> Result<()> {
        answer.write(&mut folder, stem)?;
        let sealed = folder.seal(&format!("{stem}.json"), origin, answer.json())?;
        self.conclude(folder, &sealed, || answer.text())
    }

    /// Prints the folder and the names of the files, if text is printed.
    pub fn tell_files(&self, written: &Written) -> Result<()> {
        self.say(&format!("\nwritten to {}\n", written.listing()))
    }

    pub fn warn<'w>(&self, warnings: impl IntoIterator<Item = &'w Warning>) {
        for warning in warnings {
            self.said.borrow_mut().push(warning.clone());
            if !self.quiet {
                tell(warning.to_string());
            }
        }
    }

    /// Returns a progress bar of `length` steps on a terminal; a hidden one in a pipe. It is cleared
    /// when it is dropped.
    pub fn progress(&self, length: u64, what: &str) -> ProgressBar {
        if self.quiet {
            return ProgressBar::hidden();
        }
        let template = "{msg} {wide_bar:.cyan/dim} {percent}% {eta}";
        let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
        // A run that ends at once shows no bar.
        let bar = ProgressBar::new(length).with_style(style).with_message(visible(what).into_owned());
        bar.set_draw_target(indicatif::ProgressDrawTarget::stderr_with_hz(5));
        bar
    }
}

impl Output {
    /// Makes the folder of the results of the scene `name`.
    pub fn folder(&self, name: &str) -> Result<Folder> {
        let path = self.output.clone().unwrap_or_else(|| Path::new("out").join(name));
        Ok(Folder::create(&path)?.drawing(self.figures))
    }
}

/// Prints the result: JSON if requested, else text.
pub fn print_result(as_json: bool, json: &impl serde::Serialize, text: impl FnOnce() -> String) -> Result<()> {
    if as_json { print(&to_json(json)?) } else { print(&text()) }
}

/// Returns indented JSON that ends its last line.
pub fn to_json(value: &impl serde::Serialize) -> Result<String> {
    serde_json::to_string_pretty(value).map(|text| text + "\n").map_err(unprintable)
}

/// Writes a text to a file, or prints it where none is given.
pub fn put(text: &str, path: Option<&Path>) -> Result<()> {
    path.map_or_else(|| print(text), |path| write_whole(path, text.as_bytes()))
}

pub fn json_files(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder)?.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    paths.sort();
    Ok(paths)
}

/// Tells why the command failed, although its results are written.
pub fn fail(text: impl std::fmt::Display) -> Result<ExitCode> {
    tell(format!("error: {text}"));
    Ok(ExitCode::from(1))
}

pub fn unprintable(error: serde_json::Error) -> Error {
    Error::input(format!("cannot print as JSON: {error}"))
}

/// Returns one of `names`, or an error that suggests the most similar.
pub fn pick<'a>(what: &str, found: &str, names: &[&'a str]) -> Result<&'a str> {
    let canonical = found.replace('-', "_");
    let name = names.iter().find(|name| **name == canonical).copied();
    name.ok_or_else(|| Error::unknown(what, found, names.iter().copied()))
}

/// The words of the command; characters of a name that are not text are replaced.
pub fn command_line() -> Vec<String> {
    std::env::args_os().map(|word| word.to_string_lossy().into_owned()).collect()
}
