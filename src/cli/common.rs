//! Options that the subcommands share.

pub use super::talk::{
    Output, Talk, command_line, fail, json_files, print, print_result, put, tell, to_json, unprintable,
};

use super::caller::elements;
use crate::error::{Error, Result};
use crate::math::expression::{Number, constant};
use crate::math::memory::refuse_rows;
use crate::method_spec::{Listed, MethodSpec};
use crate::prepared::{Model, Overrides};
use crate::scene::Automatic;
use crate::simulate::Span;
use crate::system::Dimensions;
use crate::trajectory::recorded;
use crate::{formulation, integrator, projection};
use clap::Args;
use std::path::PathBuf;
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

impl SceneOptions {
    /// Returns the elements and parameters that replace those of the scene.
    pub fn overrides(&self) -> Overrides {
        Overrides { elements: elements(), set: self.set.clone(), ..Overrides::default() }
    }
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

/// Attributes an error in a parameter to the option that set it, in the place of `--set`.
pub fn set_by(error: Error, option: &str) -> Error {
    error.changed(|input| {
        if input.path == "--set" {
            input.path = option.to_string();
        }
    })
}

impl Common {
    pub fn load(&self) -> Result<Model> {
        self.talk.load(&self.scene.path, &self.overrides())
    }

    /// Returns the changes of the scene's settings.
    pub fn overrides(&self) -> Overrides {
        Overrides { equilibrium: self.equilibrium, ..self.method.overrides(&self.scene, self.spec.method) }
    }

    /// Returns the time span, if its rows fit into memory.
    pub fn span(&self, prepared: &Model) -> Result<Span> {
        let Dimensions { q, v, lambda, .. } = prepared.system().dimensions();
        self.span_with(prepared, 1 + q + v + lambda + recorded(prepared.system()).len(), true)
    }

    /// Returns the time span, if its rows with this number of columns fit into memory, or into a file where they are
    /// not kept.
    pub fn span_with(&self, prepared: &Model, columns: usize, is_kept: bool) -> Result<Span> {
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
        let rest = scene.overrides();
        Overrides { method, formulation, integrator, projection, rtol, atol, step, until, output_step, ..rest }
    }
}

/// Returns one of `names`, or an error that suggests the most similar.
pub fn pick<'a>(what: &str, found: &str, names: &[&'a str]) -> Result<&'a str> {
    let canonical = found.replace('-', "_");
    let name = names.iter().find(|name| **name == canonical).copied();
    name.ok_or_else(|| Error::unknown(what, found, names.iter().copied()))
}
