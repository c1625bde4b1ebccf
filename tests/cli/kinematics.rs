use super::*;

/// Crank, rod and piston with the crank driven to an angle, from a guess that is that of 0.3 rad.
const SLIDER_CRANK: &str = r#"{
  "name": "slider_crank", "dimension": 2, "gravity": [0, -9.81],
  "parameters": { "r": 0.15, "l": 0.4, "angle": 0.3, "speed": 0 },
  "ground": { "markers": { "O": [0, 0] } },
  "bodies": [
    { "name": "crank", "type": "rigid", "mass": 1, "inertia": 0.01, "origin": ["-r/2", 0],
      "markers": { "O": [0, 0], "P": ["r", 0] }, "initial": { "angle": 0.3 } },
    { "name": "rod", "type": "rigid", "mass": 1, "inertia": 0.01, "origin": ["-l/2", 0],
      "markers": { "P": [0, 0], "Q": ["l", 0] }, "initial": { "position": [0.14, 0.04], "angle": -0.1 } },
    { "name": "piston", "type": "rigid", "mass": 1, "inertia": 0.01, "initial": { "position": [0.5, 0] } } ],
  "joints": [
    { "name": "bearing", "type": "revolute", "between": ["ground.O", "crank.O"] },
    { "name": "pin", "type": "revolute", "between": ["crank.P", "rod.P"] },
    { "name": "wrist", "type": "revolute", "between": ["rod.Q", "piston"] },
    { "name": "cylinder", "type": "prismatic", "between": ["ground.O", "piston"] },
    { "name": "motor", "type": "driver", "between": ["ground.O", "crank.O"], "coordinate": "angle",
      "value": "angle + speed*t" } ],
  "outputs": [
    { "name": "crank_angle", "measure": "angle", "of": "crank" },
    { "name": "piston_x", "measure": "position", "of": "piston" },
    { "name": "torque", "measure": "reaction", "of": "motor", "component": "mz" } ]
}"#;

fn suspension() -> Place {
    Place::new(
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("models/five_link_kinematics.json")).unwrap(),
    )
}

/// A four-bar that cannot turn through: rocker and coupler are stretched at cos(angle) = (a^2 + g^2 - (b + c)^2)/(2 a g).
fn four_bar() -> Place {
    Place::new(
        r#"{ "name": "four_bar", "dimension": 2, "parameters": { "angle": 1 },
        "ground": { "markers": { "A": [0, 0], "B": [2.1, 0] } },
        "bodies": [
            { "name": "crank", "type": "rigid", "mass": 1, "inertia": 0.3, "origin": [-0.9, 0],
              "markers": { "A": [0, 0], "C": [1.8, 0] }, "initial": { "angle": "angle" } },
            { "name": "D", "type": "point_mass", "mass": 1, "initial": { "position": [2.2, 1.6] } } ],
        "joints": [
            { "name": "A", "type": "revolute", "between": ["ground.A", "crank.A"] },
            { "name": "motor", "type": "driver", "between": ["ground.A", "crank.A"], "coordinate": "angle",
              "value": "angle" },
            { "name": "coupler", "type": "distance", "between": ["crank.C", "D"], "length": 1.4 },
            { "name": "rocker", "type": "distance", "between": ["ground.B", "D"], "length": 1.6 } ],
        "outputs": [{ "name": "D_x", "measure": "position", "of": "D" }] }"#,
    )
}

/// Columns of a table by their headings.
fn columns(text: &str) -> impl Fn(&str) -> Vec<f64> + use<> {
    let mut rows = text.lines().map(|line| line.split(',').map(str::to_string).collect::<Vec<_>>());
    let headings = rows.next().unwrap();
    let rows = rows.collect::<Vec<_>>();
    move |name| {
        let column = headings.iter().position(|heading| heading == name).unwrap_or_else(|| panic!("no {name}"));
        rows.iter().map(|row| row[column].parse().unwrap()).collect()
    }
}

