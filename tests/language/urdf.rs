//! Scenes from URDF: the same motion as by hand, merged links, closed loops, and what is refused.

use crate::scenes::parse;
use holonom::import::Given;
use holonom::import::urdf::{Imported, Options, import};
use holonom::report::check;
use serde_json::Value;

/// An arm of two links about y, its second link bent by a quarter turn and with a tool fixed to it.
const ARM: &str = include_str!("../../models/data/two_link.urdf");

fn imported(text: &str, base: Option<&str>, closures: &[&str]) -> Imported {
    let closures = closures.iter().map(|closure| closure.parse().unwrap()).collect();
    import(text, &Options { base: base.map(str::to_string), closures, ..Options::default() }).unwrap()
}

/// The lower link with its tool by hand: along its z axis the rod of 2 kg at 0.4 and the ball of 1 kg at 0.9; the rod's
/// principal axes are turned by a quarter about y.
#[test]
fn a_two_link_arm_moves_as_by_hand() {
    let centre = (2.0 * 0.4 + 0.9) / 3.0;
    let arms = 2.0 * (0.4f64 - centre).powi(2) + (0.9f64 - centre).powi(2);
    let x = 0.21 + 0.004 + arms;
    let y = 0.2 + 0.004 + arms;
    let z = 0.01 + 0.004;
    let about_y = r#""z_axis": [0, 1, 0], "x_axis": [1, 0, 0]"#;
    let hand = format!(
        r#"{{ "name": "arm", "dimension": 3, "gravity": [0, 0, -9.81],
            "ground": {{ "markers": {{ "S": {{ "position": [0, 0, 1], {about_y} }} }} }},
            "bodies": [
              {{ "name": "upper", "type": "rigid", "mass": 3, "inertia": [0.02, 0.3, 0.31], "origin": [-0.5, 0, -0.1],
                 "markers": {{ "S": {{ "position": [0, 0, 0], {about_y} }}, "E": {{ "position": [1, 0, 0], {about_y} }} }},
                 "initial": {{ "position": [0, 0, 1] }} }},
              {{ "name": "lower", "type": "rigid", "mass": 3, "inertia": [{x}, {y}, {z}], "origin": [0, 0, {}],
                 "markers": {{ "E": {{ "position": [0, 0, 0], "z_axis": [0, 1, 0], "x_axis": [0, 0, 1] }}, "T": [0, 0, 0.9] }},
                 "initial": {{ "position": [1, 0, 1], "z_axis": [1, 0, 0], "x_axis": [0, 0, -1] }} }}],
            "joints": [{{ "name": "shoulder", "type": "revolute", "between": ["ground.S", "upper.S"] }},
                       {{ "name": "elbow", "type": "revolute", "between": ["upper.E", "lower.E"] }}],
            "forces": [{{ "name": "d", "type": "torsion_spring", "between": ["ground.S", "upper.S"], "damping": 0.3 }}],
            "outputs": [{{ "name": "shoulder", "measure": "angle", "of": "upper.S", "relative_to": "ground.S" }},
                        {{ "name": "tip", "measure": "position", "of": "lower.T", "component": "x" }}] }}"#,
        -centre
    );
    let Imported { mut scene, left_out, .. } = imported(ARM, None, &[]);
    scene["outputs"][1] =
        serde_json::json!({ "name": "tip", "measure": "position", "of": "lower.tool", "component": "x" });
    let [ours, hand] = [scene.to_string(), hand].map(|text| parse(&text).tight(1e-11, 1.5, 0.1));
    for output in ["shoulder", "tip"] {
        let a = ours.column(output);
        let b = hand.column(output);
        let error = a.iter().zip(&b).fold(0.0f64, |worst, (a, b)| worst.max((a - b).abs()));
        assert!(error < 1e-9, "{output}: {error:e}");
        assert!((a[0] - a.last().unwrap()).abs() > 0.3, "{output} moves: {a:?}");
    }
    let told = left_out.join("\n");
    for piece in [
        "limit of the joints shoulder",
        "visual of the links base-link",
        "fixed joints",
        "tool",
        "`base-link`, now `base_link`",
    ] {
        assert!(told.contains(piece), "{told}");
    }
    assert!(scene["about"].as_str().unwrap().contains("base-link: package://arm/base.stl"));
    assert_eq!(scene["initial"], serde_json::json!({ "shoulder.angle": 0, "elbow.angle": 0 }));
}

