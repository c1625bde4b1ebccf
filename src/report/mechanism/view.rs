//! Projection from space to the plane of a figure.

use crate::body::{cross, dot, norm, sub, unit};
use crate::error::{Error, Result, suggest};

/// A parallel projection, in which parallel lines stay parallel and lengths comparable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Directions to the right, up, and towards the viewer, by rows.
    axes: [[f64; 3]; 3],
    /// Names of the figure's axes where they are those of the scene.
    names: Option<[&'static str; 2]>,
}

const NAMES: [&str; 7] = ["iso", "xy", "xz", "yz", "front", "side", "top"];
/// Elevation of the isometric view, degrees: all three axes appear equally long.
const ISOMETRIC: f64 = 35.264_389_682_754_654;

impl View {
    pub fn planar() -> Self {
        View { axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], names: Some(["x", "y"]) }
    }

    /// The isometric view of a scene in which axis number `up` points up.
    pub fn isometric(up: usize) -> Self {
        Self::from_angles(-45.0, ISOMETRIC, up)
    }

    /// Reads a view: a name or `azimuth=..,elevation=..` in degrees. Axis number `up` of the scene points up.
    pub fn parse(text: &str, up: usize) -> Result<Self> {
        let name = text.trim().to_lowercase();
        let plane = |i: usize, j: usize| View {
            axes: [unit(i), unit(j), cross(&unit(i), &unit(j))],
            names: Some([["x", "y", "z"][i], ["x", "y", "z"][j]]),
        };
        let first = (up + 1) % 3;
        let second = (up + 2) % 3;
        match name.as_str() {
            "iso" => Ok(Self::isometric(up)),
            "xy" => Ok(plane(0, 1)),
            "xz" => Ok(plane(0, 2)),
            "yz" => Ok(plane(1, 2)),
            "front" => Ok(plane(first, up)),
            "side" => Ok(plane(second, up)),
            "top" => Ok(plane(first, second)),
            angles if angles.contains('=') => Self::parse_angles(angles, up),
            _ => Err(Error::input(format!("there is no view `{text}`"))
                .hint(format!("{}; or give azimuth=30,elevation=20 in degrees", suggest(&name, NAMES)))),
        }
    }

    fn parse_angles(text: &str, up: usize) -> Result<Self> {
        let mut azimuth = -45.0;
        let mut elevation = ISOMETRIC;
        for part in text.split(',') {
            let (key, value) = part.split_once('=').unwrap_or((part, ""));
            let place = match key.trim() {
                "azimuth" => &mut azimuth,
                "elevation" => &mut elevation,
                key => {
                    return Err(
                        Error::input(format!("a view has no `{key}`")).hint(suggest(key, ["azimuth", "elevation"]))
                    );
                }
            };
            *place = value.trim().parse().ok().filter(|angle: &f64| angle.is_finite()).ok_or_else(|| {
                Error::input(format!("`{value}` is no angle")).hint("give degrees, as in azimuth=30,elevation=20")
            })?;
        }
        Ok(Self::from_angles(azimuth, elevation, up))
    }

    /// The view from a viewer's position, degrees: `azimuth` is counted from the first axis after `up` to the second
    /// one.
    fn from_angles(azimuth: f64, elevation: f64, up: usize) -> Self {
        let ((sa, ca), (se, ce)) = (azimuth.to_radians().sin_cos(), elevation.to_radians().sin_cos());
        let rows = [[-sa, ca, 0.0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]];
        // The third component belongs to the axis that points up.
        let turned = |row: [f64; 3]| std::array::from_fn(|i| row[(i + 2 + 3 - up) % 3]);
        View { axes: rows.map(turned), names: None }
    }

    /// Returns the components to the right and up in the figure.
    pub fn flat(&self, vector: [f64; 3]) -> (f64, f64) {
        (dot(&self.axes[0], &vector), dot(&self.axes[1], &vector))
    }

    /// Returns the component towards the viewer.
    pub fn depth(&self, vector: [f64; 3]) -> f64 {
        dot(&self.axes[2], &vector)
    }

    pub fn labels(&self) -> [String; 2] {
        match self.names {
            Some(names) => names.map(|name| format!("{name} (m)")),
            None => ["across the view (m)".to_string(), "up the view (m)".to_string()],
        }
    }
}

