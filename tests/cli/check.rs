use super::*;

#[test]
fn a_pendulum() {
    let place = Place::new(PENDULUM);
    let text = place.done(&["check", "scene.json"]);
    let first = "pendulum: 3 coordinates, 3 velocities, 2 constraints of rank 2, 1 degree of freedom\n";
    assert!(text.starts_with(first), "{text}");
    for word in
        ["rod   rigid  x y angle", "A      revolute  x y", "push   applied_force", "left out: the third dimension"]
    {
        assert!(text.contains(word), "{word} in\n{text}");
    }
    assert_eq!(place.files("."), ["scene.json"]);
}

#[test]
fn a_redundant_joint_is_named() {
    let text = Place::new(parallelogram()).done(&["check", "scene.json"]);
    assert!(text.starts_with("parallelogram: 12 coordinates, 12 velocities, 12 constraints of rank 11, 1 degree"));
    assert!(
        text.contains("redundant constraints (consistent; multipliers of least norm are computed):\n  joint `end2`")
    );
    // Of the rows that are not redundant: a number.
    assert!(text.contains("condition of the saddle-point matrix") && !text.contains("infinite"), "{text}");
}

#[test]
fn json_has_all_of_it() {
    let place = Place::new(parallelogram());
    let check: Value = serde_json::from_str(&place.done(&["check", "scene.json", "--json"])).unwrap();
    let expected = [
        "scene",
        "dimension",
        "coordinates",
        "velocities",
        "constraints",
        "rank",
        "rank_beside",
        "degrees_of_freedom",
        "redundant",
        "assembly",
        "start",
        "condition",
        "distance_to_singularity",
        "mass_range",
        "fastest_mode",
        "length_scale",
        "bodies",
        "joints",
        "forces",
        "left_out",
        "hints",
    ];
    assert_eq!(keys(&check), expected);
    assert_eq!((&check["rank"], &check["degrees_of_freedom"]), (&11.into(), &1.into()));
    let row = &check["redundant"][0];
    assert_eq!(keys(row), ["joint", "row", "follows_from"]);
    assert_eq!((&row["joint"], check["redundant"].as_array().unwrap().len()), (&"end2".into(), 1));
    assert!(row["follows_from"].as_array().unwrap().len() > 1);
}

