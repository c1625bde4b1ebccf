use super::*;

#[test]
fn a_map_of_ones_own_is_written() {
    let place = Place::new(PENDULUM);
    let args = [
        "stress",
        "scene.json",
        "--x",
        "step=1e-3..1e-1:3:log",
        "--y",
        "gain=1..1e4:3:log",
        "--integrator",
        "rk4",
        "--step",
        "0.01",
    ];
    let text = place.done(&[&args[..], &["-o", "here"]].concat());
    assert!(text.starts_with("pendulum: extremes, ") && text.contains("of 9 cells completed"), "{text}");
    assert_eq!(place.files("here"), ["stress-step_gain.svg", "stress.csv", "stress.json", "stress.md"]);
    let json = place.json("here/stress.json");
    assert_eq!(
        keys(&json)[4..],
        ["scene", "method", "typical_step", "typical_period", "wall_seconds", "maps", "files"]
    );
    let cells = json["maps"][0]["cells"].as_array().unwrap();
    let statuses: Vec<&str> = cells.iter().map(|cell| cell["status"].as_str().unwrap()).collect();
    // Gains of 1e4 1/s are unstable but at the smallest step of these, and there too.
    assert_eq!(statuses[..3], ["completed"; 3]);
    assert!(statuses[7..].iter().all(|status| *status == "diverged"), "{statuses:?}");
    assert_eq!(place.text("here/stress.csv").lines().count(), 10);
    assert!(!place.text("here/stress.json").contains("NaN") && !place.text("here/stress.csv").contains("NaN"));
    assert!(place.text("here/stress.md").contains("![pendulum: step x gain](stress-step_gain.svg)"));
}

#[test]
fn json_is_all_that_is_printed() {
    let place = Place::new(PENDULUM);
    let printed = place.done(&[
        "stress",
        "scene.json",
        "--map",
        "time",
        "--limit",
        "0.1",
        "--figures",
        "none",
        "-o",
        "here",
        "--json",
    ]);
    assert_eq!(printed, place.text("here/stress.json"));
    let map = &serde_json::from_str::<Value>(&printed).unwrap()["maps"][0];
    assert_eq!((&map["name"], &map["y"]["values"][0]), (&"time".into(), &Value::Null));
    assert_eq!(place.files("here"), ["stress.csv", "stress.json", "stress.md"]);
}

#[test]
fn bad_input_is_told() {
    let place = Place::new(PENDULUM);
    for (args, message) in [
        (&["--map", "gian"][..], "there is no map `gian`\n  help: did you mean `gain`?"),
        (&["--map", "links"], "the scene has nothing for the map `links`"),
        (
            &["--x", "stepp", "--y", "gain"],
            "--x: `stepp` is neither an extreme nor a parameter of the scene\n  help: did you mean `step`?",
        ),
        (&["--x", "step", "--y", "stiffness"], "--y: the scene has no stiffness"),
        (&["--x", "step=1..2:1", "--y", "gain"], "the number of values is 1"),
        (&["--map", "gain", "--show", "speed"], "there is no quantity `speed`"),
        (&["--x", "step"], "--y"),
        (&["--limit", "0"], "it must be above zero"),
        (&["--budget", "20 parsecs"], "`parsecs` is no unit of time; write 60s, 5min or 1h"),
        (&["--integrator", "rk"], "there is no integrator `rk`"),
    ] {
        let output = place.run(&[&["stress", "scene.json"], args].concat());
        assert_eq!(output.status.code(), Some(2), "{args:?}: {}", err(&output));
        assert!(err(&output).contains(message), "{args:?}: {}", err(&output));
    }
    assert_eq!(place.run(&["stress"]).status.code(), Some(2));
    assert!(place.done(&["stress", "--list"]).contains("mass_ratio"));
}

#[test]
fn a_folder_of_scenes_gets_one_report() {
    let place = Place::new(PENDULUM);
    fs::create_dir(place.path("scenes")).unwrap();
    fs::write(place.path("scenes/bad.json"), "{}").unwrap();
    let broken = place.run(&["stress", "--all", "scenes", "-o", "here", "--quiet"]);
    assert_eq!(broken.status.code(), Some(1), "{}", err(&broken));
    fs::write(place.path("scenes/good.json"), PENDULUM).unwrap();
    place.done(&["stress", "--all", "scenes", "--map", "start", "--figures", "png", "-o", "here", "--quiet"]);
    assert_eq!(place.files("here"), ["pendulum-start.png", "stress.csv", "stress.json", "stress.md"]);
    let page = place.text("here/stress.md");
    assert!(page.contains("## pendulum") && page.contains("## Not run") && page.contains("bad.json"), "{page}");
    let nothing = place.run(&["stress", "--all", "nowhere"]);
    assert_eq!(nothing.status.code(), Some(2), "{}", err(&nothing));
}

/// Times have their units, as in `tradeoff`; what no time was left for is no field of grey.
#[test]
fn an_empty_map_is_told_in_words() {
    for (map, of) in [("gain", "was not run to an end"), ("time", "nothing is known: the budget left out all 25 cells")]
    {
        let place = Place::new(PENDULUM);
        let args = ["stress", "scene.json", "--map", map, "--limit", "100ms", "-o", "here"];
        let text = place.done(&[&args[..], &["--budget", "0.001ms"]].concat());
        assert!(text.contains(of) && text.contains("there is no figure"), "{text}");
        assert_eq!(place.files("here"), ["stress.csv", "stress.json", "stress.md"]);
        assert!(!place.text("here/stress.md").contains("!["));
        let cells = place.json("here/stress.json")["maps"][0]["cells"].clone();
        let is_left_out =
            |cell: &Value| cell["status"] == "left_out" && cell["error"].is_null() && cell["holds"].is_null();
        assert!(cells.as_array().unwrap().iter().all(is_left_out));
    }
}

/// The error of each simulation stands beside its drift.
#[test]
fn files_carry_errors() {
    for (x, y) in [("tolerance=1e-8..1e-4:2:log", "time=0.5..1:2"), ("step=1e-3..1e-2:2", "time=0.5..1:2")] {
        let place = Place::new(PENDULUM);
        let method = if x.starts_with("step") { "rk4" } else { "dopri5" };
        let step: &[&str] = if x.starts_with("step") { &["--step", "0.01"] } else { &[] };
        let args =
            ["stress", "scene.json", "--x", x, "--y", y, "--integrator", method, "-o", "here", "--budget", "60s"];
        place.done(&[&args[..], step].concat());
        let json = place.json("here/stress.json");
        for cell in json["maps"][0]["cells"].as_array().unwrap() {
            let error = cell["error"].as_f64().unwrap();
            assert!(error > 0.0 && error < 0.1 && cell["holds"] == true && cell["worst"].is_string(), "{cell}");
        }
        let table = place.text("here/stress.csv");
        let headings: Vec<&str> = table.lines().next().unwrap().split(',').collect();
        let at = |name: &str| headings.iter().position(|heading| *heading == name).unwrap();
        for line in table.lines().skip(1) {
            let values: Vec<&str> = line.split(',').collect();
            assert!(values[at("error")].parse::<f64>().unwrap() < 0.1 && values[at("holds")] == "true", "{line}");
            assert_eq!(values[at("status")], "completed");
        }
    }
}
