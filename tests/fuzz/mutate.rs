//! Changes of a scene as a tree of values.

use crate::random::Random;
use crate::words;
use holonom::{integrator, projection};
use serde_json::{Value, json};

type Change = fn(&mut Value, &mut Random);

/// What is done to a scene; the more frequent ones twice.
const CHANGES: [Change; 29] = [
    magnitude,
    magnitude,
    magnitude,
    settings,
    settings,
    method,
    coincide,
    joint_again,
    lose,
    twice,
    exchange,
    number,
    number,
    number,
    expression,
    another_type,
    rename,
    reference,
    reference,
    extreme,
    extreme,
    coincide,
    joint_again,
    giant,
    settings,
    settings,
    own_parameter,
    nest,
    hostile,
];

pub fn mutate(scene: &mut Value, random: &mut Random) {
    let change = random.one(CHANGES);
    change(scene, random);
}

/// A part of another scene: elements of its lists behind those that are there, or a value at the place of one of the same
/// key.
pub fn splice(scene: &mut Value, other: &Value, random: &mut Random) {
    if random.is_one_in(2) {
        let list = random.one(["bodies", "joints", "forces", "outputs", "inputs"]);
        let Some(Value::Array(items)) = other.get(list) else { return };
        let count = random.below(items.len() + 1);
        if let Some(Value::Array(own)) = scene.get_mut(list) {
            own.extend(items.iter().take(count).cloned());
        }
        return;
    }
    let Some(from) = place(other, random, |_, _| true) else { return };
    let key = from.rsplit('/').next().unwrap_or_default().to_string();
    let to = place(scene, random, |at, _| at.rsplit('/').next() == Some(key.as_str()));
    set(scene, to, other.pointer(&from).cloned().unwrap_or_default());
}

/// Text that steers terminals, files or formats, for any text.
fn hostile(scene: &mut Value, random: &mut Random) {
    let at = place(scene, random, |_, value| value.is_string());
    set(scene, at, json!(words::hostile(random)));
}

/// JSON pointers of all values below the root that `is_wanted` accepts.
fn pointers(value: &Value, is_wanted: impl Fn(&str, &Value) -> bool) -> Vec<String> {
    let mut found = Vec::new();
    let mut open = vec![(String::new(), value)];
    while let Some((at, value)) = open.pop() {
        if !at.is_empty() && is_wanted(&at, value) {
            found.push(at.clone());
        }
        match value {
            Value::Array(items) => open.extend(items.iter().enumerate().map(|(i, item)| (format!("{at}/{i}"), item))),
            Value::Object(map) => {
                let escaped = |key: &str| key.replace('~', "~0").replace('/', "~1");
                open.extend(map.iter().map(|(key, value)| (format!("{at}/{}", escaped(key)), value)));
            }
            _ => {}
        }
    }
    found
}

/// A value below the root that is wanted, with its pointer.
fn place(scene: &Value, random: &mut Random, is_wanted: impl Fn(&str, &Value) -> bool) -> Option<String> {
    random.pick(&pointers(scene, is_wanted)).cloned()
}

fn set(scene: &mut Value, at: Option<String>, value: Value) {
    if let Some(place) = at.and_then(|at| scene.pointer_mut(&at)) {
        *place = value;
    }
}

fn is_leaf(_: &str, value: &Value) -> bool {
    !value.is_array() && !value.is_object()
}

fn lose(scene: &mut Value, random: &mut Random) {
    let Some(at) = place(scene, random, |_, _| true) else { return };
    let Some((parent, key)) = at.rsplit_once('/') else { return };
    match scene.pointer_mut(parent) {
        Some(Value::Array(items)) => {
            drop(key.parse().ok().filter(|i| *i < items.len()).map(|i: usize| items.remove(i)))
        }
        Some(Value::Object(map)) => drop(map.shift_remove(&key.replace("~1", "/").replace("~0", "~"))),
        _ => {}
    }
}

/// An item of a list stands there twice, with its name or another one.
fn twice(scene: &mut Value, random: &mut Random) {
    let at = place(scene, random, |_, value| value.as_array().is_some_and(|items| !items.is_empty()));
    let Some(Value::Array(items)) = at.and_then(|at| scene.pointer_mut(&at)) else { return };
    let mut copy = items[random.below(items.len())].clone();
    if let (Some(Value::String(name)), false) = (copy.get_mut("name"), random.is_one_in(3)) {
        name.push_str("_2");
    }
    items.insert(random.below(items.len() + 1), copy);
}

