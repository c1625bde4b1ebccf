//! `holonom reference`: what a scene may say.

use super::*;

#[test]
fn every_key_and_type_of_the_schema_is_a_topic() {
    let place = Place::new("");
    let schema: Value = serde_json::from_str(&place.done(&["schema"])).unwrap();
    let all = place.done(&["reference"]);
    let properties = schema["properties"].as_object().unwrap();
    for key in properties.keys().filter(|key| !key.starts_with('$')) {
        assert!(all.contains(&format!("\n  {key}")), "{key}");
        assert!(!place.done(&["reference", key]).is_empty());
    }
    for key in ["bodies", "joints", "forces"] {
        for kind in properties[key]["items"]["oneOf"].as_array().unwrap() {
            let name = kind["properties"]["type"]["const"].as_str().unwrap();
            let text = place.done(&["reference", name]);
            assert!(all.contains(&format!("\n  {name} ")), "{name}");
            assert!(text.starts_with(&format!("{name}: ")), "{text}");
            for own in kind["properties"].as_object().unwrap().keys() {
                assert!(text.contains(&format!("\n  {own}")), "{name}: {own}");
            }
        }
    }
    let rigid = place.done(&["reference", "rigid"]);
    assert!(rigid.contains("\ninitial\n  { position, ") && rigid.contains("\n  position\n"), "{rigid}");
    let gravity = place.done(&["reference", "gravity"]);
    assert!(
        gravity.starts_with("gravity: Uniform: a vector, m/s^2; or towards") && gravity.contains("\n  mu "),
        "{gravity}"
    );
    assert!(rigid.contains("\nshapes\n  { box, ") && rigid.contains("\n  box\n"), "{rigid}");
    assert!(place.done(&["reference", "simulation"]).contains("tr_bdf2, esdirk34"));
    assert!(place.done(&["reference", "units"]).contains("rad/s, deg/s, rev/s, rpm"));
    assert!(all.contains("  distance_rate         between, of "), "{all}");
}

/// Each form of a name in the table stands in an output of a scene.
#[test]
fn every_name_of_the_page_is_one() {
    let text = Place::new("").done(&["reference", "expressions"]);
    let table = text.split("\nNames\n").nth(1).unwrap();
    let rows = table.lines().skip(2).take_while(|line| line.starts_with("  "));
    let names = rows.filter_map(|row| row.trim().split("  ").next()).flat_map(|cell| cell.split(", "));
    let names: Vec<String> = names.map(|name| name.trim().to_string()).collect();
    assert!(names.len() > 10, "{names:?}");
    let planar = PENDULUM.replace(
        r#""gravity""#,
        r#""parameters": { "p": 1 }, "states": [ { "name": "xi", "rate": "-xi" } ], "gravity""#,
    );
    let spatial = include_str!("../../models/spinning_top.json");
    for name in names {
        let is_spatial = name.contains(".w") || name.ends_with(".z");
        let (scene, body) = if is_spatial { (spatial, "top") } else { (planar.as_str(), "rod") };
        let name = name
            .replace("PARAMETER", "p")
            .replace("OUTPUT", "theta")
            .replace("STATE", "xi")
            .replace("MARKER", "A")
            .replace("BODY", body);
        let output = format!(r#""outputs": [ {{ "name": "own", "measure": "expression", "value": "{name}" }},"#);
        let place = Place::new(scene.replacen(r#""outputs": ["#, &output, 1));
        place.done(&["check", "scene.json"]);
    }
}

#[test]
fn unknown_topics_are_refused() {
    let output = Place::new("").run(&["reference", "revolut"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(err(&output), "error: there is no topic `revolut`\n  help: did you mean `revolute`?\n");
}

/// Keys of elements, measures and words for them are topics of their own, with what they contain.
#[test]
fn keys_of_elements_and_measures_are_topics() {
    let place = Place::new(PENDULUM);
    let topic = |name: &str| place.done(&["reference", name]);
    for (name, words) in [
        ("section", &["section of flexible_beam", "rectangle", "height", "width"][..]),
        ("damping", &["damping of ", "rayleigh", "modal", "stiffness"]),
        ("markers", &["markers of ", "position", "z_axis"]),
        ("shapes", &["shapes of rigid", "cylinder", "density"]),
        ("reaction", &["measure reaction", "component", "on", "unit"]),
        ("unit", &["angle", "deg", "N m"]),
        ("measures", &["reaction", "bending_moment"]),
        ("flexible_beam", &["rectangle", "rayleigh"]),
    ] {
        let text = topic(name);
        words.iter().for_each(|word| assert!(text.contains(word), "{name}: no {word} in {text}"));
        assert!(name == "measures" || text.lines().all(|line| line.chars().count() <= 130), "{text}");
    }
}
