//! A flexible beam in absolute coordinates: rigid nodes with the mass, and beam elements as forces between them.
//!
//! Each node carries the mass of the adjacent half elements and the rotary inertia of their sections. The mass of half
//! an element of length h is put h/6 from its node: at the end of a beam its weight and its inertia in bending then act
//! with the moment rho A h^2/12 of a distributed load, and the inertia of the beam as a rigid body is that of its line
//! but for rho A h^3/36. Between equal elements the two shifts cancel. The statics of a straight element under loads at
//! its nodes or its own weight are exact; frequencies of bending converge with the fourth power of its length (the
//! third where an end turns freely), those of extension and torsion with the second.
//!
//! A tapered element has the mean compliance of its part of the beam. It neglects the slope of the compliance from
//! one end to the other: bending under shear forces then converges with the second power of the length.

use super::beam_mass::NodeMass;
use super::keys::start_and_markers;
use super::markers;
use crate::body::flexible::{Damping, FlexibleBeam, MOST_ELEMENTS, Profile, ReferenceLine, Section, curvature};
use crate::body::{Body, Build, BuiltBody, Frame, Marker, RigidPlanar, RigidSpatial, SHARED_KEYS, cross, parse_among};
use crate::error::{Error, Result, short};
use crate::force::{Beam, Half, Station};
use crate::math::array::{Each, from_fn};
use crate::math::expression::Number;
use crate::math::rotation::{matrix_from_quaternion, quaternion_from_vector, quaternion_product};
use crate::math::screw::dot3;
use crate::math::{Scalar, Taylor};
use crate::tolerances;
use serde_json::{Map, Value};
use std::ops::Range;

/// A flexible beam in absolute coordinates: bodies as nodes, and elements as forces between them.
pub struct BeamLine {
    /// Name of the beam in the scene.
    pub name: String,
    /// Index of its first node among the bodies; the others follow.
    pub first_body: usize,
    /// Index of its first element among the forces.
    pub first_force: usize,
    /// Abscissae of the nodes from the left end, m; one more than there are elements.
    pub abscissae: Vec<f64>,
    /// Beam elements from left to right, without mass.
    pub elements: Vec<Beam>,
    /// Stiffness and mass of the sections along the beam.
    pub profile: Profile,
    /// Mass of each element: the halves lumped at its two nodes.
    pub halves: Vec<[Half; 2]>,
}

impl BeamLine {
    /// Indices of its nodes among the bodies.
    pub fn bodies(&self) -> Range<usize> {
        self.first_body..self.first_body + self.abscissae.len()
    }

    /// Indices of its elements among the forces.
    pub fn forces(&self) -> Range<usize> {
        self.first_force..self.first_force + self.elements.len()
    }

    /// Length of the undeformed beam, m.
    pub fn length(&self) -> f64 {
        self.abscissae.last().copied().unwrap_or(0.0)
    }

    /// Point of the relaxed beam's line at `s`, in the axes of its left end, m.
    pub fn relaxed(&self, s: f64) -> [f64; 3] {
        self.elements.first().map_or([0.0; 3], |element| element.relaxed(s))
    }

    /// The section at `s`; at a node, that of the element to the left of it.
    pub fn section(&self, s: f64) -> Section {
        let element = self.element_at(s);
        self.profile.within([self.abscissae[element], self.abscissae[element + 1]], s)
    }

    /// Position and internal forces of the section at `s` from the left end, 0 <= s <= length, without the inertia and
    /// weight of the element itself; `node` gives the frame of a body of the model. At a node it is that of the element
    /// to the left of it.
    pub fn station<S: Scalar, const D: usize>(
        &self,
        s: f64,
        node: impl Fn(usize) -> Frame<Taylor<S>, D>,
    ) -> Station<S, D> {
        let element = self.element_at(s);
        let first = self.first_body + element;
        self.elements[element].station([&node(first), &node(first + 1)], s - self.abscissae[element])
    }

    /// The element at `s`; its nodes are bodies `first_body` + this and the next.
    pub fn element_at(&self, s: f64) -> usize {
        self.abscissae.partition_point(|&abscissa| abscissa < s).clamp(1, self.elements.len()) - 1
    }
}

/// True for the type and keys of a beam in absolute coordinates.
pub fn is_absolute_beam(kind: &str, json: &Map<String, Value>) -> bool {
    kind == "flexible_beam" && json.get("frame").and_then(Value::as_str) == Some("absolute")
}

/// A beam, checked and divided into elements.
pub struct AbsoluteBeam<const D: usize> {
    name: String,
    profile: Profile,
    line: ReferenceLine,
    /// Damping proportional to stiffness: beta in C = beta K, s.
    damping: f64,
    abscissae: Vec<f64>,
    /// Index of the node, name, and the marker in the node's axes.
    markers: Vec<(usize, String, Marker<D>)>,
    start: BeamStart<D>,
}

