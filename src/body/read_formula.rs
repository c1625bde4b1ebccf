//! Expressions as a scene writes them: names of markers, states, parameters and outputs are looked up.

use super::build::{Build, NamedOutput};
use super::formula::{Formula, MOST_PROBES};
use super::probe::Probe;
use crate::error::{Error, Result};
use crate::math::expression::{Expression, Name, Names, Number, with_names, words};
use crate::math::signal::Signal;
use std::cell::RefCell;
use std::sync::Arc;

/// Names of an expression beyond parameters, `t`, marker quantities and outputs.
pub type Locals<'a> = &'a [(&'a str, Probe)];

impl<const D: usize> Build<'_, D> {
    /// An expression over t alone, in the equations of motion: its value is
    /// [`eval_held`](Expression::eval_held)`(&[time.t], time.regime)`, and `switching` of the kernel has to write its
    /// [`arguments`](Expression::arguments).
    #[doc(hidden)]
    pub fn function_of_time(&self, field: &str, number: &Number) -> Result<Expression> {
        let formula = self.acting(field, number, false)?;
        formula.function_of_time().map_err(|error| error.under(field))
    }

    /// An expression over t and marker quantities, and their rates if `rates` is true, in the equations of motion: its
    /// switching functions are added to those of the scene.
    #[doc(hidden)]
    pub fn acting(&self, field: &str, number: &Number, rates: bool) -> Result<Formula> {
        self.acting_with(field, number, rates, &[])
    }

    /// The same with names of its own.
    pub(crate) fn acting_with(&self, field: &str, number: &Number, rates: bool, locals: Locals) -> Result<Formula> {
        let order = usize::from(rates);
        let formula = parse(&number.to_string(), self, order, locals);
        let mut formula = formula.map_err(|error| error.under(field))?;
        self.switches.borrow_mut().add(&mut formula.expression);
        Ok(formula)
    }

    /// An expression of an output, which may read accelerations too and does not act on the motion.
    pub(crate) fn observing(&self, field: &str, number: &Number) -> Result<Formula> {
        parse(&number.to_string(), self, 2, &[]).map_err(|error| error.under(field))
    }
}

/// Parses `text`; names of outputs are replaced by what they stand for. Marker quantities may have up to `order`
/// time derivatives.
fn parse<const D: usize>(text: &str, build: &Build<D>, order: usize, locals: Locals) -> Result<Formula> {
    let mut named = Vec::new();
    for (name, probe) in locals {
        // An output that is the quantity itself, as the length of the spring, means the same.
        let means_another = || match build.outputs.find(name, build) {
            Some(Ok(NamedOutput::Probe(own))) => own != *probe,
            found => matches!(found, Some(Ok(_))),
        };
        let is_output = || words(text).any(|(word, _)| word.trim_end_matches('\'') == *name) && means_another();
        let other = match () {
            _ if build.parameters.get(name).is_some() => Some("parameter"),
            _ if build.probe(name).is_some() => Some("state"),
            _ => is_output().then_some("output"),
        };
        if let Some(other) = other {
            let article = if other == "output" { "an" } else { "a" };
            let error = Error::input(format!("`{name}` is {article} {other}, and a name of this expression's own"));
            return Err(error.hint(format!("rename the {other}")));
        }
        named.push((name.to_string(), *probe));
    }
    let text = expand(text, build, order, &mut named)?;
    if let Some((name, _)) = named.iter().find(|(_, probe)| probe.order > order) {
        let what = if order == 0 { "a rate" } else { "an acceleration" };
        return Err(Error::input(format!("`{name}` is {what}, which cannot stand here")).hint(match order {
            0 => "use positions and angles",
            _ => "use positions and velocities: accelerations depend on all forces",
        }));
    }
    let names = FormulaScope { build, order, named, probes: Default::default() };
    let expression = Expression::parse(&text, &names)?;
    if expression.is_constant() {
        expression.constant()?;
    }
    let probes = names.probes.into_inner();
    if probes.len() > MOST_PROBES {
        return Err(Error::input(format!("{} marker quantities in one expression", probes.len()))
            .hint(format!("use at most {MOST_PROBES}")));
    }
    Ok(Formula { expression, probes })
}

/// Largest length of an expression with its outputs replaced, bytes.
const LONGEST: usize = 1_000_000;

/// Replaces names of outputs that are expressions by these in brackets, as deep as outputs use outputs, and adds the
/// others, with their rates, to `named`.
fn expand<const D: usize>(
    text: &str,
    build: &Build<D>,
    order: usize,
    named: &mut Vec<(String, Probe)>,
) -> Result<String> {
    let mut text = text.to_string();
    for _ in 0..DEEPEST {
        let next = replace_names(&text, build, order, named)?;
        if next == text {
            return Ok(text);
        }
        if next.len() > LONGEST {
            break;
        }
        text = next;
    }
    Err(Error::input("outputs refer to each other in a circle, or grow beyond all bounds")
        .hint("write one of them in terms of markers alone"))
}

/// Outputs in outputs beyond the nesting that expressions may have.
const DEEPEST: usize = 200;

fn replace_names<const D: usize>(
    text: &str,
    build: &Build<D>,
    order: usize,
    named: &mut Vec<(String, Probe)>,
) -> Result<String> {
    with_names(text, |word, _| {
        let expression = find(word, build, order, named)?;
        Ok(expression.map(|expression| format!("({expression})")))
    })
}

/// The expression of the output that `word` names; an output that is read off markers is added to `named`.
fn find<const D: usize>(
    word: &str,
    build: &Build<D>,
    order: usize,
    named: &mut Vec<(String, Probe)>,
) -> Result<Option<String>> {
    let name = word.trim_end_matches('\'');
    if named.iter().any(|(known, _)| known == word) {
        return Ok(None);
    }
    let Some(output) = build.outputs.find(name, build) else { return Ok(None) };
    let is_parameter = build.parameters.get(name).is_some();
    // What acts on the motion cannot mean such an output.
    if is_parameter && order < 2 && matches!(output, Ok(NamedOutput::Other(_))) {
        return Ok(None);
    }
    if is_parameter {
        let error = Error::input(format!("`{name}` is both a parameter and an output"));
        return Err(error.hint("rename one of them"));
    }
    match output? {
        NamedOutput::Text(text) if word == name => Ok(Some(text)),
        NamedOutput::Text(_) => Err(without_rate(name)),
        NamedOutput::Other(_) if order < 2 => {
            Err(Error::input(format!("the output `{name}` is no position, angle, distance or rate of these"))
                .hint("what acts on the motion may use outputs of these measures, and expressions"))
        }
        NamedOutput::Other(number) if word == name => {
            named.push((word.to_string(), Probe::output(number)));
            Ok(None)
        }
        NamedOutput::Other(_) => Err(without_rate(name)),
        NamedOutput::Probe(probe) => {
            let rated = (name.len()..word.len()).try_fold(probe, |probe, _| probe.rate());
            let none =
                || Error::input(format!("`{word}` is of too high an order")).hint("two time derivatives at most");
            named.push((word.to_string(), rated.ok_or_else(none)?));
            Ok(None)
        }
    }
}

fn without_rate(name: &str) -> Error {
    Error::input(format!("the output `{name}` has no rate that has a name"))
        .hint("positions, angles and distances have one: write it of these")
}

struct FormulaScope<'a, const D: usize> {
    build: &'a Build<'a, D>,
    /// Highest number of time derivatives.
    order: usize,
    named: Vec<(String, Probe)>,
    probes: RefCell<Vec<Probe>>,
}

