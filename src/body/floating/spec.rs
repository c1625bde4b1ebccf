//! Flexible bodies in floating frames made from their keys in a scene.

use super::Floating;
use crate::body::flexible::modal::{ModalBody, ModalShapes};
use crate::body::flexible::{FlexibleBeam, PointShape, elastic_beam};
use crate::body::{BodySpec, Build, BuiltBody, Initial, Marker};
use crate::error::{Error, Result, find, short};
use crate::math::expression::Number;
use std::collections::BTreeMap;

impl BodySpec for FlexibleBeam {
    const TYPE: &'static str = "flexible_beam";

    fn build<const D: usize>(
        &self,
        markers: Vec<Marker<D>>,
        initial: &Initial,
        build: &Build<D>,
    ) -> Result<BuiltBody<D>> {
        refuse_origin(&markers, "a beam is its left end")?;
        // The first marker is the frame itself.
        let places: Vec<f64> = markers.iter().skip(1).map(|marker| marker.offset[0]).collect();
        let (elastic, length) = elastic_beam::<D>(self, &places, build)?;
        let on_line = |(i, mut marker): (usize, Marker<D>)| match (&elastic.line, i) {
            (Some(line), 1..) => {
                marker.offset[0] = marker.offset[0].clamp(0.0, length);
                (line.point(marker.offset), line.at_rest(marker.offset[0]).carry(marker))
            }
            _ => (frame_itself(), marker),
        };
        let (shapes, markers) = markers.into_iter().enumerate().map(on_line).unzip();
        let (q, v) = start(initial, &elastic.names, build)?;
        Ok(BuiltBody { body: Box::new(Floating::new(elastic, markers, shapes)), q, v })
    }
}

impl BodySpec for ModalBody {
    const TYPE: &'static str = "modal_body";

    fn build<const D: usize>(
        &self,
        markers: Vec<Marker<D>>,
        initial: &Initial,
        build: &Build<D>,
    ) -> Result<BuiltBody<D>> {
        refuse_origin(&markers, "a modal_body is that of its data")?;
        let ModalShapes { elastic, nodes } = self.shapes(build)?;
        let size = nodes.iter().flat_map(|(_, node)| node.rest).fold(0.0f64, |size, x| size.max(x.abs()));
        let shape = |(i, marker): (usize, &Marker<D>)| match i {
            // The first marker is the frame itself.
            0 => Ok(frame_itself()),
            _ => node_at(&nodes, &marker.offset, size),
        };
        let shapes = markers.iter().enumerate().map(shape).collect::<Result<_>>()?;
        let (q, v) = start(initial, &elastic.names, build)?;
        Ok(BuiltBody { body: Box::new(Floating::new(elastic, markers, shapes)), q, v })
    }
}

/// The interface node at a position.
fn node_at<const D: usize>(nodes: &[(String, PointShape<D>)], at: &[f64; D], size: f64) -> Result<PointShape<D>> {
    // Files have five or six digits.
    let is_there = |node: &PointShape<D>| node.rest.iter().zip(at).all(|(a, b)| (a - b).abs() <= 1e-5 * size);
    let written = |at: &[f64; D]| format!("[{}]", at.map(short).join(", "));
    nodes.iter().find(|(_, node)| is_there(node)).map(|(_, node)| node.clone()).ok_or_else(|| {
        let known: Vec<String> =
            nodes.iter().take(8).map(|(name, node)| format!("{name} {}", written(&node.rest))).collect();
        let more = if nodes.len() > known.len() { " ..." } else { "" };
        Error::input(format!("there is no node at {}, where a marker is", written(at)))
            .under("markers")
            .hint(format!("markers of a modal_body lie at its nodes: {}{more}", known.join(", ")))
    })
}

fn refuse_origin<const D: usize>(markers: &[Marker<D>], truth: &str) -> Result<()> {
    if markers.first().is_some_and(|own| own.offset.iter().any(|x| *x != 0.0)) {
        Err(Error::input(format!("the origin of {truth}")).under("origin").hint("remove it"))
    } else {
        Ok(())
    }
}

/// Displacement functions of a marker at the floating frame: none.
pub(super) fn frame_itself<const D: usize>() -> PointShape<D> {
    PointShape {
        rest: [0.0; D],
        arm: [0.0; D],
        dofs: Vec::new(),
        translation: Vec::new(),
        rotation: Vec::new(),
        shortening: Vec::new(),
    }
}

/// Initial q and v; elastic ones are given by name.
pub(super) fn start<const D: usize>(
    initial: &Initial,
    names: &[String],
    build: &Build<D>,
) -> Result<(Vec<f64>, Vec<f64>)> {
    let (mut q, mut v) = initial.motion(build)?;
    q.extend(elastic("initial.elastic", &initial.elastic, names, build)?);
    v.extend(elastic("initial.elastic_velocity", &initial.elastic_velocity, names, build)?);
    Ok((q, v))
}

/// Values of the elastic coordinates, or of their rates; those not named are zero.
fn elastic<const D: usize>(
    field: &str,
    given: &Option<BTreeMap<String, Number>>,
    names: &[String],
    build: &Build<D>,
) -> Result<Vec<f64>> {
    let mut values = vec![0.0; names.len()];
    for (name, number) in given.iter().flatten() {
        let place = find("elastic coordinate", name, names.iter().map(String::as_str));
        values[place.map_err(|error| error.under(format!("{field}.{name}")))?] =
            build.number(&format!("{field}.{name}"), number)?;
    }
    Ok(values)
}