#[test]
fn what_assembly_moved_is_told() {
    let place = Place::new(PENDULUM.replace(r#""position": [0.5, 0]"#, r#""position": [0.4, 0.3]"#));
    let text = place.done(&["check", "scene.json"]);
    assert!(text.contains("start: |phi| 6.0e-1 -> ") && text.contains("moved rod."), "{text}");
    assert_eq!(place.done(&["check", "scene.json", "--quiet"]), "");
}

#[test]
fn a_static_equilibrium_shows_its_forces() {
    let place = Place::new(include_str!("../../models/five_link_suspension.json"));
    let text = place.done(&["check", "scene.json"]);
    assert!(text.contains("static equilibrium: at rest, accelerations below"), "{text}");
    let check: Value = serde_json::from_str(&place.done(&["check", "scene.json", "--json"])).unwrap();
    assert_eq!(check["start"]["is_equilibrium"], true);
    // Published to a tenth of a newton.
    for (rod, force) in [-860.2, -3177.2, -197.0, 2553.5, 2034.8].into_iter().enumerate() {
        let found = check["start"]["outputs"][format!("rod{}_force", rod + 1)].as_f64().unwrap();
        assert!((found - force).abs() < 0.06, "{rod}: {found}");
    }
    let falling = Place::new(PENDULUM).done(&["check", "scene.json"]);
    assert!(falling.contains("at rest, accelerations up to") && !falling.contains("equilibrium"), "{falling}");
}

/// A four-bar whose coupler hardly weighs anything: in no motion does it have a part of the energy.
#[test]
fn a_light_link_looks_superfluous_and_a_heavy_one_does_not() {
    let of = |mass: f64| {
        let link = |name: &str, mass: f64, inertia: f64, [x, y]: [f64; 2], turn: f64| {
            serde_json::json!({ "name": name, "type": "rigid", "mass": mass, "inertia": inertia,
                "markers": { "A": [-0.5, 0], "B": [0.5, 0] }, "initial": { "position": [x, y], "angle": turn } })
        };
        let pin =
            |name: &str, a: &str, b: &str| serde_json::json!({ "name": name, "type": "revolute", "between": [a, b] });
        let scene = serde_json::json!({
            "name": "four_bar", "dimension": 2, "gravity": [0, -9.81], "ground": { "markers": { "O": [0, 0], "C": [1, 0] } },
            "bodies": [link("crank", 1.0, 0.1, [0.25, 0.4], 1.0), link("coupler", mass, 0.1 * mass, [1.0, 0.85], 0.0),
                       link("rocker", 1.0, 0.1, [1.25, 0.4], 1.0)],
            "joints": [pin("O", "ground.O", "crank.A"), pin("A", "crank.B", "coupler.A"), pin("B", "coupler.B", "rocker.B"),
                       pin("C", "ground.C", "rocker.A")],
            "outputs": [{ "name": "angle", "measure": "angle", "of": "crank" }],
            "simulation": { "t_end": 1 }
        });
        let place = Place::new(scene.to_string());
        let told: Value = serde_json::from_str(&place.done(&["check", "scene.json", "--json"])).unwrap();
        (place.done(&["check", "scene.json"]), told["hints"].clone())
    };
    let (text, hints) = of(1e-6);
    assert!(text.contains("\n  coupler becomes a distance without mass: it has "), "{text}");
    let link = hints["changes"].as_array().unwrap().iter().find(|hint| hint["candidate"] == "two_force_link").unwrap();
    // A parallelogram: the coupler has the velocity of the tips of the others, which turn about their ends, l = 1.
    let share = 1e-6 / (2.0 * (0.1 + 0.25) + 1e-6);
    let estimated = link["estimated"].as_f64().unwrap();
    assert!((estimated / share - 1.0).abs() < 1e-9, "{estimated} {share}");
    assert!(!of(1.0).0.contains("superfluous"));
}

/// A weight on a tie and a strut, which is a body: by statics they carry m g sqrt(2) and -m g.
#[test]
fn rods_that_pull_are_told_from_those_that_push() {
    let mut scene = serde_json::json!({
        "name": "bracket", "dimension": 2, "gravity": [0, -9.81],
        "ground": { "markers": { "top": [0, 1], "foot": [0, 0] } },
        "bodies": [{ "name": "weight", "type": "rigid", "mass": 2, "inertia": 0.1, "markers": { "C": [0, 0] },
                     "initial": { "position": [1, 0] } },
                   { "name": "strut", "type": "rigid", "mass": 1e-9, "inertia": 1e-10,
                     "markers": { "A": [-0.5, 0], "B": [0.5, 0] }, "initial": { "position": [0.5, 0] } }],
        "joints": [{ "name": "A", "type": "revolute", "between": ["ground.foot", "strut.A"] },
                   { "name": "B", "type": "revolute", "between": ["strut.B", "weight.C"] },
                   { "name": "tie", "type": "distance", "between": ["ground.top", "weight.C"], "length": "sqrt(2)" }],
        "outputs": [{ "name": "rod", "measure": "angle", "of": "weight" }],
        "simulation": { "t_end": 1 }
    });
    let place = Place::new(scene.to_string());
    let text = place.done(&["check", "scene.json"]);
    assert!(text.contains("ropes would do: tie by 27.75 N\n") && text.contains("not do: strut by 19.62 N\n"), "{text}");
    let told: Value = serde_json::from_str(&place.done(&["check", "scene.json", "--json"])).unwrap();
    let rods = told["hints"]["rods"].as_array().unwrap();
    // The strut weighs 1e-9 of what it carries, half of which is at its end.
    for (rod, name, force) in [(&rods[0], "tie", 19.62 * 2.0f64.sqrt()), (&rods[1], "strut", -19.62)] {
        let found = rod["at_start"].as_f64().unwrap();
        assert!(rod["name"] == name && (found / force - 1.0).abs() < 1e-8, "{rod}");
    }
    // A second tie beside the first: how they share the load is not determined.
    scene["joints"].as_array_mut().unwrap().push(serde_json::json!(
        { "name": "again", "type": "distance", "between": ["ground.top", "weight.C"], "length": "sqrt(2)" }));
    let text = Place::new(scene.to_string()).done(&["check", "scene.json"]);
    assert!(text.contains("redundant") && !text.contains("rods that"), "{text}");
}

/// Two pendulums of which one is watched: the mode of the other is seen by nothing.
#[test]
fn a_mode_that_no_output_sees_is_told() {
    let place = Place::new(
        r#"{ "name": "two", "dimension": 2, "gravity": [0, -9.81], "ground": { "markers": { "O": [0, 0], "P": [9, 0] } },
        "bodies": [{ "name": "short", "type": "point_mass", "mass": 1, "initial": { "position": [0, -1] } },
                   { "name": "long", "type": "point_mass", "mass": 1, "initial": { "position": [9, -4] } }],
        "joints": [{ "name": "a", "type": "distance", "between": ["ground.O", "short"], "length": 1 },
                   { "name": "b", "type": "distance", "between": ["ground.P", "long"], "length": 4 }],
        "outputs": [{ "name": "x", "measure": "position", "of": "short", "component": "x" }],
        "simulation": { "t_end": 1 } }"#,
    );
    let text = place.done(&["check", "scene.json"]);
    // sqrt(g/l)
    assert!(text.contains("an output may be missing: no output sees the mode at 1.57 1/s (long)\n"), "{text}");
}

/// Those of the suspension as bodies, and without mass: the motions about the start go as far where a rod turns fast.
#[test]
fn rods_pull_with_and_without_mass() {
    let pulling = |name: &str| -> Vec<String> {
        let scene = std::fs::read_to_string(crate::scenes::model(name)).unwrap();
        let told: Value = serde_json::from_str(&Place::new(scene).done(&["check", "scene.json", "--json"])).unwrap();
        let rods = told["hints"]["rods"].as_array().unwrap().iter();
        rods.filter(|rod| rod["least"].as_f64().unwrap() > 0.0).map(|rod| rod["name"].to_string()).collect()
    };
    let with_mass = pulling("five_link_suspension_rods");
    assert!(with_mass.len() == 2 && with_mass == pulling("five_link_suspension"), "{with_mass:?}");
}
