//! `stress.md`.

use super::file::StressFile;

const LEGEND: &str = "Cells of the figures: ∞ diverged (joints open by a tenth of the scene's size, or infinite numbers), \
     × stopped with an error, no: refused, slow: beyond the time of a cell, –: left out for want of time, \
     which says nothing of how it ends. !: completed, but outputs or energy are off by more than 10 % of their size, \
     against an accurate run of the same motion.";

/// The verdicts of all maps in words, with the names of their figures; and what could not be run.
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
            let (scene, method) = (&file.scene, &verdict.method);
            let (name, cells, completed, held) = (&map.name, verdict.cells, verdict.completed, verdict.held);
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
