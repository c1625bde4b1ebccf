//! Names, parameters and checks with which an element reads its part of a scene.

use super::marker_table::{MarkerId, MarkerTable};
use super::probe::{Probe, Quantity};
use super::turning::{Turned, Turning};
use crate::error::{Error, Result, Warning, short};
use crate::math::Thresholds;
use crate::math::array::Each;
use crate::math::expression::{Expression, Number, Parameters, Switch, TimeFunction};
use std::cell::RefCell;
use std::f64::consts::TAU;
use std::path::Path;

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

/// The names that an element's numbers, functions and marker references are looked up in. Each lookup takes the key of
/// the scene that it reads, which errors then name.
pub struct Build<'a, const D: usize> {
    /// Values of the scene's parameters.
    pub parameters: &'a Parameters,
    /// All markers that joints and forces may name; none yet where a body is made.
    #[doc(hidden)]
    pub markers: &'a MarkerTable,
    /// Outputs that expressions may use by their names.
    #[doc(hidden)]
    pub outputs: &'a dyn NamedOutputs<D>,
    /// Acceleration of gravity in world axes, m/s^2.
    pub gravity: [f64; D],
    /// Folder from which the files that the scene names are found.
    pub folder: &'a Path,
    /// Switching functions, functions of t and warnings of the elements read so far.
    #[doc(hidden)]
    pub switches: &'a RefCell<Switches>,
    /// Angles to be counted through full turns that elements have asked for so far.
    #[doc(hidden)]
    pub turnings: &'a RefCell<Vec<Turning>>,
}

/// Switching functions of a scene's elements, where their laws change, and functions of t alone.
#[derive(Clone, Debug, Default)]
pub struct Switches {
    /// Thresholds of each switching function, by its number.
    pub all: Vec<Switch>,
    /// The element of each, such as "the force `push`".
    pub owners: Vec<String>,
    /// Functions of t alone in the scene's elements.
    pub time_functions: Vec<TimeFunction>,
    /// Warnings about values of the scene that are doubtful.
    pub doubts: Vec<Warning>,
    /// Number of the doubts whose text already names the element.
    named: usize,
}

impl Switches {
    /// Adds the switching functions of an expression and numbers them in it.
    pub(super) fn add(&mut self, expression: &mut Expression) {
        let switches = expression.number_switches(self.all.len());
        self.all.extend(switches);
        self.time_functions.extend(expression.time_functions());
    }

    /// Names the owner of all that was added since the last call.
    pub fn own(&mut self, owner: &str) {
        self.owners.resize(self.all.len(), owner.to_string());
        for doubt in &mut self.doubts[self.named..] {
            doubt.text = format!("{owner}: {}", doubt.text);
        }
        self.named = self.doubts.len();
    }
}