/// Returns a + factor b.
pub fn along(a: [f64; 3], b: [f64; 3], factor: f64) -> [f64; 3] {
    std::array::from_fn(|i| a[i] + factor * b[i])
}

/// Returns the unit vector along a vector; none for zero.
pub fn direction(a: [f64; 3]) -> Option<[f64; 3]> {
    let size = norm(&a);
    (size > 1e-12).then(|| a.map(|x| x / size))
}

/// Returns two unit vectors perpendicular to `axis` and to each other, the first as near to `hint` as possible.
pub fn square_to(axis: [f64; 3], hint: [f64; 3]) -> [[f64; 3]; 2] {
    let least = (0..3).min_by(|i, j| axis[*i].abs().total_cmp(&axis[*j].abs())).unwrap_or(0);
    let upright = |vector: [f64; 3]| along(vector, axis, -dot(&axis, &vector));
    let first = direction(upright(hint)).or_else(|| direction(upright(unit(least)))).unwrap_or(unit(least));
    [first, cross(&axis, &first)]
}

/// Returns the direction of points if they lie on a line.
pub fn straight(points: &[[f64; 3]]) -> Option<[f64; 3]> {
    let from = *points.first()?;
    let far = points.iter().copied().max_by(|a, b| norm(&sub(a, &from)).total_cmp(&norm(&sub(b, &from))))?;
    let axis = direction(sub(&far, &from))?;
    let off = points.iter().map(|point| norm(&cross(&axis, &sub(point, &from)))).fold(0.0, f64::max);
    (off < 1e-6 * norm(&sub(&far, &from))).then_some(axis)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: (f64, f64), b: (f64, f64)) -> bool {
        (a.0 - b.0).abs() < 1e-12 && (a.1 - b.1).abs() < 1e-12
    }

    #[test]
    fn named_views_show_their_axes() {
        let point = [1.0, 2.0, 3.0];
        for (name, flat) in [("xy", (1.0, 2.0)), ("xz", (1.0, 3.0)), ("yz", (2.0, 3.0)), ("top", (1.0, 2.0))] {
            assert_eq!(View::parse(name, 2).unwrap().flat(point), flat, "{name}");
        }
        assert_eq!(View::parse("front", 2).unwrap().flat(point), (1.0, 3.0));
        assert_eq!(View::parse("side", 2).unwrap().flat(point), (2.0, 3.0));
        // With y up, z and x are the axes of the floor.
        assert_eq!(View::parse("front", 1).unwrap().flat(point), (3.0, 2.0));
    }

    #[test]
    fn angles_agree_with_the_names() {
        let point = [1.0, 2.0, 3.0];
        for (angles, name) in
            [("azimuth=-90,elevation=0", "xz"), ("azimuth=0,elevation=0", "yz"), ("azimuth=-90,elevation=90", "xy")]
        {
            let a = View::parse(angles, 2).unwrap();
            let b = View::parse(name, 2).unwrap();
            assert!(near(a.flat(point), b.flat(point)) && (a.depth(point) - b.depth(point)).abs() < 1e-12, "{name}");
        }
    }

    #[test]
    fn axes_look_equally_long_in_the_isometric_view_and_up_is_up() {
        for up in 0..3 {
            let view = View::isometric(up);
            let sizes = [0, 1, 2].map(|i| view.flat(unit(i))).map(|(x, y)| x.hypot(y));
            assert!(sizes.iter().all(|size| (size - (2.0f64 / 3.0).sqrt()).abs() < 1e-12), "{sizes:?}");
            assert!(near(view.flat(unit(up)), (0.0, (2.0f64 / 3.0).sqrt())));
            assert!(dot(&cross(&view.axes[0], &view.axes[1]), &view.axes[2]) > 0.999);
        }
    }
}