impl<const D: usize> Names for FormulaScope<'_, D> {
    fn resolve(&self, name: &str) -> Option<Name> {
        if name == "t" {
            return Some(Name::Variable(0));
        }
        if let Some(value) = self.build.parameters.get(name) {
            return Some(Name::Constant(value));
        }
        let named = self.named.iter().find(|(known, _)| known == name).map(|(_, probe)| *probe);
        let probe = named.or_else(|| self.build.probe(name)).filter(|probe| probe.order <= self.order)?;
        let mut probes = self.probes.borrow_mut();
        let index = probes.iter().position(|known| *known == probe).unwrap_or_else(|| {
            probes.push(probe);
            probes.len() - 1
        });
        Some(Name::Variable(index + 1))
    }

    fn known(&self) -> Vec<String> {
        let quantities: &[&str] = if D == 2 { &["x", "y", "angle"] } else { &["x", "y", "z"] };
        let table = self.build.markers;
        let markers = table.names.iter();
        let states = table.states.iter().map(|(name, _)| name.clone());
        let probes = markers.flat_map(|marker| quantities.iter().map(move |q| format!("{marker}.{q}")));
        let named = self.named.iter().map(|(name, _)| name.clone());
        let known = self.build.parameters.known().into_iter().chain(["t".into()]);
        known.chain(named).chain(states).chain(probes).collect()
    }

    fn signals(&self) -> &[Arc<Signal>] {
        self.build.parameters.signals()
    }
}
