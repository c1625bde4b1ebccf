//! Remarks on the eigenvalues of a table: zero to rounding, with few right digits, without vectors of their own.

use crate::error::two_digits;
use crate::linearize::{LinearModel, Mode, ModePair};
use crate::tolerances::{DEFECTIVE_MODE, EIGENVALUES_AGREE};
use std::fmt::Write;

/// Returns a line for each remark on the listed eigenvalues, by their numbers in the table; `names` are those of the
/// velocities.
pub fn notes(model: &LinearModel, listed: &[(usize, ModePair)], names: &[String]) -> String {
    let mut text = String::new();
    let zeros: Vec<&(usize, ModePair)> = listed.iter().filter(|(_, pair)| pair.mode.is_zero()).collect();
    for motion in ["x", "y", "z", "angle", ""] {
        let same = zeros.iter().filter(|(_, pair)| rigid_motion(pair.mode, names) == motion);
        let (numbers, bounds): (Vec<usize>, Vec<f64>) =
            same.map(|(number, pair)| (*number, pair.mode.rounding)).unzip();
        if !numbers.is_empty() {
            let bound = two_digits(bounds.into_iter().fold(0.0, f64::max));
            let what = match motion {
                "" => String::new(),
                "angle" => ": all turns together".to_string(),
                axis => format!(": all moves together along {axis}"),
            };
            let _ = writeln!(text, "  {} to rounding, below {bound} 1/s{what}", subject(&numbers, "zero"));
        }
    }
    let others: Vec<&(usize, ModePair)> = listed.iter().filter(|(_, pair)| !pair.mode.is_zero()).collect();
    // Another eigenvalue is the same to rounding, and their vectors are dependent.
    let is_defective = |mode: &Mode| {
        let is_same = |other: &&Mode| (other.value - mode.value).norm() <= mode.error + other.error;
        let same = model.modes.iter().filter(|other| other.kind == mode.kind).filter(is_same).count();
        mode.condition > DEFECTIVE_MODE && same > 1
    };
    let defective: Vec<usize> =
        others.iter().filter(|(_, pair)| is_defective(pair.mode)).map(|(number, _)| *number).collect();
    if !defective.is_empty() {
        let _ = writeln!(
            text,
            "  {}: an eigenvalue with fewer vectors than its multiplicity; its motions contain t exp(lambda t), and \
             rounding splits it",
            subject(&defective, "defective")
        );
    }
    for (number, ModePair { mode, .. }) in others {
        // Four of the six digits that are printed hold.
        if mode.error > 1e-4 * mode.value.norm() && !defective.contains(number) {
            let error = two_digits(mode.error);
            let condition = mode.condition;
            let _ = writeln!(text, "  mode {number} is right to {error} 1/s only (condition {condition:.1e})");
        }
    }
    text
}

/// `mode 1 is zero`, `modes 1, 2 are zero`.
fn subject(numbers: &[usize], what: &str) -> String {
    let list: Vec<String> = numbers.iter().map(usize::to_string).collect();
    if let [one] = list.as_slice() {
        format!("mode {one} is {what}")
    } else {
        format!("modes {} are {what}", list.join(", "))
    }
}

/// The motion of everything as one rigid body: `x`, `y`, `z` along an axis, `angle` about one in the plane; else empty.
fn rigid_motion(mode: &Mode, names: &[String]) -> &'static str {
    let of = |end: &str| -> Vec<f64> {
        let named = names.iter().zip(&mode.shape).filter(|(name, _)| name.ends_with(end));
        named.map(|(_, x)| x.norm()).collect()
    };
    let is_still = |x: &[f64]| x.iter().all(|x| *x < EIGENVALUES_AGREE);
    let is_common = |x: &[f64]| {
        x.first()
            .is_some_and(|first| *first > EIGENVALUES_AGREE && x.iter().all(|x| (x - first).abs() < EIGENVALUES_AGREE))
    };
    let turns: Vec<f64> = [of(".angle'"), of(".wx"), of(".wy"), of(".wz")].concat();
    let along = [("x", of(".x'")), ("y", of(".y'")), ("z", of(".z'"))];
    for (axis, own) in &along {
        let rest = along.iter().filter(|(other, _)| other != axis).all(|(_, x)| is_still(x));
        if is_common(own) && rest && is_still(&turns) {
            return axis;
        }
    }
    if is_common(&of(".angle'")) { "angle" } else { "" }
}
