//! The directions of motion that assembly must not change.

use crate::error::{Error, Result};
use crate::system::MechanicalSystem;

/// Indices of the velocity directions that `hold` names: a coordinate (`crank.angle`), the rotation of a spatial body
/// (`link.rotation`) or all of a body (`crank`). Where each velocity is the rate of one coordinate, as in own equations,
/// that coordinate's name does as well.
pub fn directions(system: &dyn MechanicalSystem, hold: &[String]) -> Result<Vec<usize>> {
    let names = if hold.is_empty() { Default::default() } else { system.facts().names.clone() };
    let n = system.dimensions();
    let coordinates = if n.q == n.moving() { &names.q[..] } else { &[] };
    let mut held = Vec::new();
    for (i, wanted) in hold.iter().enumerate() {
        let is_named = |k: usize| matches(&names.v[k], wanted) || coordinates.get(k) == Some(wanted);
        let found: Vec<usize> = (0..names.v.len()).filter(|&k| is_named(k)).collect();
        if found.is_empty() {
            let mut known: Vec<&str> = names.v.iter().map(|name| name.trim_end_matches('\'')).collect();
            known.extend(names.v.iter().filter_map(|name| name.split_once('.')).map(|(body, _)| body));
            known.splice(..coordinates.len(), coordinates.iter().map(String::as_str));
            known.dedup();
            return Err(Error::unknown("coordinate", wanted, known).under(format!("assembly.hold[{i}]")));
        }
        held.extend(found);
    }
    held.sort_unstable();
    held.dedup();
    Ok(held)
}

fn matches(direction: &str, wanted: &str) -> bool {
    let Some((body, quantity)) = direction.split_once('.') else { return direction == wanted };
    match wanted.split_once('.') {
        None => wanted == body,
        Some((wanted_body, "rotation")) => wanted_body == body && quantity.starts_with(['w', 'r']),
        Some((wanted_body, coordinate)) => wanted_body == body && quantity.trim_end_matches('\'') == coordinate,
    }
}
