use super::*;

const FILES: [&str; 7] =
    ["drift.csv", "drift.svg", "energy.csv", "energy.svg", "outputs.svg", "summary.json", "trajectory.csv"];

fn assert_no_nan(place: &Place, folder: &str) {
    for name in place.files(folder).iter().filter(|name| !name.ends_with(".png")) {
        let text = place.text(&format!("{folder}/{name}")).to_lowercase();
        let words = text.split(|c: char| !c.is_alphanumeric());
        assert!(words.into_iter().all(|word| !["nan", "inf", "infinity"].contains(&word)), "{name}");
    }
}

#[test]
fn the_files_lie_in_a_folder_of_the_scenes_name() {
    let place = Place::new(PENDULUM);
    let text = place.done(&["simulate", "scene.json"]);
    assert_eq!(place.files("out/pendulum"), FILES);
    assert!(text.starts_with("pendulum: index1 + dop853 + manifold, rtol 1e-8, atol 1e-10\n"), "{text}");
    assert!(text.contains("written to out/pendulum: trajectory.csv") && text.contains("theta"), "{text}");
    assert_no_nan(&place, "out/pendulum");
}

#[test]
fn the_trajectory_has_named_columns_and_one_row_an_output_step() {
    let place = Place::new(PENDULUM);
    place.done(&["simulate", "scene.json", "-o", "here", "--quiet"]);
    let text = place.text("here/trajectory.csv");
    let lines: Vec<&str> = text.lines().collect();
    let header = "t,rod.x,rod.y,rod.angle,rod.x',rod.y',rod.angle',joint.A.x,joint.A.y,theta,pin";
    assert_eq!((lines[0], lines.len()), (header, 12));
    for (i, line) in lines[1..].iter().enumerate() {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        assert_eq!(cells.len(), 11);
        assert!((cells[0] - 0.1 * i as f64).abs() < 1e-12 && cells.iter().all(|x| x.is_finite()));
        assert_eq!(cells[3], cells[9]);
        assert!((cells[7].hypot(cells[8]) - cells[10]).abs() < 1e-12);
    }
    assert_eq!(place.text("here/drift.csv").lines().next(), Some("t,position,velocity,acceleration"));
    assert_eq!(place.text("here/energy.csv").lines().next(), Some("t,kinetic,potential,work,error"));
}

/// The keys that DESIGN.md promises come first or among the given ones.
fn assert_keys(json: &Value, promised: &[&str], more: &[&str]) {
    let mut expected: Vec<&str> = promised.iter().chain(more).copied().collect();
    let mut found = keys(json);
    expected.sort_unstable();
    found.sort_unstable();
    assert_eq!(found, expected);
}

#[test]
fn the_summary_has_the_promised_keys() {
    let place = Place::new(PENDULUM);
    place.done(&["simulate", "scene.json", "-o", "here", "--quiet"]);
    let summary = place.json("here/summary.json");
    let top = [
        "holonom",
        "command",
        "parameters",
        "warnings",
        "scene",
        "method",
        "status",
        "failure",
        "t_end",
        "wall_seconds",
        "statistics",
        "drift",
        "energy",
        "final",
    ];
    assert_keys(
        &summary,
        &top,
        &["assembly", "error", "files", "outputs", "restart", "scene_hash", "singularity", "stiffness"],
    );
    assert_eq!(summary["warnings"], serde_json::json!([]));
    assert_keys(&summary["method"], &["formulation", "integrator", "projection", "rtol", "atol", "step"], &[]);
    let counters = ["steps", "rejected", "rhs_evaluations", "jacobian_evaluations", "factorizations"];
    let rest = ["newton_iterations", "projections"];
    assert_keys(&summary["statistics"], &[&counters[..], &rest, &["rows"]].concat(), &["rank_deficient", "stagnated"]);
    assert_keys(&summary["statistics"]["rows"], &[&counters[2..], &rest].concat(), &[]);
    assert_keys(&summary["drift"], &["position", "velocity", "acceleration"], &[]);
    for level in ["position", "velocity", "acceleration"] {
        assert_keys(&summary["drift"][level], &["max", "final"], &["relative_max", "relative_final"]);
    }
    assert_keys(&summary["energy"], &["initial", "final", "max_error"], &["work", "relative_max_error", "tolerated"]);
    assert_keys(&summary["final"], &["t", "q", "v", "lambda", "outputs"], &[]);
    assert_eq!(keys(&summary["final"]["q"]), ["rod.x", "rod.y", "rod.angle"]);
    assert_eq!(keys(&summary["final"]["v"]), ["rod.x'", "rod.y'", "rod.angle'"]);
    assert_eq!(keys(&summary["final"]["lambda"]), ["joint.A.x", "joint.A.y"]);
    assert_eq!(keys(&summary["final"]["outputs"]), ["theta", "pin"]);
}

