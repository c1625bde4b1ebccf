//! What a scene says is shown, not obeyed.

use crate::cli::{PENDULUM, Place, err, out};
use serde_json::Value;

/// Escape, bell, NUL, a control sequence of one character, a right-to-left override and an isolate.
const HOSTILE: &str = "\u{1b}[2J\u{7}\0\u{9b}31m\u{202e}x\u{2067}\r";

fn is_plain(text: &str) -> bool {
    let turns = |c: char| matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{200e}' | '\u{200f}');
    !text.chars().any(|c| c.is_control() && c != '\n' || turns(c))
}

fn changed(change: impl FnOnce(&mut Value)) -> Place {
    let mut scene: Value = serde_json::from_str(PENDULUM).unwrap();
    change(&mut scene);
    Place::new(scene.to_string())
}

#[test]
fn names_titles_and_units_are_escaped() {
    let place = changed(|scene| {
        scene["outputs"][0]["unit"] = HOSTILE.into();
        scene["outputs"].as_array_mut().unwrap().push(serde_json::json!(
            { "name": "odd", "expression": "sqrt(-1 - t)", "unit": HOSTILE }
        ));
    });
    for args in [&["check", "scene.json"][..], &["simulate", "scene.json"], &["simulate", "scene.json", "--json"]] {
        let output = place.run(args);
        assert!(is_plain(&out(&output)) && is_plain(&err(&output)), "{args:?}: {:?} {:?}", out(&output), err(&output));
    }
}

#[test]
fn quotations_are_escaped() {
    type Change = fn(&mut Value);
    let changes: [Change; 6] = [
        |scene| scene["bodies"][0]["type"] = HOSTILE.into(),
        |scene| scene["bodies"][0]["mass"] = HOSTILE.into(),
        |scene| scene["bodies"][0]["name"] = HOSTILE.into(),
        |scene| scene["joints"][0]["between"][1] = HOSTILE.into(),
        |scene| scene["simulation"]["formulation"] = HOSTILE.into(),
        |scene| scene[HOSTILE] = 1.into(),
    ];
    for (i, change) in changes.into_iter().enumerate() {
        let output = changed(change).run(&["check", "scene.json"]);
        let message = err(&output);
        assert_eq!(output.status.code(), Some(2), "{i}: {message:?}");
        assert!(is_plain(&message), "{i}: {message:?}");
        assert!(message.contains("\\u001b"), "{i}: {message:?}");
    }
}

/// What is escaped for the terminal means the same as JSON.
#[test]
fn json_says_what_was_typed() {
    let place = Place::new(PENDULUM);
    let name = "a\u{202e}b.json";
    std::fs::rename(place.path("scene.json"), place.path(name)).unwrap();
    let text = place.done(&["simulate", name, "--json"]);
    let written = place.json("out/pendulum/summary.json");
    assert!(is_plain(&text) && text.contains("\\u202e"), "{text}");
    assert_eq!(serde_json::from_str::<Value>(&text).unwrap(), written);
    assert_eq!(written["command"][2], name);
}
