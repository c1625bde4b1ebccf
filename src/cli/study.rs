//! `holonom study SCENE`

use super::common::{Common, Output, duration, fail, print};
use super::interrupt;
use crate::error::{Error, Result, Warning};
use crate::prepared::{Model, Overrides};
use crate::report::{Answer, Folder, Origin, StudyAnswer, cell};
use crate::study::Budget;
use crate::study::variants::{Axis, Plan, Recorded, Sample, Shard, Study, StudyTable};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom study models/quarter_car.json --vary c_strut=500..4000:8 --record travel
  holonom study models/quarter_car.json --vary c_strut=500..4000 --sample latin:6 --linearize")]
pub struct Args {
    #[command(flatten)]
    common: Common,
    /// A parameter and its values, such as k=1e3..1e5:9:log; several make a grid. With --sample leave out :N
    #[arg(long, value_name = "NAME=A..B[:N][:log]", required_unless_present_any = ["list", "merge", "again"])]
    vary: Vec<Axis>,
    /// N points in the ranges: latin:N, sobol:N or random:N
    #[arg(long, value_name = "KIND:N", requires = "vary")]
    sample: Option<Sample>,
    /// Another number gives another sample
    #[arg(long, value_name = "NUMBER", default_value_t = 1, requires = "sample")]
    seed: u64,
    /// Variants from a table whose headings are parameters
    #[arg(long, value_name = "FILE.csv", conflicts_with = "vary")]
    list: Option<PathBuf>,
    /// Numbers of each variant: an output or an expression (its last value), max, min, mean, rms, final of one,
    /// time_of(max(x)), time_of(x, level), above(x, level), at(x, time), error(output), drift, energy_error, cost, steps
    /// (default: the last value of each output)
    #[arg(long, value_name = "QUANTITY[,QUANTITY...]")]
    record: Vec<String>,
    /// Record the eigenvalues of the linear model at the start, their frequencies and damping ratios; without --record
    /// nothing is simulated
    #[arg(long)]
    linearize: bool,
    /// Every N-th variant from the I-th on, for one of N machines; --merge joins the parts
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Compute only the rows that the folder does not have yet
    #[arg(long)]
    resume: bool,
    /// Time for all variants, such as 5min or 2h: those that do not fit in are left to --resume
    #[arg(long, value_name = "TIME", value_parser = duration, allow_hyphen_values = true)]
    budget: Option<Duration>,
    /// Join the rows of the folders of a study
    #[arg(long, value_name = "DIR", num_args = 1.., conflicts_with_all = ["vary", "list", "record", "linearize", "shard", "resume"])]
    merge: Vec<PathBuf>,
    /// Print the command that computes the variant of a row alone, with the same numbers
    #[arg(long, value_name = "ROW", conflicts_with_all = ["vary", "list", "record", "linearize", "shard", "resume", "merge"])]
    again: Option<usize>,
    #[command(flatten)]
    output: Output,
}

pub fn run(args: Args) -> Result<ExitCode> {
    let talk = &args.common.talk;
    let overrides = args.overrides();
    let prepared = talk.load(&args.common.scene.path, &overrides)?;
    let name = match args.shard {
        Some(Shard { index, count }) => format!("{}/shard-{index}-of-{count}", prepared.name),
        None => prepared.name.clone(),
    };
    let place = args.output.output.clone().unwrap_or_else(|| Path::new("out").join(&name));
    if let Some(row) = args.again {
        return again(&StudyTable::read(&place)?, row, &place);
    }
    let (prepared, table, asked) = if args.merge.is_empty() {
        // A folder that cannot be written is told before the work.
        drop(args.output.folder(&name)?);
        args.computed(prepared, &overrides, &place)?
    } else {
        let table = StudyTable::merged(&args.merge, &prepared.fingerprint)?;
        let asked = table.count;
        (prepared, table, asked)
    };
    let failed = table.rows.iter().find(|(_, row)| !row.failure.is_empty());
    talk.warn(&failed.map(|(row, found)| {
        let counts = format!("{} of {} variants failed", table.failed(), table.rows.len());
        let text = format!("{counts}, the first in row {row}: {}", found.failure);
        Warning::new(text, format!("`--again {row}` prints the command that runs it alone"))
    }));
    let answer = StudyAnswer { table: &table, asked, has_figures: true };
    talk.publish(args.output.folder(&name)?, "study", talk.origin(&prepared), &answer)?;
    let done = table.rows.len();
    if interrupt::is_asked() || done < asked {
        let reason = if interrupt::is_asked() { "interrupted" } else { "unfinished" };
        return fail(format!("{reason}: {done} of {asked} variants are there\n  help: go on with --resume"));
    }
    if table.failed() == done { fail("all variants failed") } else { Ok(ExitCode::SUCCESS) }
}

impl Args {
    fn overrides(&self) -> Overrides {
        let overrides = self.common.overrides();
        // The linear model finds its equilibrium by itself.
        let simulates = !self.linearize || !self.record.is_empty();
        Overrides { equilibrium: overrides.equilibrium && simulates, ..overrides }
    }

    fn plan(&self) -> Result<Plan> {
        match (&self.list, self.sample) {
            (Some(path), _) => Plan::list(path),
            (None, Some(sample)) => Plan::sample(&self.vary, sample, self.seed),
            (None, None) => Plan::grid(&self.vary).map_err(|error| error.under("--vary")),
        }
    }