impl<const D: usize> Build<'_, D> {
    /// Names the element, such as "force" `push`, that all that was added since the last call belongs to.
    pub(crate) fn own(&self, what: &str, name: &str) {
        self.switches.borrow_mut().own(&format!("the {what} `{name}`"));
        let mut turnings = self.turnings.borrow_mut();
        let unnamed = turnings.iter_mut().filter(|turning| turning.name.is_empty());
        unnamed.for_each(|turning| turning.name = format!("{what}.{name}.turn"));
    }

    /// Value of a number or expression.
    pub fn number(&self, field: &str, number: &Number) -> Result<f64> {
        number.evaluate(self.parameters).map_err(|error| Error::from(error).under(field))
    }

    /// An angle, rad, with a warning if it is more than a full turn.
    pub fn angle(&self, field: &str, number: &Number) -> Result<f64> {
        let angle = self.number(field, number)?;
        self.doubt_turns(field, angle);
        Ok(angle)
    }

    /// Warns of an angle of more than a full turn, which is probably in degrees.
    pub(crate) fn doubt_turns(&self, field: &str, angle: f64) {
        if angle.abs() > TAU {
            let text =
                format!("`{field}` is {} rad, {} turns", short(angle), short((10.0 * angle / TAU).round() / 10.0));
            let hint = format!("for {} degrees write {0}*pi/180", short(angle));
            self.switches.borrow_mut().doubts.push(Warning::new(text, hint));
        }
    }

    /// Value of a number, or `default` if it is not given.
    pub fn number_or(&self, field: &str, number: &Option<Number>, default: f64) -> Result<f64> {
        number.as_ref().map_or(Ok(default), |number| self.number(field, number))
    }

    /// A whole number from zero on.
    pub fn count(&self, field: &str, number: &Number) -> Result<u32> {
        let value = self.number(field, number)?;
        if value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value) {
            Ok(value as u32)
        } else {
            Err(Error::input(format!("{field} is {}, but must be a whole number from zero on", short(value)))
                .under(field))
        }
    }

    /// A number that must not be negative.
    pub fn not_negative(&self, field: &str, number: &Number) -> Result<f64> {
        let value = self.number(field, number)?;
        if value < 0.0 {
            return Err(Error::input(format!("{field} is {value}, but cannot be negative"))
                .under(field)
                .hint("give zero or more"));
        }
        Ok(value)
    }

    /// A number that must be above zero.
    pub fn positive(&self, field: &str, number: &Number) -> Result<f64> {
        let value = self.number(field, number)?;
        if value <= 0.0 {
            return Err(Error::input(format!("{field} is {value}, but must be above zero"))
                .under(field)
                .hint("give a number above zero"));
        }
        Ok(value)
    }

    /// Values of exactly N numbers.
    pub fn vector<const N: usize>(&self, field: &str, numbers: &[Number]) -> Result<[f64; N]> {
        if numbers.len() != N {
            return Err(Error::input(format!("expected {N} numbers, found {}", numbers.len()))
                .under(field)
                .hint(format!("the scene has \"dimension\": {D}")));
        }
        let mut vector = [0.0; N];
        for (i, (place, number)) in vector.iter_mut().zip(numbers).enumerate() {
            let value = number.evaluate(self.parameters);
            *place = value.map_err(|error| Error::from(error).under(format!("{field}[{i}]")))?;
        }
        Ok(vector)
    }

    /// A marker by its full name, `body.marker`; `body` alone is the body's own frame.
    pub fn marker(&self, field: &str, name: &str) -> Result<MarkerId> {
        self.markers.find(name).map_err(|error| error.under(field))
    }

    /// Two markers on different bodies.
    pub fn between(&self, names: &[String; 2]) -> Result<Vec<MarkerId>> {
        let ids = [self.marker("between[0]", &names[0])?, self.marker("between[1]", &names[1])?];
        let [a, b] = ids.each(|id| self.markers.bodies[id]);
        if a == b {
            let body = a.map_or("ground", |body| self.markers.body_names[body].as_str());
            return Err(Error::input(format!("both markers, `{}` and `{}`, are on `{body}`", names[0], names[1]))
                .under("between")
                .hint("name markers of two different bodies"));
        }
        Ok(ids.to_vec())
    }

    /// Refuses markers without an orientation.
    pub fn oriented(&self, field: &str, markers: &[MarkerId]) -> Result<()> {
        match markers.iter().find(|&&marker| !self.markers.oriented[marker]) {
            None => Ok(()),
            Some(&marker) => Err(Error::input(format!(
                "`{}` is on a point mass, which has no orientation to hold",
                self.markers.names[marker]
            ))
            .under(field)
            .hint("use a body of type \"rigid\", or a joint that holds positions only")),
        }
    }

    /// Refuses an element that makes sense in one kind of scene only: `what` needs the `dimension`; in others take
    /// `instead`.
    pub fn needs_dimension(&self, dimension: usize, what: &str, instead: &str) -> Result<()> {
        if D == dimension {
            Ok(())
        } else {
            Err(Error::input(format!("{what} needs \"dimension\": {dimension}"))
                .under("type")
                .hint(format!("in this scene use {instead}")))
        }
    }

    /// Number of a switching function that an element has in addition to its expressions; its threshold is zero.
    /// `switching` of its kernel writes the argument at this number; [`Regime::piece`](crate::math::Regime::piece)
    /// gives the side of zero whose law applies within a step: 0 below, 2 above.
    pub fn switch(&self) -> usize {
        let all = &mut self.switches.borrow_mut().all;
        all.push(Switch { thresholds: Thresholds::At([0.0].into()), of_time: None, signal: None });
        all.len() - 1
    }

    /// Number of a piece that the time loop sets, see [`Thresholds::Held`].
    pub(crate) fn held(&self) -> usize {
        let all = &mut self.switches.borrow_mut().all;
        all.push(Switch { thresholds: Thresholds::Held, of_time: None, signal: None });
        all.len() - 1
    }

    /// Index of an angle in space that an element needs counted through full turns; it begins within half a turn of
    /// `start`. In the plane angles are coordinates.
    #[doc(hidden)]
    pub fn turning(&self, terms: Vec<Turned>, start: f64) -> usize {
        let mut all = self.turnings.borrow_mut();
        if D == 3 {
            all.push(Turning { name: String::new(), terms, start });
        }
        all.len().saturating_sub(1)
    }

    /// Counted angle of these terms that begins near zero: one that is there already, or a new one of this `name`.
    pub(crate) fn turning_named(&self, name: &str, term: Turned) -> usize {
        let known = |turning: &Turning| turning.terms == [term] && turning.start == 0.0;
        let found = self.turnings.borrow().iter().position(known);
        found.unwrap_or_else(|| {
            let turning = self.turning(vec![term], 0.0);
            self.turnings.borrow_mut().last_mut().into_iter().for_each(|last| last.name = name.to_string());
            turning
        })
    }

    /// A marker quantity such as `crank.C.x` or `crank.angle`, or a state, with `'` for its rate.
    #[doc(hidden)]
    pub fn probe(&self, name: &str) -> Option<Probe> {
        let (state, order) = name.strip_suffix('\'').map_or((name, 1), |state| (state, 2));
        match self.markers.states.iter().find(|(known, _)| known == state) {
            Some(&(_, of)) => Some(Probe { of, to: None, quantity: Quantity::Position(0), order }),
            None => Probe::parse::<D>(name, self.markers),
        }
    }
}
