//! Outputs that are read off markers: positions, angles and distances with their rates, of joints too.

use super::absolute_beam::BeamLine;
use super::format::SceneFile;
use super::keys::{missing, named_component};
use super::measures::{MeasureKind, OutputSpec};
use super::model::{Connection, ModelForce, ModelJoint, Part};
use crate::body::{Build, MarkerId, NamedOutput, NamedOutputs, Probe, Quantity, TurnAxes, Turned, in_space};
use crate::error::{Error, Result, suggest};
use crate::joint::{ClosedForm, JointCoordinate};
use std::cell::RefCell;

/// A joint or force, as outputs see it.
pub struct Placed<const D: usize> {
    /// Name in the scene.
    pub name: String,
    /// Its `type`.
    pub kind: &'static str,
    /// The two markers that it is between.
    pub ends: Option<[MarkerId; 2]>,
    /// The form of a joint, if it is known.
    pub form: Option<ClosedForm<D>>,
}

/// The elements of the model that outputs may read.
#[derive(Clone, Copy)]
pub struct Elements<'a, const D: usize> {
    pub bodies: &'a [Part<D>],
    pub beams: &'a [BeamLine],
    pub joints: &'a [ModelJoint<D>],
    pub forces: &'a [ModelForce<D>],
    /// Joints and given forces as kinematic outputs see them.
    pub placed: &'a [Placed<D>],
}

/// The outputs of a scene by name, with the joints and forces that are read so far.
pub struct Named<'a, const D: usize> {
    pub file: &'a SceneFile,
    pub elements: RefCell<Vec<Placed<D>>>,
}

impl<const D: usize> NamedOutputs<D> for Named<'_, D> {
    fn find(&self, name: &str, build: &Build<D>) -> Option<Result<NamedOutput>> {
        let number = self.file.outputs.iter().position(|spec| spec.name == name)?;
        let spec = &self.file.outputs[number];
        if spec.measure == MeasureKind::Work {
            let error = Error::input(format!("the output `{name}` is an integral over the run"));
            return Some(Err(error.hint("expressions know the state alone: a state xi with that rate is part of it")));
        }
        if let (MeasureKind::Expression, Some(value)) = (spec.measure, &spec.value) {
            return Some(Ok(NamedOutput::Text(value.to_string())));
        }
        let probe = match probe(spec, &self.elements.borrow(), build) {
            Ok(None) => {
                let before = self.file.outputs[..number].iter();
                Ok(NamedOutput::Other(before.filter(|spec| spec.measure != MeasureKind::Work).count()))
            }
            Ok(Some(probe)) => Ok(NamedOutput::Probe(probe)),
            Err(error) => Err(self.unreadable(spec, error)),
        };
        Some(probe)
    }
}

impl<const D: usize> Named<'_, D> {
    /// Adds a joint or force that is read; `between` if its first two markers are those that it is between.
    pub fn add<E>(&self, element: &Connection<E>, between: bool, form: Option<ClosedForm<D>>) {
        let Connection { name, kind, markers, .. } = element;
        let ends = markers.first_chunk::<2>().copied().filter(|_| between);
        self.elements.borrow_mut().push(Placed { name: name.clone(), kind, ends, form });
    }

    /// The error of an output that an expression names, with its place in the message.
    fn unreadable(&self, spec: &OutputSpec, error: Error) -> Error {
        let Error::Input(input) = error else { return error };
        let all = self.file.joints.iter().chain(&self.file.forces);
        let read = self.elements.borrow();
        // How many elements stand between this one, which is read, and that of the output.
        let ahead = |of: &String| {
            let place = all.skip(read.len()).position(|element| element["name"] == **of);
            place.filter(|_| !read.iter().any(|known| known.name == *of))
        };
        match (&spec.of, spec.of.as_ref().and_then(ahead)) {
            (Some(of), Some(0)) => Error::input(format!("the output `{}` measures `{of}` itself", spec.name))
                .hint("measure its markers, by `between` or `relative_to`; laws of springs know their own `length`, `angle` and `rate`"),
            (Some(of), Some(_)) => {
                Error::input(format!("the output `{}` measures `{of}`, which comes after this", spec.name))
                    .hint(format!("put `{of}` before it in the scene"))
            }
            _ => Error::input(format!("the output `{}` cannot be read: {}", spec.name, input.message))
                .hint(input.hint.unwrap_or_default()),
        }
    }
}

