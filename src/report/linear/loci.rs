//! `loci.csv`, `loci.json`, and text on eigenvalues at many states.

use super::against::{LociAgainst, with_others};
use super::crossings::{sensitivity_lines, threshold_lines, with_thresholds};
use super::mode_figures::{frequency_figure, motion_figure};
use super::plane::loci_figure;
use super::turning::{speeds, unit_of_speed};
use crate::error::{Error, Failure, Result, significant};
use crate::linearize::{Branch, Complex, Gap, Kind, Loci, LociVariable, Reached, damping, frequency};
use crate::math::bounds;
use crate::plot::AxisSpec;
use crate::report::figures::label;
use crate::report::{Answer, Folder, TextTable, cell, table};
use crate::tolerances;
use crate::tolerances::SAME;
use serde::Serialize;
use serde_json::{Value, json};

pub struct LociAnswer<'a> {
    scene: &'a str,
    loci: &'a Loci,
    /// Unit of time; of a parameter the one that is given, or that of the speed of a steady rotation; else empty.
    unit: &'a str,
    modes: Vec<ModeSummary>,
    /// Another scene by its name.
    other: Option<(&'a str, &'a Loci)>,
    against: Option<LociAgainst>,
}

/// Ranges of a mode, and those of time or parameter with a real part above zero.
#[derive(Serialize)]
struct ModeSummary {
    mode: String,
    kind: Kind,
    frequency_hz: Extent,
    damping_ratio: Extent,
    growing: Vec<Stretch>,
}

#[derive(Clone, Copy, Serialize)]
struct Extent {
    min: f64,
    max: f64,
}

#[derive(Serialize)]
struct Stretch {
    from: f64,
    to: f64,
}

#[derive(Serialize)]
struct BranchFile {
    mode: String,
    kind: Kind,
    /// True if the conjugates are eigenvalues too; their branch is dropped.
    pair: bool,
    points: Vec<PointFile>,
}

#[derive(Serialize)]
struct PointFile {
    at: f64,
    re: f64,
    im: f64,
    frequency_hz: f64,
    damping_ratio: f64,
    /// Derivative of `re` and `im`, where it is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    d_re: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    d_im: Option<f64>,
}

/// Growth by less than this part over the whole motion is not reported.
const LITTLE: f64 = 0.01;

impl<'a> LociAnswer<'a> {
    /// The answer on loci, against those of another scene; `unit` is that of the parameter, if it is known.
    pub fn new(scene: &'a str, loci: &'a Loci, unit: Option<&'a str>, other: Option<(&'a str, &'a Loci)>) -> Self {
        let [from, to] = ends(loci);
        let (unit, least) = match &loci.along {
            LociVariable::Time => (Some("s"), LITTLE / (to - from)),
            LociVariable::Parameter(_) => (unit.or_else(|| unit_of_speed(loci)), tolerances::EIGENVALUES_AGREE),
        };
        let modes = loci.named().map(|(mode, branch)| mode_summary(mode, branch, least)).collect();
        let against = other.map(|(name, other)| LociAgainst::new(loci, name, other));
        LociAnswer { scene, loci, unit: unit.unwrap_or_default(), modes, other, against }
    }

    /// Returns what is printed as JSON: all but states and branches.
    pub fn summary(&self) -> Value {
        let Loci { method, chart, reached, gaps, places, .. } = self.loci;
        let [from, to] = ends(self.loci);
        let failure = |gap: &Gap| {
            let (reason, hint) = told(&gap.error);
            json!({ "at": gap.at, "reason": reason, "hint": hint })
        };
        let mut summary = json!({
            "scene": self.scene,
            "method": method,
            "chart": chart,
            "along": {
                "name": self.name_along(),
                "unit": self.unit,
                "from": from,
                "to": to,
                "count": places.len(),
                "log": self.is_log(),
            },
            "reached": reached.len(),
            "equilibria": self.equilibria(),
            "failures": gaps.iter().map(failure).collect::<Vec<Value>>(),
            "modes": self.modes,
        });
        if !self.loci.thresholds.is_empty() {
            summary["thresholds"] = json!(self.loci.thresholds);
        }
        if let Some(sensitivity) = &self.loci.sensitivity {
            summary["sensitivity"] = json!(sensitivity);
        }
        if let Some(against) = &self.against {
            summary["against"] = json!(against);
        }
        summary
    }