/// Keys of a beam in a floating frame, refused here.
const FLOATING: [&str; 6] = ["frame_conditions", "axial", "rotary_inertia", "geometric_stiffening", "modes", "ritz"];

impl<const D: usize> AbsoluteBeam<D> {
    /// Reads the body's JSON without `name` and `type`.
    pub fn read(name: &str, mut json: Map<String, Value>, build: &Build<D>) -> Result<Self> {
        refuse_floating(&json)?;
        let (initial, given) = start_and_markers(&mut json)?;
        initial.refuse_elastic()?;
        let spec: FlexibleBeam = parse_among(Value::Object(json), &SHARED_KEYS)?;
        let length = build.positive("length", &spec.length)?;
        let named = markers::markers(&given, &[0.0; D], build)?;
        let wanted = elements(spec.elements.as_ref(), build)?;
        let abscissae = mesh(length, wanted, named.iter().map(|(_, marker)| marker.offset[0]));
        let at_node = |(name, mut marker): (String, Marker<D>)| {
            let s = std::mem::replace(&mut marker.offset[0], 0.0);
            let node = check_marker(&name, s, &abscissae).map_err(|error| error.under(&name).under("markers"))?;
            Ok((node, name, marker))
        };
        Ok(AbsoluteBeam {
            name: name.to_string(),
            profile: Profile::of(&spec, length, build)?,
            line: ReferenceLine { length, curvature: curvature(spec.curvature.as_ref(), build)? },
            damping: damping(spec.damping.as_ref(), build).map_err(|error| error.under("damping"))?,
            markers: named.into_iter().map(at_node).collect::<Result<_>>()?,
            abscissae,
            start: initial.motion(build).map(|(q, v)| BeamStart { q, v })?,
        })
    }

    /// The nodes from left to right: names of their markers, and bodies that start at rest in the relaxed beam, which
    /// moves like a rigid body.
    pub fn nodes(&self) -> Vec<(Vec<String>, BuiltBody<D>)> {
        let node = |node: usize| {
            let here = || self.markers.iter().filter(move |(at, ..)| *at == node);
            let mass = NodeMass::of(&self.profile, &self.abscissae, node);
            let from_centre = |mut marker: Marker<D>| {
                marker.offset[0] -= mass.shift();
                marker
            };
            let own = Marker::point([0.0; D]);
            // The left end has two frames: that of the node and that of the beam as a whole.
            let frames = [own].into_iter().chain((node == 0).then_some(own));
            let markers = frames.chain(here().map(|(_, _, marker)| *marker)).map(from_centre).collect();
            let names = here().map(|(_, name, _)| name.clone()).collect();
            let (q, v) = self.start.at(self.abscissae[node], mass.shift(), &self.line);
            (names, BuiltBody { body: body(&mass, &q, markers), q, v })
        };
        (0..self.abscissae.len()).map(node).collect()
    }

    /// The beam for the model: its first node is body `first_body`, its first element force `first_force`.
    pub fn line(self, first_body: usize, first_force: usize) -> BeamLine {
        let beam = |ends: &[f64]| {
            let ends = [ends[0], ends[1]];
            let mean = self.profile.mean(ends);
            Beam::new::<D>(&mean, ends[1] - ends[0], self.line.curvature, self.damping)
                .tapered::<D>(ends.each(|s| self.profile.within(ends, s)))
        };
        let elements: Vec<Beam> = self.abscissae.windows(2).map(beam).collect();
        let mass = |node: usize| NodeMass::of(&self.profile, &self.abscissae, node);
        let nodes: Vec<NodeMass> = (0..self.abscissae.len()).map(mass).collect();
        let halves = nodes.windows(2).map(|ends| [ends[0].half(true), ends[1].half(false)]).collect();
        let AbsoluteBeam { name, profile, abscissae, .. } = self;
        BeamLine { name, first_body, first_force, elements, halves, abscissae, profile }
    }
}

