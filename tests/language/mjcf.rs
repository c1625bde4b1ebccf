//! Scenes from MJCF: the same motion as by hand, conventions of frames, defaults, equalities, motors.

use crate::scenes::parse;
use holonom::import::{Imported, Options, mjcf::import};
use holonom::report::check;
use holonom::scene::json;
use serde_json::Value;
use std::f64::consts::PI;

fn imported(text: &str) -> Imported {
    import(text, &Options::default()).unwrap()
}

/// A model whose world has this in it.
fn world(text: &str) -> Imported {
    imported(&format!("<mujoco>{text}</mujoco>"))
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

#[track_caller]
fn near(found: &[f64], expected: &[f64], tolerance: f64) {
    let is_near = found.iter().zip(expected).all(|(x, y)| (x - y).abs() <= tolerance);
    assert!(is_near && found.len() == expected.len(), "{found:?} is not {expected:?}");
}

/// Both arms lie on the x axis of the world: the upper one by -90 degrees about y, the lower one by 60 more.
#[test]
fn a_double_pendulum_moves_as_by_hand() {
    let about_y = json!({ "position": [0, 0, 0], "z_axis": [0, 1, 0], "x_axis": [1, 0, 0] });
    let mut at_elbow = about_y.clone();
    at_elbow["position"] = json!([0, 0, -0.8]);
    let mut at_shoulder = about_y.clone();
    (at_shoulder["position"], at_shoulder["x_axis"]) = (json!([0, 0, 1]), json!([0, 0, 1]));
    let turned = |degrees: f64| json!([(0.5 * degrees.to_radians()).cos(), 0, (0.5 * degrees.to_radians()).sin(), 0]);
    let mut turned_elbow = at_elbow.clone();
    // The lower arm's x axis in the frame of the upper one.
    let sixty = PI / 3.0;
    turned_elbow["x_axis"] = json!([sixty.cos(), 0, -sixty.sin()]);
    let damper = |name: &str, a: &str, b: &str, c: f64| json!({ "name": name, "type": "torsion_spring", "between": [a, b], "damping": c });
    let hand = json!({ "name": "hand", "dimension": 3, "gravity": [0, 0, -9.8],
        "ground": { "markers": { "S": at_shoulder } },
        "bodies": [
            { "name": "upper", "type": "rigid", "mass": 2, "inertia": [0.1, 0.12, 0.03], "origin": [0, 0, 0.4],
              "markers": { "S": about_y, "E": turned_elbow }, "initial": { "position": [0, 0, 1], "rotation": turned(-90.0) } },
            { "name": "lower", "type": "rigid", "mass": 1, "inertia": [0.04, 0.05, 0.02, 0, 0.003, 0],
              "origin": [0, 0, 0.3], "markers": { "E": about_y },
              "initial": { "position": [0.8, 0, 1], "rotation": turned(-30.0) } }],
        "joints": [{ "name": "shoulder", "type": "revolute", "between": ["ground.S", "upper.S"] },
                   { "name": "elbow", "type": "revolute", "between": ["upper.E", "lower.E"] }],
        "forces": [damper("c", "ground.S", "upper.S", 0.02), damper("d", "upper.E", "lower.E", 0.01)],
        "outputs": [{ "name": "x", "measure": "position", "of": "lower.E", "component": "x" },
                    { "name": "turn", "measure": "angle", "of": "lower.E", "relative_to": "upper.E" }] });
    let mut ours = imported(include_str!("../data/import/double_pendulum.xml")).scene;
    assert_eq!(ours["initial"], json!({ "shoulder.angle": 0, "elbow.angle": 0 }));
    ours["outputs"] = json!([{ "name": "x", "measure": "position", "of": "lower.elbow", "component": "x" },
                             { "name": "turn", "measure": "angle", "of": "lower.elbow", "relative_to": "upper.elbow" }]);
    let [ours, hand] = [ours, hand].map(|scene| parse(&scene.to_string()).tight(1e-11, 1.5, 0.1));
    for output in ["x", "turn"] {
        let a = ours.column(output);
        let b = hand.column(output);
        near(&a, &b, 1e-9);
        assert!((a[0] - a.last().unwrap()).abs() > 0.1, "{output} moves: {a:?}");
    }
}

/// The parallelogram of the URDF tests: 1/2 I w^2 + g s cos(angle) with I = 2 (0.1 + 1/4) + 2 and s = 2 (1/2) + 2.
#[test]
fn a_four_bar_is_closed_by_connect() {
    let four_bar = imported(include_str!("../data/import/four_bar.xml"));
    let told = "softness of the equalities, which are exact constraints here: D";
    assert!(four_bar.left_out.iter().any(|what| what == told), "{:?}", four_bar.left_out);
    let mut scene = four_bar.scene;
    assert_eq!(scene.get("initial"), None);
    scene["initial"] = json!({ "A.angle'": 1 });
    let ready = parse(&scene.to_string());
    assert_eq!(check(&ready.0).degrees_of_freedom, 1);
    let run = ready.tight(1e-10, 0.8, 0.4);
    let angle = run.column("A");
    let rate = run.column("crank.wy");
    assert!(angle[2] > 0.3, "{angle:?}");
    near(&angle, &run.column("B"), 1e-9);
    let energy = |i: usize| 0.5 * 2.7 * rate[i].powi(2) + 9.81 * 3.0 * angle[i].cos();
    assert!((energy(2) - energy(0)).abs() < 1e-8 * energy(0), "{} {}", energy(0), energy(2));
}

/// Mass, centre and Ixx, Iyy, Izz of geoms against the formulas.
#[test]
fn inertia_follows_from_geoms() {
    let r = 0.1;
    let h = 0.3;
    let rod = 1000.0 * PI * r * r * 2.0 * h;
    let half = 500.0 * 4.0 / 3.0 * PI * r.powi(3);
    // A half ball about its own centre of mass, 3 r/8 from the disc, and from there to the middle.
    let across =
        rod * (r * r / 4.0 + h * h / 3.0) + 2.0 * half * ((2.0 / 5.0 - 9.0 / 64.0) * r * r + (h + 0.375 * r).powi(2));
    let capsule = (rod + 2.0 * half, [across, across, 0.5 * rod * r * r + 0.8 * half * r * r]);
    let ball = 1000.0 * 4.0 / 3.0 * PI * 0.008;
    let block = [2.0 / 3.0 * (0.04 + 0.09), 2.0 / 3.0 * (0.01 + 0.09), 2.0 / 3.0 * (0.01 + 0.04)];
    let wheel = [3.0 * (0.0025 + 0.03), 3.0 * (0.0025 + 0.03), 3.0 * 0.005];
    let egg = [0.2 * (0.04 + 0.09), 0.2 * (0.01 + 0.09), 0.2 * (0.01 + 0.04)];
    let table: [(&str, f64, [f64; 3]); 6] = [
        (r#"type="capsule" size="0.1 0.3""#, capsule.0, capsule.1),
        (r#"type="capsule" size="0.1" fromto="0 0 0.3 0 0 -0.3""#, capsule.0, capsule.1),
        (r#"size="0.2""#, ball, [0.4 * ball * 0.04; 3]),
        (r#"type="box" size="0.1 0.2 0.3" mass="2""#, 2.0, block),
        (r#"type="cylinder" size="0.1 0.3" mass="3""#, 3.0, wheel),
        (r#"type="ellipsoid" size="0.1 0.2 0.3" mass="1""#, 1.0, egg),
    ];
    for (geom, mass, inertia) in table {
        let made = world(&format!("<worldbody><body><freejoint/><geom {geom}/></body></worldbody>"));
        let body = &made.scene["bodies"][0];
        assert!((body["mass"].as_f64().unwrap() - mass).abs() < 1e-13 * mass, "{geom}: {body}");
        near(&numbers(&body["inertia"])[..3], &inertia, 1e-13 * inertia[0]);
        near(&numbers(&body["origin"]), &[0.0; 3], 1e-15);
    }
}

/// Two balls of 1 kg at 1 and 3 on x, turned by a quarter to y: the centre is at y = 2, and Ixx = Izz = 2 (1 + 0.4 r^2).
#[test]
fn geoms_add_up_in_their_frames() {
    let body = r#"<body><freejoint/><frame euler="0 0 90"><geom size=".1" mass="1" pos="1 0 0"/>
        <geom size=".1" mass="1" pos="3 0 0"/></frame><geom type="mesh" mesh="skin" density="0"/></body>"#;
    let made = world(&format!("<worldbody>{body}</worldbody>"));
    let body = &made.scene["bodies"][0];
    near(&numbers(&body["origin"]), &[0.0, -2.0, 0.0], 1e-14);
    near(&numbers(&body["inertia"])[..3], &[2.008, 0.008, 2.008], 1e-14);
    assert!(!made.left_out.iter().any(|what| what.contains("mass")), "{:?}", made.left_out);
    let scaled = world(&format!(
        "<compiler settotalmass=\"6\"/><worldbody>{}</worldbody>",
        r#"<body><freejoint/><geom size=".1" mass="1"/></body><body pos="1 0 0"><freejoint/><geom size=".1" mass="2"/></body>"#
    ));
    assert_eq!(scaled.scene["bodies"][0]["mass"], 2.0);
    near(&numbers(&scaled.scene["bodies"][1]["inertia"])[..1], &[4.0 * 0.004], 1e-15);
}

/// The ways to turn a frame against rotation matrices by hand.
#[test]
fn frames_turn_by_their_conventions() {
    // x to y, y to z, z to x: a third of a turn about (1, 1, 1).
    let third = [0.5; 4];
    let (s, c) = (PI / 8.0).sin_cos();
    let intrinsic = r#"eulerseq="xyz""#;
    let table = [
        ("", r#"quat="2 2 2 2""#, third),
        ("", r#"axisangle="1 1 1 120""#, third),
        ("", r#"xyaxes="0 2 0 0 1 3""#, third),
        // About x, then about the new y: z goes to x.
        (intrinsic, r#"euler="90 90 0""#, [0.5, 0.5, 0.5, 0.5]),
        // About the fixed x and then the fixed y: the other way round.
        (r#"eulerseq="XYZ""#, r#"euler="90 90 0""#, [0.5, 0.5, 0.5, -0.5]),
        (r#"angle="radian" eulerseq="zyx""#, r#"euler="0.7853981633974483 0 0""#, [c, 0.0, 0.0, s]),
        ("", r#"zaxis="0 -3 0""#, [0.5f64.sqrt(), 0.5f64.sqrt(), 0.0, 0.0]),
    ];
    for (compiler, turn, expected) in table {
        let text =
            format!("<compiler {compiler}/><worldbody><body {turn}><freejoint/><geom size=\"1\"/></body></worldbody>");
        let rotation = numbers(&world(&text).scene["bodies"][0]["initial"]["rotation"]);
        let sign = if rotation[0] * expected[0] < 0.0 { -1.0 } else { 1.0 };
        near(&rotation.iter().map(|x| sign * x).collect::<Vec<_>>(), &expected, 4e-15);
    }
}

/// A class of a class, that of the bodies around, and an own value.
#[test]
fn defaults_come_from_classes() {
    let made = world(
        r#"<default><joint damping="1" axis="1 0 0"/><default class="arm"><joint damping="2"/>
             <default class="hand"><joint type="slide"/></default></default></default>
           <worldbody><body name="a"><joint name="a"/><geom size="1"/>
             <body name="b" childclass="arm"><joint name="b"/><geom size="1"/>
               <body name="c"><joint name="c" class="hand" damping="3"/><geom size="1"/></body></body></body></worldbody>"#,
    );
    let kinds: Vec<&Value> = made.scene["joints"].as_array().unwrap().iter().map(|joint| &joint["type"]).collect();
    assert_eq!(kinds, ["revolute", "revolute", "prismatic"]);
    let forces = &made.scene["forces"];
    assert_eq!(
        [&forces[0]["damping"], &forces[1]["damping"], &forces[2]["force"][2]],
        [&json!(1.0), &json!(2.0), &json!("-(3)*c_2'")]
    );
}

/// (m + a) x'' = -c x' - k (x - x0) along the horizontal, from the position `ref`.
#[test]
fn sliders_have_springs_dampers_rotors_and_a_position_of_the_file() {
    let made = world(
        r#"<worldbody><body pos="5 0 0"><joint name="x" type="slide" axis="1 0 0" ref="0.5" springref="0.2"
             stiffness="8" damping="2" armature="0.5"/><geom size=".1" mass="1.5"/></body></worldbody>"#,
    );
    let run = parse(&made.scene.to_string()).tight(1e-11, 2.0, 0.25);
    let decay = 0.5;
    let w = (4.0f64 - 0.25).sqrt();
    let x = |t: f64| 0.2 + 0.3 * (-decay * t).exp() * ((w * t).cos() + decay / w * (w * t).sin());
    assert!(run.worst("x", x) < 1e-9, "{:?}", run.column("x"));
}

/// (J + a) angle'' = -k (angle - rest) about the vertical, from `ref`; in degrees, more than half a turn from rest.
#[test]
fn hinges_have_springs_and_rotors_in_degrees() {
    let made = world(
        r#"<worldbody><body><joint name="q" ref="30" springref="240" stiffness="3" armature="0.25"/>
             <inertial pos="0 0 0" mass="1" diaginertia="1 1 0.5"/></body></worldbody>"#,
    );
    let run = parse(&made.scene.to_string()).tight(1e-11, 2.0, 0.25);
    let angle = |t: f64| (240.0 - 210.0 * (2.0 * t).cos()) * PI / 180.0;
    assert!(run.worst("q", angle) < 1e-9, "{:?}", run.column("q"));
}

/// w' = -c/J w of a ball on its centre.
#[test]
fn balls_are_damped() {
    let mut made = world(
        r#"<worldbody><body name="b"><joint type="ball" damping="0.3"/>
             <inertial pos="0 0 0" mass="1" diaginertia="0.2 0.2 0.2"/></body></worldbody>"#,
    );
    made.scene["bodies"][0]["initial"]["angular_velocity"] = json!([1, 2, -3]);
    let run = parse(&made.scene.to_string()).tight(1e-11, 1.0, 0.25);
    assert!(run.worst("b.wz", |t| -3.0 * (-1.5 * t).exp()) < 1e-9);
}

/// y - 0.1 = 0.2 + 2 (x - 0.3)^2, and a joint that stands at its constant.
#[test]
fn joints_are_coupled_by_polynomials() {
    let slide = |name: &str, more: &str| {
        format!(
            "<body><joint name=\"{name}\" type=\"slide\" axis=\"1 0 0\" {more}/><geom size=\".1\" mass=\"1\"/></body>"
        )
    };
    let mut made = world(&format!(
        "<worldbody>{}{}{}</worldbody><equality><joint joint1=\"y\" joint2=\"x\" polycoef=\"0.2 0 2 0 0\"/>\
         <joint joint1=\"z\" polycoef=\"0.4 1 0 0 0\"/></equality>",
        slide("x", "ref=\"0.3\""),
        slide("y", "ref=\"0.1\""),
        slide("z", "")
    ));
    made.scene["initial"]["x.position'"] = json!(1);
    let run = parse(&made.scene.to_string()).tight(1e-11, 1.0, 0.25);
    let x = run.column("x");
    assert!((x[0] - 0.3).abs() < 1e-12 && x[4] > 0.4, "{x:?}");
    let y: Vec<f64> = x.iter().map(|x| 0.3 + 2.0 * (x - 0.3).powi(2)).collect();
    near(&run.column("y"), &y, 1e-9);
    near(&run.column("z"), &[0.4; 5], 1e-12);
}

/// A bar that is welded at its other end to the world, at `relpose` too; both hold six directions of a free body.
#[test]
fn welds_hold_where_they_are_or_at_their_pose() {
    let free = |weld: &str| {
        let text = format!(
            "<worldbody><body name=\"b\" pos=\"1 2 3\" euler=\"0 0 30\"><freejoint/><geom size=\"1\"/></body></worldbody>\
             <equality><weld body1=\"b\" {weld}/></equality>"
        );
        let ready = parse(&world(&text).scene.to_string());
        assert_eq!(check(&ready.0).degrees_of_freedom, 0);
        ready.start().q.clone()
    };
    near(&free("")[..3], &[1.0, 2.0, 3.0], 1e-12);
    // The world at (0, 0, -1) in the body, not turned.
    near(&free("relpose=\"0 0 -1 1 0 0 0\"")[..4], &[0.0, 0.0, 1.0, 1.0], 1e-9);
}

/// (J + 50^2 a) angle'' = u; m x'' = u, x first: links without mass stand between the joints of one body.
#[test]
fn motors_are_inputs_and_bodies_have_several_joints() {
    let mut made = world(
        r#"<option gravity="0 0 0"/><worldbody><body name="b"><joint name="x" type="slide" axis="1 0 0"/><joint name="q" axis="0 0 1"/>
             <inertial pos="0 0 0" mass="2" diaginertia="1 1 0.5"/></body></worldbody>
           <actuator><motor name="m" joint="q" gear="50" ctrlrange="-1 1" armature="0.0002"/><motor joint="x"/><position joint="x" kp="3"/></actuator>"#,
    );
    let told = made.left_out.join("\n");
    for piece in ["gear of the motors", "bounds of the motors m", "actuators of the type position: position_3"] {
        assert!(told.contains(piece), "{told}");
    }
    assert!(!told.contains("mass"), "{told}");
    made.scene["inputs"][0]["value"] = json!(3);
    made.scene["inputs"][1]["value"] = json!(4);
    let ready = parse(&made.scene.to_string());
    assert_eq!(check(&ready.0).degrees_of_freedom, 2);
    let run = ready.tight(1e-11, 1.0, 0.25);
    assert!(run.worst("q", |t| 1.5 * t * t) < 1e-9 && run.worst("x", |t| t * t) < 1e-9);
}

#[test]
fn what_a_scene_has_no_place_for_is_told() {
    let made = world(
        r#"<option timestep="0.01" viscosity="1"/><asset><mesh name="m" file="m.stl"/></asset>
           <worldbody><body name="b" gravcomp="1"><joint name="j" range="-10 10" frictionloss="1" stiffness="1 2"/>
             <geom type="mesh" mesh="m"/><geom size="1"/><camera/></body></worldbody>
           <equality><connect active="false" body1="b" anchor="0 0 0"/><tendon tendon1="t"/></equality>
           <tendon/><contact/><sensor/>"#,
    );
    let told = made.left_out.join("\n");
    for piece in [
        "limits of the joints j",
        "dry friction (frictionloss) of the joints j",
        "stiffness beyond the linear term of the joints j",
        "gravcomp of the bodies b",
        "mass of the meshes",
        "contacts of the bodies b",
        "equalities that are not active: connect_1",
        "equalities of the type tendon: tendon_2",
        "elements asset, tendon, contact, sensor",
        "forces of the medium: viscosity",
        "settings of the solver: timestep",
    ] {
        assert!(told.contains(piece), "{piece} in\n{told}");
    }
}

#[test]
fn faults_of_the_file_are_told_with_their_place() {
    let table = [
        ("<include file=\"a.xml\"/>", "a part of the model is in `a.xml`"),
        ("<compiler coordinate=\"global\"/>", "global coordinates"),
        ("<compiler eulerseq=\"abc\"/>", "expected three of x, y, z, X, Y, Z"),
        ("<worldbody><body><joint type=\"hing\"/></body></worldbody>", "there is no joint of type `hing`"),
        ("<worldbody><body><joint class=\"c\"/></body></worldbody>", "there is no default class `c`"),
        ("<worldbody><body><geom type=\"box\" size=\"1 1\"/></body></worldbody>", "a box has 3 sizes above zero"),
        ("<worldbody><body name=\"b\"/><body name=\"b\"/></worldbody>", "the name `b` is taken"),
        ("<worldbody><body><body><freejoint/></body></body></worldbody>", "is not in a body of the world"),
        ("<worldbody/><equality><weld body1=\"b\"/></equality>", "there is no body `b`"),
        ("<worldbody/><actuator><motor joint=\"j\"/></actuator>", "there is no joint `j`"),
        (
            "<worldbody><body name=\"b\"><joint name=\"j\"/></body></worldbody><equality><joint joint1=\"j\" joint2=\"j\"/></equality>",
            "the joint is coupled with itself",
        ),
    ];
    for (text, expected) in table {
        let error = import(&format!("<mujoco>{text}</mujoco>"), &Options::default()).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
        let holonom::Error::Input(input) = error else { unreachable!() };
        assert!(input.place.is_some(), "{expected}");
    }
    let free = Options { is_free: true, ..Options::default() };
    let error = import("<mujoco/>", &free).unwrap_err().to_string();
    assert!(error.contains("at free: an MJCF file says itself what is free"), "{error}");
}

#[test]
fn scenes_of_models_are_valid() {
    let schema: Value = holonom::scene::Elements::default().schema();
    for text in [include_str!("../data/import/double_pendulum.xml"), include_str!("../data/import/four_bar.xml")] {
        assert_eq!(crate::common::json_schema::faults(&schema, &imported(text).scene), [""; 0]);
    }
}
