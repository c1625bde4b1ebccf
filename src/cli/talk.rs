//! What the commands print, and where their results go.

pub use super::caller::command_line;
pub use super::terminal::{print, tell};

use super::terminal::{capture, is_captured, visible};
use crate::error::{Error, Result, Warning};
use crate::math::expression::{Number, Parameters};
use crate::prepared::{Model, Overrides};
use crate::report::{Answer, Folder, Format, Origin, Written, write_whole};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

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

impl Talk {
    /// Loads the scene, with warnings about its start.
    pub fn load(&self, path: &Path, overrides: &Overrides) -> Result<Model> {
        refuse_twice(&overrides.set)?;
        let prepared = Model::load_with(path, overrides)?;
        self.warn(&prepared.doubts);
        Ok(prepared)
    }

    /// Prints a text of one of several results as it comes, unless JSON is requested or nothing.
    pub fn say(&self, text: &str) -> Result<()> {
        if (self.json || self.quiet) && !is_captured() { Ok(()) } else { print(text) }
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
    pub fn origin(&self, prepared: &Model) -> Origin {
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
        let sealed = answer.stage(&mut folder, stem, origin)?;
        self.conclude(folder, &sealed, || answer.text())
    }

    pub fn tell_files(&self, written: &Written) -> Result<()> {
        // Who takes the output has chosen the folder.
        if is_captured() {
            return Ok(());
        }
        self.say(&format!("\nwritten to {}\n", written.listing()))
    }

    pub fn warn<'w>(&self, warnings: impl IntoIterator<Item = &'w Warning>) {
        for warning in warnings {
            self.said.borrow_mut().push(warning.clone());
            if !self.quiet {
                tell(format!("{warning:#}"));
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

    /// Returns a progress bar that is told the times of a run between two.
    pub fn progress_between(&self, from: f64, to: f64, what: &str) -> impl Fn(f64) + use<> {
        let bar = self.progress(1000, what);
        move |t| bar.set_position((1000.0 * (t - from) / (to - from)) as u64)
    }
}

impl Output {
    pub fn folder(&self, name: &str) -> Result<Folder> {
        let path = self.output.clone().unwrap_or_else(|| Path::new("out").join(name));
        Ok(Folder::create(&path)?.drawing(self.figures))
    }
}

/// Prints the result: JSON if requested, else text. Who takes the output gets both.
pub fn print_result(as_json: bool, json: &impl serde::Serialize, text: impl FnOnce() -> String) -> Result<()> {
    if is_captured() {
        let json = to_json(json)?;
        capture(|captured| captured.json = Some(json));
        return print(&text());
    }
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
    tell(format!("error: {text:#}"));
    Ok(ExitCode::from(1))
}

pub fn unprintable(error: serde_json::Error) -> Error {
    Error::input(format!("cannot print as JSON: {error}"))
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
