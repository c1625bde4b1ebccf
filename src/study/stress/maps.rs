//! The maps offered for a scene.

use super::cell::CellQuantity;
use super::change::CellChange;
use super::map::{AxisPlace, Map, MapAxis};
use super::parameters::find;
use super::subject::Subject;
use crate::error::{Error, Result};
use crate::method_spec::MethodSpec;

/// A map as the command line lists it.
pub struct MapEntry {
    /// Name on the command line.
    pub name: &'static str,
    /// One line of description.
    pub about: &'static str,
    x: &'static str,
    y: &'static str,
    quantity: CellQuantity,
    methods: fn() -> Vec<AxisPlace>,
    /// Changes the axes from the default values of their stress parameters.
    adapt: fn(&mut Map),
    /// True if the map makes sense for a subject that has both stress parameters.
    suits: fn(&Subject) -> bool,
}

/// Returns every map, the most important first.
pub fn known() -> &'static [MapEntry] {
    const KNOWN: [MapEntry; 9] = [
        MapEntry {
            methods: fixed,
            adapt: beside_gains,
            ..drifting(
                "gain",
                "step x Baumgarte's gain, beside no stabilization and post-stabilization on the same steps",
                "step",
                "gain",
            )
        },
        MapEntry {
            quantity: CellQuantity::FinalPosition,
            methods: || {
                let projected = method("index1", "dopri5", "manifold");
                vec![method("index1", "dopri5", "none"), method("baumgarte", "dopri5", "none"), projected]
            },
            ..usual(
                "start",
                "tolerance x error of the start: which methods pull an inconsistent start back",
                "tolerance",
                "start_error",
            )
        },
        MapEntry {
            suits: |subject| !has("stiffness", subject),
            ..usual("mass", "tolerance x mass of the last body", "tolerance", "mass_ratio")
        },
        usual("stiffness", "stiffness of the springs x mass of the last body", "stiffness", "mass_ratio"),
        usual("damping", "stiffness of the springs x their damping", "stiffness", "damping"),
        MapEntry {
            methods: || vec![method("index1", "rk4", "none"), method("index1", "rk4", "manifold")],
            ..drifting("speed", "step x speed of the motion", "step", "speed")
        },
        usual("geometry", "tolerance x link lengths towards a singular geometry", "tolerance", "link_ratio"),
        MapEntry {
            methods: || vec![method("index1", "rk4", "manifold"), method("index3", "generalized_alpha", "none")],
            ..drifting("links", "step x number of links", "step", "links")
        },
        MapEntry {
            methods: || vec![AxisPlace::named("", Vec::new())],
            adapt: by_method,
            ..usual("time", "simulated time x method", "time", "time")
        },
    ];
    &KNOWN
}

/// A map of energy errors of adaptive methods.
const fn usual(name: &'static str, about: &'static str, x: &'static str, y: &'static str) -> MapEntry {
    let quantity = CellQuantity::Energy;
    MapEntry { name, about, x, y, quantity, methods: adaptive, adapt: |_| {}, suits: |_| true }
}

/// A map of velocity drift.
const fn drifting(name: &'static str, about: &'static str, x: &'static str, y: &'static str) -> MapEntry {
    MapEntry { quantity: CellQuantity::Velocity, ..usual(name, about, x, y) }
}

/// Returns the maps of these names, or all that make sense for the subject.
///
/// # Errors
/// An unknown name, or a map of stress parameters that do not apply to the scene.
pub fn maps(subject: &Subject, names: &[String]) -> Result<Vec<Map>> {
    if names.is_empty() {
        return known().iter().filter(|entry| entry.suits(subject)).map(|entry| entry.map(subject)).collect();
    }
    let named = |name: &String| {
        let found = known().iter().find(|entry| entry.name == name.replace('-', "_"));
        let entry = found.ok_or_else(|| Error::unknown("map", name, known().iter().map(|entry| entry.name)))?;
        if has(entry.x, subject) && has(entry.y, subject) {
            entry.map(subject)
        } else {
            Err(Error::input(format!("the scene has nothing for the map `{name}`: {}", entry.about))
                .hint("leave --map out for the maps that make sense for the scene"))
        }
    };
    names.iter().map(named).collect()
}

