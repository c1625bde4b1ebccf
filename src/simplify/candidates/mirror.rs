//! The mirror image of a scene in a plane across an axis of the world.

use super::merged_bodies::{PLACES, packed};
use super::plane::world;
use crate::body::{cross, dot, norm, sub};
use crate::simplify::edit::{carrier, change_words, elements, text};
use crate::simplify::{Facts, Placed, Relative};
use crate::tolerances::SAME;
use serde_json::Value;
use std::array::from_fn;

type Vector = [f64; 3];

/// A plane in which each body is its own mirror image at the start, or that of another.
pub struct Mirror<'a> {
    /// The scene.
    pub facts: &'a Facts,
    /// Axis of the world across the plane: 0, 1 or 2 for x, y or z.
    pub axis: usize,
    /// Place of the plane along it, m.
    pub offset: f64,
    /// Bodies that are their own image, and the ground.
    pub middle: Vec<&'a str>,
    /// Pairs of bodies: that which stays, that which goes.
    pub pairs: Vec<[&'a str; 2]>,
    /// True if those that go are on the upper side of the plane.
    pub upper_goes: bool,
}

/// A body at the start, seen from the world.
struct Solid<'a> {
    body: &'a Value,
    mass: f64,
    inertia: [Vector; 3],
    centre: Vector,
    velocity: Vector,
    spin: Vector,
}

impl<'a> Solid<'a> {
    fn new(facts: &'a Facts, body: &'a Value) -> Option<Self> {
        let is_plain = ["rigid", "point_mass"].contains(&text(body, "type")) && body.get("shapes").is_none();
        let place = is_plain.then(|| facts.place(text(body, "name"))).flatten()?;
        let moments = packed(&body["inertia"]).map(|all| all.map(|value| facts.number(&value)));
        let mut inertia = [[0.0; 3]; 3];
        for (&(k, l), moment) in PLACES.iter().zip(moments.iter().flatten()) {
            let (moment, [a, b]) = ((*moment)?, [k, l].map(|k| place.axes[k]));
            for (i, row) in inertia.iter_mut().enumerate() {
                let part = |j: usize| if k == l { a[i] * a[j] } else { a[i] * b[j] + b[i] * a[j] };
                (0..3).for_each(|j| row[j] += moment * part(j));
            }
        }
        let arm = arm(facts, body, &place);
        let lever = cross(&place.spin, &arm);
        Some(Solid {
            body,
            mass: facts.number(&body["mass"])?,
            inertia,
            centre: sub(&place.r, &arm),
            velocity: sub(&place.velocity, &lever),
            spin: place.spin,
        })
    }
}

/// From the centre of mass of a body at `place` to its origin, in the world.
fn arm(facts: &Facts, body: &Value, place: &Placed) -> Vector {
    world(place, &from_fn(|i| facts.number(&body["origin"][i]).unwrap_or(0.0)))
}

impl<'a> Mirror<'a> {
    /// The plane across `axis` through the centre of mass; `None` where it is no plane of symmetry of the bodies and of
    /// gravity. The lower side stays.
    pub fn new(facts: &'a Facts, axis: usize) -> Option<Self> {
        let scene = facts.scene();
        let across = match &scene["gravity"] {
            Value::Null => 0.0,
            gravity => facts.number(gravity.as_array()?.get(axis)?)?,
        };
        if across != 0.0 {
            return None;
        }
        let bodies = elements(scene, "bodies").iter();
        let solids: Vec<Solid> = bodies.map(|body| Solid::new(facts, body)).collect::<Option<_>>()?;
        let mass: f64 = solids.iter().map(|solid| solid.mass).sum();
        let centre = solids.iter().map(|solid| solid.mass * solid.centre[axis]).sum::<f64>() / mass;
        let offset = if centre.abs() < SAME * facts.prepared.system().length() { 0.0 } else { centre };
        let mut mirror = Mirror { facts, axis, offset, middle: vec!["ground"], pairs: Vec::new(), upper_goes: true };
        let mut open: Vec<&Solid> = solids.iter().collect();
        while let Some(first) = open.pop() {
            let name = text(first.body, "name");
            if mirror.is_image(first, first) {
                mirror.middle.push(name);
                continue;
            }
            let other = open.remove(open.iter().position(|other| mirror.is_image(first, other))?);
            let pair = [name, text(other.body, "name")];
            let is_before = first.centre[axis] < offset;
            mirror.pairs.push(if is_before { pair } else { [pair[1], pair[0]] });
        }
        Some(mirror)
    }

    /// The same with the other side to stay.
    pub fn turned(self) -> Self {
        let pairs = self.pairs.iter().map(|[stays, goes]| [*goes, *stays]).collect();
        Mirror { pairs, upper_goes: !self.upper_goes, ..self }
    }

