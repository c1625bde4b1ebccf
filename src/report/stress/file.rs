//! `stress.json`, `stress.csv` and `stress.md`.

use super::figure::stress_figure;
use super::words::{gain_table, sentences};
use crate::error::Result;
use crate::report::tables::{TableColumn, by_columns, optional};
use crate::report::{Answer, Folder, cell as full};
use crate::simulate::Method;
use crate::study::stress::{AxisPlace, Cell, Map, MapAxis, MethodVerdict, Stressed};
use serde::Serialize;
use serde_json::{Value, json};

pub struct SceneMaps {
    pub scene: String,
    /// Method without the changes of the maps.
    pub method: Method,
    /// Mean step of this method, s.
    pub typical_step: f64,
    /// Typical period of the motion, s.
    pub typical_period: f64,
    pub wall_seconds: f64,
    pub maps: Vec<Stressed>,
}

pub struct FolderMaps {
    pub scenes: Vec<SceneMaps>,
    /// Scenes that could not be run, with the reasons.
    pub unread: Vec<(String, String)>,
}

impl Answer for SceneMaps {
    fn json(&self) -> impl Serialize {
        json!({
            "scene": self.scene,
            "method": self.method,
            "typical_step": self.typical_step,
            "typical_period": self.typical_period,
            "wall_seconds": self.wall_seconds,
            "maps": self.maps.iter().map(map_json).collect::<Vec<Value>>(),
        })
    }

    /// Returns the verdicts, and the table of the gains.
    fn text(&self) -> String {
        let mut text = format!("{}: extremes, {:.0} s\n", self.scene, self.wall_seconds);
        for stressed in &self.maps {
            text += &format!("\n{}: {}\n", stressed.map.name, stressed.map.about);
            text.extend(sentences(stressed).iter().map(|sentence| format!("  {sentence}\n")));
            let opinion = stressed.second_opinion.iter();
            text.extend(opinion.map(|opinion| format!("  the reference in the middle of the map is {opinion}\n")));
            for gains in stressed.gains() {
                text += &format!("\n  {}, {} drift\n{}", gains.method, gains.quantity.name(), gain_table(&gains));
            }
        }
        text
    }

    fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        write(folder, stem, std::slice::from_ref(self), &[], |_, map| format!("{stem}-{map}"))
    }
}

impl Answer for FolderMaps {
    fn json(&self) -> impl Serialize {
        json!({ "scenes": self.scenes.iter().map(|scene| json!(scene.json())).collect::<Vec<Value>>() })
    }

    /// Nothing: the texts of the scenes are printed as they come.
    fn text(&self) -> String {
        String::new()
    }

    fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        write(folder, stem, &self.scenes, &self.unread, |scene, map| format!("{scene}-{map}"))
    }
}

/// Writes a figure for each map, under the name of its scene and its own, then page and table.
fn write(
    folder: &mut Folder,
    stem: &str,
    scenes: &[SceneMaps],
    unread: &[(String, String)],
    name: impl Fn(&str, &str) -> String,
) -> Result<()> {
    for (scene, stressed) in each(scenes) {
        folder.figure(&name(scene, &stressed.map.name), stress_figure(scene, stressed))?;
    }
    let page = stress_page(scenes, unread, |scene, map| folder.drawn(&name(scene, map)));
    folder.write(&format!("{stem}.md"), page.as_bytes())?;
    let cells = each(scenes).flat_map(|(scene, stressed)| {
        stressed.cells.iter().map(move |cell| MapCell { scene, map: &stressed.map, cell })
    });
    folder.table(stem, &by_columns(&columns(), cells)?)
}

/// Returns all maps with the names of their scenes.
fn each(scenes: &[SceneMaps]) -> impl Iterator<Item = (&str, &Stressed)> {
    scenes.iter().flat_map(|scene| scene.maps.iter().map(|map| (scene.scene.as_str(), map)))
}

fn map_json(stressed: &Stressed) -> Value {
    let map = &stressed.map;
    json!({
        "name": map.name,
        "about": map.about,
        "quantity": map.quantity,
        "x": axis(&map.x),
        "y": axis(&map.y),
        "methods": map.methods.iter().map(|method| &method.label).collect::<Vec<_>>(),
        "is_empty": stressed.is_empty(),
        "words": sentences(stressed),
        "second_opinion": stressed.second_opinion,
        "verdicts": stressed.verdicts(),
        "gains": stressed.gains(),
        "cells": stressed.cells,
    })
}

/// Returns an axis with null for an entry that is not a number, such as another method.
fn axis(axis: &MapAxis) -> Value {
    json!({
        "name": axis.name,
        "unit": axis.unit,
        "labels": axis.entries.iter().map(|entry| &entry.label).collect::<Vec<_>>(),
        "values": axis.entries.iter().map(|entry| entry.value).collect::<Vec<_>>(),
    })
}

struct MapCell<'a> {
    scene: &'a str,
    map: &'a Map,
    cell: &'a Cell,
}

impl MapCell<'_> {
    fn x(&self) -> &AxisPlace {
        &self.map.x.entries[self.cell.column]
    }

    fn y(&self) -> &AxisPlace {
        &self.map.y.entries[self.cell.row]
    }
}

fn columns<'a>() -> [TableColumn<MapCell<'a>>; 26] {
    [
        ("scene", |at| at.scene.to_string()),
        ("map", |at| at.map.name.clone()),
        ("x_name", |at| at.map.x.name.clone()),
        ("x", |at| optional(at.x().value)),
        ("y_name", |at| at.map.y.name.clone()),
        ("y", |at| optional(at.y().value)),
        ("y_label", |at| at.y().label.clone()),
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

const LEGEND: &str = "Cells of the figures: ∞ diverged (joints open by a tenth of the scene's size, or infinite numbers), \
     × stopped with an error, no: refused, slow: beyond the time of a cell, –: left out for want of time, \
     which says nothing of how it ends. !: completed, but outputs or energy are off by more than 10 % of their size, \
     against an accurate run of the same motion.";

/// Returns the verdicts of all maps in sentences, with the names of their figures; and the scenes that could not be
/// run.
fn stress_page(
    scenes: &[SceneMaps],
    unread: &[(String, String)],
    figure: impl Fn(&str, &str) -> Option<String>,
) -> String {
    let mut page = format!("# Extremes\n\n{LEGEND}\n");
    page += "\n| scene | map | method | cells | completed | right | others |\n|---|---|---|---|---|---|---|\n";
    for (scene, stressed) in each(scenes) {
        for MethodVerdict { method, cells, completed, held, others, .. } in stressed.verdicts() {
            let others: Vec<String> = others.iter().map(|(status, n)| format!("{n} {}", status.word())).collect();
            let name = &stressed.map.name;
            let others = others.join(", ");
            page += &format!("| {scene} | {name} | {method} | {cells} | {completed} | {held} | {others} |\n");
        }
    }
    for SceneMaps { scene, maps, .. } in scenes {
        page += &format!("\n## {scene}\n");
        for stressed in maps {
            let Map { name, about, .. } = &stressed.map;
            page += &format!("\n### {name}: {about}\n\n");
            page.extend(sentences(stressed).iter().map(|words| format!("- {words}\n")));
            if let Some(file) = figure(scene, name).filter(|_| !stressed.is_empty()) {
                page += &format!("\n![{scene}: {about}]({file})\n");
            }
        }
    }
    if !unread.is_empty() {
        page += "\n## Not run\n\n";
        page.extend(unread.iter().map(|(scene, reason)| format!("- {scene}: {reason}\n")));
    }
    page
}
