//! The chart at the states of a motion, one after the other.

use super::carried::nearest;
use crate::error::{Error, Result, clock};
use crate::linearize::coordinates::least_moved;
use crate::linearize::flow::Bundle;
use crate::linearize::{Chart, Coordinates, LinearModel, Matrix, State, Variation};
use crate::math::largest;
use crate::tolerances;

/// A chart that is continuous along a motion. The basis of `intrinsic` is transported parallel, that of
/// `mass_orthogonal` moves as little as it can. Named coordinates z = B dq have a constant B and R = Z (B Z)^-1.
#[derive(Clone)]
pub(super) struct Course {
    pub chart: Chart,
    pub start: Coordinates,
    /// Time and R of the last state, of named coordinates.
    last: Option<(f64, Matrix)>,
}

impl Course {
    /// The chart at the first state.
    ///
    /// # Errors
    /// A chart that does not exist there, or along no motion.
    pub fn new(variation: &mut Variation, chart: &Chart) -> Result<Self> {
        if *chart == Chart::Frozen {
            let error =
                Error::input("the frozen chart neglects that the basis moves, so it has no model along a motion");
            return Err(error.under("--chart").hint("take intrinsic, mass_orthogonal, or independent coordinates"));
        }
        let start = chart.at(variation)?;
        let start = if *chart == Chart::MassOrthogonal { least_moved(variation, start.r)? } else { start };
        Ok(Course { start, chart: chart.clone(), last: None })
    }

    /// The same chart, begun anew at another of its states.
    pub fn from(&self, start: &Coordinates) -> Self {
        Course { chart: self.chart.clone(), start: start.clone(), last: None }
    }

    /// Returns a bundle with the directions to transport: none for named coordinates.
    pub fn bundle(&self, start: &State) -> Bundle {
        let is_named = matches!(self.chart, Chart::Independent(_));
        let count = if is_named { 0 } else { self.start.r.ncols() };
        let basis = self.start.r.columns(0, count).clone_owned();
        let is_parallel = self.chart == Chart::Intrinsic;
        Bundle { columns: self.start.changes(), basis, is_parallel, ..Bundle::of(start) }
    }

    /// Returns the chart at the next state, with the transported directions there.
    ///
    /// # Errors
    /// Coordinates that are none any more, here or since the last state.
    pub fn at(&mut self, variation: &mut Variation, basis: &Matrix) -> Result<Coordinates> {
        let chart = match &self.chart {
            Chart::Intrinsic => return nearest(variation, basis),
            Chart::MassOrthogonal | Chart::Frozen => return least_moved(variation, basis.clone()),
            Chart::Independent(_) => self.chart.at(variation)?,
        };
        let r = chart.r.columns(0, chart.freedom()).clone_owned();
        let t = variation.point.t;
        if let Some((before, last)) = &self.last
            && last.tr_mul(&variation.mass_times(&r)).determinant() <= 0.0
        {
            return Err(ceased(&self.start.name, *before, t));
        }
        self.last = Some((t, r));
        Ok(chart)
    }
}

impl Course {
    /// Returns B(start) R(end) of a transported basis where the last state is the first one again.
    pub fn closure(&self, models: &[LinearModel]) -> Option<Matrix> {
        let [first, .., last] = models else { return None };
        let gap = |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0f64, |largest, (a, b)| largest.max((a - b).abs()));
        let off = gap(&first.point.q, &last.point.q).max(gap(&first.point.v, &last.point.v));
        let scale = largest(&first.point.q).max(largest(&first.point.v)).max(1.0);
        let returns = !matches!(self.chart, Chart::Independent(_)) && off <= tolerances::PERIODIC * scale;
        let start = &first.frame.as_ref()?.coordinates;
        let end = &last.frame.as_ref()?.coordinates;
        let k = self.start.freedom();
        let turned = start.b.rows(0, k) * end.r.columns(0, k);
        returns.then_some(turned)
    }
}

/// Error: between two states, R of a chart has passed infinity.
fn ceased(chart: &str, before: f64, t: f64) -> Error {
    let text =
        format!("between t = {} s and {} s {chart} cease to be coordinates of the motion", clock(before), clock(t));
    let hint = "end before, name other coordinates, or take --chart intrinsic where bodies have no floating frames";
    Error::input(text).under("--chart").hint(hint)
}
