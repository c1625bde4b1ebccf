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
