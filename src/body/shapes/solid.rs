//! Geometry of the shapes of a body, for pictures.

use super::Shape;
use crate::body::{Build, in_space};
use crate::error::Result;
use crate::math::rotation::quaternion_from_axes;
use serde::Serialize;
use serde_json::Value;

/// A shape with its place in the axes of its body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Solid {
    /// Its kind and sizes, m.
    #[serde(flatten)]
    pub form: Form,
    /// Position of its axes from the origin of the body, m.
    pub at: [f64; 3],
    /// Unit quaternion [w, x, y, z] of its axes.
    pub rotation: [f64; 4],
}

/// Kind and sizes of a shape, m; flat ones have no thickness where the scene gives none.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// Edges along x, y and z.
    Box([f64; 3]),
    /// Hollow cylinder about z: outer radius, inner radius, length.
    Tube([f64; 3]),
    /// Radius.
    Sphere(f64),
    /// Two points, and a radius, zero for a slender rod.
    Rod([f64; 3], [f64; 3], f64),
    /// Corners of a prism about z, and its thickness.
    Polygon(Vec<[f64; 2]>, f64),
}

/// Returns the shapes of a body as its scene gives them, without holes; none for a body without shapes.
///
/// # Errors
/// Shapes that [`MassProperties::of`](super::MassProperties::of) refuses, too.
pub fn solids<const D: usize>(shapes: Option<&Value>, build: &Build<D>) -> Result<Vec<Solid>> {
    let Some(shapes) = shapes else { return Ok(Vec::new()) };
    let shapes: Vec<Shape> = crate::body::parse(shapes.clone())?;
    let doubts = build.switches.borrow().doubts.len();
    let solids = shapes.iter().filter(|shape| !shape.hole).map(|shape| shape.solid(build)).collect();
    // The same numbers are read again with the mass, and their doubts with them.
    build.switches.borrow_mut().doubts.truncate(doubts);
    solids
}

impl Shape {
    fn solid<const D: usize>(&self, build: &Build<D>) -> Result<Solid> {
        let at = self.at.as_ref().map_or(Ok([0.0; D]), |at| build.vector("at", at))?;
        Ok(Solid { form: self.form(build)?, at: in_space(&at), rotation: quaternion_from_axes(&self.axes(build)?) })
    }

    fn form<const D: usize>(&self, build: &Build<D>) -> Result<Form> {
        let thickness = build.number_or("thickness", &self.thickness, 0.0)?;
        if let Some(edges) = &self.r#box {
            return Ok(Form::Box(build.vector("box", edges)?));
        }
        if let Some(edges) = &self.plate {
            let [a, b] = build.vector("plate", edges)?;
            return Ok(Form::Box([a, b, thickness]));
        }
        if let Some(round) = &self.cylinder {
            return Ok(Form::Tube([
                build.number("radius", &round.radius)?,
                0.0,
                build.number("length", &round.length)?,
            ]));
        }
        if let Some(round) = &self.disc {
            return Ok(Form::Tube([build.number("radius", &round.radius)?, 0.0, thickness]));
        }
        if let Some(tube) = &self.tube {
            let radii = [build.number("outer", &tube.outer)?, build.number("inner", &tube.inner)?];
            return Ok(Form::Tube([radii[0], radii[1], build.number("length", &tube.length)?]));
        }
        if let Some(round) = &self.sphere {
            return Ok(Form::Sphere(build.number("radius", &round.radius)?));
        }
        if let Some(rod) = &self.rod {
            let from: [f64; D] = build.vector("from", &rod.from)?;
            let to: [f64; D] = build.vector("to", &rod.to)?;
            return Ok(Form::Rod(in_space(&from), in_space(&to), build.number_or("radius", &rod.radius, 0.0)?));
        }
        let corners = self.polygon.iter().flatten().map(|corner| build.vector("polygon", corner));
        Ok(Form::Polygon(corners.collect::<Result<_>>()?, thickness))
    }
}