    fn name_along(&self) -> &str {
        match &self.loci.along {
            LociVariable::Time => "t",
            LociVariable::Parameter(range) => &range.parameter,
        }
    }

    fn is_log(&self) -> bool {
        matches!(&self.loci.along, LociVariable::Parameter(range) if range.is_log)
    }

    fn equilibria(&self) -> usize {
        self.loci.reached.iter().filter(|state| state.equilibrium).count()
    }

    /// Draws the modes; over a parameter also the complex plane, where a motion would leave loose dots.
    fn figures(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        let branches = &self.loci.branches;
        let modes = format!("{stem}_modes");
        let LociVariable::Parameter(range) = &self.loci.along else {
            let title = format!("{}: eigenvalues along the motion", self.scene);
            let other = self.other.map(|(name, other)| (name, other.branches.as_slice()));
            return folder.figure(&modes, motion_figure(&title, branches, other));
        };
        let is_turning = self.loci.reached.iter().any(|state| state.turning.is_some());
        let axes = if is_turning { ", in axes that turn along" } else { "" };
        let title = format!("{}: eigenvalues over {}{axes}", self.scene, range.parameter);
        let speeds = speeds(self.loci, self.unit);
        let axis = AxisSpec::from(label(&range.parameter, self.unit));
        let axis = if range.is_log { axis.log() } else { axis };
        let mut plane = loci_figure(&title, axis.clone(), branches, &speeds);
        if let Some((name, other)) = self.other {
            plane = with_others(plane, name, other);
        }
        folder.figure(stem, plane)?;
        let figure = frequency_figure(&title, axis, branches, &speeds);
        folder.figure(&modes, with_thresholds(figure, &self.loci.thresholds))
    }
}

fn ends(loci: &Loci) -> [f64; 2] {
    [loci.places.first().copied().unwrap_or(0.0), loci.places.last().copied().unwrap_or(0.0)]
}

/// Returns time or parameter, then real and imaginary part, frequency and damping ratio of each mode; empty cells where
/// there are none.
fn loci_table(loci: &Loci, along: &str) -> Result<Vec<u8>> {
    let modes: Vec<(String, &Branch)> = loci.named().collect();
    let names = modes
        .iter()
        .flat_map(|(mode, _)| ["re", "im", "frequency_hz", "damping_ratio"].map(|column| format!("{mode}.{column}")));
    // The row in which a branch begins.
    let start = |branch: &Branch| {
        let first = branch.points.first().map_or(f64::NAN, |point| point.0);
        loci.places.iter().position(|place| *place == first).unwrap_or(usize::MAX)
    };
    let starts: Vec<usize> = modes.iter().map(|(_, branch)| start(branch)).collect();
    let rows = loci.places.iter().enumerate().map(|(row, place)| {
        let cells = modes.iter().zip(&starts).flat_map(|((_, branch), start)| {
            let point = row.checked_sub(*start).and_then(|i| branch.points.get(i));
            match point.filter(|point| point.1.re.is_finite()) {
                Some((_, value)) => [value.re, value.im, frequency(*value), damping(*value)].map(cell),
                None => Default::default(),
            }
        });
        [cell(*place)].into_iter().chain(cells).collect()
    });
    table([along.to_string()].into_iter().chain(names), rows)
}

fn finite(branch: &Branch) -> impl Iterator<Item = (f64, Complex<f64>)> + Clone {
    branch.points.iter().copied().filter(|(_, value)| is_finite(*value))
}

