//! Settings of a whole model: `<compiler>` and `<option>`.

use crate::error::{Result, excerpt};
use crate::import::told::Told;
use crate::import::xml::{Element, all, faulty, list};
use roxmltree::Node;

pub struct MjcfSettings {
    /// Radians of a unit of the file's angles.
    pub unit: f64,
    /// The axes of Euler angles in their order; true for those that do not turn with the frame.
    pub euler: [(usize, bool); 3],
    /// True: masses follow from geoms; false: from `<inertial>`; `None`: from geoms where there is no `<inertial>`.
    pub from_geoms: Option<bool>,
    /// Groups of geoms that have mass.
    pub groups: [f64; 2],
    /// kg
    pub total_mass: Option<f64>,
    /// m/s^2
    pub gravity: [f64; 3],
}

/// What scenes have no place for.
const OPTIONS: [&str; 4] = ["density", "viscosity", "wind", "magnetic"];

impl MjcfSettings {
    pub fn read(root: Node, told: &mut Told) -> Result<MjcfSettings> {
        let compiler = Element::merged(root, "compiler");
        if let Some((node, "global")) = compiler.found("coordinate") {
            return Err(faulty(node, "global coordinates are no part of the format any more")
                .hint("save the model with local coordinates"));
        }
        tell_bounds(&compiler, told)?;
        tell_options(root, told)?;
        let total_mass = compiler.number("settotalmass")?;
        let groups = compiler.numbers_or("inertiagrouprange", [0.0, 5.0])?;
        Ok(MjcfSettings {
            unit: if compiler.is("angle", "radian") { 1.0 } else { 1f64.to_radians() },
            euler: euler(&compiler)?,
            from_geoms: compiler.text("inertiafromgeom").and_then(|text| text.parse().ok()),
            groups,
            total_mass: total_mass.filter(|mass| *mass > 0.0),
            gravity: gravity(root)?,
        })
    }
}

fn euler(compiler: &Element) -> Result<[(usize, bool); 3]> {
    let Some((node, text)) = compiler.found("eulerseq") else {
        return Ok([(0, false), (1, false), (2, false)]);
    };
    let axes: Option<Vec<(usize, bool)>> = text.chars().map(|c| "xyzXYZ".find(c).map(|i| (i % 3, i > 2))).collect();
    axes.and_then(|axes| axes.try_into().ok()).ok_or_else(|| {
        faulty(node, format!("expected three of x, y, z, X, Y, Z in `eulerseq`, found \"{}\"", excerpt(text)))
    })
}

fn gravity(root: Node) -> Result<[f64; 3]> {
    let flags = all(root, "option").flat_map(|option| all(option, "flag"));
    if flags.filter_map(|flag| flag.attribute("gravity")).last() == Some("disable") {
        return Ok([0.0; 3]);
    }
    Element::merged(root, "option").numbers_or("gravity", [0.0, 0.0, -9.81])
}

/// Bounds that change masses.
fn tell_bounds(compiler: &Element, told: &mut Told) -> Result<()> {
    for key in ["boundmass", "boundinertia"] {
        told.add_if(compiler.number_or(key, 0.0)? > 0.0, "bounds from below by the compiler:", key);
    }
    Ok(())
}

fn tell_options(root: Node, told: &mut Told) -> Result<()> {
    for option in all(root, "option") {
        for attribute in option.attributes().filter(|attribute| attribute.name() != "gravity") {
            let key = attribute.name();
            if !OPTIONS.contains(&key) {
                told.add("settings of the solver:", key);
            } else if list(option, key, attribute.value())?.iter().any(|value| *value != 0.0) && key != "magnetic" {
                told.add("forces of the medium:", key);
            }
        }
        for flag in all(option, "flag").flat_map(|flag| flag.attributes()).filter(|flag| flag.name() != "gravity") {
            told.add("flags of the solver:", flag.name());
        }
    }
    Ok(())
}
