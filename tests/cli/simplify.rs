use super::*;

#[test]
fn a_scene_a_table_and_a_figure() {
    let scene = PENDULUM.replace(r#""mass": 1,"#, r#""mass": "m","#);
    let place = Place::new(scene.replacen('{', r#"{ "parameters": { "m": 1 },"#, 1));
    let text =
        place.done(&["simplify", "scene.json", "--within", "5%", "--robust", "10%", "--samples", "2", "-o", "here"]);
    assert!(text.starts_with("pendulum: within 5 % of the range of theta, pin\n"), "{text}");
    assert!(text.contains("on 2 of 2 motions nearby"), "{text}");
    assert_eq!(place.files("here"), ["simplified.json", "simplify.csv", "simplify.json", "simplify.svg"]);
    let told = place.json("here/simplify.json");
    assert_eq!((&told["within"], &told["outputs"]), (&0.05.into(), &serde_json::json!(["theta", "pin"])));
    assert!(told["chosen"]["outputs"].as_array().unwrap().len() == 2 && told["trials"].is_array());
    let run = place.done(&["simulate", "here/simplified.json", "--figures", "none", "-o", "run"]);
    assert!(run.starts_with("pendulum_simplified: "), "{run}");
}

#[test]
fn a_promise_is_in_per_cent() {
    let place = Place::new(PENDULUM);
    for within in ["5", "0%", "100%", "x%"] {
        let output = place.run(&["simplify", "scene.json", "--within", within]);
        assert_eq!(output.status.code(), Some(2), "{within}");
    }
}

/// Looser than any tolerance that is tried.
#[test]
fn a_scene_of_any_tolerance_is_simplified() {
    let place = Place::new(PENDULUM.replace(r#""output_step": 0.1"#, r#""output_step": 0.1, "rtol": 1.0"#));
    place.done(&["simplify", "scene.json", "--within", "10%", "--until", "0.01", "-o", "here"]);
}

/// States are bodies without a place; files and what is included or repeated are found from anywhere.
#[test]
fn controllers_roads_and_included_scenes_are_simplified() {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let place = Place::new("");
    for (name, kept) in [
        ("pid_arm", "rate follows at once"),
        ("half_car", "front_tyre is not damped"),
        ("suspension_on_road", "corner_tyre is not damped"),
        // At the start, where the springs are relaxed, distances would carry a load.
        ("flyball_governor", "nothing can be left out"),
    ] {
        let scene = models.join(format!("{name}.json")).display().to_string();
        let text = place.done(&["simplify", &scene, "--within", "10%", "--figures", "none", "-o", name]);
        assert!(text.contains(kept), "{name}: {text}");
        let simplified = format!("{name}/simplified.json");
        place.done(&["simulate", &simplified, "--until", "0.01", "--figures", "none", "-o", "run"]);
    }
}

#[test]
fn a_scene_is_not_written_over() {
    let place = Place::new(PENDULUM);
    fs::rename(place.path("scene.json"), place.path("simplified.json")).unwrap();
    let output = place.run(&["simplify", "simplified.json", "--within", "5%", "-o", "."]);
    assert_eq!(output.status.code(), Some(2));
}

/// A motion that takes minutes, in two seconds of counted time: the promise is about its first part, and the scene stays as long as it
/// was.
#[test]
fn a_budget_is_kept() {
    let place = Place::new(
        PENDULUM
            .replace(r#""t_end": 1, "output_step": 0.1"#, r#""t_end": 9e4, "output_step": 0.01"#)
            .replace(r#""mass": 1,"#, r#""mass": "m","#)
            .replacen('{', r#"{ "parameters": { "m": 1 },"#, 1),
    );
    let output = place.run(&["simplify", "scene.json", "--within", "5%", "--budget", "2s", "-o", "here"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert!(err(&output).contains("the time sufficed for the motion until t = "), "{}", err(&output));
    // The whole motion has 9 million rows, which would take 900 s.
    let told = place.json("here/simplify.json");
    assert!(told["richest"]["seconds"].as_f64().unwrap() < 2.0, "{}", told["richest"]);
    assert_eq!(place.json("here/simplified.json")["simulation"]["t_end"], 9e4);
    // Motions nearby for which there is no time are told, and are no error.
    let output =
        place.run(&["simplify", "scene.json", "--within", "5%", "--budget", "2s", "--robust", "10%", "-o", "near"]);
    assert!(output.status.code() == Some(0) && err(&output).contains(" motions nearby"), "{}", err(&output));
    // Not even a few rows of the motion.
    let output = place.run(&["simplify", "scene.json", "--within", "5%", "--budget", "0.01ms", "-o", "none"]);
    assert!(output.status.code() == Some(1) && err(&output).contains("more time by --budget"), "{}", err(&output));
}

/// A chaotic motion whose own error grows beyond what is promised: the scene that is written says so.
#[test]
fn a_promise_that_no_run_keeps_ends_with_one() {
    let place = Place::new(include_str!("../data/chaos.json"));
    let output = place.run(&["simplify", "scene.json", "--within", "5%", "--at-most", "3", "-o", "out"]);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    assert!(err(&output).contains("error: no run keeps within 5 %: "), "{}", err(&output));
    let about = place.json("out/simplified.json")["about"].to_string();
    assert!(about.contains("no run keeps within 5 %"), "{about}");
}