#[test]
fn camber_and_toe_over_the_travel_of_a_wheel() {
    let place = suspension();
    let text = place.done(&["kinematics", "scene.json", "travel=-0.08..0.08:81", "-o", "here"]);
    assert_eq!(place.files("here"), ["kinematics.csv", "kinematics.json", "kinematics.svg"]);
    assert!(
        text.contains("81 of 81 values") && text.contains("(1.559°)") && text.contains("written to here"),
        "{text}"
    );
    let csv = place.text("here/kinematics.csv");
    assert!(csv.starts_with("travel,carrier.x,carrier.y,carrier.z,carrier.qw,"), "{csv}");
    assert!(
        csv.lines().next().unwrap().ends_with("joint.lift.z,wheel_travel,camber,toe,track_change,wheelbase_change")
    );
    let column = columns(&csv);
    let travel = column("travel");
    let camber = column("camber");
    let toe = column("toe");
    assert_eq!((travel[0], travel[40], travel[80], travel.len()), (-0.08, 0.0, 0.08, 81));
    assert!(travel.iter().zip(column("wheel_travel")).all(|(asked, found)| (asked - found).abs() < 1e-10));
    let ends = [camber[0], camber[80], toe[0], toe[80]].map(f64::to_degrees);
    let off = ends.iter().zip([1.56, -1.62, -0.41, 0.21]).map(|(found, known)| (found - known).abs());
    assert!(off.fold(0.0, f64::max) < 0.01, "{ends:?}");
    assert!(camber.is_sorted_by(|a, b| a > b) && toe.is_sorted_by(|a, b| a < b));
    let json = place.json("here/kinematics.json");
    assert_eq!((&json["status"], &json["failure"], &json["reached"]), (&"completed".into(), &Value::Null, &81.into()));
    let camber_json = &json["outputs"][1];
    assert_eq!(
        (camber_json["max"]["at"].as_f64(), camber_json["max"]["value"].as_f64()),
        (Some(-0.08), Some(camber[0]))
    );
}

#[test]
fn a_value_is_what_the_scene_set_to_it_starts_at() {
    let place = suspension();
    place.done(&["kinematics", "scene.json", "travel=-0.08..0.08:5", "-o", "here", "--quiet", "--figures", "none"]);
    let column = columns(&place.text("here/kinematics.csv"));
    for (i, set) in ["travel=-0.08", "travel=-0.04", "travel=0", "travel=0.04", "travel=0.08"].iter().enumerate() {
        let short = ["--until", "0.01", "--output-step", "0.01", "--figures", "none", "--quiet"];
        place.done(&[&["simulate", "scene.json", "--set", set, "-o", "one"], &short[..]].concat());
        let one = columns(&place.text("one/trajectory.csv"));
        for name in ["carrier.x", "carrier.qy", "camber", "toe", "track_change", "wheelbase_change"] {
            assert!((column(name)[i] - one(name)[0]).abs() < 1e-10, "{set} {name}");
        }
    }
}

#[test]
fn the_piston_goes_as_in_the_closed_form() {
    let place = Place::new(SLIDER_CRANK);
    place.done(&["kinematics", "scene.json", "angle=-7..7:57", "-o", "here"]);
    let column = columns(&place.text("here/kinematics.csv"));
    for (angle, (piston, crank)) in column("angle").iter().zip(column("piston_x").iter().zip(column("crank_angle"))) {
        let known = 0.15 * angle.cos() + (0.16 - (0.15 * angle.sin()).powi(2)).sqrt();
        assert!((piston - known).abs() < 1e-10 && (crank - angle).abs() < 1e-10, "at {angle}: {piston}, not {known}");
    }
    // At rest, but not held against gravity by the other joints: the motor carries the crank and half of the rod.
    let torque = column("torque");
    assert!(torque.iter().all(|torque| torque.is_finite()) && torque.iter().any(|torque| torque.abs() > 1.0));
}

#[test]
fn the_end_of_travel_is_found_and_what_lies_before_it_is_written() {
    let place = four_bar();
    let output = place.run(&["kinematics", "scene.json", "angle=0.5..3:26", "-o", "here"]);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    let end = ((1.8f64.powi(2) + 2.1f64.powi(2) - 9.0) / (2.0 * 1.8 * 2.1)).acos();
    let json = place.json("here/kinematics.json");
    let limit = json["limits"][0]["value"].as_f64().unwrap();
    assert!((limit - end).abs() < 1e-6, "{limit}, not {end}");
    assert_eq!((&json["status"], json["failure"]["value"].as_f64()), (&"failed".into(), Some(1.8)));
    assert!(json["failure"]["reason"].as_str().unwrap().contains("the joints cannot all be closed"));
    let reached = columns(&place.text("here/kinematics.csv"))("angle");
    assert_eq!((reached.len(), reached[0], reached[12]), (13, 0.5, 1.7));
    let message = err(&output);
    assert!(message.starts_with("error: the branch ends at angle = 1.7") && message.contains("1.8 is out of reach"));
    assert!(
        message.contains("the mechanism moves from 0.5 to 1.7") && out(&output).contains("SINGULAR at"),
        "{message}"
    );
    assert!(place.text("here/kinematics.svg").contains("limit"));
}

