//! Cost and accuracy of richer models.

use super::Args;
use crate::cli::common::{assignment, set_by};
use crate::error::{Error, Result};
use crate::math::expression::Number;
use crate::prepared::{Model, Overrides};
use crate::report::tradeoff::ModelsAnswer;
use crate::study::work_precision::models::{Variant, compare};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

pub fn run(args: &Args, prepared: Model) -> Result<ExitCode> {
    let mut others = Vec::new();
    for text in &args.variants {
        others.push(variant(text, args, &prepared)?);
    }
    let name = prepared.name.clone();
    let set = args.scene.set.iter().map(|(name, value)| format!("{name}={value}")).collect::<Vec<_>>().join(",");
    let source = Some((args.scene.path.clone(), args.overrides()));
    let own = Variant { name: named(&args.scene.path, &set), prepared, source };
    let variants: Vec<Variant> = [own].into_iter().chain(others).collect();
    let folder = args.output.folder(&name)?;
    let repeats = usize::from(args.repeats);
    let bar = args.talk.progress((variants.len() * (repeats + 1) + 1) as u64, &name);
    let watch = |name: &str, done: usize| {
        bar.set_message(name.to_string());
        bar.set_position(done as u64);
    };
    let costs = compare(&variants, &args.outputs, repeats, args.budget, watch);
    bar.finish_and_clear();
    args.talk.publish(folder, "models", args.talk.origin(&variants[0].prepared), &ModelsAnswer::new(&name, &costs?))?;
    Ok(ExitCode::SUCCESS)
}

fn variant(text: &str, args: &Args, like: &Model) -> Result<Variant> {
    let (path, set) = match text.rsplit_once(':') {
        Some((path, rest)) if rest.contains('=') => (path, rest),
        _ => (text, ""),
    };
    let pairs = set.split(',').filter(|pair| !pair.is_empty());
    let own = pairs.map(|pair| {
        let wrong = |_| Error::input(format!("`{pair}` is no parameter")).hint("write SCENE:NAME=VALUE,NAME=VALUE");
        assignment(pair).map_err(wrong)
    });
    let own: Vec<(String, Number)> = own.collect::<Result<_>>().map_err(|error| error.under("--variants"))?;
    let span = like.span()?;
    let overrides = Overrides { set: own, until: Some(span.end), ..args.overrides() };
    let prepared = args
        .talk
        .load(Path::new(path), &overrides)
        .and_then(Model::settled)
        .map_err(|error| set_by(error, "--variants"))?;
    let source = Some((PathBuf::from(path), overrides));
    Ok(Variant { name: named(Path::new(path), set), prepared, source })
}

fn named(path: &Path, set: &str) -> String {
    let stem = path.file_stem().map_or(String::new(), |stem| stem.to_string_lossy().into_owned());
    if set.is_empty() { stem } else { format!("{stem}:{set}") }
}
