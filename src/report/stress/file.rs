//! `stress.json`, `stress.csv` and `stress.md`.

use super::words::sentences;
use crate::error::Result;
use crate::report::cell as full;
use crate::report::tables::{Column, by_columns, optional};
use crate::simulate::Method;
use crate::study::SecondOpinion;
use crate::study::stress::{Axis, Cell, GainVerdict, Quantity, Stressed, Verdict};
use serde::Serialize;

/// All maps of a scene.
#[derive(Serialize)]
pub struct StressFile {
    /// Name of the scene.
    pub scene: String,
    /// Method without the changes of the maps.
    pub method: Method,
    /// Mean step of this method, s.
    pub typical_step: f64,
    /// Typical period of the motion, s.
    pub typical_period: f64,
    /// Wall-clock time of all maps, s.
    pub wall_seconds: f64,
    /// The maps.
    pub maps: Vec<MapFile>,
}

/// A map with its verdicts and cells.
#[derive(Serialize)]
pub struct MapFile {
    /// Name.
    pub name: String,
    /// One line of description.
    pub about: String,
    /// Quantity shown.
    pub quantity: Quantity,
    /// Columns.
    pub x: AxisFile,
    /// Rows.
    pub y: AxisFile,
    /// Names of the methods.
    pub methods: Vec<String>,
    /// True if no cell has a value of the quantity.
    pub is_empty: bool,
    /// Verdicts in sentences.
    pub words: Vec<String>,
    /// The difference of the reference in the middle of the map from a run of diffsol.
    pub second_opinion: Option<SecondOpinion>,
    /// Summary of each method.
    pub verdicts: Vec<Verdict>,
    /// Results of Baumgarte's gains; empty for other maps.
    pub gains: Vec<GainVerdict>,
    /// Cells by method, then row, then column.
    pub cells: Vec<Cell>,
}

#[derive(Serialize)]
pub struct AxisFile {
    pub name: String,
    pub unit: String,
    pub labels: Vec<String>,
    /// Values; null for an entry that is not a number, such as another method.
    pub values: Vec<Option<f64>>,
}

impl From<&Axis> for AxisFile {
    fn from(axis: &Axis) -> Self {
        AxisFile {
            name: axis.name.clone(),
            unit: axis.unit.clone(),
            labels: axis.entries.iter().map(|entry| entry.label.clone()).collect(),
            values: axis.entries.iter().map(|entry| entry.value).collect(),
        }
    }
}

impl From<&Stressed> for MapFile {
    fn from(stressed: &Stressed) -> Self {
        let map = &stressed.map;
        MapFile {
            name: map.name.clone(),
            about: map.about.clone(),
            quantity: map.quantity,
            x: AxisFile::from(&map.x),
            y: AxisFile::from(&map.y),
            methods: map.methods.iter().map(|method| method.label.clone()).collect(),
            is_empty: stressed.is_empty(),
            words: sentences(stressed),
            second_opinion: stressed.second_opinion.clone(),
            verdicts: stressed.verdicts(),
            gains: stressed.gains(),
            cells: stressed.cells.clone(),
        }
    }
}

/// A cell of a map of a scene.
struct Place<'a> {
    scene: &'a str,
    map: &'a MapFile,
    cell: &'a Cell,
}

fn columns<'a>() -> [Column<Place<'a>>; 26] {
    [
        ("scene", |at| at.scene.to_string()),
        ("map", |at| at.map.name.clone()),
        ("x_name", |at| at.map.x.name.clone()),
        ("x", |at| optional(at.map.x.values[at.cell.column])),
        ("y_name", |at| at.map.y.name.clone()),
        ("y", |at| optional(at.map.y.values[at.cell.row])),
        ("y_label", |at| at.map.y.labels[at.cell.row].clone()),
        ("formulation", |at| at.cell.method.formulation.to_string()),
        ("integrator", |at| at.cell.method.integrator.to_string()),
        ("projection", |at| at.cell.method.projection.to_string()),
        ("rtol", |at| full(at.cell.method.rtol)),
        ("atol", |at| full(at.cell.method.atol)),
        ("step", |at| optional(at.cell.method.step)),
        ("status", |at| at.cell.status.word().replace(' ', "_")),
        ("reason", |at| at.cell.reason.clone().unwrap_or_default()),
        ("t", |at| full(at.cell.t)),
        ("position_drift", |at| optional(at.cell.drift.as_ref().map(|drift| drift.position.max))),
        ("velocity_drift", |at| optional(at.cell.drift.as_ref().map(|drift| drift.velocity.max))),
        ("final_position_drift", |at| optional(at.cell.drift.as_ref().map(|drift| drift.position.last))),
        ("energy_error", |at| optional(at.cell.energy_error)),
        ("relative_energy_error", |at| optional(at.cell.relative_energy_error)),
        ("error", |at| optional(at.cell.error)),
        ("worst_output", |at| at.cell.worst.clone().unwrap_or_default()),
        ("holds", |at| at.cell.holds.map_or(String::new(), |holds| holds.to_string())),
        ("steps", |at| at.cell.steps.to_string()),
        ("seconds", |at| full(at.cell.seconds)),
    ]
}

/// Returns one row for each cell, over all scenes; empty where a value is not known.
pub fn stress_table(files: &[StressFile]) -> Result<Vec<u8>> {
    let maps = files.iter().flat_map(|file| file.maps.iter().map(move |map| (&file.scene, map)));
    let places = maps.flat_map(|(scene, map)| map.cells.iter().map(move |cell| Place { scene, map, cell }));
    by_columns(&columns(), places)
}

const LEGEND: &str = "Cells of the figures: ∞ diverged (joints open by a tenth of the scene's size, or infinite numbers), \
     × stopped with an error, no: refused, slow: beyond the time of a cell, –: left out for want of time, \
     which says nothing of how it ends. !: completed, but outputs or energy are off by more than 10 % of their size, \
     against an accurate run of the same motion.";

/// Returns the verdicts of all maps in sentences, with the names of their figures; and the scenes that could not be
/// run.
pub fn stress_page(
    files: &[StressFile],
    unread: &[(String, String)],
    figure: impl Fn(&str, &str) -> Option<String>,
) -> String {
    let mut page = format!("# Extremes\n\n{LEGEND}\n");
    page += "\n| scene | map | method | cells | completed | right | others |\n|---|---|---|---|---|---|---|\n";
    for file in files {
        for (map, verdict) in file.maps.iter().flat_map(|map| map.verdicts.iter().map(move |verdict| (map, verdict))) {
            let others: Vec<String> =
                verdict.others.iter().map(|(status, n)| format!("{n} {}", status.word())).collect();
            let scene = &file.scene;
            let method = &verdict.method;
            let name = &map.name;
            let cells = verdict.cells;
            let completed = verdict.completed;
            let held = verdict.held;
            page +=
                &format!("| {scene} | {name} | {method} | {cells} | {completed} | {held} | {} |\n", others.join(", "));
        }
    }
    for file in files {
        page += &format!("\n## {}\n", file.scene);
        for map in &file.maps {
            page += &format!("\n### {}: {}\n\n", map.name, map.about);
            page.extend(map.words.iter().map(|words| format!("- {words}\n")));
            if let Some(name) = figure(&file.scene, &map.name).filter(|_| !map.is_empty) {
                page += &format!("\n![{}: {}]({name})\n", file.scene, map.about);
            }
        }
    }
    if !unread.is_empty() {
        page += "\n## Not run\n\n";
        page.extend(unread.iter().map(|(scene, reason)| format!("- {scene}: {reason}\n")));
    }
    page
}
