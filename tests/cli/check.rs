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