fn exchange(scene: &mut Value, random: &mut Random) {
    let all = pointers(scene, |_, _| true);
    let [from, to] = [random.pick(&all).cloned(), random.pick(&all).cloned()];
    let values = [&from, &to].map(|at| at.as_ref().and_then(|at| scene.pointer(at)).cloned().unwrap_or_default());
    let [first, second] = values;
    set(scene, to, first);
    set(scene, from, second);
}

fn number(scene: &mut Value, random: &mut Random) {
    let at = place(scene, random, |_, value| value.is_number());
    set(scene, at, words::number(random));
}

/// A number becomes much larger or smaller, or turns its sign: the scene may still be one.
fn magnitude(scene: &mut Value, random: &mut Random) {
    let at = place(scene, random, |_, value| value.is_number());
    let old = at.as_ref().and_then(|at| scene.pointer(at)).and_then(Value::as_f64).unwrap_or(1.0);
    let factor = random.one([-1.0, 1e-9, 1e-3, 0.1, 1.001, 3.0, 1e3, 1e9]);
    set(scene, at, json!(old * factor));
}

fn expression(scene: &mut Value, random: &mut Random) {
    let at = place(scene, random, is_leaf);
    set(scene, at, words::expression(random));
}

fn another_type(scene: &mut Value, random: &mut Random) {
    let at = place(scene, random, |_, _| true);
    set(scene, at, words::thing(random));
}

/// A key gets another name: that of another key, or a strange one.
fn rename(scene: &mut Value, random: &mut Random) {
    let all = pointers(scene, |_, _| true);
    let other = random.pick(&all).and_then(|at| at.rsplit('/').next()).unwrap_or("x").to_string();
    let name = if random.is_one_in(2) { other } else { words::word(random) };
    let at = place(scene, random, |_, value| value.as_object().is_some_and(|map| !map.is_empty()));
    let Some(Value::Object(map)) = at.and_then(|at| scene.pointer_mut(&at)) else { return };
    let old = map.keys().nth(random.below(map.len())).cloned().unwrap_or_default();
    let renamed = std::mem::take(map).into_iter();
    *map = renamed.map(|(key, value)| if key == old { (name.clone(), value) } else { (key, value) }).collect();
}

/// A text becomes another one of the same scene, so that names lead elsewhere or to themselves.
fn reference(scene: &mut Value, random: &mut Random) {
    let texts = pointers(scene, |_, value| value.is_string());
    let other = random.pick(&texts).and_then(|at| scene.pointer(at)).cloned();
    let value = other.filter(|_| !random.is_one_in(4)).unwrap_or_else(|| json!(words::word(random)));
    set(scene, random.pick(&texts).cloned(), value);
}

/// Masses, stiffnesses and lengths that no thing has.
fn extreme(scene: &mut Value, random: &mut Random) {
    const KEYS: [&str; 14] = [
        "mass",
        "inertia",
        "stiffness",
        "damping",
        "length",
        "free_length",
        "E",
        "nu",
        "rho",
        "radius",
        "height",
        "ratio",
        "velocity",
        "angular_velocity",
    ];
    let at = place(scene, random, |at, _| KEYS.iter().any(|key| at.ends_with(&format!("/{key}"))));
    let value = words::number(random);
    let old = at.as_ref().and_then(|at| scene.pointer(at)).cloned();
    set(scene, at, old.as_ref().and_then(Value::as_array).map_or(value.clone(), |old| json!(vec![value; old.len()])));
}

/// Two markers, or two positions, are one.
fn coincide(scene: &mut Value, random: &mut Random) {
    let points =
        pointers(scene, |at, value| value.is_array() && (at.contains("/markers/") || at.ends_with("/position")));
    let from = random.pick(&points).and_then(|at| scene.pointer(at)).cloned().unwrap_or_default();
    let to = random.pick(&points).cloned();
    set(scene, to, from);
}

