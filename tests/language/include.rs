//! Scenes in scenes: the same motion as alone, and errors in the file where they are written.

use holonom::prepared::{Model, Overrides};
use holonom::scene::Scene;
use std::fs;
use std::path::Path;

const LEG: &str = r#"{
  "name": "leg", "dimension": 2, "gravity": [0, -9.81],
  "parameters": { "l": 1, "m": "2*l", "n": 2 },
  "ground": { "markers": { "O": [0, 0], "P{i}": { "repeat": { "i": "1..n" }, "position": ["l*{i}", 0] } } },
  "bodies": [{ "name": "rod", "type": "rigid", "mass": "m", "inertia": "m*l^2/12", "markers": { "A": ["-l/2", 0], "B": ["l/2", 0] },
    "initial": { "position": ["l/2", 0] } }],
  "joints": [{ "name": "A", "type": "revolute", "between": ["ground.O", "rod.A"] }],
  "forces": [{ "name": "spring{i}", "repeat": { "i": "1..n" }, "type": "spring_damper", "between": ["ground.P{i}", "rod.B"],
    "stiffness": "10*{i}", "free_length": "l" },
    { "name": "push", "type": "applied_torque", "at": "rod", "torque": "m*sin(3*t) - 1e-1*rod.angle' + lag" }],
  "signals": [{ "name": "gust", "points": [[0, 0], [0.4, 1], [0.9, "l/2"], [1.5, 0.2]] }],
  "states": [{ "name": "lag", "rate": "gust(t) - lag" }],
  "inputs": [{ "name": "u", "force": "push" }],
  "outputs": [{ "name": "theta", "measure": "angle", "of": "rod" },
    { "name": "twice", "measure": "expression", "value": "2*theta + rod.B.x*l" }],
  "initial": { "A.angle": -0.3 }
}"#;

const MAIN: &str = r#"{
  "name": "main", "dimension": 2, "gravity": [0, -9.81], "parameters": { "a": 0.5 },
  "bodies": [],
  "include": [{ "file": "parts/leg.json", "as": "left" },
    { "file": "parts/leg.json", "as": "right", "parameters": { "l": "a + 0.25", "n": 1 } }]
}"#;

fn folder(main: &str, leg: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("parts")).unwrap();
    fs::write(folder.path().join("main.json"), main).unwrap();
    fs::write(folder.path().join("parts/leg.json"), leg).unwrap();
    folder
}

fn load(path: &Path, set: &[(&str, f64)]) -> holonom::Result<crate::scenes::Ready> {
    let set = set.iter().map(|(name, value)| (name.to_string(), (*value).into())).collect();
    Model::load_with(path, &Overrides { set, ..Overrides::default() }).map(crate::scenes::Ready)
}

#[track_caller]
fn same(both: &crate::scenes::Ready, leg: &crate::scenes::Ready, prefix: &str) {
    let [both, leg] = [both, leg].map(|ready| ready.tight(1e-11, 1.0, 0.1));
    for column in ["rod.x", "rod.angle'", "theta", "twice"] {
        let pairs = both.column(&format!("{prefix}_{column}")).into_iter().zip(leg.column(column));
        let error = pairs.fold(0.0f64, |worst, (a, b)| worst.max((a - b).abs()));
        assert!(error < 1e-9, "{prefix} {column}: {error:e}");
    }
}

#[test]
fn included_scenes_move_as_alone() {
    let folder = folder(MAIN, LEG);
    let [main, leg] = ["main.json", "parts/leg.json"].map(|name| folder.path().join(name));
    let both = load(&main, &[]).unwrap();
    same(&both, &load(&leg, &[]).unwrap(), "left");
    same(&both, &load(&leg, &[("l", 0.75), ("n", 1.0)]).unwrap(), "right");
    let parameters: Vec<(&str, f64)> = both.0.parameters.iter().collect();
    let right = [("right_l", 0.75), ("right_m", 1.5), ("right_n", 1.0)];
    assert_eq!(parameters, [&[("a", 0.5), ("left_l", 1.0), ("left_m", 2.0), ("left_n", 2.0)][..], &right].concat());
    // A value for an included parameter, which also repeats.
    let set = load(&main, &[("left_n", 3.0), ("left_l", 0.6)]).unwrap();
    same(&set, &load(&leg, &[("n", 3.0), ("l", 0.6)]).unwrap(), "left");
}