/// Returns a map of two given axes, for the subject's own method and for it without stabilization.
pub fn pair(subject: &Subject, x: MapAxis, y: MapAxis, quantity: CellQuantity) -> Map {
    let label = {
        let method = &subject.base.method;
        format!("{} {} {}", method.formulation, method.integrator, method.projection)
    };
    Map {
        name: format!("{}_{}", x.name, y.name),
        about: format!("{} x {}", x.name, y.name),
        x,
        y,
        methods: vec![AxisPlace::named(&label, Vec::new())],
        quantity,
    }
}

fn has(parameter: &str, subject: &Subject) -> bool {
    find(parameter).is_ok_and(|parameter| (parameter.suits)(subject))
}

impl MapEntry {
    fn suits(&self, subject: &Subject) -> bool {
        has(self.x, subject) && has(self.y, subject) && (self.suits)(subject)
    }

    fn map(&self, subject: &Subject) -> Result<Map> {
        let axis = |name: &str| -> Result<MapAxis> { Ok(MapAxis::usual(find(name)?, subject)) };
        let mut map = Map {
            name: self.name.to_string(),
            about: self.about.to_string(),
            x: axis(self.x)?,
            y: axis(self.y)?,
            methods: (self.methods)(),
            quantity: self.quantity,
        };
        (self.adapt)(&mut map);
        Ok(map)
    }
}

/// Adds rows below and above the gains: the methods without gains.
fn beside_gains(map: &mut Map) {
    let row = |label: &str, projection: &str| {
        let projection = MethodSpec::parse(projection).unwrap_or_default();
        AxisPlace::named(label, vec![CellChange::Stabilization(MethodSpec::named("index1"), projection)])
    };
    let above = [
        AxisPlace::named("(2/h, 1/h²)", vec![CellChange::OwnGains]),
        row("manifold", "manifold"),
        row("manifold × 2", "manifold:sweeps=2"),
    ];
    map.y.entries.insert(0, row("none", "none"));
    map.y.entries.extend(above);
}

/// Replaces the second axis by methods, and keeps the first five times, which take seconds.
fn by_method(map: &mut Map) {
    let first = map.x.entries.iter().take(5).cloned().collect();
    map.x.entries = first;
    let methods = [
        method("index1", "dop853", "none"),
        explicit(),
        method("ggl", "radau_iia", "none"),
        method("index1", "rk4", "none"),
        method("index1", "rk4", "manifold"),
    ];
    map.y = MapAxis { name: "method".to_string(), unit: String::new(), entries: methods.to_vec() };
}

fn fixed() -> Vec<AxisPlace> {
    let integrator = |name: &str| AxisPlace::named(name, vec![CellChange::Integrator(MethodSpec::named(name))]);
    vec![integrator("rk4"), integrator("heun")]
}

fn adaptive() -> Vec<AxisPlace> {
    vec![explicit(), method("ggl", "radau_iia", "none")]
}

fn explicit() -> AxisPlace {
    method("index1", "dop853", "manifold")
}

fn method(formulation: &str, integrator: &str, projection: &str) -> AxisPlace {
    let label = match (formulation, projection) {
        ("index1", projection) => format!("{integrator} {projection}"),
        (formulation, "none") => format!("{integrator} {formulation}"),
        _ => format!("{integrator} {formulation} {projection}"),
    };
    let formulation = MethodSpec::named(formulation);
    let integrator = MethodSpec::named(integrator);
    let projection = MethodSpec::named(projection);
    AxisPlace::named(
        &label,
        vec![CellChange::Integrator(integrator), CellChange::Stabilization(formulation, projection)],
    )
}
