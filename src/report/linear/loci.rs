//! `loci.csv`, `loci.json`, and text on eigenvalues at many states.

use super::against::{LociAgainst, Value};
use super::crossings::{SensitivityFile, sensitivity_lines, threshold_lines};
use super::turning::unit_of_speed;
use crate::error::{Error, Failure, Result, significant};
use crate::linearize::{Branch, Complex, Kind, Loci, LociVariable, Reached, Threshold, damping, frequency};
use crate::math::bounds;
use crate::plot::AxisSpec;
use crate::report::figures::label;
use crate::report::{Table, cell, table};
use crate::tolerances::linearize as tolerances;
use crate::tolerances::report::SAME;
use serde::Serialize;

/// Summary of eigenvalues at many states.
#[derive(Clone, Debug, Serialize)]
pub struct LociSummary {
    /// Name of the scene.
    pub scene: String,
    /// Method with its options.
    pub method: String,
    /// Chart of the coordinates.
    pub chart: String,
    /// Time or parameter.
    pub along: AlongFile,
    /// Number of states with eigenvalues.
    pub reached: usize,
    /// Number of these that are equilibria.
    pub equilibria: usize,
    /// States without eigenvalues.
    pub failures: Vec<FailureFile>,
    /// Ranges of the modes.
    pub modes: Vec<ModeSummary>,
    /// Values of the parameter at which eigenvalues meet or cross the imaginary axis.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub thresholds: Vec<Threshold>,
    /// Derivatives of the eigenvalues with respect to the parameter.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sensitivity: Option<SensitivityFile>,
    /// The modes against those of another scene, if requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub against: Option<LociAgainst>,
}

/// Variable that the eigenvalues are functions of: time in s, or a parameter of the scene.
#[derive(Clone, Debug, Serialize)]
pub struct AlongFile {
    pub name: String,
    /// Unit of time; of a parameter the one that is given, or that of the speed of a steady rotation; else empty.
    pub unit: String,
    pub from: f64,
    pub to: f64,
    pub count: usize,
    pub log: bool,
}

#[derive(Clone, Debug, Serialize)]
pub struct FailureFile {
    pub at: f64,
    pub reason: String,
    pub hint: Option<String>,
}

