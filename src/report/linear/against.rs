//! Which modes of a model another one has lost or shifted.

use crate::error::{percent, significant};
use crate::linearize::{Against, Branch, Complex, Fate, Kind, Loci, both, branch_places, damping, frequency};
use crate::plot::{Figure, Series, Style};
use crate::report::Table;
use serde::Serialize;

/// The modes of a scene against those of another at a state.
#[derive(Clone, Debug, Serialize)]
pub struct AgainstFile {
    /// Time of the state, s.
    pub t: f64,
    /// Name of the other scene.
    pub against: String,
    /// Measure by which modes were matched.
    pub matched_by: &'static str,
    /// Modes of the scene, each conjugate pair once.
    pub modes: Vec<FateFile>,
    /// Modes that only the other scene has.
    pub added: Vec<Value>,
}

/// Frequency and damping of an eigenvalue.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Value {
    pub re: f64,
    pub im: f64,
    pub frequency_hz: f64,
    pub damping_ratio: f64,
}

/// A mode, with that in its place.
#[derive(Clone, Debug, Serialize)]
pub struct FateFile {
    #[serde(flatten)]
    pub value: Value,
    /// The mode in its place; null where it is lost.
    pub there: Option<Value>,
    /// |change| over |value|.
    pub shift: Option<f64>,
    /// MAC of the outputs of both; null where they do not tell.
    pub mac: Option<f64>,
    /// Part of it that outputs see, of what they see of the mode of which they see most.
    pub seen: f64,
}

impl From<Complex<f64>> for Value {
    fn from(value: Complex<f64>) -> Value {
        Value { re: value.re, im: value.im, frequency_hz: frequency(value), damping_ratio: damping(value) }
    }
}

impl AgainstFile {
    /// The comparison with the scene `name`.
    pub fn new(t: f64, name: &str, found: &Against) -> Self {
        let fate = |fate: &Fate| FateFile {
            value: fate.value.into(),
            there: fate.there.map(Value::from),
            shift: fate.shift(),
            mac: fate.mac,
            seen: fate.seen,
        };
        AgainstFile {
            t,
            against: name.to_string(),
            matched_by: if found.outputs > 1 { "eigenvalue and MAC of the outputs of both" } else { "eigenvalue" },
            modes: found.modes.iter().map(fate).collect(),
            added: found.added.iter().map(|value| (*value).into()).collect(),
        }
    }

    /// Returns a line for each mode.
    pub fn text(&self) -> String {
        let mut table =
            Table::new(&["frequency (Hz)", "damping ratio", "there (Hz)", "damping ratio", "shift", "MAC", "seen"]);
        let dash = || "-".to_string();
        for mode in self.modes.iter().take(MOST_LINES) {
            let [own, there] = [Some(mode.value), mode.there].map(|value| match value {
                Some(value) => [significant(value.frequency_hz, 5), significant(value.damping_ratio, 4)],
                None => ["lost".to_string(), dash()],
            });
            let rest = [
                mode.shift.map_or_else(dash, percent),
                mode.mac.map_or_else(dash, |mac| format!("{mac:.2}")),
                percent(mode.seen),
            ];
            table.row(own.into_iter().chain(there).chain(rest));
        }
        let more = match self.modes.len().saturating_sub(MOST_LINES) {
            0 => String::new(),
            more => format!("  {more} more in the file\n"),
        };
        let lost = self.modes.iter().filter(|mode| mode.there.is_none()).count();
        let added = if self.added.is_empty() { String::new() } else { format!(", {} added", self.added.len()) };
        format!(
            "against {}: of {} modes {lost} lost{added}\n{table}{more}  matched by {}; seen: what outputs see of a mode, of \
             what they see of others with the same energy\n",
            self.against,
            self.modes.len(),
            self.matched_by
        )
    }
}

/// Largest number of lines of a table.
const MOST_LINES: usize = 30;

/// Loci of a scene against those of another.
#[derive(Clone, Debug, Serialize)]
pub struct LociAgainst {
    /// Name of the other scene.
    pub scene: String,
    /// Modes of the scene that have a place there, or are lost.
    pub modes: Vec<BranchFate>,
    /// Number of modes that only the other has.
    pub added: usize,
}

/// A mode of loci, with that in its place.
#[derive(Clone, Debug, Serialize)]
pub struct BranchFate {
    /// Name of the mode.
    pub mode: String,
    /// Name of the mode in its place; null where it is lost.
    pub there: Option<String>,
    /// Largest |change| over |value|, and where.
    pub shift: Option<f64>,
    pub at: Option<f64>,
}

impl LociAgainst {
    /// The comparison of physical branches.
    pub fn new(loci: &Loci, scene: &str, other: &Loci) -> Self {
        let [(names, branches), (there, others)] = [loci, other].map(|loci| {
            let physical = loci.named().filter(|(_, branch)| branch.kind == Kind::Physical);
            physical.unzip::<String, &Branch, Vec<String>, Vec<&Branch>>()
        });
        let places = branch_places(&branches, &others);
        let added = (0..others.len()).filter(|j| !places.contains(&Some(*j))).count();
        let fate = |(i, mode): (usize, String)| {
            let part = |(at, [a, b]): (f64, [Complex<f64>; 2])| (at, (b - a).norm() / a.norm().max(f64::MIN_POSITIVE));
            let largest = places[i]
                .and_then(|j| both(branches[i], others[j]).map(part).max_by(|one, other| one.1.total_cmp(&other.1)));
            let (at, shift) = largest.unzip();
            BranchFate { mode, there: places[i].map(|j| there[j].clone()), shift, at }
        };
        LociAgainst { scene: scene.to_string(), modes: names.into_iter().enumerate().map(fate).collect(), added }
    }

    /// Returns a line for each mode.
    pub fn text(&self, along: &str) -> String {
        let mut table = Table::new(&["mode", "there", "largest shift", &format!("at {along}")]).words(1);
        let dash = || "-".to_string();
        for mode in self.modes.iter().take(MOST_LINES) {
            table.row([
                mode.mode.clone(),
                mode.there.clone().unwrap_or("lost".to_string()),
                mode.shift.map_or_else(dash, percent),
                mode.at.map_or_else(dash, |at| significant(at, 4)),
            ]);
        }
        let lost = self.modes.iter().filter(|mode| mode.there.is_none()).count();
        let added = if self.added == 0 { String::new() } else { format!(", {} added", self.added) };
        format!(
            "against {}: of {} modes {lost} lost{added}\n{table}  matched by eigenvalue, in the mean over all states\n",
            self.scene,
            self.modes.len()
        )
    }
}

/// Adds the eigenvalues of the other scene to the complex plane of the first; those outside its axes are cut off.
pub fn with_others(figure: Option<Figure>, scene: &str, other: &Loci) -> Option<Figure> {
    let mut figure = figure?;
    let physical = other.named().filter(|(_, branch)| branch.kind == Kind::Physical);
    let points = physical.flat_map(|(_, branch)| &branch.points).filter(|(_, value)| value.im >= 0.0);
    let points: Vec<(f64, f64)> = points.map(|(_, value)| (value.re, value.im)).collect();
    let panel = figure.panels.pop()?;
    figure.panels.push(panel.series(Series::dots(scene, points).style(Style::Crosses).color(BLUE)));
    Some(figure)
}

/// Colour, as index in the palette.
const BLUE: usize = 0;
