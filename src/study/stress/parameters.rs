//! The stress parameters: quantities that a map can vary over many powers of ten.

use super::ladder::{decades, sequence};
use super::subject::{Case, Subject};
use crate::error::{Error, Result};
use crate::method_spec::MethodSpec;
use crate::scene::document::{elements, elements_mut, faster, has_velocities, multiply, multiply_velocities, text};
use crate::scene::generate;
use serde_json::Value;
use std::sync::Arc;

/// A quantity of a simulation that a map can vary over many powers of ten.
pub struct StressParameter {
    /// Name on the command line.
    pub name: &'static str,
    /// Unit; empty for a ratio.
    pub unit: &'static str,
    /// One line of description.
    pub about: &'static str,
    /// True if the exact motion stays the same, so that one reference serves all values.
    pub keeps_motion: bool,
    /// True if the subject has this quantity.
    pub suits: fn(&Subject) -> bool,
    /// Default values for the subject.
    pub values: fn(&Subject) -> Vec<f64>,
    /// Sets the value in a case.
    pub apply: fn(&mut Case, f64) -> Result<()>,
}

/// Returns the stress parameter of this name.
///
/// # Errors
/// An unknown name, with the most similar one.
pub fn find(name: &str) -> Result<&'static StressParameter> {
    let canonical = name.replace('-', "_");
    registry().iter().find(|parameter| parameter.name == canonical).ok_or_else(|| {
        let names = registry().iter().map(|parameter| parameter.name);
        Error::unknown("extreme", name, names)
    })
}

/// Returns every stress parameter, in the order of the documentation.
pub fn registry() -> &'static [StressParameter] {
    &[
        StressParameter {
            name: "step",
            unit: "s",
            about: "fixed step of the method",
            keeps_motion: true,
            values: |subject| {
                let step = subject.base.typical.step;
                sequence(step / 40.0, 6.0 * step)
            },
            apply: |case, step| {
                case.method.step = Some(step);
                Ok(())
            },
            ..PARAMETER
        },
        // alpha = beta is the critical damping of phi'' + 2 alpha phi' + beta^2 phi = 0. The range is from gains
        // without effect within a step to those at which explicit methods are unstable.
        StressParameter {
            name: "gain",
            unit: "1/s",
            about: "Baumgarte's gains alpha = beta",
            keeps_motion: true,
            suits: |subject| subject.dimensions.lambda > 0,
            values: |subject| {
                let rate = 1.0 / subject.base.typical.step;
                sequence(0.02 * rate, 40.0 * rate)
            },
            apply: |case, gain| {
                (case.method.formulation, case.method.projection) = (baumgarte(gain), MethodSpec::named("none"));
                Ok(())
            },
        },
        StressParameter {
            name: "tolerance",
            about: "rtol = atol of adaptive methods",
            keeps_motion: true,
            values: |_| decades(-14, -2, 2),
            apply: |case, tolerance| {
                (case.method.rtol, case.method.atol, case.method.step) = (tolerance, tolerance, None);
                Ok(())
            },
            ..PARAMETER
        },
        // Mass and inertia of the last body with a mass in the list, which in chains is the end.
        StressParameter {
            name: "mass_ratio",
            about: "factor on mass and inertia of the last body",
            suits: |subject| has(&subject.base.scene, "bodies", "mass"),
            values: |_| decades(-8, 8, 2),
            apply: |case, factor| scale_mass(Arc::make_mut(&mut case.scene), factor),
            ..PARAMETER
        },
        StressParameter {
            name: "stiffness",
            unit: "N/m",
            about: "stiffness of all springs (N/m, N m/rad), bushings and tyres",
            suits: |subject| has(&subject.base.scene, "forces", "stiffness"),
            values: |_| decades(-2, 12, 2),
            apply: |case, value| set(Arc::make_mut(&mut case.scene), "stiffness", value),
            ..PARAMETER
        },
        StressParameter {
            name: "damping",
            unit: "N s/m",
            about: "damping of all springs (N s/m, N m s/rad), bushings and tyres",
            suits: |subject| has(&subject.base.scene, "forces", "damping"),
            values: |_| decades(-2, 12, 2),
            apply: |case, value| set(Arc::make_mut(&mut case.scene), "damping", value),
            ..PARAMETER
        },
        // Initial velocities and the time of drivers are multiplied by the factor, the simulated time divided by it, so
        // that the amount of motion is about the same.
        StressParameter {
            name: "speed",
            about: "factor on the velocities of the start and the time of drivers; the simulated time divided by it",
            suits: |subject| moves(&subject.base.scene),
            values: |_| decades(-1, 4, 1),
            apply: |case, factor| {
                speed_up(Arc::make_mut(&mut case.scene), factor);
                case.duration /= factor;
                Ok(())
            },
            ..PARAMETER
        },
        // A crank of r whose slider runs on a line at the offset folds with its rod of l where r + offset = l:
        // r = (1 - gap) l - offset.
        StressParameter {
            name: "link_ratio",
            about: "gap 1 - (r + offset)/l to the singular geometry of a planar crank r on a rod l (scenes with parameters r and l)",
            suits: |subject| lengths(&subject.base.scene).is_ok(),
            values: |_| decades(-9, 0, 1).into_iter().map(|gap| 0.5 * gap).collect(),
            apply: |case, gap| {
                let given =
                    |name: &str| case.set.iter().rev().find(|(known, _)| known == name).map(|(_, value)| *value);
                let [length, offset] = lengths(&case.scene)?;
                let [length, offset] = [given("l").unwrap_or(length), given("offset").unwrap_or(offset)];
                case.set.push(("r".to_string(), (1.0 - gap) * length - offset));
                Ok(())
            },
            ..PARAMETER
        },
        // The scene generated again with this number of links or loops.
        StressParameter {
            name: "links",
            about: "number of links or loops of a generated scene (n_four_bar, chain, flexible_chain)",
            suits: |subject| kind(&subject.base.scene).is_ok(),
            values: |_| sequence(1.0, 200.0),
            apply: |case, n| {
                case.scene = Arc::new(kind(&case.scene)?(n.round().max(1.0) as usize));
                Ok(())
            },
            ..PARAMETER
        },
        // In periods of the subject: see [`Typical`](super::Typical).
        StressParameter {
            name: "time",
            unit: "periods",
            about: "simulated time in periods of the motion",
            values: |_| decades(0, 6, 1),
            apply: |case, periods| {
                case.duration = periods * case.typical.period;
                Ok(())
            },
            ..PARAMETER
        },
        StressParameter {
            name: "start_error",
            about: "error of positions, in sizes of the scene, and of velocities, in these over the period",
            apply: |case, error| {
                case.start_error = [error; 2];
                Ok(())
            },
            ..START
        },
        StressParameter {
            name: "position_error",
            about: "error of the positions of the start, in sizes of the scene",
            apply: |case, error| {
                case.start_error[0] = error;
                Ok(())
            },
            ..START
        },
        StressParameter {
            name: "velocity_error",
            about: "error of the velocities of the start, in sizes of the scene over the period",
            apply: |case, error| {
                case.start_error[1] = error;
                Ok(())
            },
            ..START
        },
    ]
}

