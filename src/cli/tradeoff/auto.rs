//! Models that `simplify` finds, each by many methods.

use super::{Args, Question};
use crate::cli::common::fail;
use crate::cli::interrupt;
use crate::error::{Result, percent};
use crate::prepared::Model;
use crate::report::tradeoff::{MeasuredModel, ModelsAndMethods};
use crate::simplify::{Simplification, SimplificationSettings, Source, registry, simplify};
use crate::study::Motion;
use crate::study::work_precision::{Runner, WorkPrecision};
use crate::system::Dimensions;
use indicatif::ProgressBar;
use std::process::ExitCode;
use std::time::Duration;

/// Promises for which a model is sought.
const WITHIN: [f64; 3] = [0.1, 0.01, 1e-3];
/// Part of the budget for each search.
const SEARCH: u32 = 8;

pub fn run(args: &Args, prepared: Model) -> Result<ExitCode> {
    args.check_choices(prepared.system())?;
    let folder = args.output.folder(&prepared.name)?;
    let name = prepared.name.clone();
    let bar = args.talk.progress((WITHIN.len() + 1) as u64, &name);
    let found = models(args, &prepared, &bar);
    let found = found?;
    let searched = WITHIN.len() as u32;
    let rest = args.budget - args.budget * searched / SEARCH;
    let budget = rest / (1 + found.len()) as u32;
    let own = ("as it is".to_string(), Vec::new());
    let all = [(own, &prepared)].into_iter().chain(found.iter().map(|(own, prepared)| (own.clone(), prepared)));
    let mut models: Vec<MeasuredModel> = Vec::new();
    for ((model, left_out), scene) in all {
        bar.set_message(model.clone());
        let measured = measure(args, scene, budget)?;
        bar.inc(1);
        let Dimensions { v, lambda, .. } = scene.system().dimensions();
        models.push(MeasuredModel::new(model, left_out, v, lambda, measured, models.first()));
    }
    bar.finish_and_clear();
    args.talk.publish(
        folder,
        "tradeoff_models",
        args.talk.origin(&prepared),
        &ModelsAndMethods { scene: name, models },
    )?;
    if interrupt::is_asked() { fail("interrupted") } else { Ok(ExitCode::SUCCESS) }
}

type Named = (String, Vec<String>);

/// The models that are simpler than the scene, each once, with what they leave out.
fn models(args: &Args, prepared: &Model, bar: &ProgressBar) -> Result<Vec<(Named, Model)>> {
    let source = Source::load(&args.scene.path, &args.overrides())?;
    let mut models: Vec<(Named, Model)> = Vec::new();
    for within in WITHIN {
        let settings = SimplificationSettings {
            within,
            outputs: args.outputs.clone(),
            budget: Some(args.budget / SEARCH),
            ..SimplificationSettings::default()
        };
        let mut watch = |what: &str, _: usize| bar.set_message(format!("{}: {what}", prepared.name));
        let found = simplify(&source, &settings, registry(), &interrupt::is_asked, &mut watch)?;
        let left_out: Vec<String> = found.left_out().flat_map(|trial| trial.what.clone()).collect();
        let is_new = models.iter().all(|((_, known), _)| *known != left_out);
        if found.is_simpler() && is_new {
            let Simplification { simplified, .. } = &found;
            models.push(((format!("within {}", percent(within)), left_out), source.prepare(simplified)?));
        }
        bar.inc(1);
    }
    Ok(models)
}

/// Methods on a model, their errors against its own motion.
fn measure(args: &Args, prepared: &Model, budget: Duration) -> Result<WorkPrecision> {
    let span = prepared.span()?;
    let Question { watched, plan } = args.question(prepared, budget, None)?;
    let motion = Motion::of(prepared, span, watched, &interrupt::is_asked);
    let mut measured = WorkPrecision::fresh(&prepared.name, span.start, span.end, plan.rows);
    Runner::new(motion, &plan, |_: &WorkPrecision, _: &str| ()).run(&mut measured)?;
    Ok(measured)
}
