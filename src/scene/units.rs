//! Units in which a scene may ask for an output.

use crate::error::{Error, Result, nearest};
use std::f64::consts::{PI, TAU};

/// Physical dimension of an output, with the units known for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    Angle,
    AngularVelocity,
    AngularAcceleration,
    Length,
    Velocity,
    Acceleration,
    Force,
    Torque,
    Energy,
    Power,
    Strain,
}

/// A unit with its conversion from the SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// Name as it is shown, such as `deg`.
    pub name: String,
    /// Factor from the SI unit to this one: 180/pi for `deg`.
    pub per_si: f64,
}

const POUND: f64 = 4.4482216152605;
const INCH: f64 = 0.0254;
const MILE: f64 = 1609.344;

/// Names of units with their size in SI units; the first is the SI unit.
type UnitSizes = &'static [(&'static str, f64)];

const DIMENSIONS: [(Dimension, &str, UnitSizes); 11] = [
    (
        Dimension::Angle,
        "angle",
        &[("rad", 1.0), ("mrad", 1e-3), ("deg", PI / 180.0), ("arcmin", PI / 10800.0), ("rev", TAU)],
    ),
    (
        Dimension::AngularVelocity,
        "angular velocity",
        &[("rad/s", 1.0), ("deg/s", PI / 180.0), ("rev/s", TAU), ("rpm", TAU / 60.0)],
    ),
    (Dimension::AngularAcceleration, "angular acceleration", &[("rad/s^2", 1.0), ("deg/s^2", PI / 180.0)]),
    (
        Dimension::Length,
        "position",
        &[("m", 1.0), ("km", 1e3), ("cm", 1e-2), ("mm", 1e-3), ("um", 1e-6), ("in", INCH), ("ft", 12.0 * INCH)],
    ),
    (
        Dimension::Velocity,
        "velocity",
        &[
            ("m/s", 1.0),
            ("cm/s", 1e-2),
            ("mm/s", 1e-3),
            ("km/h", 1.0 / 3.6),
            ("mph", MILE / 3600.0),
            ("in/s", INCH),
            ("ft/s", 12.0 * INCH),
        ],
    ),
    (
        Dimension::Acceleration,
        "acceleration",
        &[("m/s^2", 1.0), ("mm/s^2", 1e-3), ("g", 9.80665), ("in/s^2", INCH), ("ft/s^2", 12.0 * INCH)],
    ),
    (
        Dimension::Force,
        "force",
        &[("N", 1.0), ("mN", 1e-3), ("kN", 1e3), ("MN", 1e6), ("kgf", 9.80665), ("lbf", POUND)],
    ),
    (
        Dimension::Torque,
        "torque",
        &[
            ("N m", 1.0),
            ("N mm", 1e-3),
            ("N cm", 1e-2),
            ("mN m", 1e-3),
            ("kN m", 1e3),
            ("MN m", 1e6),
            ("lbf in", POUND * INCH),
            ("lbf ft", POUND * 12.0 * INCH),
        ],
    ),
    (
        Dimension::Energy,
        "energy",
        &[("J", 1.0), ("mJ", 1e-3), ("kJ", 1e3), ("MJ", 1e6), ("Wh", 3600.0), ("kWh", 3.6e6)],
    ),
    (
        Dimension::Power,
        "power",
        &[("W", 1.0), ("mW", 1e-3), ("kW", 1e3), ("MW", 1e6), ("hp", 550.0 * 12.0 * INCH * POUND)],
    ),
    (Dimension::Strain, "strain", &[("", 1.0), ("1", 1.0), ("%", 1e-2), ("mm/m", 1e-3), ("um/m", 1e-6)]),
];