    /// Computes the rows that were asked for; returns them with their number.
    fn computed(&self, prepared: Model, overrides: &Overrides, place: &Path) -> Result<(Model, StudyTable, usize)> {
        let plan = self.plan()?;
        let is_automatic = prepared.is_automatic;
        let prepared = prepared.settled()?;
        let recorded = Recorded { measures: &self.record, modes: self.linearize, is_at_rest: self.common.equilibrium };
        let study = Study::new(&self.common.scene.path, &prepared, overrides, &plan.names, recorded);
        let mut study = study.map_err(|error| error.in_file(&self.common.scene.path))?;
        if is_automatic {
            study = study.with_method(&prepared.method);
            let because = prepared.chosen_because.as_deref().unwrap_or_default();
            self.common.talk.say(&format!("auto: {} for all variants. {because}\n", prepared.method.triple()))?;
        }
        let mut table = StudyTable::new(&study, &plan, &prepared, self.commands(&study));
        if self.resume && place.join("study.json").exists() {
            table.add(StudyTable::read(place)?, place)?;
        }
        let (table, asked) = self.filled(table, &study, &plan, self.common.talk.origin(&prepared), place);
        Ok((prepared, table, asked))
    }

    /// Computes the rows that are missing, within the budget; returns the number that there should be, too.
    fn filled(
        &self,
        table: StudyTable,
        study: &Study,
        plan: &Plan,
        origin: Origin,
        place: &Path,
    ) -> (StudyTable, usize) {
        let is_missing = |row: &usize| self.shard.is_none_or(|part| part.has(*row)) && !table.rows.contains_key(row);
        let missing: Vec<usize> = (0..plan.rows.len()).filter(is_missing).collect();
        let asked = table.rows.len() + missing.len();
        let bar = self.common.talk.progress(missing.len() as u64, "variants");
        let budget = self.budget.map(Budget::begin);
        let is_over = || interrupt::is_asked() || budget.is_some_and(|budget| budget.left().is_zero());
        let mut saved = Instant::now();
        let done = |table: &StudyTable| {
            bar.inc(1);
            if saved.elapsed() > Duration::from_secs(30) {
                // A failure to save is reported at the end.
                let _ = save(table, asked, origin.clone(), place);
                saved = Instant::now();
            }
        };
        let table = table.filled(study, plan, missing, &is_over, done);
        bar.finish_and_clear();
        (table, asked)
    }

    /// Returns the commands that compute one variant alone, without its values.
    fn commands(&self, study: &Study) -> Vec<Vec<String>> {
        let scene = &self.common.scene;
        let mut begun = vec![scene.path.display().to_string()];
        for (name, value) in &scene.set {
            begun.extend(["--set".to_string(), format!("{name}={value}")]);
        }
        let command = |verb: &str, options: Vec<String>| {
            ["holonom", verb].into_iter().map(String::from).chain(begun.clone()).chain(options).collect()
        };
        let mut commands = Vec::new();
        if !study.measures.is_empty() {
            commands.push(command("simulate", options(study)));
        }
        if study.modes.is_some() {
            let at_rest = self.common.equilibrium.then(|| "--equilibrium".to_string());
            commands.push(command("linearize", at_rest.into_iter().collect()));
        }
        commands
    }
}

/// Writes the rows so far, for --resume after a process that is killed.
fn save(table: &StudyTable, asked: usize, origin: Origin, place: &Path) -> Result<()> {
    let mut folder = Folder::create(place)?;
    StudyAnswer { table, asked, has_figures: false }.stage(&mut folder, "study", origin)?;
    folder.finish().map(drop)
}

/// Returns the options of `simulate` that give the settings of every variant.
fn options(study: &Study) -> Vec<String> {
    let Overrides { formulation, integrator, projection, rtol, atol, step, until, output_step, .. } = &study.overrides;
    let methods = [("--formulation", formulation), ("--integrator", integrator), ("--projection", projection)];
    let methods = methods.into_iter().filter_map(|(name, spec)| Some((name, spec.as_ref()?.to_string())));
    let numbers =
        [("--rtol", rtol), ("--atol", atol), ("--step", step), ("--until", until), ("--output-step", output_step)];
    let numbers = numbers.into_iter().filter_map(|(name, number)| Some((name, cell((*number)?))));
    let flags = [("--equilibrium", study.overrides.equilibrium), ("--check-error", study.needs_error())];
    let flags = flags.into_iter().filter(|(_, is_given)| *is_given).map(|(name, _)| name.to_string());
    methods.chain(numbers).flat_map(|(name, value)| [name.to_string(), value]).chain(flags).collect()
}

fn again(table: &StudyTable, row: usize, place: &Path) -> Result<ExitCode> {
    let found = table.rows.get(&row).ok_or_else(|| {
        let (count, place) = (table.count, place.display());
        Error::input(format!("row {row} is not in {place}; there are rows from 0 to {}", count.saturating_sub(1)))
            .under("--again")
            .hint("name the folder of the study with -o")
    })?;
    let values = table.columns.iter().zip(&found.values).take(table.parameters);
    let values: Vec<String> =
        values.flat_map(|(column, value)| ["--set".to_string(), format!("{}={}", column.name, cell(*value))]).collect();
    for command in &table.again {
        let words: Vec<String> = command.iter().chain(&values).map(|word| quoted(word)).collect();
        print(&format!("{}\n", words.join(" ")))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Returns a word as a shell reads it.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-+=./:,%@".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_string();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}
