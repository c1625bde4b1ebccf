//! Expressions over time, scalars read off markers, and outputs by their names.

use super::{Build, Frame, MarkerId, Probe};
use crate::error::{Error, Result};
use crate::math::expression::{Expression, Name, Names, with_names, words};
use crate::math::signal::Signal;
use crate::math::{Scalar, Taylor, Time};
use std::cell::RefCell;
use std::sync::Arc;

/// An expression over t and probes; variable 0 is t, variable i + 1 is probe i.
#[derive(Clone, Debug)]
pub struct Formula {
    /// The expression, its variables numbered as above.
    pub expression: Expression,
    /// Marker quantities in the order of the variables.
    pub probes: Vec<Probe>,
}

/// The largest number of probes of a formula: they are evaluated on the stack.
pub const MOST_PROBES: usize = 24;

/// An output of the scene as expressions read it.
pub enum NamedOutput {
    /// An expression that stands for it.
    Text(String),
    /// A scalar of markers.
    Probe(Probe),
    /// Another measure, of the output of this number, which outputs alone may use.
    Other(usize),
}

/// The outputs of a scene by their names.
pub trait NamedOutputs<const D: usize> {
    /// The output of this name, if there is one.
    ///
    /// # Errors
    /// It is none that an expression may use.
    fn find(&self, name: &str, build: &Build<D>) -> Option<Result<NamedOutput>>;
}

/// No outputs.
impl<const D: usize> NamedOutputs<D> for () {
    fn find(&self, _: &str, _: &Build<D>) -> Option<Result<NamedOutput>> {
        None
    }
}

/// Names of an expression beyond parameters, `t`, marker quantities and outputs.
pub type Locals<'a> = &'a [(&'a str, Probe)];

impl Formula {
    /// Parses `text`; names of outputs are replaced by what they stand for. Marker quantities may have up to `order`
    /// time derivatives.
    pub fn parse<const D: usize>(text: &str, build: &Build<D>, order: usize, locals: Locals) -> Result<Formula> {
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
        let names = Scope { build, order, named, probes: Default::default() };
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

    /// The expression as a function of t alone; an error if it reads a marker.
    pub fn function_of_time(self) -> Result<Expression> {
        if self.probes.is_empty() {
            Ok(self.expression)
        } else {
            Err(Error::input("this may depend on t and parameters only, but uses a marker")
                .hint("markers and outputs may stand in an `equation` joint, an applied force or torque, the law of a spring, a tyre's road, and outputs"))
        }
    }

    /// The markers that it reads, each once, in the order of its probes.
    pub fn markers(&self) -> Vec<MarkerId> {
        let mut markers = Vec::new();
        for marker in self.probes.iter().flat_map(Probe::markers) {
            if !markers.contains(&marker) {
                markers.push(marker);
            }
        }
        markers
    }

    /// These markers, and after them the others that it reads.
    pub fn markers_after(&self, own: &[MarkerId]) -> Vec<MarkerId> {
        let others = self.markers().into_iter().filter(|marker| !own.contains(marker));
        own.iter().copied().chain(others).collect()
    }

    /// Value of the expression, with `read` for the values of the probes.
    pub fn evaluate<S: Scalar>(&self, time: Time<S>, read: impl Fn(&Probe) -> S) -> S {
        self.with(time, read, |variables| self.expression.eval_held(variables, time.regime))
    }

    /// Writes the arguments of its switching functions at their numbers.
    pub fn switching<S: Scalar>(&self, time: Time<S>, read: impl Fn(&Probe) -> S, out: &mut [S]) {
        self.with(time, read, |variables| self.expression.arguments(variables, time.regime, out));
    }

    /// Value at the moving frames of an element's markers.
    pub fn at<S: Scalar, const D: usize>(
        &self,
        time: Time<S>,
        markers: &[MarkerId],
        frames: &[Frame<Taylor<S>, D>],
    ) -> S {
        self.evaluate(time, |probe| probe.read(time.regime, |marker| slot(markers, marker, frames)))
    }

    /// As [`switching`](Self::switching), at the moving frames of an element's markers.
    pub fn switching_at<S: Scalar, const D: usize>(
        &self,
        time: Time<S>,
        markers: &[MarkerId],
        frames: &[Frame<Taylor<S>, D>],
        out: &mut [S],
    ) {
        self.switching(time, |probe| probe.read(time.regime, |marker| slot(markers, marker, frames)), out);
    }

    /// Value of a formula over positions and angles alone at the frames of an element's markers.
    pub fn placed<S: Scalar, const D: usize>(&self, time: Time<S>, markers: &[MarkerId], frames: &[Frame<S, D>]) -> S {
        self.evaluate(time, |probe| probe.position(time.regime, |marker| slot(markers, marker, frames)))
    }

    /// As [`switching`](Self::switching), for a formula over positions and angles alone.
    pub fn switching_placed<S: Scalar, const D: usize>(
        &self,
        time: Time<S>,
        markers: &[MarkerId],
        frames: &[Frame<S, D>],
        out: &mut [S],
    ) {
        self.switching(time, |probe| probe.position(time.regime, |marker| slot(markers, marker, frames)), out);
    }

    fn with<S: Scalar, R>(&self, time: Time<S>, read: impl Fn(&Probe) -> S, see: impl FnOnce(&[S]) -> R) -> R {
        if self.probes.is_empty() {
            return see(&[time.t]);
        }
        let mut variables = [time.t; MOST_PROBES + 1];
        for (place, probe) in variables[1..].iter_mut().zip(&self.probes) {
            *place = read(probe);
        }
        see(&variables[..=self.probes.len()])
    }
}

/// The frame of a marker among those of an element.
fn slot<'f, F>(markers: &[MarkerId], marker: MarkerId, frames: &'f [F]) -> &'f F {
    &frames[markers.iter().position(|&known| known == marker).unwrap_or(0)]
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

struct Scope<'a, const D: usize> {
    build: &'a Build<'a, D>,
    /// Highest number of time derivatives.
    order: usize,
    named: Vec<(String, Probe)>,
    probes: RefCell<Vec<Probe>>,
}

impl<const D: usize> Names for Scope<'_, D> {
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
