//! Which modes of a model another one has lost or shifted.

use crate::error::{percent, significant};
use crate::linearize::{Against, Branch, Complex, Fate, Kind, Loci, both, branch_places, damping, frequency};
use crate::plot::{Figure, Series, Style};
use crate::report::{Answer, TextTable};
use serde::Serialize;
use serde_json::{Value, json};

/// The modes of a scene against those of another at a state.
pub struct AgainstAnswer<'a> {
    pub t: f64,
    pub other: &'a str,
    pub found: Against,
}

fn eigenvalue(value: Complex<f64>) -> Value {
    json!({ "re": value.re, "im": value.im, "frequency_hz": frequency(value), "damping_ratio": damping(value) })
}

/// A mode with that in its place, which is null where the mode is lost.
fn fate(fate: &Fate) -> Value {
    let mut found = eigenvalue(fate.value);
    found["there"] = json!(fate.there.map(eigenvalue));
    found["shift"] = json!(fate.shift());
    found["mac"] = json!(fate.mac);
    found["seen"] = json!(fate.seen);
    found
}

impl AgainstAnswer<'_> {
    fn matched_by(&self) -> &'static str {
        if self.found.outputs > 1 { "eigenvalue and MAC of the outputs of both" } else { "eigenvalue" }
    }
}

impl Answer for AgainstAnswer<'_> {
    fn json(&self) -> impl Serialize {
        json!({
            "t": self.t,
            "against": self.other,
            "matched_by": self.matched_by(),
            "modes": self.found.modes.iter().map(fate).collect::<Vec<Value>>(),
            "added": self.found.added.iter().copied().map(eigenvalue).collect::<Vec<Value>>(),
        })
    }

    fn text(&self) -> String {
        let mut table =
            TextTable::new(&["frequency (Hz)", "damping ratio", "there (Hz)", "damping ratio", "shift", "MAC", "seen"]);
        let dash = || "-".to_string();
        for mode in self.found.modes.iter().take(MOST_LINES) {
            let [own, there] = [Some(mode.value), mode.there].map(|value| match value {
                Some(value) => [significant(frequency(value), 5), significant(damping(value), 4)],
                None => ["lost".to_string(), dash()],
            });
            let rest = [
                mode.shift().map_or_else(dash, percent),
                mode.mac.map_or_else(dash, |mac| format!("{mac:.2}")),
                percent(mode.seen),
            ];
            table.row(own.into_iter().chain(there).chain(rest));
        }
        let more = match self.found.modes.len().saturating_sub(MOST_LINES) {
            0 => String::new(),
            more => format!("  {more} more in the file\n"),
        };
        let lost = self.found.modes.iter().filter(|mode| mode.there.is_none()).count();
        format!(
            "\n{}{table}{more}  matched by {}; seen: what outputs see of a mode, of what they see of others with the same \
             energy\n",
            heading(self.other, self.found.modes.len(), lost, self.found.added.len()),
            self.matched_by()
        )
    }
}

/// Returns the numbers of the modes, of those that are lost, and of those that only the other scene has.
fn heading(other: &str, modes: usize, lost: usize, added: usize) -> String {
    let added = if added == 0 { String::new() } else { format!(", {added} added") };
    format!("against {other}: of {modes} modes {lost} lost{added}\n")
}

/// Largest number of lines of a table.
const MOST_LINES: usize = 30;

/// Loci of a scene against those of another.
#[derive(Serialize)]
pub(super) struct LociAgainst {
    scene: String,
    /// Modes of the scene that have a place there, or are lost.
    modes: Vec<BranchFate>,
    /// Number of modes that only the other has.
    added: usize,
}

/// A mode of loci; in its place one with a largest |change| over |value|, or null where it is lost.
#[derive(Serialize)]
struct BranchFate {
    mode: String,
    there: Option<String>,
    shift: Option<f64>,
    at: Option<f64>,
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

    pub fn text(&self, along: &str) -> String {
        let mut table = TextTable::new(&["mode", "there", "largest shift", &format!("at {along}")]).words(1);
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
        let heading = heading(&self.scene, self.modes.len(), lost, self.added);
        format!("{heading}{table}  matched by eigenvalue, in the mean over all states\n")
    }
}

/// Adds the eigenvalues of the other scene to the complex plane of the first; those outside its axes are cut off.
pub(super) fn with_others(figure: Option<Figure>, scene: &str, other: &Loci) -> Option<Figure> {
    let mut figure = figure?;
    let physical = other.named().filter(|(_, branch)| branch.kind == Kind::Physical);
    let points = physical.flat_map(|(_, branch)| &branch.points).filter(|(_, value)| value.im >= 0.0);
    let points: Vec<(f64, f64)> = points.map(|(_, value)| (value.re, value.im)).collect();
    let panel = figure.panels.pop()?;
    figure.panels.push(panel.series(Series::dots(scene, points).style(Style::Crosses).color(0)));
    Some(figure)
}
