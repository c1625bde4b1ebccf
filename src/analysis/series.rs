//! One column of a record.

use super::Record;
use crate::error::{Error, Result};
use crate::trajectory::Trajectory;
use std::ops::Deref;

/// The values of one column at the rows of a record, as a slice and by what is asked of them most.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Times of the rows, s.
    pub times: Vec<f64>,
    values: Vec<f64>,
}

impl Deref for Series {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.values
    }
}

impl Series {
    /// The value at the last row; not a number without rows.
    pub fn last(&self) -> f64 {
        self.values.last().copied().unwrap_or(f64::NAN)
    }

    /// The value at the first row; not a number without rows.
    pub fn first(&self) -> f64 {
        self.values.first().copied().unwrap_or(f64::NAN)
    }

    /// The least value.
    pub fn min(&self) -> f64 {
        self.values.iter().copied().fold(f64::NAN, f64::min)
    }

    /// The greatest value.
    pub fn max(&self) -> f64 {
        self.values.iter().copied().fold(f64::NAN, f64::max)
    }

    /// The greatest size of a value.
    pub fn max_abs(&self) -> f64 {
        self.values.iter().map(|value| value.abs()).fold(f64::NAN, f64::max)
    }
}

impl Record {
    /// A column by its heading: an output, a coordinate, a velocity or a multiplier.
    ///
    /// # Errors
    /// A name that is none of them.
    pub fn output(&self, name: &str) -> Result<Series> {
        let trajectory: &Trajectory = &self.trajectory;
        let values = trajectory
            .column(name)
            .ok_or_else(|| Error::unknown("column", name, trajectory.headings().into_iter().skip(1)))?;
        Ok(Series { times: trajectory.times().collect(), values })
    }

    /// The largest error of the energy balance, as a part of the energy converted; not a number where the system
    /// defines no potential, or where no energy is converted.
    pub fn energy_error(&self) -> f64 {
        self.energy.and_then(|energy| energy.relative_max_error).unwrap_or(f64::NAN)
    }
}
