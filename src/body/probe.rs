//! Scalars read off markers, and expressions over them.

use super::frame::{cross, dot};
use super::{Build, Frame, MarkerId, MarkerTable};
use crate::error::{Error, Result};
use crate::math::expression::{Expression, Name, Names};
use crate::math::signal::Signal;
use crate::math::{Scalar, Taylor, Time};
use std::sync::Arc;

/// One scalar of one marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Probe {
    /// Index of the marker.
    pub marker: MarkerId,
    /// Component that is read.
    pub quantity: Quantity,
}

/// Quantity of a marker that a probe reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// World coordinate of the marker's origin, m.
    Position(usize),
    /// World component of the velocity of the marker's origin, m/s.
    Velocity(usize),
    /// Angle of turn in the plane, rad.
    Angle,
    /// World component of the angular velocity, rad/s; in the plane the third.
    Spin(usize),
}

const AXES: [&str; 3] = ["x", "y", "z"];

impl Probe {
    /// `body.marker.x`, `body.x`, `body.angle`, with `'` for rates; `body.wx` in space.
    pub fn parse<const D: usize>(name: &str, markers: &MarkerTable) -> Option<Probe> {
        let (place, quantity) = name.rsplit_once('.')?;
        let marker = markers.find(place).ok()?;
        let axis = |text: &str| AXES[..D].iter().position(|axis| *axis == text);
        let quantity = match quantity.strip_suffix('\'') {
            Some("angle") if D == 2 => Quantity::Spin(2),
            Some(base) => Quantity::Velocity(axis(base)?),
            None if quantity == "angle" && D == 2 => Quantity::Angle,
            None if D == 3 && quantity.starts_with('w') => Quantity::Spin(axis(&quantity[1..])?),
            None => Quantity::Position(axis(quantity)?),
        };
        Some(Probe { marker, quantity })
    }

    /// True if the quantity is a velocity or an angular velocity.
    pub fn is_rate(&self) -> bool {
        matches!(self.quantity, Quantity::Velocity(_) | Quantity::Spin(_))
    }

    /// Place of its marker among those of an element.
    pub fn place_in(&self, markers: &[MarkerId]) -> usize {
        markers.iter().position(|&marker| marker == self.marker).unwrap_or(0)
    }

    /// Value of a position or angle at a frame; rates need [`Probe::read`].
    pub fn position<S: Scalar, const D: usize>(&self, frame: &Frame<S, D>) -> S {
        match self.quantity {
            Quantity::Position(axis) => frame.r[axis],
            _ => frame.turn,
        }
    }

    /// Value of the quantity at a moving frame.
    pub fn read<S: Scalar, const D: usize>(&self, frame: &Frame<Taylor<S>, D>) -> S {
        match self.quantity {
            Quantity::Position(axis) => frame.r[axis].x,
            Quantity::Velocity(axis) => frame.r[axis].d,
            Quantity::Angle => frame.turn.x,
            Quantity::Spin(axis) => frame.angular_velocity()[axis],
        }
    }
}

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

impl Formula {
    /// Parses `text`; names of outputs are replaced by their expressions.
    pub fn parse<const D: usize>(text: &str, build: &Build<D>, rates: bool) -> Result<Formula> {
        let names = Scope { build, rates, probes: Default::default() };
        let expression = Expression::parse(&expand(text, build)?, &names)?;
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
        match self.probes.is_empty() {
            true => Ok(self.expression),
            false => Err(Error::input("this may depend on t and parameters only, but uses a marker").hint(
                "markers may stand in an `equation` joint, an applied force or torque, a tyre's road, and outputs",
            )),
        }
    }

    /// The markers that it reads, each once, in the order of its probes.
    pub fn markers(&self) -> Vec<MarkerId> {
        let mut markers = Vec::new();
        for probe in &self.probes {
            if !markers.contains(&probe.marker) {
                markers.push(probe.marker);
            }
        }
        markers
    }