fn body<const D: usize>(node: &NodeMass, q: &[f64], markers: Vec<Marker<D>>) -> Box<dyn Body<D>> {
    let mass = node.mass();
    let [y, z] = node.about();
    match D {
        2 => Box::new(RigidPlanar::new(mass, z, from_fn(|i| q[i]), &[0, 1, 2], markers)),
        _ => {
            let inertia = [[y + z, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
            Box::new(RigidSpatial { mass, inertia, markers })
        }
    }
}

fn refuse_floating(json: &Map<String, Value>) -> Result<()> {
    if let Some(key) = FLOATING.iter().find(|key| json.contains_key(**key)) {
        return Err(Error::input(format!("an absolute beam has no `{key}`"))
            .under(key)
            .hint("remove it, or use \"frame\": \"floating\""));
    }
    if json.contains_key("origin") {
        Err(Error::input("the origin of a beam is its left end").under("origin").hint("remove it"))
    } else {
        Ok(())
    }
}

fn elements<const D: usize>(given: Option<&Number>, build: &Build<D>) -> Result<u32> {
    match given.map(|given| build.count("elements", given)).transpose()? {
        None => {
            Err(Error::input("the key `elements` is missing").hint("say into how many elements the beam is divided"))
        }
        Some(n @ 1..=MOST_ELEMENTS) => Ok(n),
        Some(n) => Err(Error::input(format!("elements is {n}"))
            .under("elements")
            .hint(format!("give a whole number from 1 to {MOST_ELEMENTS}"))),
    }
}

fn damping<const D: usize>(given: Option<&Damping>, build: &Build<D>) -> Result<f64> {
    match given {
        None => Ok(0.0),
        Some(Damping::Modal(_)) => Err(Error::input("an absolute beam has no modes to damp")
            .under("modal")
            .hint("give \"rayleigh\": {\"stiffness\": ...}")),
        Some(Damping::Rayleigh { mass, stiffness }) => {
            let mass = mass.as_ref().map_or(Ok(0.0), |mass| build.number("rayleigh.mass", mass))?;
            if mass != 0.0 {
                return Err(Error::input("damping by mass would brake an absolute beam that moves as a whole")
                    .under("rayleigh.mass")
                    .hint("give \"stiffness\" alone, or use \"frame\": \"floating\""));
            }
            stiffness.as_ref().map_or(Ok(0.0), |stiffness| build.not_negative("rayleigh.stiffness", stiffness))
        }
    }
}

/// Abscissae of the nodes, m: both ends, every marker, and equal elements between these, none longer than the length
/// divided by `wanted`.
fn mesh(length: f64, wanted: u32, markers: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut stops: Vec<f64> =
        markers.filter(|s| *s > tolerances::SAME * length && *s < (1.0 - tolerances::SAME) * length).collect();
    stops.push(length);
    stops.sort_by(f64::total_cmp);
    stops.dedup_by(|b, a| *b - *a < tolerances::SAME * length);
    let mut abscissae = vec![0.0];
    let mut from = 0.0;
    for to in stops {
        // Round-off must not add an element.
        let parts = ((to - from) / length * f64::from(wanted) - tolerances::SAME).ceil().max(1.0) as u32;
        abscissae.extend((1..parts).map(|i| from + (to - from) * f64::from(i) / f64::from(parts)));
        abscissae.push(to);
        from = to;
    }
    abscissae
}

/// Index of the node at the marker `name`, which is at `s`.
fn check_marker(name: &str, s: f64, abscissae: &[f64]) -> Result<usize> {
    if name.strip_prefix('n').is_some_and(|digits| !digits.is_empty() && digits.bytes().all(|c| c.is_ascii_digit())) {
        return Err(Error::input(format!("`{name}` is the name of a node")).hint("choose another one"));
    }
    let length = abscissae[abscissae.len() - 1];
    let slack = tolerances::SAME * length;
    if !(-slack..=length + slack).contains(&s) {
        return Err(Error::input(format!("the marker is off the beam, at s = {}", short(s)))
            .hint(format!("give [s, ...] with 0 <= s <= {}, the length", short(length))));
    }
    Ok(abscissae.partition_point(|abscissa| *abscissa < s - slack).min(abscissae.len() - 1))
}

/// Coordinates and velocities of the beam at the start, as of a rigid body with its origin at the left end.
struct BeamStart<const D: usize> {
    q: Vec<f64>,
    v: Vec<f64>,
}

impl<const D: usize> BeamStart<D> {
    /// Coordinates and velocities of the node at `s`, with its centre of mass `ahead` of it.
    fn at(&self, s: f64, ahead: f64, line: &ReferenceLine) -> (Vec<f64>, Vec<f64>) {
        let (axes, node) = line.at(s);
        let centre: [f64; 3] = from_fn(|i| node[i] + ahead * axes[0][i]);
        // Unit quaternion, and angular velocity in the axes of the left end.
        let (turn, spin): ([f64; 4], [f64; 3]) = match D {
            2 => (quaternion_from_vector(&[0.0, 0.0, self.q[2]]), [0.0, 0.0, self.v[2]]),
            _ => (from_fn(|i| self.q[3 + i]), from_fn(|i| self.v[3 + i])),
        };
        let matrix = matrix_from_quaternion(&turn);
        let in_world = |v: &[f64; 3]| -> [f64; 3] { from_fn(|i| dot3(&matrix[i], v)) };
        let arm = in_world(&centre);
        let lever = cross(&in_world(&spin), &arm);
        let mut q: Vec<f64> = (0..D).map(|i| self.q[i] + arm[i]).collect();
        let mut v: Vec<f64> = (0..D).map(|i| self.v[i] + lever[i]).collect();
        if D == 2 {
            q.push(self.q[2] + line.curvature[2] * s);
            v.push(self.v[2]);
        } else {
            q.extend(quaternion_product(&turn, &quaternion_from_vector(&line.curvature.each(|k| k * s))));
            v.extend(axes.each(|axis| dot3(&axis, &spin)));
        }
        (q, v)
    }
}
