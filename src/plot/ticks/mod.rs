//! Tick marks and labels of an axis.

pub(super) mod decimal;
mod linear;
mod log;

use super::axis::Axis;
use super::panel::Scale;
use super::text;

/// A mark on an axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    /// Position between 0 and 1 along the axis.
    pub at: f64,
    /// Label; empty for a minor mark.
    pub label: String,
}

/// The marks of an axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Ticks {
    pub major: Vec<Tick>,
    pub minor: Vec<f64>,
    /// Factor or offset of all labels, like "×10⁻⁶"; may be empty.
    pub factor: String,
}

/// Space for labels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room {
    pub length: f64,
    pub size: f64,
    /// True if labels are in a row along the axis (as on x), not one above another (as on y).
    pub along: bool,
}

impl Room {
    /// Returns the least distance of marks at which these labels do not touch.
    fn spacing<'a>(&self, labels: impl Iterator<Item = &'a str>) -> f64 {
        if !self.along {
            return 2.2 * self.size;
        }
        labels.map(|label| text::width(label, self.size)).fold(self.size, f64::max) + 0.9 * self.size
    }
}

impl Ticks {
    /// Chooses the marks of an axis.
    pub fn new(axis: &Axis, room: Room) -> Self {
        match axis.scale {
            Scale::Linear => linear::ticks(axis.low, axis.high, room, axis.is_angle),
            Scale::Log => log::ticks(axis.low, axis.high, room),
        }
    }

    /// Sets texts at 0, 1, 2 ..., thinned where there is no space.
    pub fn named(axis: &Axis, names: &[String], room: Room) -> Self {
        let unit = axis.place(1.0).unwrap_or(1.0) - axis.place(0.0).unwrap_or(0.0);
        let least = if room.along { room.spacing(names.iter().map(String::as_str)) } else { 1.05 * room.size };
        let stride = (least / (unit * room.length).max(1e-9)).ceil().clamp(1.0, 1e6) as usize;
        let tick = |(k, name): (usize, &String)| Some(Tick { at: axis.place(k as f64)?, label: name.clone() });
        let major = names.iter().enumerate().step_by(stride).filter_map(tick);
        Ticks { major: major.filter(|tick| (0.0..=1.0).contains(&tick.at)).collect(), ..Ticks::default() }
    }

    /// Returns the width of the widest label.
    pub fn widest(&self, size: f64) -> f64 {
        self.major.iter().map(|tick| text::width(&tick.label, size)).fold(0.0, f64::max)
    }
}
