//! Reference values for lengths and for the rows of phi.

use crate::body::norm;
use crate::joint::{ClosedForm, Joint};
use crate::scene::Model;

/// A length typical of the scene, m: the largest distance of a marker from its body's origin or length of a rod; where
/// there are none, of the ground's markers; else the extent of the start, if that is below 1.
pub(super) fn length_scale<const D: usize>(model: &Model<D>) -> f64 {
    let bodies = model.bodies.iter().map(|part| part.facts.reach).fold(0.0, f64::max);
    let rods = model.joints.iter().filter_map(|joint| rod_length(&*joint.element)).fold(0.0, f64::max);
    let ground = model.ground.iter().map(|marker| norm(&marker.offset)).fold(0.0, f64::max);
    [f64::max(bodies, rods), ground, model.extent.min(1.0)].into_iter().find(|length| *length > 0.0).unwrap_or(1.0)
}

/// The length of a rod, m; `None` for other joints.
fn rod_length<const D: usize>(joint: &dyn Joint<D>) -> Option<f64> {
    match joint.closed_form()? {
        ClosedForm::Rod(length) => Some(length),
        ClosedForm::Lock(_) => None,
    }
}

/// Lengths above zero of bodies and rods, m, by name.
pub(super) fn named_lengths<const D: usize>(model: &Model<D>) -> Vec<(String, f64)> {
    let bodies = model.bodies.iter().map(|part| (part.name.clone(), part.facts.reach));
    let rods = model.joints.iter().filter_map(|joint| Some((joint.name.clone(), rod_length(&*joint.element)?)));
    bodies.chain(rods).filter(|(_, length)| *length > 0.0).collect()
}

/// The unit of each row of phi that drift is measured against: the length for rows in metres, 1 rad for angles.
pub(super) fn row_scales<const D: usize>(model: &Model<D>, length: f64) -> Vec<f64> {
    let rows = model.joints.iter().flat_map(|joint| joint.element.row_names());
    rows.map(|row| if matches!(row, "x" | "y" | "z" | "length") { length } else { 1.0 }).collect()
}