#[test]
fn figures_show_what_is_asked_for_in_degrees() {
    let place = suspension();
    let run = |more: &[&str]| {
        place.done(&[&["kinematics", "scene.json", "travel=-0.08..0.08:9", "-o", "here", "--quiet"], more].concat());
        place.text("here/kinematics.svg")
    };
    let all = run(&[]);
    assert!([">angle (deg)<", ">position (m)<", ">travel<"].iter().all(|text| all.contains(text)), "{all}");
    let two = run(&["--outputs", "camber,toe", "--against", "wheel_travel"]);
    assert!(
        [">angle (deg)<", ">wheel_travel (m)<", ">toe<"].iter().all(|text| two.contains(text))
            && !two.contains("track")
    );
    let apart = run(&["--outputs", "camber,toe", "--separate"]);
    assert!([">camber (deg)<", ">toe (deg)<", ">travel<"].iter().all(|text| apart.contains(text)), "{apart}");
}

#[test]
fn json_is_the_file_and_nothing_else() {
    let place = four_bar();
    let text = place.done(&["kinematics", "scene.json", "angle=0.5..1.5:3", "--json"]);
    assert_eq!(serde_json::from_str::<Value>(&text).unwrap(), place.json("out/four_bar/kinematics.json"));
    let json = place.json("out/four_bar/kinematics.json");
    let promised = [
        "holonom",
        "command",
        "parameters",
        "warnings",
        "files",
        "scene",
        "parameter",
        "range",
        "count",
        "reached",
        "status",
        "failure",
        "own_value",
        "limits",
        "nearest_singular",
        "outputs",
    ];
    let mut expected = promised.to_vec();
    expected.sort_unstable();
    let mut found = keys(&json);
    found.sort_unstable();
    assert_eq!(found, expected);
}

#[test]
fn what_is_swept_can_be_set_and_turned_round() {
    let place = suspension();
    let sweep = ["kinematics", "scene.json", "travel=0.05..-0.05:3", "--set", "travel=0.01", "--quiet"];
    place.done(&sweep);
    let json = place.json("out/five_link_kinematics/kinematics.json");
    assert_eq!((json["own_value"].as_f64(), json["outputs"][1]["own"]["at"].as_f64()), (Some(0.01), Some(0.01)));
    let column = columns(&place.text("out/five_link_kinematics/kinematics.csv"));
    assert_eq!(column("travel"), [0.05, 0.0, -0.05]);
}

#[test]
fn bad_sweeps_are_refused_and_nothing_is_written() {
    let place = suspension();
    let table: [(&[&str], &str); 9] = [
        (&["travl=-1..1"], "error: unknown parameter `travl`\n  help: did you mean `travel`?"),
        (&["travel"], "write NAME=A..B:N, as in travel=-0.08..0.08:81"),
        (&["travel=0..x:3"], "`x` is not a number"),
        (&["travel=0..1:1"], "the number of values is 1; give 2 to 100000"),
        (&["travel=1..1"], "the range is empty"),
        (
            &["travel=0..0.1", "--outputs", "camer"],
            "at --outputs: there is no output `camer`\n  help: did you mean `camber`?",
        ),
        (&["travel=0..0.1", "--against", "toes"], "at --against: there is no output `toes`"),
        (&["travel=0..0.1", "--rtol", "1e-3"], "unexpected argument '--rtol'"),
        (&["travel=5..6"], "the mechanism can be moved to 0.3725"),
    ];
    for (args, message) in table {
        let output = place.run(&[&["kinematics", "scene.json"], args].concat());
        assert_eq!((output.status.code(), out(&output)), (Some(2), String::new()), "{args:?}");
        assert!(err(&output).contains(message), "{args:?}: {}", err(&output));
        assert!(!place.path("out").exists());
    }
}

#[test]
fn a_parameter_that_moves_nothing_is_told() {
    let place = Place::new("");
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let said = |scene: &str, range: &str| err(&place.run(&["kinematics", models.join(scene).to_str().unwrap(), range]));
    let stiffness = said("four_bar_spring.json", "k1=10..100:5");
    assert!(stiffness.contains("`k1` changes no position") && stiffness.contains("holonom loci"), "{stiffness}");
    assert!(!said("double_wishbone.json", "rack=-0.01..0.01:3").contains("changes no position"));
}