/// A joint that is there already: redundant, or between other markers and so perhaps impossible.
fn joint_again(scene: &mut Value, random: &mut Random) {
    let ends = pointers(scene, |at, value| at.contains("/between/") && value.is_string());
    let other = random.pick(&ends).and_then(|at| scene.pointer(at)).cloned();
    let Some(Value::Array(joints)) = scene.get_mut("joints") else { return };
    let Some(mut joint) = random.pick(joints).filter(|joint| joint.is_object()).cloned() else { return };
    joint["name"] = json!(format!("again{}", joints.len()));
    if let (Some(end), Some(other), true) = (joint.pointer_mut("/between/0"), other, random.is_one_in(2)) {
        *end = other;
    }
    joints.push(joint);
}

/// Far too much of something.
fn giant(scene: &mut Value, random: &mut Random) {
    const COUNTS: [&str; 4] = ["/elements", "/modes", "/nodes", "/count"];
    let count = place(scene, random, |at, _| COUNTS.iter().any(|key| at.ends_with(key)));
    if count.is_some() && random.is_one_in(2) {
        let value = json!(random.one([1e9, 1e18, 40.0, -5.0, 0.5, 1e5]));
        return set(scene, count, value);
    }
    let at = place(scene, random, |_, value| value.as_array().is_some_and(|items| !items.is_empty()));
    // Ten thousand joints on one body are no fault, and take their time.
    let is_element = at.as_ref().is_some_and(|at| at.matches('/').count() == 1);
    let count = if is_element { 100 } else { random.one([100, 1000, 10_000]) };
    let Some(Value::Array(items)) = at.and_then(|at| scene.pointer_mut(&at)) else { return };
    let item = items[random.below(items.len())].clone();
    let named = |i: usize| {
        let mut copy = item.clone();
        if let Some(Value::String(name)) = copy.get_mut("name") {
            name.push_str(&format!("_{i}"));
        }
        copy
    };
    items.extend((0..count).map(named));
}

/// How to simulate: any method, and any numbers.
fn settings(scene: &mut Value, random: &mut Random) {
    let Some(scene) = scene.as_object_mut() else { return };
    let settings = scene.entry("simulation").or_insert(json!({}));
    let Some(settings) = settings.as_object_mut() else { return };
    match random.below(5) {
        0 => settings.insert("t_end".into(), json!(random.one([1e300, 1e-300, 0.0, -1.0, 1e9]))),
        1 => settings.insert("output_step".into(), json!(random.one([1e-300, 1e300, 1e-6, 0.0]))),
        2 => settings.insert("rtol".into(), json!(random.one([1e-300, 1e300, 1e-16, 1.0, 0.0]))),
        3 => settings.insert("atol".into(), json!(random.one([1e-300, 1e300, 1e-16, 1.0, 0.0]))),
        _ => settings.insert("step".into(), json!(random.one([1e-300, 1e300, 1e-9, 1.0, 1e-3]))),
    };
}

/// Another method, one that goes together.
fn method(scene: &mut Value, random: &mut Random) {
    let Some(Value::Object(settings)) = scene.get_mut("simulation") else { return };
    let Some(integrator) = random.pick(integrator::registry()) else { return };
    let formulations: Vec<&str> = integrator.accepts().collect();
    let Some(formulation) = random.pick(&formulations) else { return };
    let Some(projection) = random.pick(projection::registry()) else { return };
    if integrator.steps == integrator::Steps::Fixed {
        settings.insert("step".into(), json!(random.one([1e-3, 1e-2, 0.1])));
    } else {
        settings.shift_remove("step");
    }
    settings.insert("formulation".into(), json!(formulation));
    settings.insert("integrator".into(), json!(integrator.name));
    settings.insert("projection".into(), json!(projection.name));
}

/// Parameters that lead to themselves, at once or over others.
fn own_parameter(scene: &mut Value, random: &mut Random) {
    let Some(Value::Object(parameters)) = scene.get_mut("parameters") else { return };
    let names: Vec<String> = parameters.keys().cloned().collect();
    let [Some(first), Some(second)] = [random.pick(&names), random.pick(&names)] else { return };
    parameters.insert(first.clone(), json!(format!("2*{second} + {first}")));
}

/// Brackets within brackets.
fn nest(scene: &mut Value, random: &mut Random) {
    let depth = random.one([10, 100, 120]);
    let nested = (0..depth).fold(json!(1), |inner, i| if i % 2 == 0 { json!([inner]) } else { json!({ "a": inner }) });
    let at = place(scene, random, |_, _| true);
    set(scene, at, nested);
}
