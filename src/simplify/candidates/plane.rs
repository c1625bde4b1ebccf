//! A plane in space, and numbers of a scene seen in it.

use crate::body::{cross, dot, norm, unit};
use crate::math::array::{Each, from_fn};
use crate::scene::document::{change_names, elements, text};
use crate::simplify::{Facts, PlacedMarker};
use crate::tolerances::SAME;
use serde_json::{Value, json};

/// The plane that bodies move in: its x and y axes and its normal, in the world.
pub struct Plane {
    /// x, y and normal.
    pub axes: [[f64; 3]; 3],
}

impl Plane {
    /// The plane across the fastest rotation of a body, or across z where none rotates; seen from where the first hinge
    /// turns to the left.
    pub fn new(facts: &Facts) -> Plane {
        let bodies = elements(facts.scene(), "bodies").iter();
        let spins = bodies.filter_map(|body| facts.path(text(body, "name"))).flatten().map(|place| place.spin);
        let fastest = spins.max_by(|a, b| dot(a, a).total_cmp(&dot(b, b))).unwrap_or_default();
        let size = norm(&fastest);
        let normal = if size > 0.0 { exact(fastest.each(|x| x / size)) } else { unit(2) };
        let hinges = elements(facts.scene(), "joints").iter().filter(|joint| text(joint, "type") == "revolute");
        let markers = hinges.filter_map(|joint| facts.place(joint["between"][0].as_str()?));
        let hinge = markers.map(|place| place.axes[2]).find(|z| (dot(z, &normal).abs() - 1.0).abs() < SAME);
        let is_turned = hinge.map_or(normal.iter().sum::<f64>() < 0.0, |z| dot(&z, &normal) < 0.0);
        let normal = if is_turned { normal.each(|x| 0.0 - x) } else { normal };
        // Of a coordinate plane its own axes.
        let axis = (0..3).find(|i| normal[*i].abs() == 1.0);
        let first = axis.map(|i| if normal[i] > 0.0 { unit((i + 1) % 3) } else { unit((i + 2) % 3) });
        Plane { axes: first.map_or_else(|| basis(normal), |x| [x, cross(&normal, &x), normal]) }
    }

    /// The normal.
    pub fn normal(&self) -> &[f64; 3] {
        &self.axes[2]
    }

    /// 1 or -1 where a direction is along the normal.
    pub fn along(&self, direction: &[f64; 3]) -> Option<f64> {
        let part = dot(direction, self.normal());
        ((part.abs() - 1.0).abs() < SAME).then(|| part.signum())
    }

    /// True if a direction lies in the plane.
    pub fn contains(&self, direction: &[f64; 3]) -> bool {
        dot(direction, self.normal()).abs() < SAME
    }

    /// Angle of a direction in the plane.
    pub fn angle(&self, direction: &[f64; 3]) -> f64 {
        dot(&self.axes[1], direction).atan2(dot(&self.axes[0], direction))
    }

    /// Direction in the world of the planar x axis of a marker: its x axis where its z axis is along the normal, else
    /// that.
    pub fn marker(&self, place: &PlacedMarker) -> Option<[f64; 3]> {
        let [x, _, z] = place.axes;
        match self.along(&z) {
            Some(_) => Some(x),
            None => self.contains(&z).then_some(z),
        }
    }

    /// Direction at the start of the planar x axis of what has this name: the ground, a body or a marker.
    pub fn x_of(&self, facts: &Facts, name: &str) -> Option<[f64; 3]> {
        let place = facts.place(name)?;
        if name.contains('.') { self.marker(&place) } else { Some(world(&place, &self.seen_from(name, &place)[0])) }
    }

    /// The axes of the plane in those of the ground or of a body that is at `place`.
    pub fn seen_from(&self, name: &str, place: &PlacedMarker) -> [[f64; 3]; 3] {
        if name == "ground" { self.axes } else { self.seen_by(place) }
    }

    /// The axes of the plane as a body at `place` sees them: its own x axis first, if that lies in the plane.
    fn seen_by(&self, place: &PlacedMarker) -> [[f64; 3]; 3] {
        basis(exact(place.axes.each(|axis| dot(&axis, self.normal()))))
    }

    /// A vector of the world in the plane.
    pub fn flat(&self, vector: &Value) -> Option<Value> {
        flat(&self.axes, vector)
    }

    /// The part of a vector of the world along the normal.
    pub fn across(&self, vector: &Value) -> Option<Value> {
        combined(self.normal(), vector)
    }

    /// The name in the plane of a component x, y or z of the world; `None` where it is no axis of the plane.
    pub fn component(&self, name: &str) -> Option<&'static str> {
        let axis = unit(["x", "y", "z"].iter().position(|own| *own == name)?);
        ["x", "y"].into_iter().zip(&self.axes).find(|(_, own)| dot(own, &axis) == 1.0).map(|(name, _)| name)
    }

    /// Quantities of markers such as `crank.tip.z` in the plane, in all texts of a value; `None` where one has none.
    pub fn translate(&self, value: &mut Value) -> Option<()> {
        let mut is_possible = true;
        change_names(value, &mut |word, _| {
            let (of, name) = word.rsplit_once('.')?;
            let quantity = name.trim_end_matches('\'');
            let seen = match quantity {
                "x" | "y" | "z" => self.component(quantity),
                "wx" | "wy" | "wz" => None,
                _ => return None,
            };
            is_possible &= seen.is_some();
            Some(format!("{of}.{}{}", seen?, &name[quantity.len()..]))
        });
        is_possible.then_some(())
    }
}

/// A direction of a body in the world.
pub fn world(frame: &PlacedMarker, direction: &[f64; 3]) -> [f64; 3] {
    from_fn(|i| (0..3).map(|k| direction[k] * frame.axes[k][i]).sum())
}

/// A direction without what rounding has added to one along a coordinate axis.
fn exact(direction: [f64; 3]) -> [f64; 3] {
    direction.each(|x| if (x - x.round()).abs() < SAME { x.round() + 0.0 } else { x })
}

/// Axes across and along `normal`: the first is the part of x, or of y where that is along the normal.
fn basis(normal: [f64; 3]) -> [[f64; 3]; 3] {
    let from = unit(usize::from((normal[0].abs() - 1.0).abs() < SAME));
    let part: [f64; 3] = from_fn(|i| from[i] - dot(&from, &normal) * normal[i]);
    let size = norm(&part);
    let first = exact(part.each(|x| x / size));
    [first, exact(cross(&normal, &first)), normal]
}

/// The first two components of a vector in other axes.
pub fn flat(axes: &[[f64; 3]; 3], vector: &Value) -> Option<Value> {
    Some(json!([combined(&axes[0], vector)?, combined(&axes[1], vector)?]))
}

/// `direction` . `vector`, in the numbers of the scene.
pub fn combined(direction: &[f64], vector: &Value) -> Option<Value> {
    let parts: Vec<(f64, &Value)> = direction.iter().copied().zip(vector.as_array()?).collect();
    let number = |value: &Value| value.as_str().map_or_else(|| value.to_string(), |text| format!("({text})"));
    let parts: Vec<(f64, &Value)> = parts.into_iter().filter(|(part, _)| *part != 0.0).collect();
    match parts[..] {
        [] => Some(json!(0)),
        [(1.0, one)] => Some(one.clone()),
        _ => Some(json!(
            parts.iter().map(|(part, value)| format!("{part}*{}", number(value))).collect::<Vec<_>>().join(" + ")
        )),
    }
}