/// Joint coordinates are the positions of URDF: about the axis in the frame of the child.
#[test]
fn joints_start_at_the_positions_that_they_are_given() {
    let mut scene = imported(ARM, None, &[]).scene;
    scene["initial"] = serde_json::json!({ "shoulder.angle": -0.5, "elbow.angle": 1.2 });
    let ready = parse(&scene.to_string());
    let names = ready.system().facts().names.q.clone();
    let at = |name: &str| ready.start().q[names.iter().position(|known| known == name).unwrap()];
    // About y: -0.5 + pi/2 + 1.2 for the lower link.
    let half = 0.5 * (0.7 + std::f64::consts::FRAC_PI_2);
    assert!((at("lower.qw") - half.cos()).abs() < 1e-12 && (at("lower.qy") - half.sin()).abs() < 1e-12);
}

/// The same positions in the guess itself.
#[test]
fn joints_are_imported_at_given_positions() {
    let positions = ["shoulder=-0.5", "elbow=1.2"].map(|given| given.parse().unwrap()).to_vec();
    let scene = import(ARM, &Options { positions, ..Options::default() }).unwrap().scene;
    assert_eq!(scene["initial"], serde_json::json!({ "shoulder.angle": -0.5, "elbow.angle": 1.2 }));
    let half = 0.5 * (0.7 + std::f64::consts::FRAC_PI_2);
    let turn: Vec<f64> =
        scene["bodies"][1]["initial"]["rotation"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    assert!((turn[0] - half.cos()).abs() < 1e-15 && (turn[2] - half.sin()).abs() < 1e-15, "{turn:?}");
    let refused = |given: &str| {
        let positions = vec![given.parse().unwrap()];
        import(ARM, &Options { positions, ..Options::default() }).unwrap_err().to_string()
    };
    assert!(refused("sholder=1").contains("at at: there is no joint `sholder`"));
    assert!(refused("flange=1").contains("`flange` has no coordinate"));
}

/// A closed loop that position zero is not: the crank is of length 1 with its support at 2.5 instead of 2.
#[test]
fn a_loop_is_closed_from_a_posture() {
    let text = CHAIN.replace("xyz=\"2 0 0\"/><parent link=\"base\"", "xyz=\"2.5 0 0\"/><parent link=\"base\"");
    let closures = vec!["D=revolute:coupler@2,0,0:rocker@0,0,1:axis=0,1,0".parse().unwrap()];
    let positions = vec!["A=-0.4".parse().unwrap(), "C=0.5".parse().unwrap()];
    let scene = import(&text, &Options { closures, positions, ..Options::default() }).unwrap().scene;
    let ready = parse(&scene.to_string());
    let names = ready.system().facts().names.q.clone();
    let turn = |body: &str| ready.start().q[names.iter().position(|known| *known == format!("{body}.qy")).unwrap()];
    assert!(ready.start().after.phi < 1e-12);
    // Near the posture: the crank leans by 0.4 against the other way.
    assert!((2.0 * turn("crank").asin() + 0.4).abs() < 0.4, "{}", turn("crank"));
}

/// Three bars between supports, closed at position zero: crank 1 up, coupler 2 along x, rocker 1 down to the base.
const CHAIN: &str = r#"<robot name="four_bar">
  <link name="base"/>
  <link name="crank"><inertial><origin xyz="0 0 0.5"/><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".01"/></inertial></link>
  <link name="coupler"><inertial><origin xyz="1 0 0"/><mass value="2"/><inertia ixx=".01" iyy=".7" izz=".7"/></inertial></link>
  <link name="rocker"><inertial><origin xyz="0 0 0.5"/><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".01"/></inertial></link>
  <joint name="A" type="continuous"><parent link="base"/><child link="crank"/><axis xyz="0 1 0"/></joint>
  <joint name="C" type="continuous"><origin xyz="0 0 1"/><parent link="crank"/><child link="coupler"/><axis xyz="0 1 0"/></joint>
  <joint name="B" type="continuous"><origin xyz="2 0 0"/><parent link="base"/><child link="rocker"/><axis xyz="0 1 0"/></joint>
</robot>"#;

/// A parallelogram: the coupler translates, so that it is a pendulum of (J_A + J_B + m l^2) angle'' = g (...)
/// sin(angle).
#[test]
fn a_four_bar_is_closed_by_a_joint() {
    let scene = imported(CHAIN, None, &["D=revolute:coupler@2,0,0:rocker@0,0,1:axis=0,1,0"]).scene;
    assert_eq!(scene.get("initial"), None);
    let mut moving = scene.clone();
    moving["initial"] = serde_json::json!({ "A.angle'": 1 });
    let ready = parse(&moving.to_string());
    assert_eq!(check(&ready.0).degrees_of_freedom, 1);
    let run = ready.tight(1e-10, 0.8, 0.4);
    let angle = run.column("A");
    assert!(run.worst("C", |_| 0.0) > 0.1 && angle[2] > angle[1] && angle[1] > 0.1, "{angle:?}");
    for (turn, (b, c)) in angle.iter().zip(run.column("B").iter().zip(run.column("C"))) {
        assert!((turn - b).abs() < 1e-9 && (turn + c).abs() < 1e-9, "{turn} {b} {c}");
    }
    // Energy: 1/2 I w^2 + g s cos(angle) with I = 2 (0.1 + 1/4) + 2 and s = 2 (1/2) + 2.
    let inertia = 2.0 * (0.1 + 0.25) + 2.0;
    let weight = 9.81 * 3.0;
    let rate = run.column("crank.wy");
    let energy = |i: usize| 0.5 * inertia * rate[i].powi(2) + weight * angle[i].cos();
    assert!((energy(2) - energy(0)).abs() < 1e-8 * energy(0), "{} {}", energy(0), energy(2));
}

/// Two jaws on one rail, the second one moved by the first.
const GRIPPER: &str = r#"<robot name="gripper">
  <link name="base"/>
  <link name="a"><inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1"/></inertial></link>
  <link name="b"><inertial><mass value="2"/><inertia ixx=".1" iyy=".1" izz=".1"/></inertial></link>
  <joint name="jaw" type="prismatic"><parent link="base"/><child link="a"/><axis xyz="1 0 0"/><dynamics damping="0.6"/>
    <safety_controller k_velocity="1"/></joint>
  <joint name="other jaw" type="prismatic"><parent link="base"/><child link="b"/><axis xyz="0 1 0"/>
    <mimic joint="jaw" multiplier="-0.5" offset="0.1"/></joint>
</robot>"#;

/// (1 + 2/4) x'' = -0.6 x' from x' = 1, and y = 0.1 - x/2.
#[test]
fn a_joint_mimics_another_and_a_slider_is_damped() {
    let Imported { mut scene, left_out, .. } = imported(GRIPPER, None, &[]);
    assert_eq!(scene["initial"], serde_json::json!({ "jaw.position": 0 }));
    assert!(left_out.iter().any(|what| what == "safety_controller of the joints jaw"), "{left_out:?}");
    assert!(!left_out.iter().any(|what| what.contains("damping") || what.contains("mimic")), "{left_out:?}");
    scene["initial"]["jaw.position'"] = serde_json::json!(1);
    let run = parse(&scene.to_string()).tight(1e-11, 3.0, 0.5);
    let x = |t: f64| 2.5 * (1.0 - (-0.4 * t).exp());
    assert!(run.worst("jaw", x) < 1e-10 && run.worst("other_jaw", |t| 0.1 - 0.5 * x(t)) < 1e-10);
    let error =
        import(&GRIPPER.replace("joint=\"jaw\"", "joint=\"jow\""), &Options::default()).unwrap_err().to_string();
    assert!(error.contains("it mimics `jow`, which is no joint\n  help: did you mean `jaw`?"), "{error}");
}

#[test]
fn any_link_may_be_the_ground_or_none() {
    let bodies = |imported: &Imported| {
        let all = imported.scene["bodies"].as_array().unwrap().iter();
        all.map(|body| body["name"].as_str().unwrap().to_string()).collect::<Vec<_>>()
    };
    let held = imported(ARM, Some("tool"), &[]);
    assert_eq!(bodies(&held), ["base_link", "upper"]);
    // The base, seen from the tool: 0.9 beyond the elbow along the arm, which lies in the world's x.
    let place = &held.scene["bodies"][0]["initial"]["position"];
    let place: Vec<f64> = place.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    for (x, expected) in place.iter().zip([1.0, 0.0, -1.9]) {
        assert!((x - expected).abs() < 1e-12, "{place:?}");
    }
    let free = import(ARM, &Options { is_free: true, ..Options::default() }).unwrap();
    assert_eq!(bodies(&free), ["base_link", "upper", "lower"]);
    assert!(free.left_out.iter().any(|what| what.contains("mass") && what.contains("base-link")));
}

#[test]
fn faults_of_the_file_are_told_with_their_place() {
    let with = |from: &str, to: &str| {
        assert!(ARM.contains(from), "{from}");
        ARM.replacen(from, to, 1)
    };
    let table = [
        (with("</robot>", ""), "this is not XML"),
        ("<scene/>".to_string(), "expected a robot, found <scene>"),
        (with("type=\"continuous\"", "type=\"continous\""), "there is no joint of type `continous`"),
        (with("<child link=\"tool\"/>", "<child link=\"tol\"/>"), "there is no link `tol`"),
        (with("<child link=\"tool\"/>", "<child link=\"upper\"/>"), "`upper` is the child of `shoulder` too"),
        (with("<mass value=\"3\"/>", "<mass value=\"3 kg\"/>"), "expected a number in `value`, found \"3 kg\""),
        (with("xyz=\"0 0 0.9\"", "xyz=\"0 0.9\""), "expected 3 numbers in `xyz`, found 2"),
        (with("name=\"upper\"", "name=\"lower\""), "the name `lower` is taken"),
        (with("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 0 0\"/>"), "the axis has no direction"),
        (with("<parent link=\"base-link\"/>", "<parent link=\"tool\"/>"), "its joints go in a circle"),
        (with("<link name=\"tool\">", "<link>"), "<link> has no `name`"),
    ];
    for (text, expected) in table {
        let error = import(&text, &Options::default()).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
        let holonom::Error::Input(input) = error else { unreachable!() };
        assert!(input.place.is_some(), "{expected}");
    }
    let missing = import(ARM, &Options { base: Some("tol".into()), ..Options::default() }).unwrap_err().to_string();
    assert!(missing.contains("at base: there is no link `tol`\n  help: did you mean `tool`?"), "{missing}");
    let closures = vec!["weld:lower@0,0,0:tool@0,0,0".parse().unwrap()];
    let one = import(ARM, &Options { closures, ..Options::default() }).unwrap_err().to_string();
    assert!(one.contains("at close: `lower` and `tool` are one body"), "{one}");
}

#[test]
fn scenes_of_robots_are_valid() {
    let schema: Value = holonom::scene::Elements::default().schema();
    for scene in [imported(ARM, None, &[]).scene, imported(CHAIN, Some("rocker"), &[]).scene] {
        assert_eq!(crate::common::json_schema::faults(&schema, &scene), [""; 0]);
    }
}

#[test]
fn positions_are_read_or_refused() {
    let read = |text: &str| text.parse::<Given>().map_err(|error| error.to_string());
    assert_eq!(read("knee=-pi/2").map(|given| given.value), Ok(-std::f64::consts::FRAC_PI_2));
    assert!(read("knee").unwrap_err().starts_with("`knee` has no value"));
    assert!(read("knee=x").unwrap_err().starts_with("the position of `knee` is no number"));
}
