//! The saddle-point system without some rows of G.

use super::super::redundant_rows::Least;
use super::super::system::System;
use super::{Pattern, SaddlePoint, Singular};
use std::sync::Arc;

/// A separate solver over the rows that are kept, so that dropped rows cost nothing.
pub(super) struct Kept {
    pub inner: SaddlePoint,
    /// Rows that are kept. `dropped`: rows that are never factored; `left_out`: all rows without a multiplier at the
    /// last factorization.
    rows: Vec<usize>,
    dropped: Vec<usize>,
    left_out: Vec<usize>,
    /// Places of their entries in the whole G, and their values.
    entries: Vec<usize>,
    g: Vec<f64>,
    bottom: Vec<f64>,
    least: Least,
    inconsistency: f64,
}

impl Kept {
    pub fn new(system: &System, dropped: &[usize]) -> Self {
        let mut is_kept = vec![true; system.g.rows];
        dropped.iter().filter(|row| **row < system.g.rows).for_each(|row| is_kept[*row] = false);
        let rows: Vec<usize> = (0..system.g.rows).filter(|row| is_kept[*row]).collect();
        let mut number = vec![0; system.g.rows];
        rows.iter().enumerate().for_each(|(k, row)| number[*row] = k);
        let entries: Vec<usize> = (0..system.g.entries.len()).filter(|k| is_kept[system.g.entries[*k].0]).collect();
        let places = entries.iter().map(|k| system.g.entries[*k]).map(|(row, column)| (number[row], column));
        let g = Pattern { rows: rows.len(), cols: system.g.cols, entries: places.collect() };
        let dropped: Vec<usize> = (0..system.g.rows).filter(|row| !is_kept[*row]).collect();
        Kept {
            inner: SaddlePoint::sharing(&system.mass, &Arc::new(g), &system.analysis.without(&dropped)),
            dropped,
            left_out: Vec::with_capacity(system.g.rows),
            g: vec![0.0; entries.len()],
            bottom: vec![0.0; rows.len()],
            least: Least::new(&system.g),
            inconsistency: 0.0,
            entries,
            rows,
        }
    }

    /// See [`SaddlePoint::condition_number`]; of the rows that are kept, at the last values.
    pub fn condition_number(&mut self, mass: &[f64]) -> f64 {
        self.inner.condition_number(mass, &self.g)
    }

    pub fn is_without(&self, rows: &[usize]) -> bool {
        self.dropped == rows
    }

    /// Factors with these values of the whole system, truncated below `part` of the reference value where it is given.
    pub fn factor(&mut self, mass: &[f64], g: &[f64], part: Option<f64>) -> Result<(), Singular> {
        self.left_out.clear();
        self.least.clear();
        self.g.iter_mut().zip(&self.entries).for_each(|(value, k)| *value = g[*k]);
        match part {
            Some(part) => self.inner.factor_truncated(mass, &self.g, part)?,
            None => self.inner.factor(mass, &self.g)?,
        }
        self.left_out.extend_from_slice(&self.dropped);
        self.left_out.extend(self.inner.left_out().iter().map(|k| self.rows[*k]));
        Ok(())
    }

    /// All rows of the whole G that are dropped.
    pub fn left_out(&self) -> &[usize] {
        &self.left_out
    }

    /// The norm of the part of the last right side that no motion can meet.
    pub fn inconsistency(&self) -> f64 {
        self.inconsistency.max(self.inner.inconsistency())
    }

    /// Solves in place. If `counts_all`, right sides of dropped rows enter by least squares; if `is_least`, multipliers
    /// are those of least norm.
    pub fn solve(
        &mut self,
        system: &System,
        top: &mut [f64],
        bottom: &mut [f64],
        counts_all: bool,
        is_least: bool,
    ) -> Result<(), Singular> {
        self.inconsistency = if counts_all { self.project(system, bottom)? } else { 0.0 };
        solve(&mut self.inner, &self.rows, top, bottom, &mut self.bottom, is_least)?;
        if is_least {
            self.project(system, bottom)?;
        }
        Ok(())
    }

    /// v := P v; returns the norm of the removed part. If further rows are dependent, the part in their
    /// null space stays, orthogonal to the removed part.
    fn project(&mut self, system: &System, v: &mut [f64]) -> Result<f64, Singular> {
        let Kept { inner, rows, dropped, bottom: short, least, .. } = self;
        let mut result = Ok(());
        let mut inverse = |top: &mut [f64], bottom: &mut [f64]| {
            let solved = solve(inner, rows, top, bottom, short, true);
            result = result.and(solved);
        };
        let norm = least.project(system, dropped, &mut inverse, v);
        result.map(|()| norm)
    }
}

/// Solves with the kept rows; multipliers of dropped rows are zero. `short` is scratch for the others.
fn solve(
    inner: &mut SaddlePoint,
    rows: &[usize],
    top: &mut [f64],
    bottom: &mut [f64],
    short: &mut [f64],
    is_least: bool,
) -> Result<(), Singular> {
    short.iter_mut().zip(rows).for_each(|(value, row)| *value = bottom[*row]);
    if is_least {
        inner.solve(top, short)?
    } else {
        inner.solve_motion(top, short)?
    }
    bottom.fill(0.0);
    short.iter().zip(rows).for_each(|(value, row)| bottom[*row] = *value);
    Ok(())
}