#[test]
fn what_is_included_is_joined_by_its_names() {
    let spring = r#""bodies": [], "forces": [{ "name": "link", "type": "spring_damper", "between": ["left_rod.B", "ground.right_P1"],
        "stiffness": "left_l*100" }],"#;
    let folder = folder(&MAIN.replace(r#""bodies": [],"#, spring), LEG);
    let ready = load(&folder.path().join("main.json"), &[]).unwrap();
    let columns = ready.tight(1e-9, 0.1, 0.1).record.trajectory.headings().join(" ");
    assert!(columns.contains("left_rod.x") && columns.contains("joint.right_A.x"), "{columns}");
    // Two levels, each with its prefix.
    let top = r#"{ "name": "top", "dimension": 2, "bodies": [], "include": [{ "file": "main.json", "as": "up" }] }"#;
    fs::write(folder.path().join("top.json"), top).unwrap();
    let top = load(&folder.path().join("top.json"), &[("up_left_l", 0.8)]).unwrap();
    let parameters: Vec<(&str, f64)> = top.0.parameters.iter().collect();
    assert!(parameters.contains(&("up_left_m", 1.6)) && parameters.contains(&("up_right_l", 0.75)), "{parameters:?}");
    assert!(top.system().facts().names.q.contains(&"up_right_rod.angle".to_string()));
}

#[test]
fn faults_are_told_in_their_file() {
    let message = |main: &str, leg: &str| {
        let folder = folder(main, leg);
        load(&folder.path().join("main.json"), &[]).map(|_| ()).unwrap_err().to_string()
    };
    let leg = |from: &str, to: &str| {
        assert!(LEG.contains(from), "{from}");
        message(MAIN, &LEG.replacen(from, to, 1))
    };
    let wrong = leg(r#""mass": "m""#, r#""mass": "-m""#);
    assert!(wrong.contains("leg.json:5:") && wrong.contains("at bodies[0].mass (`left_rod`): mass is -2"), "{wrong}");
    let wrong = leg("10*{i}", "10 - 10*{i}^2");
    assert!(wrong.contains("leg.json:") && wrong.contains("at forces[0].stiffness (`left_spring2`): "), "{wrong}");
    let wrong = leg("ground.O", "ground.Q");
    assert!(wrong.contains("leg.json:") && wrong.contains("at joints[0].between[0] (`left_A`): "), "{wrong}");
    let wrong = leg("{ \"l\": 1,", "{ \"l\": 1 ");
    assert!(wrong.contains("leg.json:3:") && wrong.contains("this is not JSON"), "{wrong}");
    let wrong = leg("\"dimension\": 2", "\"dimension\": 3");
    assert!(wrong.contains("leg.json:2:") && wrong.contains("the dimension is not that of the scene"), "{wrong}");
    let wrong = leg("\"initial\": { \"A", "\"initals\": { \"A");
    assert!(wrong.contains("a scene with `initals` cannot be included"), "{wrong}");
    let main = |from: &str, to: &str| {
        assert!(MAIN.contains(from), "{from}");
        message(&MAIN.replacen(from, to, 1), LEG)
    };
    let wrong = main("parts/leg.json", "parts/log.json");
    assert!(
        wrong.contains("main.json:4:") && wrong.contains("at include[0].file: `parts/log.json`: there is no such file")
    );
    let wrong = main("\"n\": 1", "\"k\": 1");
    assert!(wrong.contains("at include[1].parameters: the included scene has no parameter `k`"), "{wrong}");
    let wrong = main("\"left\"", "\"left.\"");
    assert!(wrong.contains("at include[0].as: `left.` cannot be a name"), "{wrong}");
    let wrong = main("\"right\"", "\"left\"");
    assert!(wrong.contains("at include[1].as: the name `left_l` is taken"), "{wrong}");
    let wrong = main("parts/leg.json", "main.json");
    assert!(wrong.contains("at include[0].file: `main.json` includes itself"), "{wrong}");
    assert!(Scene::parse(MAIN, &[]).map(|_| ()).unwrap_err().to_string().contains("there is no such file"));
}

/// Ten files that each include the next ten times stand for ten thousand million bodies: refused before they are read.
#[test]
fn includes_that_multiply_are_refused() {
    let place = tempfile::tempdir().unwrap();
    let body = r#"{ "name": "b", "type": "point_mass", "mass": 1 }"#;
    for level in 0..11 {
        let include = |k: usize| format!(r#"{{ "file": "s{}.json", "as": "a{k}" }}"#, level + 1);
        let includes = if level < 10 { (0..10).map(include).collect::<Vec<_>>().join(", ") } else { String::new() };
        let scene = format!(r#"{{ "name": "s", "dimension": 2, "bodies": [{body}], "include": [{includes}] }}"#);
        fs::write(place.path().join(format!("s{level}.json")), scene).unwrap();
    }
    let error = Scene::load(&place.path().join("s0.json"), &[]).map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("more than 10000 scenes are included"), "{error}");
}