/// Range of a mode.
#[derive(Clone, Debug, Serialize)]
pub struct ModeSummary {
    pub mode: String,
    pub kind: Kind,
    pub frequency_hz: Extent,
    pub damping_ratio: Extent,
    /// Ranges of time or parameter with a real part above zero.
    pub growing: Vec<Stretch>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Extent {
    pub min: f64,
    pub max: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Stretch {
    pub from: f64,
    pub to: f64,
}

/// `loci.json`: the summary, the states that are equilibria, and the branches.
#[derive(Clone, Debug, Serialize)]
pub struct LociFile {
    /// Summary.
    #[serde(flatten)]
    pub summary: LociSummary,
    /// Times or values with a model.
    pub states: Vec<Reached>,
    /// Branches, of conjugate pairs one.
    pub branches: Vec<BranchFile>,
}

#[derive(Clone, Debug, Serialize)]
pub struct BranchFile {
    pub mode: String,
    pub kind: Kind,
    /// True if the conjugates are eigenvalues too; their branch is dropped.
    pub pair: bool,
    pub points: Vec<PointFile>,
}

#[derive(Clone, Copy, Debug, Serialize)]
pub struct PointFile {
    pub at: f64,
    #[serde(flatten)]
    pub value: Value,
}

/// Growth by less than this part over the whole motion is not reported.
const LITTLE: f64 = 0.01;

impl LociSummary {
    /// The summary of loci; `unit` is that of the parameter, if it is known.
    pub fn new(scene: &str, loci: &Loci, unit: Option<&str>) -> Self {
        let ends = [loci.places.first(), loci.places.last()].map(|place| place.copied().unwrap_or(0.0));
        let (name, unit, log, least) = match &loci.along {
            LociVariable::Time => ("t".to_string(), Some("s"), false, LITTLE / (ends[1] - ends[0])),
            LociVariable::Parameter(range) => {
                let unit = unit.or_else(|| unit_of_speed(loci));
                (range.parameter.clone(), unit, range.is_log, tolerances::EIGENVALUES_AGREE)
            }
        };
        let unit = unit.unwrap_or_default().to_string();
        LociSummary {
            scene: scene.to_string(),
            method: loci.method.clone(),
            chart: loci.chart.clone(),
            along: AlongFile { name, unit, from: ends[0], to: ends[1], count: loci.places.len(), log },
            reached: loci.reached.len(),
            equilibria: loci.reached.iter().filter(|state| state.equilibrium).count(),
            failures: loci.gaps.iter().map(|gap| failure(gap.at, &gap.error)).collect(),
            modes: loci.named().map(|(mode, branch)| mode_summary(mode, branch, least)).collect(),
            thresholds: loci.thresholds.clone(),
            sensitivity: loci.sensitivity.as_ref().map(SensitivityFile::new),
            against: None,
        }
    }

    /// Returns the axis of the parameter, with its unit if that is known.
    pub fn axis(&self) -> AxisSpec {
        let axis = AxisSpec::from(label(&self.along.name, &self.along.unit));
        if self.along.log { axis.log() } else { axis }
    }
}

impl LociFile {
    /// The file of loci.
    pub fn new(summary: LociSummary, loci: &Loci) -> Self {
        let branches = loci.named().map(|(mode, branch)| branch_file(mode, branch)).collect();
        LociFile { summary, states: loci.reached.clone(), branches }
    }
}

/// Returns time or parameter, then real and imaginary part, frequency and damping ratio of each mode; empty cells where
/// there are none.
///
/// # Errors
/// A table that cannot be written.
pub fn loci_table(loci: &Loci) -> Result<Vec<u8>> {
    let along = match &loci.along {
        LociVariable::Time => "t".to_string(),
        LociVariable::Parameter(range) => range.parameter.clone(),
    };
    let modes: Vec<(String, &Branch)> = loci.named().collect();
    let names = modes
        .iter()
        .flat_map(|(mode, _)| ["re", "im", "frequency_hz", "damping_ratio"].map(|column| format!("{mode}.{column}")));
    let starts: Vec<usize> = modes.iter().map(|(_, branch)| start(loci, branch)).collect();
    let rows = loci.places.iter().enumerate().map(|(row, place)| {
        let cells = modes.iter().zip(&starts).flat_map(|((_, branch), start)| {
            let point = row.checked_sub(*start).and_then(|i| branch.points.get(i));
            cells(point.map(|point| point.1).filter(|value| value.re.is_finite()))
        });
        [cell(*place)].into_iter().chain(cells).collect()
    });
    table([along].into_iter().chain(names), rows)
}

/// Returns the row in which a branch begins.
fn start(loci: &Loci, branch: &Branch) -> usize {
    let first = branch.points.first().map_or(f64::NAN, |point| point.0);
    loci.places.iter().position(|place| *place == first).unwrap_or(usize::MAX)
}

fn cells(value: Option<Complex<f64>>) -> [String; 4] {
    match value {
        Some(value) => [value.re, value.im, frequency(value), damping(value)].map(cell),
        None => Default::default(),
    }
}

/// Returns the finite points.
fn finite(branch: &Branch) -> impl Iterator<Item = (f64, Complex<f64>)> + Clone {
    branch.points.iter().copied().filter(|(_, value)| value.re.is_finite() && value.im.is_finite())
}

fn failure(at: f64, error: &Error) -> FailureFile {
    let (reason, hint) = match error {
        Error::Input(input) => (input.message.clone(), input.hint.clone()),
        Error::Run(Failure { reason, hint, .. }) => (reason.clone(), Some(hint.clone())),
        Error::File { problem, .. } | Error::Unwritten { problem, .. } => (problem.clone(), None),
    };
    FailureFile { at, reason, hint }
}

fn mode_summary(mode: String, branch: &Branch, least: f64) -> ModeSummary {
    let extent = |of: fn(Complex<f64>) -> f64| {
        let (min, max) = bounds(finite(branch).map(|(_, value)| of(value)));
        Extent { min, max }
    };
    let mut growing: Vec<Stretch> = Vec::new();
    let mut goes_on = false;
    for (at, value) in &branch.points {
        let grows = value.re > least && value.re > tolerances::EIGENVALUES_AGREE * value.norm();
        match growing.last_mut().filter(|_| grows && goes_on) {
            Some(last) => last.to = *at,
            None if grows => growing.push(Stretch { from: *at, to: *at }),
            None => {}
        }
        goes_on = grows;
    }
    ModeSummary { mode, kind: branch.kind, frequency_hz: extent(frequency), damping_ratio: extent(damping), growing }
}

fn branch_file(mode: String, branch: &Branch) -> BranchFile {
    let point = |(at, value): (f64, Complex<f64>)| PointFile { at, value: value.into() };
    let pair = finite(branch).all(|(_, value)| value.im > 0.0);
    BranchFile { mode, kind: branch.kind, pair, points: finite(branch).map(point).collect() }
}

/// Largest number of lines of the table; the files have all modes.
const MOST_LINES: usize = 30;
/// Largest number of stretches listed for a mode.
const MOST_STRETCHES: usize = 4;

impl LociSummary {
    /// Returns method, chart and states, then the modes.
    pub fn text(&self) -> String {
        let along = &self.along;
        let unit = if along.unit.is_empty() { String::new() } else { format!(" {}", along.unit) };
        let ends = [along.from, along.to].map(|end| significant(end, 9));
        let mut text = format!(
            "{}: eigenvalues at {} of {} states, {} from {} to {}{unit}, by {}, chart {}\n  {}\n",
            self.scene,
            self.reached,
            along.count,
            along.name,
            ends[0],
            ends[1],
            self.method,
            self.chart,
            self.meaning()
        );
        for (first, last, count) in self.gaps() {
            let place = if count == 1 { significant(first.at, 9) } else { span(first.at, last.at) };
            text += &format!("  NO EIGENVALUES at {} = {place}{unit}: {}\n", along.name, first.reason);
        }
        let against =
            self.against.as_ref().map_or(String::new(), |against| "\n".to_string() + &against.text(&along.name));
        text + "\n"
            + &self.table()
            + &threshold_lines(&along.name, &self.thresholds)
            + &sensitivity_lines(&along.name, self.sensitivity.as_ref())
            + &against
    }

    /// Returns the meaning of the real parts.
    fn meaning(&self) -> &'static str {
        match self.equilibria {
            all if all == self.reached => "all are equilibria: one with a growing mode is unstable",
            0 => {
                "none is an equilibrium: a growing mode tells where neighbours leave the motion at that instant, and proves \
                 nothing about its stability"
            }
            _ => "some are equilibria: only there does a growing mode mean that the state is unstable",
        }
    }

    /// Groups neighbouring states without eigenvalues for the same reason: first, last, count.
    fn gaps(&self) -> Vec<(&FailureFile, &FailureFile, usize)> {
        let mut found: Vec<(&FailureFile, &FailureFile, usize)> = Vec::new();
        for failure in &self.failures {
            match found.last_mut() {
                Some((first, last, count)) if first.reason == failure.reason => (*last, *count) = (failure, *count + 1),
                _ => found.push((failure, failure, 1)),
            }
        }
        found
    }

    fn table(&self) -> String {
        let growing = label(&format!("growing at {}", self.along.name), &self.along.unit);
        let mut table = Table::new(&["mode", "frequency (Hz)", "damping ratio", &growing]).words(1).words(2).words(3);
        let of = |kind: Kind| self.modes.iter().filter(move |mode| mode.kind == kind);
        of(Kind::Physical).take(MOST_LINES).for_each(|mode| table.row(mode_cells(mode)));
        let physical = of(Kind::Physical).count();
        let uncertain = of(Kind::Uncertain).count();
        let spurious = of(Kind::Spurious).count();
        let mut text = if physical > 0 { table.to_string() } else { "  no physical eigenvalues\n".to_string() };
        if physical > MOST_LINES {
            text += &format!("  {} more in the files\n", physical - MOST_LINES);
        }
        if uncertain > 0 {
            text += &format!("  {uncertain} uncertain in the files: neither clearly physical nor spurious\n");
        }
        if spurious > 0 {
            text += &format!("  {spurious} spurious in the files\n");
        }
        text
    }
}

fn mode_cells(mode: &ModeSummary) -> [String; 4] {
    let clean = |x: f64| if x.abs() < SAME { 0.0 } else { x };
    let Extent { min, max } = mode.damping_ratio;
    let growing: Vec<String> = mode.growing.iter().take(MOST_STRETCHES).map(stretch).collect();
    let more = if mode.growing.len() > MOST_STRETCHES { ", ..." } else { "" };
    [
        mode.mode.clone(),
        extent(mode.frequency_hz, 5),
        extent(Extent { min: clean(min), max: clean(max) }, 4),
        if growing.is_empty() { "-".to_string() } else { growing.join(", ") + more },
    ]
}

fn extent(extent: Extent, digits: usize) -> String {
    let min = significant(extent.min, digits);
    let max = significant(extent.max, digits);
    if min == max { min } else { format!("{min} to {max}") }
}

fn stretch(stretch: &Stretch) -> String {
    if stretch.from == stretch.to { significant(stretch.from, 6) } else { span(stretch.from, stretch.to) }
}

fn span(from: f64, to: f64) -> String {
    format!("{} to {}", significant(from, 6), significant(to, 6))
}