#[test]
fn the_summary_says_what_was_done() {
    let place = Place::new(PENDULUM);
    place.done(&["simulate", "scene.json", "-o", "here", "--quiet"]);
    let summary = place.json("here/summary.json");
    assert_eq!(summary["scene"], "pendulum");
    assert_eq!((&summary["status"], &summary["failure"]), (&Value::from("completed"), &Value::Null));
    assert_eq!((&summary["t_end"], &summary["final"]["t"]), (&Value::from(1.0), &Value::from(1.0)));
    assert_eq!(summary["method"]["step"], Value::Null);
    assert!(summary["statistics"]["steps"].as_u64().unwrap() > 10);
    assert!(summary["drift"]["position"]["max"].as_f64().unwrap() < 1e-12);
}

/// Many rows are most of the work; few are not worth a word.
#[test]
fn work_of_rows_is_told_where_it_counts() {
    let place = Place::new(PENDULUM);
    for (step, is_told) in [("0.001", true), ("1", false)] {
        let text = place.done(&["simulate", "scene.json", "-o", "here", "--output-step", step]);
        let rows = &place.json("here/summary.json")["statistics"]["rows"]["rhs_evaluations"];
        assert_eq!(text.contains(&format!("evaluations and {rows} in rows, ")), is_told, "{text}");
    }
}

#[test]
fn json_prints_the_summary_and_nothing_else() {
    let place = Place::new(PENDULUM);
    let printed = place.done(&["simulate", "scene.json", "-o", "here", "--json"]);
    assert_eq!(printed, place.text("here/summary.json"));
    let both = place.done(&["simulate", "scene.json", "-o", "here", "--json", "--quiet"]);
    assert_eq!(keys(&serde_json::from_str(&both).unwrap()), keys(&place.json("here/summary.json")));
}

#[test]
fn quiet_prints_nothing() {
    let place = Place::new(PENDULUM);
    let output = place.run(&["simulate", "scene.json", "--quiet"]);
    assert_eq!((output.status.code(), out(&output), err(&output)), (Some(0), String::new(), String::new()));
}

#[test]
fn a_pipe_gets_no_progress_bar() {
    let output = Place::new(PENDULUM).run(&["simulate", "scene.json"]);
    assert_eq!(err(&output), "");
}

fn method_of(scene: &str, args: &[&str]) -> Value {
    let place = Place::new(scene);
    let printed = place.done(&[&["simulate", "scene.json", "--json", "--figures", "none"], args].concat());
    serde_json::from_str::<Value>(&printed).unwrap()["method"].clone()
}

#[test]
fn methods_are_named_with_their_options() {
    let table: [(&[&str], &str, &str); 5] = [
        (&["--formulation", "baumgarte:alpha=5,beta=5"], "formulation", "baumgarte:alpha=5,beta=5"),
        (&["--formulation", "invariant-manifold"], "formulation", "invariant_manifold"),
        (&["--formulation", " Baumgarte : alpha = 5 "], "formulation", "baumgarte:alpha=5"),
        (&["--projection", "manifold:sweeps=2"], "projection", "manifold:sweeps=2"),
        (&["--integrator", "dop853"], "integrator", "dop853"),
    ];
    for (args, key, expected) in table {
        assert_eq!(method_of(PENDULUM, args)[key], expected, "{args:?}");
    }
    let given = method_of(PENDULUM, &["--rtol", "1e-5", "--atol", "1e-6", "--step", "0.01", "--integrator", "rk4"]);
    assert_eq!((&given["rtol"], &given["atol"], &given["step"]), (&1e-5.into(), &1e-6.into(), &0.01.into()));
}