/// The scalar of an output that is read off markers; none of another measure.
///
/// # Errors
/// Names that there are not, and components that the element does not have.
pub fn probe<const D: usize>(spec: &OutputSpec, elements: &[Placed<D>], build: &Build<D>) -> Result<Option<Probe>> {
    let reader = Reader { spec, elements, build };
    Ok(Some(match spec.measure {
        MeasureKind::Angle => reader.angle(0)?,
        MeasureKind::AngularVelocity => reader.angle(1)?,
        MeasureKind::AngularAcceleration => reader.angle(2)?,
        MeasureKind::Position => reader.position(0)?,
        MeasureKind::Velocity => reader.position(1)?,
        MeasureKind::Acceleration => reader.position(2)?,
        MeasureKind::Distance => reader.distance(0)?,
        MeasureKind::DistanceRate => reader.distance(1)?,
        _ => return Ok(None),
    }))
}

struct Reader<'a, const D: usize> {
    spec: &'a OutputSpec,
    elements: &'a [Placed<D>],
    build: &'a Build<'a, D>,
}

/// What `of` names.
enum Of<'a, const D: usize> {
    Marker(MarkerId),
    Element(&'a Placed<D>),
}

const AXES: [&str; 3] = ["x", "y", "z"];

impl<const D: usize> Reader<'_, D> {
    fn of(&self) -> Result<Of<'_, D>> {
        let name = self.spec.subject()?;
        if let Ok(marker) = self.build.markers.find(name) {
            return Ok(Of::Marker(marker));
        }
        if let Some(element) = self.elements.iter().find(|element| element.name == name) {
            if self.spec.relative_to.is_some() {
                return Err(Error::input("a joint or force is measured between its own markers")
                    .under("relative_to")
                    .hint("remove it, or measure a marker"));
            }
            return Ok(Of::Element(element));
        }
        let names = self.elements.iter().map(|element| element.name.as_str());
        let table = self.build.markers;
        let markers = table.names[..table.names.len() - table.states.len()].iter().map(String::as_str);
        let known = markers.chain(names);
        Err(Error::unknown("marker, joint or force", name, known).under("of"))
    }

    fn position(&self, order: usize) -> Result<Probe> {
        match self.of()? {
            Of::Marker(of) => {
                let axis = self.spec.component_of("x", &AXES[..D])?;
                Ok(Probe::new(of, self.spec.reference(self.build)?, Quantity::Position(axis), order))
            }
            Of::Element(joint) => {
                let (Some(ClosedForm::Lock(lock)), Some([a, b])) = (&joint.form, joint.ends) else {
                    return Err(immeasurable(joint, "position"));
                };
                let translation = |(_, coordinate)| match coordinate {
                    JointCoordinate::Translation(axis) => Some(axis),
                    _ => None,
                };
                let free: Vec<usize> = lock.coordinates().into_iter().filter_map(translation).collect();
                let names: Vec<&str> = free.iter().map(|&axis| AXES[axis]).collect();
                let Some(first) = names.first() else { return Err(immeasurable(joint, "position")) };
                let axis = free[self.spec.component_of(first, &names)?];
                let along = |triad: &[[f64; D]; D]| Quantity::Along(in_space(&triad[axis]));
                let quantity = lock.triad.as_ref().map_or(Quantity::Position(axis), along);
                Ok(Probe::new(b, a, quantity, order))
            }
        }
    }

    fn angle(&self, order: usize) -> Result<Probe> {
        let of = match self.of()? {
            Of::Marker(of) => of,
            Of::Element(element) => return self.angle_of(element, order),
        };
        let to = self.spec.reference(self.build)?;
        self.build.oriented("of", &[of, to])?;
        let about = if D == 2 || order == 0 {
            2 + self.spec.component_of("z", &["z"])?
        } else {
            self.spec.component_of("z", &AXES)?
        };
        Ok(match (order, D) {
            (0, 2) => Probe::new(of, to, Quantity::Angle, 0),
            (0, _) => self.turn(Turned { of, to, factor: 1.0, axes: None }, None, 0),
            _ => Probe::new(of, to, Quantity::Spin(about), order),
        })
    }

    /// Angle of the second marker against the first about the axis of the element.
    fn angle_of(&self, element: &Placed<D>, order: usize) -> Result<Probe> {
        let none = || immeasurable(element, "angle");
        let Some([a, b]) = element.ends else { return Err(none()) };
        if element.kind == "torsion_spring" {
            return Ok(self.between(a, b, None, Some(&element.name), order));
        }
        let Some(ClosedForm::Lock(lock)) = &element.form else { return Err(none()) };
        let has = |wanted| lock.coordinates().iter().any(|(_, coordinate)| *coordinate == wanted);
        if has(JointCoordinate::FirstPin) {
            let about = self.spec.component.as_deref();
            let about = about.ok_or_else(|| missing("component", "x or y: the pin on the first or second body"))?;
            let term = universal(a, b, named_component(about, &["x", "y"])?);
            return Ok(self.turn(term, None, order));
        }
        if !has(JointCoordinate::Angle) {
            return Err(none());
        }
        self.spec.component_of("z", &["z"])?;
        self.build.oriented("of", &[a, b])?;
        let about = |triad: &[[f64; D]; D]| {
            let [x, y] = [in_space(&triad[0]), in_space(&triad[1])];
            TurnAxes { of: x, to: [x, y] }
        };
        Ok(self.between(a, b, lock.triad.as_ref().map(about), None, order))
    }

    fn between(&self, a: MarkerId, b: MarkerId, axes: Option<TurnAxes>, spring: Option<&str>, order: usize) -> Probe {
        match D {
            2 => Probe::new(b, a, Quantity::Angle, order),
            _ => self.turn(Turned { of: b, to: a, factor: 1.0, axes }, spring, order),
        }
    }

    /// A counted angle in space: that which force `spring` has of its own, or one of this output's.
    fn turn(&self, term: Turned, spring: Option<&str>, order: usize) -> Probe {
        let own = spring.map(|name| format!("force.{name}.turn"));
        let known = self.build.turnings.borrow().iter().position(|turning| Some(&turning.name) == own.as_ref());
        let named = || self.build.turning_named(&format!("output.{}.turn", self.spec.name), term);
        let turning = known.unwrap_or_else(named);
        let start = self.build.turnings.borrow().get(turning).map_or(0.0, |turning| turning.start);
        let Turned { of, to, factor, axes } = term;
        Probe::new(of, to, Quantity::Turn { turning, start, factor, axes }, order)
    }

    fn distance(&self, order: usize) -> Result<Probe> {
        let ends = match (&self.spec.between, &self.spec.of) {
            (Some(names), None) => {
                [self.build.marker("between[0]", &names[0])?, self.build.marker("between[1]", &names[1])?]
            }
            (None, Some(name)) => match self.elements.iter().find(|element| element.name == *name) {
                Some(element) => element.ends.ok_or_else(|| immeasurable(element, "length"))?,
                None => {
                    let known = self.elements.iter().filter(|element| element.ends.is_some());
                    let hint = suggest(name, known.map(|element| element.name.as_str()));
                    return Err(Error::input(format!("there is no joint or force `{name}`")).under("of").hint(hint));
                }
            },
            _ => return Err(missing("between", "name two markers, or a spring or a rod as `of`")),
        };
        Ok(Probe::new(ends[1], ends[0], Quantity::Distance, order))
    }
}

fn immeasurable<const D: usize>(element: &Placed<D>, what: &str) -> Error {
    Error::input(format!("the {} `{}` has no {what} of its own", element.kind, element.name))
        .under("of")
        .hint("name a joint that leaves it free, or a marker, with `relative_to` another one")
}

/// Rotation of the cross of a universal joint about x of the first marker (`pin` 0), or of the second marker against
/// the cross about its own y (1): the rotation from the first marker to the second is R_x R_y.
fn universal(a: MarkerId, b: MarkerId, pin: usize) -> Turned {
    let [x, y, z, back] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    match pin {
        0 => Turned { of: b, to: a, factor: 1.0, axes: Some(TurnAxes { of: y, to: [y, z] }) },
        _ => Turned { of: a, to: b, factor: -1.0, axes: Some(TurnAxes { of: x, to: [x, back] }) },
    }
}
