//! The page itself: its data in the frame of `page.html`.

use super::ShownMotion;
use super::curves::{Curve, curves};
use super::encode::{base64, in_script};
use super::modes::{ModePart, modes};
use super::moving::{MovingMechanism, fitting_parts, numbers_of_row};
use super::rows::even_rows;
use crate::linearize::LinearModel;
use crate::report::mechanism::up;
use serde::Serialize;

const FRAME: &str = include_str!("page.html");
const STYLE: &str = concat!(include_str!("uPlot.css"), include_str!("page.css"));
const CODE: &str =
    concat!(include_str!("shapes.js"), include_str!("mechanism.js"), include_str!("curves.js"), include_str!("app.js"));
const LIBRARIES: &[u8] = include_bytes!("libraries.js.gz");
const LICENSES: &str = include_str!("LICENSES.txt");

/// Bytes that a page has room for beside 310 kB of code: of parts, and of numbers with 16/3 bytes each in base64.
const BYTES: usize = 175_000;
/// Numbers for which the parts are chosen that are shown.
const NUMBERS: usize = 31_000;
/// Numbers of all further runs together: with them a page stays below 1 MB.
const NUMBERS_OF_GHOSTS: usize = 80_000;

/// Rows of a motion: more are not told apart by the eye.
pub const ROWS: usize = 600;

/// What a page shows beside a run.
pub struct Extras<'a> {
    /// Other runs, as ghosts.
    pub ghosts: Vec<ShownMotion<'a>>,
    /// Linear model whose modes it shows.
    pub model: Option<&'a LinearModel>,
    /// Notes below the title.
    pub notes: Vec<String>,
    /// Largest number of rows.
    pub rows: usize,
}

impl Default for Extras<'_> {
    fn default() -> Self {
        Extras { ghosts: Vec::new(), model: None, notes: Vec::new(), rows: ROWS }
    }
}

#[derive(Serialize)]
struct Data<'a> {
    holonom: &'static str,
    name: &'a str,
    about: &'a str,
    dimension: usize,
    /// Index of the axis that points up.
    up: usize,
    notes: Vec<String>,
    /// The run, then the ghosts.
    mechanisms: Vec<MovingMechanism>,
    curves: Vec<Curve>,
    modes: Vec<ModePart>,
}

/// Returns the page of a run with at least one row.
pub fn page(run: &ShownMotion, extras: &Extras) -> String {
    let mut notes = extras.notes.clone();
    let parts = fitting_parts(run, NUMBERS);
    note_rest(&mut notes, "bodies", parts.bodies.len(), parts.all_bodies);
    let (modes, all_modes) =
        extras.model.map_or_else(Default::default, |model| modes(run.prepared, model, &parts, NUMBERS / 3));
    note_rest(&mut notes, "modes", modes.len(), all_modes);
    let of_modes: usize = modes.iter().map(|mode| mode.clip.len()).sum();
    let (of_row, all_curves) = curves(run, &[0]);
    note_rest(&mut notes, "outputs", of_row.len(), all_curves);
    let of_row = numbers_of_row(run, &parts) + of_row.iter().map(Curve::len).sum::<usize>();
    let numbers = (BYTES.saturating_sub(parts.bytes()) * 3 / 16).saturating_sub(of_modes);
    let rows = even_rows(run.rows, extras.rows.min(numbers / of_row));
    let curves = curves(run, &rows).0;
    let mut mechanisms = vec![MovingMechanism::new(run, parts, &rows)];
    let of_ghost = NUMBERS.min(NUMBERS_OF_GHOSTS / extras.ghosts.len().max(1));
    mechanisms.extend(extras.ghosts.iter().map(|ghost| moving_ghost(ghost, extras.rows, of_ghost)));
    let prepared = run.prepared;
    let data = Data {
        holonom: env!("CARGO_PKG_VERSION"),
        name: &prepared.name,
        about: &prepared.about,
        dimension: prepared.mechanism.dimension(),
        up: up(&prepared.mechanism),
        notes,
        mechanisms,
        curves,
        modes,
    };
    html(&data)
}

/// Notes how many of some things a page does not show.
fn note_rest(notes: &mut Vec<String>, what: &str, shown: usize, all: usize) {
    if shown < all {
        notes.push(format!("the first {shown} of {all} {what} are shown"));
    }
}

/// Returns another run; `numbers` are those that the page has room for.
fn moving_ghost(ghost: &ShownMotion, rows: usize, numbers: usize) -> MovingMechanism {
    let parts = fitting_parts(ghost, NUMBERS);
    let rows = rows.min(numbers / numbers_of_row(ghost, &parts));
    MovingMechanism::new(ghost, parts, &even_rows(ghost.rows, rows))
}

fn html(data: &Data) -> String {
    // Only numbers, texts and lists of them: these have a form in JSON.
    let data = in_script(&serde_json::to_string(data).unwrap_or_default());
    // Each place is filled in what is before the next one, so that no text of a scene is taken for a place.
    let parts = [
        ("/*STYLE*/", STYLE),
        ("/*LICENSES*/", LICENSES),
        ("/*DATA*/", &data),
        ("/*LIBRARIES*/", &base64(LIBRARIES)),
        ("/*CODE*/", CODE),
    ];
    let mut page = String::with_capacity(FRAME.len() + parts.iter().map(|(_, text)| text.len()).sum::<usize>());
    let mut rest = FRAME;
    for (place, text) in parts {
        let (before, after) = rest.split_once(place).unwrap_or((rest, ""));
        page.push_str(before);
        page.push_str(text);
        rest = after;
    }
    page + rest
}
