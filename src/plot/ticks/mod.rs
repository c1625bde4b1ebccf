//! Where an axis is marked, and with what.

pub(super) mod decimal;
mod linear;
mod log;

use super::axis::Axis;
use super::panel::Scale;
use super::text;

/// A mark on an axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    /// Between 0 and 1 along the axis.
    pub at: f64,
    /// Empty for a minor mark.
    pub label: String,
}

/// The marks of an axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Ticks {
    pub major: Vec<Tick>,
    pub minor: Vec<f64>,
    /// What all labels are multiplied with or added to, like "×10⁻⁶"; may be empty.
    pub factor: String,
}

/// How much room labels have.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room {
    pub length: f64,
    pub size: f64,
    /// Labels lie one after another along the axis (as on x), not one above another (as on y).
    pub along: bool,
}

impl Room {
    /// The least distance of marks at which these labels do not touch.
    fn spacing<'a>(&self, labels: impl Iterator<Item = &'a str>) -> f64 {
        if !self.along {
            return 2.2 * self.size;
        }
        labels.map(|label| text::width(label, self.size)).fold(self.size, f64::max) + 0.9 * self.size
    }
}

impl Ticks {
    /// The marks that suit an axis.
    pub fn new(axis: &Axis, room: Room) -> Self {
        match axis.scale {
            Scale::Linear => linear::ticks(axis.low, axis.high, room, axis.is_angle),
            Scale::Log => log::ticks(axis.low, axis.high, room),
        }
    }

    /// Words at 0, 1, 2 ..., thinned where they have no room.
    pub fn named(axis: &Axis, names: &[String], room: Room) -> Self {
        let unit = axis.place(1.0).unwrap_or(1.0) - axis.place(0.0).unwrap_or(0.0);
        let least = if room.along { room.spacing(names.iter().map(String::as_str)) } else { 1.05 * room.size };
        let stride = (least / (unit * room.length).max(1e-9)).ceil().clamp(1.0, 1e6) as usize;
        let tick = |(k, name): (usize, &String)| Some(Tick { at: axis.place(k as f64)?, label: name.clone() });
        let major = names.iter().enumerate().step_by(stride).filter_map(tick);
        Ticks { major: major.filter(|tick| (0.0..=1.0).contains(&tick.at)).collect(), ..Ticks::default() }
    }

    /// Width of the widest label.
    pub fn widest(&self, size: f64) -> f64 {
        self.major.iter().map(|tick| text::width(&tick.label, size)).fold(0.0, f64::max)
    }
}
