use super::*;
use crate::common::json_schema::faults;

fn schema() -> Value {
    serde_json::from_str(&Place::new("").done(&["schema"])).unwrap()
}

fn models() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("models")
}

#[test]
fn the_committed_schema_is_that_of_the_program() {
    let path = models().join("scene.schema.json");
    let committed = fs::read_to_string(&path).unwrap();
    let ours = Place::new("").done(&["schema"]);
    assert!(committed == ours, "run `holonom schema > models/scene.schema.json`");
}

#[test]
fn every_shipped_scene_is_valid() {
    let schema = schema();
    let scenes = files(&models()).into_iter().filter(|name| name.ends_with(".json") && name != "scene.schema.json");
    for name in scenes {
        let scene: Value = serde_json::from_str(&fs::read_to_string(models().join(&name)).unwrap()).unwrap();
        let faults = faults(&schema, &scene);
        assert!(faults.is_empty(), "{name}: {faults:#?}");
    }
}

#[test]
fn generated_scenes_are_valid() {
    let schema = schema();
    for name in ["chain", "flexible_chain", "n_four_bar"] {
        let scene: Value = serde_json::from_str(&Place::new("").done(&["generate", name])).unwrap();
        assert_eq!(faults(&schema, &scene), [""; 0], "{name}");
    }
    assert_eq!(faults(&schema, &serde_json::from_str(&parallelogram()).unwrap()), [""; 0]);
}

#[test]
fn slips_are_not_valid() {
    let schema = schema();
    assert_eq!(faults(&schema, &serde_json::from_str(PENDULUM).unwrap()), [""; 0]);
    let slips = [
        ("gravity", "gravty"),
        ("inertia", "inertai"),
        ("between", "betwen"),
        ("\"initial\"", "\"intial\""),
        ("\"position\"", "\"positon\""),
        ("t_end", "tend"),
        ("\"measure\"", "\"mesure\""),
        ("revolute", "revolut"),
        ("\"dimension\": 2", "\"dimension\": 4"),
        ("\"mass\": 1", "\"mass\": null"),
        ("\"dimension\": 2, ", ""),
    ];
    for (right, wrong) in slips {
        assert!(PENDULUM.contains(right), "{right}");
        let scene: Value = serde_json::from_str(&PENDULUM.replacen(right, wrong, 1)).unwrap();
        assert!(!faults(&schema, &scene).is_empty(), "{wrong}");
    }
}

/// Names of methods and units as the registries have them, however they may be written.
#[test]
fn methods_and_units_are_those_that_exist() {
    let schema = schema();
    let faulty = |simulation: &str, unit: &str| {
        let unit = format!(r#""measure": "angle", "unit": "{unit}""#);
        let scene = PENDULUM.replace(r#""measure": "angle""#, &unit);
        let scene = scene.replace(r#""t_end": 1"#, &format!(r#""t_end": 1, {simulation}"#));
        let is_refused = Place::new(&scene).run(&["check", "scene.json"]).status.code() == Some(2);
        (!faults(&schema, &serde_json::from_str(&scene).unwrap()).is_empty(), is_refused)
    };
    let all = Place::new("").done(&["methods", "--json"]);
    let all: Value = serde_json::from_str(&all).unwrap();
    for triple in all["triples"].as_array().unwrap().iter().step_by(7) {
        let name = |key: &str| triple[key].as_str().unwrap();
        let [f, i, p] = ["formulation", "integrator", "projection"].map(name);
        let step = if ["heun", "rk4", "rattle", "ali3p"].contains(&i) || i.starts_with("hem") {
            r#", "step": 0.01"#
        } else {
            ""
        };
        let simulation = format!(r#""formulation": "{f}", "integrator": "{i}", "projection": "{p}"{step}"#);
        assert_eq!(faulty(&simulation, "deg"), (false, false), "{simulation}");
    }
    for right in [
        r#""formulation": "baumgarte:alpha=5,beta=5""#,
        r#""formulation": { "baumgarte": { "alpha": 5 } }"#,
        r#""formulation": "ggl", "integrator": "radau-iia", "projection": "none""#,
    ] {
        assert_eq!(faulty(right, "°"), (false, false), "{right}");
    }
    for wrong in [
        r#""integrator": "ode45""#,
        r#""formulation": "bamgarte:alpha=5""#,
        r#""formulation": { "baumgarte": { "alfa": 5 } }"#,
        r#""projection": "manifolds""#,
    ] {
        assert_eq!(faulty(wrong, "rad"), (true, true), "{wrong}");
    }
    assert_eq!(faulty(r#""rtol": 1e-8"#, "kN"), (true, true));
}