#[test]
fn the_command_line_goes_before_the_scene() {
    let own = r#""simulation": { "formulation": {"baumgarte": {"alpha": 5, "beta": 6.5}}, "integrator": "rk4", "step": 0.01, "#;
    let scene = PENDULUM.replace(r#""simulation": {"#, own);
    let method = method_of(&scene, &[]);
    assert_eq!(method["formulation"], "baumgarte:alpha=5,beta=6.5");
    assert_eq!((&method["integrator"], &method["step"]), (&"rk4".into(), &0.01.into()));
    let method = method_of(&scene, &["--integrator", "dopri5", "--formulation", "index1"]);
    assert_eq!((&method["formulation"], &method["step"]), (&"index1".into(), &Value::Null));
}

#[test]
fn parameters_and_the_end_are_set_from_outside() {
    let scene = PENDULUM.replace(r#""gravity": [0, -9.81]"#, r#""gravity": [0, "-g"], "parameters": { "g": 9.81 }"#);
    let place = Place::new(scene);
    place.done(&["simulate", "scene.json", "--set", "g=0", "--until", "0.25", "--output-step", "0.1", "-o", "here"]);
    let summary = place.json("here/summary.json");
    assert_eq!((&summary["t_end"], &summary["final"]["q"]["rod.angle"]), (&0.25.into(), &0.0.into()));
    let times: Vec<String> =
        place.text("here/trajectory.csv").lines().map(|line| line.split(',').next().unwrap().into()).collect();
    assert_eq!(times, ["t", "0", "0.1", "0.2", "0.25"]);
}

#[test]
fn figures_come_as_asked() {
    let place = Place::new(PENDULUM);
    place.done(&["simulate", "scene.json", "-o", "png", "--figures", "png", "--quiet"]);
    for name in ["drift.png", "energy.png", "outputs.png"] {
        assert!(fs::read(place.path("png").join(name)).unwrap().starts_with(b"\x89PNG\r\n\x1a\n"), "{name}");
    }
    place.done(&["simulate", "scene.json", "-o", "none", "--figures", "none", "--quiet"]);
    assert_eq!(place.files("none"), ["drift.csv", "energy.csv", "summary.json", "trajectory.csv"]);
    place.done(&["simulate", "scene.json", "-o", "svg", "--quiet"]);
    for name in ["drift.svg", "energy.svg", "outputs.svg"] {
        assert_well_formed(&place.text(&format!("svg/{name}")));
    }
}

#[test]
fn outputs_are_drawn_apart_where_asked() {
    let other = r#""outputs": [ { "name": "again", "measure": "angle", "of": "rod" },"#;
    let place = Place::new(PENDULUM.replace(r#""outputs": ["#, other));
    for command in [&["simulate", "scene.json"][..], &["plot", "scene.json", "--outputs"]] {
        let name = if command[0] == "plot" { "plot-outputs" } else { "outputs" };
        place.done(&[command, &["-o", "here", "--quiet"]].concat());
        let together = place.text(&format!("here/{name}.svg"));
        assert!([">angle (rad)<", ">theta<", ">again<"].iter().all(|text| together.contains(text)), "{together}");
        place.done(&[command, &["--separate", "-o", "here", "--quiet"]].concat());
        let apart = place.text(&format!("here/{name}.svg"));
        assert!([">theta (rad)<", ">again (rad)<"].iter().all(|text| apart.contains(text)), "{apart}");
    }
}

/// The joint opens with each step, from one the rod to eighty: a figure ends before.
#[test]
fn what_a_divergence_spoils_is_not_drawn() {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/pendulum.json").display().to_string();
    let place = Place::new("");
    let gains = ["--formulation", "baumgarte:alpha=150,beta=150", "--projection", "none", "--integrator", "rk4"];
    let steps = ["--step", "0.02", "--output-step", "0.02", "--quiet", "-o", "here"];
    let run = place.run(&[&["simulate", &scene], &gains[..], &steps].concat());
    assert_eq!(run.status.code(), Some(1));
    for name in ["outputs", "drift", "energy"] {
        let svg = place.text(&format!("here/{name}.svg"));
        assert!(svg.contains("not drawn: t ≥ 0.18 s, where the run diverged"), "{svg}");
        assert!(!svg.contains(">0.20<"), "{svg}");
    }
    place.done(&["plot", &scene, "--from", "here", "-o", "drawn", "--outputs", "--stroboscope", "--quiet"]);
    for name in ["plot-outputs", "stroboscope"] {
        assert!(place.text(&format!("drawn/{name}.svg")).contains(", where the run diverged"), "{name}");
    }
}

/// Every element that opens closes, in the right order, and text has no stray signs.
fn assert_well_formed(svg: &str) {
    let mut open: Vec<&str> = Vec::new();
    for piece in svg.split('<').skip(1) {
        let (tag, text) = piece.split_once('>').expect("a tag closes");
        assert!(!text.replace("&amp;", "").replace("&lt;", "").replace("&gt;", "").contains('&'), "{text}");
        match tag {
            _ if tag.starts_with(['?', '!']) || tag.ends_with('/') => {}
            _ if tag.starts_with('/') => assert_eq!(open.pop(), Some(&tag[1..])),
            _ => open.push(tag.split_whitespace().next().unwrap()),
        }
    }
    assert!(open.is_empty() && svg.contains("<svg"), "{open:?}");
}

#[test]
fn repeated_runs_are_the_same_bit_by_bit() {
    let place = Place::new(parallelogram());
    for folder in ["first", "second"] {
        place.done(&["simulate", "scene.json", "-o", folder, "--quiet"]);
    }
    for name in ["trajectory.csv", "drift.csv", "energy.csv", "drift.svg"] {
        let [first, second] = ["first", "second"].map(|folder| place.text(&format!("{folder}/{name}")));
        assert!(first == second, "{name}");
    }
}

/// After half a second the force is the root of a negative number.
fn spoilt() -> Place {
    Place::new(PENDULUM.replace(r#""force": [0, 0]"#, r#""force": ["sqrt(0.5 - t)", 0]"#))
}

#[test]
fn a_run_that_cannot_go_on_keeps_what_came_before() {
    for method in [&["--integrator", "dopri5"][..], &["--integrator", "rk4", "--step", "0.01"]] {
        let place = spoilt();
        let output = place.run(&[&["simulate", "scene.json", "-o", "here"], method].concat());
        assert_eq!(output.status.code(), Some(1));
        let message = err(&output);
        for word in [
            "error: stopped at t = ",
            "the force on `rod.x` is infinite or not a number",
            "an expression left its domain",
            "`floor` or `mod` beyond",
        ] {
            assert!(message.contains(word), "{message}");
        }
        assert_eq!(place.files("here"), FILES);
        let rows = place.text("here/trajectory.csv");
        let last: f64 = rows.lines().last().unwrap().split(',').next().unwrap().parse().unwrap();
        assert!(rows.lines().count() >= 6 && last > 0.48 && last <= 0.5, "{last}");
        assert_no_nan(&place, "here");
    }
}

#[test]
fn a_failed_run_says_so_in_its_summary() {
    let place = spoilt();
    let output = place.run(&["simulate", "scene.json", "-o", "here", "--json"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(out(&output), place.text("here/summary.json"));
    let summary = place.json("here/summary.json");
    assert_eq!(summary["status"], "failed");
    assert_eq!(keys(&summary["failure"]), ["t", "reason", "hint"]);
    let [t, end, last] =
        [&summary["failure"]["t"], &summary["t_end"], &summary["final"]["t"]].map(|t| t.as_f64().unwrap());
    assert!(t > 0.49 && t <= 0.5 && t == end && t == last, "{t} {end} {last}");
}

#[test]
fn a_motion_that_flies_apart_fails_or_warns() {
    let fast = PENDULUM.replace(r#""angle": 0"#, r#""angle": 0, "velocity": [0, 500], "angular_velocity": 1000"#);
    let place = Place::new(fast);
    let heun = ["simulate", "scene.json", "--integrator", "heun", "--step", "0.05", "--projection", "none"];
    let output = place.run(&[&heun[..], &["--until", "50", "-o", "here"]].concat());
    let message = err(&output);
    assert!(
        message.starts_with("warning: the joints have come apart by") || output.status.code() == Some(1),
        "{message}"
    );
    assert!(message.contains("help: ") && message.contains("projection"), "{message}");
    assert_no_nan(&place, "here");
}

#[test]
fn results_of_before_are_replaced_whole() {
    let place = Place::new(PENDULUM);
    place.done(&["simulate", "scene.json", "-o", "here", "--quiet"]);
    fs::write(place.path("here/notes.txt"), "mine").unwrap();
    place.done(&["simulate", "scene.json", "-o", "here", "--quiet", "--until", "0.2"]);
    assert_eq!(place.text("here/notes.txt"), "mine");
    assert_eq!(place.json("here/summary.json")["t_end"], 0.2);
    assert!(place.files("here").iter().all(|name| !name.starts_with('.')));
}

#[test]
fn redundant_constraints_are_told() {
    let text = Place::new(parallelogram()).done(&["simulate", "scene.json"]);
    assert!(text.contains("redundant constraints at all states: multipliers are those of least norm"), "{text}");
}

/// Before the run, with a method that can; and in the summary.
#[test]
fn a_stiff_scene_is_warned_of() {
    let place = Place::new(include_str!("../../models/quarter_car.json"));
    let args = ["simulate", "scene.json", "--figures", "none", "-o", "here"];
    let output = place.run(&[&args[..], &["--set", "c_strut=2e5"]].concat());
    let message = err(&output);
    assert!(message.starts_with("warning: the fastest mode of the start decays at "), "{message}");
    assert!(message.contains("help: take an implicit method: --formulation ggl --integrator radau_iia"), "{message}");
    let told = &place.json("here/summary.json")["stiffness"];
    assert_eq!(told["integrator"], "dopri5");
    assert!(told["steps_for_stability"].as_f64().unwrap() > 4e3, "{told}");
    // What is advised is quiet, and so are the scene itself and --quiet.
    let advised = ["--formulation", "ggl", "--integrator", "radau_iia", "--projection", "none", "--set", "c_strut=2e5"];
    for more in [&advised[..], &[], &["--quiet", "--set", "c_strut=2e5"]] {
        fs::remove_dir_all(place.path("here")).unwrap();
        assert_eq!(err(&place.run(&[&args[..], more].concat())), "", "{more:?}");
    }
    assert_eq!(place.run(&args).status.code(), Some(0));
    assert_eq!(place.json("here/summary.json")["stiffness"], Value::Null);
}

/// The motion is fine where an output is not defined: the cells are empty, and it is said.
#[test]
fn an_output_without_a_value_leaves_empty_cells() {
    let bad = r#""outputs": [ { "name": "bad", "measure": "expression", "value": "sqrt(theta)" },"#;
    let place = Place::new(PENDULUM.replace(r#""outputs": ["#, bad));
    let output = place.run(&["simulate", "scene.json", "-o", "here"]);
    let message = err(&output);
    assert!(
        message.starts_with("warning: the output `bad` has no finite value at 10 of 11 times, first at t = 0.1"),
        "{message}"
    );
    assert_no_nan(&place, "here");
    let last = place.text("here/trajectory.csv").lines().last().unwrap().to_string();
    assert!(last.split(',').nth(9) == Some(""), "{last}");
    assert_eq!(
        (output.status.code(), &place.json("here/summary.json")["final"]["outputs"]["bad"]),
        (Some(0), &Value::Null)
    );
}

#[test]
fn the_trajectory_is_written_as_text_and_arrays() {
    let place = Place::new(PENDULUM);
    let formats = [("csv", "trajectory.csv"), ("npz", "trajectory.npz"), ("mat", "trajectory.mat")];
    place.done(&["simulate", "scene.json", "-o", "all", "--format", "csv,npz,mat", "--quiet"]);
    for (format, file) in formats {
        place.done(&["simulate", "scene.json", "-o", format, "--format", format, "--figures", "none", "--quiet"]);
        assert_eq!(place.files(format), ["drift.csv", "energy.csv", "summary.json", file]);
        let [one, all] = [format, "all"].map(|folder| fs::read(place.path(&format!("{folder}/{file}"))).unwrap());
        assert_eq!(one, all);
    }
    assert!(fs::read(place.path("mat/trajectory.mat")).unwrap().starts_with(b"MATLAB 5.0 MAT-file"));
}

#[test]
fn without_coordinates_the_trajectory_has_the_outputs_and_the_summary_the_state() {
    let place = Place::new(PENDULUM);
    place.done(&["simulate", "scene.json", "-o", "all", "--quiet"]);
    place.done(&["simulate", "scene.json", "-o", "few", "--outputs-only", "--quiet", "--check-error"]);
    let outputs = |folder: &str| -> Vec<String> {
        let text = place.text(&format!("{folder}/trajectory.csv"));
        let few = |line: &str| {
            let cells: Vec<&str> = line.split(',').collect();
            [cells[0], cells[cells.len() - 2], cells[cells.len() - 1]].join(",")
        };
        text.lines().map(few).collect()
    };
    assert_eq!(place.text("few/trajectory.csv").lines().collect::<Vec<_>>(), outputs("all"));
    assert_eq!(place.text("few/outputs.svg"), place.text("all/outputs.svg"));
    let [all, few] = ["all", "few"].map(|folder| place.json(&format!("{folder}/summary.json")));
    assert_eq!([&all["final"], &all["restart"]], [&few["final"], &few["restart"]]);
    assert!(few["error"]["outputs"]["theta"]["max"].is_number());
    let bare = Place::new(parallelogram());
    let refused = bare.run(&["simulate", "scene.json", "--outputs-only"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(err(&refused).contains("the scene has no outputs"), "{}", err(&refused));
}

/// Commas, blanks, comments and a row of units: the same signal.
#[test]
fn tables_are_read_as_instruments_write_them() {
    let signal = r#""signals": [{ "name": "road", "file": "road.csv", "interpolation": "linear" }], "gravity""#;
    let output = r#""outputs": [{ "name": "z", "measure": "expression", "value": "road(1.5)" },"#;
    let place = Place::new(PENDULUM.replacen("\"gravity\"", signal, 1).replacen("\"outputs\": [", output, 1));
    for table in [
        "s,z\n0,1\n1,2\n2,4\n",
        "# measured\ns;z\nm;m\n0;1\n# a gap\n1;2\n2;4\n",
        "  s   z\n [m] [m]\n  0   1\n  1   2\n\n  2   4\n",
        "s\tz\n0\t1\n1\t2\n2\t4\n",
    ] {
        fs::write(place.path("road.csv"), table).unwrap();
        place.done(&["simulate", "scene.json", "-o", "here", "--quiet"]);
        assert_eq!(place.json("here/summary.json")["final"]["outputs"]["z"], 3.0, "{table}");
    }
}

/// Half of the scene's size is no drift any more, and the rows up to there are kept.
#[test]
fn joints_that_come_apart_are_a_failure() {
    let place = Place::new(PENDULUM);
    let coarse = ["--integrator", "heun", "--step", "0.05", "--projection", "none", "--until", "50", "-o", "here"];
    let output = place.run(&[&["simulate", "scene.json"][..], &coarse].concat());
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("the joints have come apart by 5.0e-1 of the scene's size"), "{}", err(&output));
    let summary = place.json("here/summary.json");
    let open = summary["drift"]["position"]["relative_max"].as_f64().unwrap();
    assert!(summary["t_end"].as_f64().unwrap() > 30.0 && open > 0.5 && open < 0.6, "{summary}");
}