    fn is_image(&self, one: &Solid, other: &Solid) -> bool {
        let length = self.facts.prepared.system().length();
        let near = |a: Vector, b: Vector, size: f64| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= SAME * size);
        let size = |x: Vector| 1.0 + norm(&x);
        let moments = one.inertia.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
        let turned: [Vector; 3] = from_fn(|i| {
            let row = self.flip(one.inertia[i]);
            if i == self.axis { row.map(|x| 0.0 - x) } else { row }
        });
        // An angular velocity is mirrored as a torque is.
        let spin = self.flip(one.spin).map(|x| 0.0 - x);
        ["type", "free"].iter().all(|key| one.body.get(key) == other.body.get(key))
            && (one.mass - other.mass).abs() <= SAME * one.mass
            && near(self.image(one.centre), other.centre, length)
            && near(self.flip(one.velocity), other.velocity, size(one.velocity))
            && near(spin, other.spin, size(one.spin))
            && (0..3).all(|i| near(turned[i], other.inertia[i], moments))
    }

    /// The mirror image of a place.
    pub fn image(&self, mut place: Vector) -> Vector {
        place[self.axis] = 2.0 * self.offset - place[self.axis];
        place
    }

    /// The mirror image of a direction.
    pub fn flip(&self, mut direction: Vector) -> Vector {
        direction[self.axis] = 0.0 - direction[self.axis];
        direction
    }

    /// The body that is the image of another; itself on the plane.
    pub fn mate(&self, body: &str) -> Option<&'a str> {
        let of_pair = |[a, b]: &[&'a str; 2]| if *a == body { Some(*b) } else { (*b == body).then_some(*a) };
        let own = self.middle.iter().find(|own| **own == body).copied();
        own.or_else(|| self.pairs.iter().find_map(of_pair))
    }

    /// True if the body of a marker goes.
    pub fn goes(&self, marker: &str) -> bool {
        self.pairs.iter().any(|[_, goes]| *goes == carrier(marker))
    }

    /// Placement of a marker at the start.
    pub fn place(&self, marker: &str) -> Option<Placed> {
        self.facts.place(marker)
    }

    /// True if `other` is on the body of which that of `marker` is the image, and there at its image.
    pub fn are_images(&self, marker: &str, other: &str) -> bool {
        let (Some(place), Some(there)) = (self.place(marker), self.place(other)) else { return false };
        let gap: Vector = from_fn(|i| self.image(place.r)[i] - there.r[i]);
        self.mate(carrier(marker)) == Some(carrier(other)) && norm(&gap) <= SAME * self.facts.prepared.system().length()
    }

    /// 1 or -1 for each axis of a marker that is the image, or minus the image, of that of another.
    pub fn signs(&self, [marker, other]: [&str; 2]) -> Option<[Option<f64>; 3]> {
        let (place, there) = (self.place(marker)?, self.place(other)?);
        let sign = |k: usize| {
            let part = dot(&self.flip(place.axes[k]), &there.axes[k]);
            ((part.abs() - 1.0).abs() < SAME).then(|| part.signum())
        };
        Some(from_fn(sign))
    }

    /// The marker, or body, at the image of another; one with the same axes if there are several.
    pub fn marker_mate(&self, marker: &str) -> Option<String> {
        let body = self.mate(carrier(marker))?;
        let own = if body == "ground" { &self.facts.scene()["ground"] } else { self.facts.element("bodies", body)? };
        let markers = own["markers"].as_object().into_iter().flatten().map(|(name, _)| format!("{body}.{name}"));
        let there: Vec<String> =
            [body.to_string()].into_iter().chain(markers).filter(|other| self.are_images(marker, other)).collect();
        let is_alike = |other: &&String| {
            self.signs([marker, other.as_str()]).is_some_and(|signs| signs.iter().all(Option::is_some))
        };
        there.iter().find(is_alike).or(there.first()).cloned()
    }

    /// Quantities of bodies that go, such as `right.hub.y'`, by those of their images, in all texts of a value; `None`
    /// where one has no image.
    pub fn translate(&self, value: &mut Value) -> Option<()> {
        change_words(value, &|word, primes| {
            if !self.goes(word) {
                return Some(format!("{word}{primes}"));
            }
            let (of, name) = word.rsplit_once('.')?;
            let axis = ["x", "y", "z"].iter().position(|own| *own == name)?;
            let own = format!("{}.{name}{primes}", self.marker_mate(of)?);
            let offset = if primes.is_empty() { 2.0 * self.offset } else { 0.0 };
            Some(if axis == self.axis { format!("({offset} - {own})") } else { own })
        })
    }

    /// How far bodies along the motion are from the images of each other.
    pub fn asymmetry(&self) -> Option<Relative> {
        let middle = self.middle.iter().filter(|name| **name != "ground").map(|name| [*name, *name]);
        let mut most = Relative::default();
        for pair in middle.chain(self.pairs.iter().copied()) {
            let [one, other] = [self.course(pair[0])?, self.course(pair[1])?];
            for ((centre, rotation), (there, turned)) in one.into_iter().zip(other) {
                let gap: Vector = from_fn(|i| self.image(centre)[i] - there[i]);
                // The size of the difference of two rotations by an angle is 2 sqrt(2) sin(angle/2).
                let rows = (0..3).map(|i| {
                    let image = self.flip(rotation[i]);
                    let image = if i == self.axis { image.map(|x| 0.0 - x) } else { image };
                    let gap: Vector = from_fn(|j| image[j] - turned[i][j]);
                    dot(&gap, &gap)
                });
                let half_sine = (rows.sum::<f64>() / 8.0).sqrt();
                most.shift = most.shift.max(norm(&gap));
                most.turn = most.turn.max(2.0 * half_sine.min(1.0).asin());
            }
        }
        Some(most)
    }

    /// Centre of mass of a body, and its rotation since the start, at each state.
    fn course(&self, body: &str) -> Option<Vec<(Vector, [Vector; 3])>> {
        let (element, path) = (self.facts.element("bodies", body)?, self.facts.path(body)?);
        let start = path.first()?.axes;
        let at = |place: &Placed| {
            let arm = arm(self.facts, element, place);
            let rotation = from_fn(|i| from_fn(|j| (0..3).map(|k| place.axes[k][i] * start[k][j]).sum()));
            (sub(&place.r, &arm), rotation)
        };
        Some(path.iter().map(at).collect())
    }
}
