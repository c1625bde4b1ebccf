//! Joints that close loops, as the command line names them.

use crate::error::{Error, suggest};
use std::str::FromStr;

/// A joint between two links, whose axes coincide at position zero: `[NAME=]TYPE:LINK@X,Y,Z:LINK@X,Y,Z[:axis=X,Y,Z]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Closure {
    /// Name of the joint.
    pub name: String,
    /// Its type in the scene: one of `KINDS`.
    pub kind: &'static str,
    /// The two links, each with a point in its frame, m.
    pub ends: [(String, [f64; 3]); 2],
    /// z axis of the joint in the frame of the first link.
    pub axis: [f64; 3],
}

/// Types of joints that can close loops.
pub const KINDS: [&str; 3] = ["revolute", "spherical", "weld"];

const FORM: &str = "write [NAME=]revolute:LINK@X,Y,Z:LINK@X,Y,Z, with :axis=X,Y,Z in the first link's frame (default: its z \
                    axis); spherical and weld likewise";

impl FromStr for Closure {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let faulty = |what: String| Error::input(what).hint(FORM);
        let parts: Vec<&str> = text.split(':').collect();
        let (head, ends, axis) = match parts[..] {
            [head, a, b] => (head, [a, b], None),
            [head, a, b, axis] => (head, [a, b], Some(axis)),
            _ => return Err(faulty(format!("expected a joint and two links, found {} parts", parts.len()))),
        };
        let (name, kind) = head.split_once('=').unwrap_or(("loop", head));
        let known = KINDS.iter().find(|known| **known == kind);
        let kind = known.ok_or_else(|| Error::input(format!("`{kind}` closes no loop")).hint(suggest(kind, KINDS)))?;
        let end = |text: &str| {
            let (link, point) = text.split_once('@')?;
            Some((link.to_string(), triple(point)?))
        };
        let [a, b] = ends.map(|text| end(text).ok_or_else(|| faulty(format!("`{text}` is no point of a link"))));
        let axis = match axis.map(|text| text.strip_prefix("axis=").and_then(triple).ok_or(text)) {
            None => [0.0, 0.0, 1.0],
            Some(Ok(axis)) if axis != [0.0; 3] => axis,
            Some(_) => return Err(faulty("the axis has no direction".to_string())),
        };
        Ok(Closure { name: name.to_string(), kind, ends: [a?, b?], axis })
    }
}

fn triple(text: &str) -> Option<[f64; 3]> {
    let numbers: Option<Vec<f64>> = text.split(',').map(crate::math::expression::constant).collect();
    numbers?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::Closure;

    #[test]
    fn joints_are_read_or_refused() {
        let read = |text: &str| text.parse::<Closure>().map_err(|error| error.to_string());
        let joint = read("D=revolute:coupler@1,0,0:rocker@0.5,-1,2:axis=0,1,0").unwrap();
        assert_eq!((joint.name.as_str(), joint.kind, joint.axis), ("D", "revolute", [0.0, 1.0, 0.0]));
        assert_eq!(joint.ends[1], ("rocker".to_string(), [0.5, -1.0, 2.0]));
        assert_eq!(read("spherical:a@0,0,0:b@1,1,1").map(|joint| joint.name), Ok("loop".to_string()));
        for (text, expected) in [
            ("revolute:a@0,0,0", "expected a joint and two links, found 2 parts"),
            ("gear:a@0,0,0:b@1,1,1", "`gear` closes no loop"),
            ("weld:a@0,0:b@1,1,1", "`a@0,0` is no point of a link"),
            ("weld:a@0,0,0:b", "`b` is no point of a link"),
            ("weld:a@0,0,0:b@0,0,0:axis=0,0,0", "the axis has no direction"),
            ("weld:a@0,0,0:b@0,0,0:0,0,1", "the axis has no direction"),
        ] {
            assert!(read(text).unwrap_err().starts_with(expected), "{text}");
        }
    }
}