/// What most parameters have.
const PARAMETER: StressParameter = StressParameter {
    name: "",
    unit: "",
    about: "",
    keeps_motion: false,
    suits: |_| true,
    values: |_| Vec::new(),
    apply: |_, _| Ok(()),
};

/// Errors of an inconsistent start.
const START: StressParameter =
    StressParameter { suits: |subject| subject.dimensions.lambda > 0, values: |_| decades(-14, 0, 2), ..PARAMETER };

/// Baumgarte's stabilization with alpha = beta = `gain`: phi'' + 2 gain phi' + gain^2 phi = 0.
pub(super) fn baumgarte(gain: f64) -> MethodSpec {
    let gain = gain.to_string();
    MethodSpec::named("baumgarte").with("alpha", &gain).with("beta", &gain)
}

/// Returns the length of the rod, and the offset.
fn lengths(scene: &Value) -> Result<[f64; 2]> {
    let parameter = |name: &str| scene.get("parameters")?.get(name)?.as_f64();
    let is_planar = scene.get("dimension").and_then(Value::as_i64) == Some(2);
    let rod = parameter("l").filter(|_| is_planar && parameter("r").is_some());
    rod.map(|length| [length, parameter("offset").unwrap_or(0.0)]).ok_or_else(|| {
        Error::input("the scene is no planar one with parameters `r` and `l` that are numbers")
            .hint("name a parameter as the axis")
    })
}

/// Returns the generator of scenes of this name: `chain_10` is a `chain`.
fn kind(scene: &Value) -> Result<fn(usize) -> Value> {
    let name = scene.get("name").and_then(Value::as_str).unwrap_or_default();
    let kind = name.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end_matches('_');
    let found = generate::registry().iter().find(|(known, _)| *known == kind);
    found.map(|(_, make)| *make).ok_or_else(|| Error::input(format!("`{name}` is no generated scene")))
}

/// True if some element of a list has this key.
fn has(scene: &Value, list: &str, key: &str) -> bool {
    elements(scene, list).iter().any(|element| element.get(key).is_some())
}

fn scale_mass(scene: &mut Value, factor: f64) -> Result<()> {
    let body = elements_mut(scene, "bodies").filter(|body| body.get("mass").is_some()).last();
    let body = body.ok_or_else(|| Error::input("no body of the scene has a mass to change"))?;
    for key in ["mass", "inertia"] {
        body.get_mut(key).into_iter().for_each(|value| multiply(value, factor));
    }
    Ok(())
}

/// Sets this coefficient of every force that has it.
fn set(scene: &mut Value, key: &str, value: f64) -> Result<()> {
    if !has(scene, "forces", key) {
        return Err(Error::input(format!("no force of the scene has a {key} to change")));
    }
    elements_mut(scene, "forces").filter_map(|force| force.get_mut(key)).for_each(|number| replace(number, value));
    Ok(())
}

/// Replaces a number or an expression, or each of a list of them that is not zero.
fn replace(value: &mut Value, by: f64) {
    match value {
        Value::Array(entries) => {
            entries.iter_mut().filter(|entry| entry.as_f64() != Some(0.0)).for_each(|entry| replace(entry, by))
        }
        _ => *value = Value::from(by),
    }
}

fn is_driven(joint: &Value) -> bool {
    ["driver", "equation"].contains(&text(joint, "type"))
}

fn moves(scene: &Value) -> bool {
    has_velocities(scene) || has(scene, "bodies", "motion") || elements(scene, "joints").iter().any(is_driven)
}

fn speed_up(scene: &mut Value, factor: f64) {
    multiply_velocities(scene, factor);
    for joint in elements_mut(scene, "joints").filter(|joint| is_driven(joint)) {
        for key in ["value", "expression"] {
            joint.get_mut(key).into_iter().for_each(|value| faster(value, factor));
        }
    }
}