fn is_finite(value: Complex<f64>) -> bool {
    value.re.is_finite() && value.im.is_finite()
}

fn told(error: &Error) -> (&str, Option<&str>) {
    match error {
        Error::Input(input) => (&input.message, input.hint.as_deref()),
        Error::Run(Failure { reason, hint, .. }) => (reason, Some(hint)),
        Error::File { problem, .. } | Error::Unwritten { problem, .. } => (problem, None),
    }
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
    let point = |((at, value), slope): (&(f64, Complex<f64>), &Option<Complex<f64>>)| PointFile {
        at: *at,
        re: value.re,
        im: value.im,
        frequency_hz: frequency(*value),
        damping_ratio: damping(*value),
        d_re: slope.map(|slope| slope.re),
        d_im: slope.map(|slope| slope.im),
    };
    let pair = finite(branch).all(|(_, value)| value.im > 0.0);
    let points = branch.points.iter().zip(&branch.slopes).filter(|((_, value), _)| is_finite(*value));
    BranchFile { mode, kind: branch.kind, pair, points: points.map(point).collect() }
}

/// Largest number of lines of the table; the files have all modes.
const MOST_LINES: usize = 30;
/// Largest number of stretches listed for a mode.
const MOST_STRETCHES: usize = 4;

impl Answer for LociAnswer<'_> {
    fn json(&self) -> impl Serialize {
        /// The summary, the states that are equilibria, and the branches.
        #[derive(Serialize)]
        struct Whole<'a> {
            #[serde(flatten)]
            summary: Value,
            states: &'a [Reached],
            branches: Vec<BranchFile>,
        }
        let branches = self.loci.named().map(|(mode, branch)| branch_file(mode, branch)).collect();
        Whole { summary: self.summary(), states: &self.loci.reached, branches }
    }

    /// Returns method, chart and states, then the modes.
    fn text(&self) -> String {
        let Loci { method, chart, reached, places, .. } = self.loci;
        let along = self.name_along();
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        let [from, to] = ends(self.loci).map(|end| significant(end, 9));
        let mut text = format!(
            "{}: eigenvalues at {} of {} states, {along} from {from} to {to}{unit}, by {method}, chart {chart}\n  {}\n",
            self.scene,
            reached.len(),
            places.len(),
            self.meaning()
        );
        // Neighbouring states without eigenvalues for the same reason are told together.
        for gaps in self.loci.gaps.chunk_by(|a, b| told(&a.error).0 == told(&b.error).0) {
            let [first, last] = [&gaps[0], &gaps[gaps.len() - 1]];
            let place = if gaps.len() == 1 { significant(first.at, 9) } else { span(first.at, last.at) };
            text += &format!("  NO EIGENVALUES at {along} = {place}{unit}: {}\n", told(&first.error).0);
        }
        let against = self.against.as_ref().map_or(String::new(), |against| format!("\n{}", against.text(along)));
        text + "\n"
            + &self.table()
            + &threshold_lines(along, &self.loci.thresholds)
            + &sensitivity_lines(along, self.loci.sensitivity.as_ref())
            + &against
    }

    fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        folder.table(stem, &loci_table(self.loci, self.name_along())?)?;
        self.figures(folder, stem)
    }
}

impl LociAnswer<'_> {
    fn meaning(&self) -> &'static str {
        match self.equilibria() {
            all if all == self.loci.reached.len() => "all are equilibria: one with a growing mode is unstable",
            0 => {
                "none is an equilibrium: a growing mode tells where neighbours leave the motion at that instant, and proves \
                 nothing about its stability"
            }
            _ => "some are equilibria: only there does a growing mode mean that the state is unstable",
        }
    }

    fn table(&self) -> String {
        let growing = label(&format!("growing at {}", self.name_along()), self.unit);
        let mut table =
            TextTable::new(&["mode", "frequency (Hz)", "damping ratio", &growing]).words(1).words(2).words(3);
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