    /// Value of the expression, with `read` for the values of the probes.
    pub fn evaluate<S: Scalar>(&self, time: Time<S>, read: impl Fn(&Probe) -> S) -> S {
        self.with(time, read, |variables| self.expression.eval_held(variables, time.regime))
    }

    /// Writes the arguments of its switching functions at their numbers.
    pub fn switching<S: Scalar>(&self, time: Time<S>, read: impl Fn(&Probe) -> S, out: &mut [S]) {
        self.with(time, read, |variables| self.expression.arguments(variables, time.regime, out));
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

/// Largest length of an expression with its outputs replaced, bytes.
const LONGEST: usize = 1_000_000;

/// Replaces names of outputs by their expressions in brackets, as deep as outputs use outputs.
fn expand<const D: usize>(text: &str, build: &Build<D>) -> Result<String> {
    let mut text = text.to_string();
    for _ in 0..=build.outputs.len() {
        let next = replace_names(&text, build)?;
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

fn replace_names<const D: usize>(text: &str, build: &Build<D>) -> Result<String> {
    let is_name = |c: char| c.is_alphanumeric() || c == '_' || c == '.' || c == '\'';
    let mut result = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find(is_name) {
        let (before, tail) = rest.split_at(start);
        let (word, after) = tail.split_at(tail.find(|c| !is_name(c)).unwrap_or(tail.len()));
        result.push_str(before);
        match build.outputs.iter().find(|(name, _)| name == word) {
            Some(_) if build.parameters.get(word).is_some() => {
                let error = Error::input(format!("`{word}` is both a parameter and an output"));
                return Err(error.hint("rename one of them"));
            }
            Some((_, expression)) => result.push_str(&format!("({expression})")),
            None => result.push_str(word),
        }
        rest = after;
    }
    Ok(result + rest)
}

struct Scope<'a, const D: usize> {
    build: &'a Build<'a, D>,
    rates: bool,
    probes: std::cell::RefCell<Vec<Probe>>,
}

impl<const D: usize> Names for Scope<'_, D> {
    fn resolve(&self, name: &str) -> Option<Name> {
        if name == "t" {
            return Some(Name::Variable(0));
        }
        if let Some(value) = self.build.parameters.get(name) {
            return Some(Name::Constant(value));
        }
        let probe = self.build.probe(name).filter(|probe| self.rates || !probe.is_rate())?;
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
        let (markers, states) = (table.names.iter(), table.states.iter().map(|(name, _)| name.clone()));
        let probes = markers.flat_map(|marker| quantities.iter().map(move |q| format!("{marker}.{q}")));
        self.build.parameters.known().into_iter().chain(["t".into()]).chain(states).chain(probes).collect()
    }

    fn signals(&self) -> &[Arc<Signal>] {
        self.build.parameters.signals()
    }
}

/// Rotation vector, rad, that turns frame `a` into frame `b`, for small relative rotations: the sum of the cross
/// products of their axes, halved.
pub fn small_rotation<S: Scalar, const D: usize>(a: &Frame<S, D>, b: &Frame<S, D>) -> [S; 3] {
    let mut twice = [S::zero(); 3];
    for (from, to) in a.axes.iter().zip(&b.axes) {
        let turn = cross(from, to);
        (0..3).for_each(|i| twice[i] += turn[i]);
    }
    twice.map(|x| x * 0.5)
}

/// Torque on `b`, with its opposite on `a`, whose power is `moment` times the rate of [`small_rotation`]: with
/// b' = w x b, 2 rotation' = (sum a_j . b_j) w - sum b_j (a_j . w), so the torque is the transpose of that.
pub fn small_rotation_torque<S: Scalar, const D: usize>(a: &Frame<S, D>, b: &Frame<S, D>, moment: &[S; 3]) -> [S; 3] {
    let mut torque = [S::zero(); 3];
    for (from, to) in a.axes.iter().zip(&b.axes) {
        let (cosine, along) = (dot(from, to), (0..D).fold(S::zero(), |sum, k| sum + to[k] * moment[k]));
        (0..D).for_each(|k| torque[k] += (cosine * moment[k] - from[k] * along) * 0.5);
    }
    torque
}