impl Dimension {
    /// Name of the dimension in messages, such as `angular velocity`.
    pub fn word(self) -> &'static str {
        self.entry().1
    }

    /// The SI unit.
    pub fn si(self) -> Unit {
        Unit { name: self.entry().2[0].0.to_string(), per_si: 1.0 }
    }

    /// All dimensions.
    pub fn all() -> impl Iterator<Item = Dimension> {
        DIMENSIONS.iter().map(|(dimension, ..)| *dimension)
    }

    /// Names of its units, the SI unit first.
    pub fn units(self) -> impl Iterator<Item = &'static str> + Clone {
        self.entry().2.iter().map(|(name, _)| *name).filter(|name| !name.is_empty())
    }

    /// The unit of this name; `N*m`, `Nm` and `N·m` are `N m`.
    ///
    /// # Errors
    /// A name that is not known, or is that of a unit of something else.
    pub fn unit(self, name: &str) -> Result<Unit> {
        let (_, word, sizes) = self.entry();
        if let Some((name, size)) = sizes.iter().find(|(known, _)| plain(known) == plain(name)) {
            return Ok(Unit { name: name.to_string(), per_si: 1.0 / size });
        }
        let message = match dimension_of(name) {
            Some(other) => format!("`{name}` is a unit of {}, not of {word}", other.word()),
            None => format!("there is no unit `{name}` of {word}"),
        };
        let names = self.units();
        let meant = nearest(name, names.clone()).map_or(String::new(), |near| format!("did you mean `{near}`? "));
        Err(Error::input(message)
            .under("unit")
            .hint(format!("{meant}choose one of {}", names.collect::<Vec<_>>().join(", "))))
    }

    fn entry(self) -> &'static (Dimension, &'static str, UnitSizes) {
        // The table is in the order of the enumeration, which a test compares.
        &DIMENSIONS[self as usize]
    }
}

/// Physical dimension that the unit of this name belongs to.
pub fn dimension_of(unit: &str) -> Option<Dimension> {
    let has = |sizes: UnitSizes| sizes.iter().any(|(known, _)| !known.is_empty() && plain(known) == plain(unit));
    DIMENSIONS.iter().find(|(_, _, sizes)| has(sizes)).map(|(dimension, ..)| *dimension)
}

/// Ways to write the name of a unit, the name itself first.
pub fn spellings(name: &str) -> Vec<String> {
    let mut all = vec![name.to_string()];
    let ways: [(&str, &[&str]); 3] = [(" ", &["", "*", "·", "⋅", "."]), ("deg", &["°"]), ("um", &["µm", "μm"])];
    for (part, others) in ways.into_iter().filter(|(part, _)| name.contains(part)) {
        all.extend(others.iter().map(|other| name.replace(part, other)));
    }
    all
}

/// The name in ASCII (`deg`, `u`) and without signs of products (space, `*`, dots).
fn plain(name: &str) -> String {
    let name = name.replace('°', "deg").replace(['µ', 'μ'], "u");
    name.replace([' ', '*', '·', '⋅', '.', '\u{a0}'], "")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_dimension_has_its_own_entry_and_begins_with_the_si() {
        for (i, (dimension, word, sizes)) in DIMENSIONS.iter().enumerate() {
            assert_eq!((*dimension as usize, dimension.word(), dimension.si().per_si), (i, *word, 1.0));
            assert_eq!(sizes[0].1, 1.0);
            let named = sizes.iter().filter(|(name, _)| !name.is_empty());
            let spelled = named.flat_map(|(name, _)| spellings(name));
            spelled.for_each(|name| assert_eq!(dimension_of(&name), Some(*dimension), "{name}"));
        }
    }

    #[test]
    fn units_are_read_as_people_write_them() {
        let table = [
            (Dimension::Angle, "°", "deg", 180.0 / PI),
            (Dimension::AngularVelocity, "rpm", "rpm", 60.0 / TAU),
            (Dimension::Torque, "N·m", "N m", 1.0),
            (Dimension::Torque, "kNm", "kN m", 1e-3),
            (Dimension::Length, "µm", "um", 1e6),
            (Dimension::Velocity, "km/h", "km/h", 3.6),
            (Dimension::Strain, "%", "%", 100.0),
        ];
        for (dimension, written, name, per_si) in table {
            let unit = dimension.unit(written).unwrap();
            assert!(unit.name == name && (unit.per_si / per_si - 1.0).abs() < 1e-15, "{written}: {unit:?}");
        }
    }

    #[test]
    fn units_of_something_else_are_refused() {
        let message = |dimension: Dimension, name: &str| dimension.unit(name).unwrap_err().to_string();
        assert_eq!(
            message(Dimension::Angle, "kN"),
            "at unit: `kN` is a unit of force, not of angle\n  help: choose one of rad, mrad, deg, arcmin, rev"
        );
        assert!(
            message(Dimension::Angle, "degs")
                .contains("there is no unit `degs` of angle\n  help: did you mean `deg`? ")
        );
    }
}
