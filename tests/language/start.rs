//! Starts by coordinates of joints, and aims of bodies by their axes.

use crate::scenes::{Ready, parse};
use holonom::prepared::{Model, Overrides};
use holonom::scene::Scene;
use holonom::sweep::Family;
use std::f64::consts::PI;

/// A four-bar linkage: crank 1, coupler 2, rocker 1.5, base 2, the crank at A and the rocker at B.
fn four_bar(initial: &str) -> String {
    format!(
        r#"{{ "name": "four_bar", "dimension": 2, "parameters": {{ "theta": 1 }},
            "ground": {{ "markers": {{ "A": [0, 0], "B": [2, 0] }} }},
            "bodies": [
                {{ "name": "crank", "type": "rigid", "mass": 1, "inertia": 0.1, "origin": [-0.5, 0],
                   "markers": {{ "A": [0, 0], "C": [1, 0] }}, "initial": {{ "angle": 1.2 }} }},
                {{ "name": "coupler", "type": "rigid", "mass": 1, "inertia": 0.1, "origin": [-1, 0],
                   "markers": {{ "C": [0, 0], "D": [2, 0] }}, "initial": {{ "position": [0.4, 0.9], "angle": 0.2 }} }},
                {{ "name": "rocker", "type": "rigid", "mass": 1, "inertia": 0.1, "origin": [-0.75, 0],
                   "markers": {{ "B": [0, 0], "D": [1.5, 0] }}, "initial": {{ "position": [2, 0], "angle": 1.3 }} }}],
            "joints": [
                {{ "name": "A", "type": "revolute", "between": ["ground.A", "crank.A"] }},
                {{ "name": "C", "type": "revolute", "between": ["crank.C", "coupler.C"] }},
                {{ "name": "D", "type": "revolute", "between": ["coupler.D", "rocker.D"] }},
                {{ "name": "B", "type": "revolute", "between": ["ground.B", "rocker.B"] }}],
            "outputs": [{{ "name": "beta", "measure": "angle", "of": "rocker" }}],
            "initial": {{ {initial} }} }}"#
    )
}

/// Angle of the rocker above the base for a crank angle: by the diagonal from the crank's end to B.
fn rocker(theta: f64) -> f64 {
    let x = 2.0 - theta.cos();
    let y = -theta.sin();
    let diagonal = x.hypot(y);
    let at_b = ((diagonal * diagonal + 2.25 - 4.0) / (3.0 * diagonal)).acos();
    (-y).atan2(-x) - at_b
}

fn state(ready: &Ready) -> impl Fn(&str) -> f64 {
    let names = ready.system().facts().names.clone();
    let values = names.q.into_iter().zip(ready.start().q.clone());
    let rates = names.v.into_iter().zip(ready.start().v.clone());
    let all: Vec<(String, f64)> = values.chain(rates).collect();
    move |name| all.iter().find(|(known, _)| known == name).unwrap_or_else(|| panic!("no {name}")).1
}

/// A slider crank, crank 1 and rod 2.5, with the slider ahead: it comes from 1.5 to 3.5.
fn slider_crank(initial: &str) -> Result<Model, String> {
    let rod = |name: &str, length: f64, initial: &str| {
        format!(
            r#"{{ "name": "{name}", "type": "rigid", "mass": 1, "inertia": 0.1, "origin": [{}, 0],
                "markers": {{ "a": [0, 0], "b": [{length}, 0] }}, "initial": {{ {initial} }} }}"#,
            -0.5 * length
        )
    };
    let text = format!(
        r#"{{ "name": "slider_crank", "dimension": 2, "ground": {{ "markers": {{ "O": [0, 0] }} }},
            "bodies": [{}, {}, {{ "name": "slider", "type": "rigid", "mass": 1, "inertia": 1,
                                  "initial": {{ "position": [3.3, 0] }} }}],
            "joints": [
                {{ "name": "O", "type": "revolute", "between": ["ground.O", "crank.a"] }},
                {{ "name": "A", "type": "revolute", "between": ["crank.b", "rod.a"] }},
                {{ "name": "B", "type": "revolute", "between": ["rod.b", "slider"] }},
                {{ "name": "S", "type": "prismatic", "between": ["ground.O", "slider"] }}],
            "initial": {{ {initial} }}, "simulation": {{ "t_end": 1 }} }}"#,
        rod("crank", 1.0, r#""angle": 0.5"#),
        rod("rod", 2.5, r#""position": [0.88, 0.48], "angle": -0.19"#)
    );
    let scene = Scene::parse(&text, &[]).map_err(|error| error.to_string())?;
    Model::new(scene, &Overrides::default()).map_err(|error| error.to_string())
}

#[test]
fn a_value_on_another_branch_is_refused() {
    for (x, is_reached) in [(1.5, true), (2.0, true), (3.5, true), (1.4, false), (-2.0, false), (-3.0, false)] {
        let found = slider_crank(&format!(r#""S.position": {x}"#));
        assert_eq!(found.is_ok(), is_reached, "{x}: {:?}", found.err());
    }
    let told = slider_crank(r#""S.position": -2"#).err().unwrap();
    assert!(
        told.contains("on another branch") && told.contains("they stop short by `initial S.position` 3.5"),
        "{told}"
    );
}

#[test]
fn a_rate_at_a_dead_centre_is_refused() {
    let told = slider_crank(r#""S.position": 3.5, "S.position'": 1"#).err().unwrap();
    assert!(told.contains("the joints are at a dead centre"), "{told}");
    assert!(slider_crank(r#""S.position": 3.4999, "S.position'": 0.1"#).is_ok());
}

/// A spring on the hinge is wound up by full turns.
#[test]
fn full_turns_of_a_hinge_count() {
    for angle in [3.5, 2.0 * PI, 7.0] {
        let ready = parse(&format!(
            r#"{{ "name": "wound", "dimension": 2, "ground": {{ "markers": {{ "A": [0, 0] }} }},
                "bodies": [{{ "name": "rod", "type": "rigid", "mass": 1, "inertia": 0.1, "markers": {{ "A": [-0.5, 0] }},
                             "initial": {{ "position": [0.5, 0] }} }}],
                "joints": [{{ "name": "A", "type": "revolute", "between": ["ground.A", "rod.A"] }}],
                "forces": [{{ "name": "s", "type": "torsion_spring", "between": ["ground.A", "rod.A"], "stiffness": 1 }}],
                "initial": {{ "A.angle": {angle} }} }}"#
        ));
        let at = state(&ready);
        assert!((at("rod.angle") - angle).abs() < 1e-14 && (at("rod.x") - 0.5 * angle.cos()).abs() < 1e-14, "{angle}");
    }
}

#[test]
fn a_loop_starts_at_the_angle_of_its_joint() {
    let ready = parse(&four_bar(r#""A.angle": "theta + 0.5", "A.angle'": 3"#));
    let at = state(&ready);
    assert!((at("crank.angle") - 1.5).abs() < 1e-13, "{}", at("crank.angle"));
    assert!((at("rocker.angle") - rocker(1.5)).abs() < 1e-12, "{} {}", at("rocker.angle"), rocker(1.5));
    let h = 1e-5;
    let slope = (rocker(1.5 + h) - rocker(1.5 - h)) / (2.0 * h);
    assert!((at("crank.angle'") - 3.0).abs() < 1e-13);
    assert!((at("rocker.angle'") - 3.0 * slope).abs() < 1e-8);
    // An angle between two moving bodies, and none but a rate.
    let ready = parse(&four_bar(r#""C.angle": -1"#));
    let at = state(&ready);
    assert!((at("coupler.angle") - at("crank.angle") + 1.0).abs() < 1e-13);
    let ready = parse(&four_bar(r#""B.angle'": -2"#));
    assert!((state(&ready)("rocker.angle'") + 2.0).abs() < 1e-13);
    assert!(ready.start().after.phi < 1e-14 && ready.start().after.phi_dot < 1e-13);
}

/// The crank goes around; the rocker stays on its branch, by the closed form.
#[test]
fn a_loop_is_turned_to_an_angle_far_from_the_guess() {
    for k in -12..=16 {
        let angle = 0.5 * f64::from(k);
        let at = parse(&four_bar(&format!(r#""A.angle": {angle}"#)));
        let at = state(&at);
        assert!((at("crank.angle") - angle).abs() < 1e-12, "{angle}: {}", at("crank.angle"));
        let off = (at("rocker.angle") - rocker(angle)).rem_euclid(2.0 * PI);
        assert!(off.min(2.0 * PI - off) < 1e-11, "{angle}: the rocker is off by {off}");
    }
}

#[test]
fn values_that_cannot_be_are_refused_with_their_names() {
    let refused = |initial: &str| {
        let scene = Scene::parse(&four_bar(initial), &[]);
        scene.and_then(|scene| Model::new(scene, &Overrides::default())).map(|_| ()).unwrap_err().to_string()
    };
    let table = [
        (r#""A.angle": 1, "B.angle": 3"#, "at initial: the joints cannot be closed with the coordinates in `initial`"),
        (r#""A.angle": 1, "B.angle": 3"#, "`initial B.angle`"),
        // The rocker turns back where crank and coupler are in line, 1 from A to D: at acos((1 - 4 - 2.25)/6) = 2.636.
        (r#""B.angle": 3"#, "turned there from the guess, they stop short by `initial B.angle` 0.364"),
        (r#""A.angle'": 1, "B.angle'": 3"#, "at initial: the rates in `initial` contradict the joints or each other"),
        (r#""E.angle": 1"#, "at initial.E.angle: there is no joint `E`"),
        (r#""A.angel": 1"#, "at initial.A.angel: the revolute joint `A` has no coordinate `angel`"),
        (r#""A": 1"#, "at initial.A: `A` is no coordinate of a joint"),
        (r#""A.angle": "2*x""#, "at initial.A.angle: unknown name `x`"),
        (r#""crank.angle": 1"#, "at initial.crank.angle: there is no joint `crank`"),
    ];
    for (initial, expected) in table {
        let message = refused(initial);
        assert!(message.contains(expected), "{message}");
    }
    let degrees = parse(&four_bar(r#""A.angle": "80""#));
    assert!(degrees.0.doubts.iter().any(|doubt| doubt.text.contains("`A.angle` is 80 rad")));
}

/// One body on the ground by a joint in space, with its own axis.
fn spatial(joint: &str, initial: &str) -> Ready {
    parse(&format!(
        r#"{{ "name": "s", "dimension": 3, "ground": {{ "markers": {{ "O": [0.1, 0.2, 0.3] }} }},
            "bodies": [{{ "name": "b", "type": "rigid", "mass": 1, "inertia": [1, 2, 2.5], "markers": {{ "P": [0, 0, 0] }} }}],
            "joints": [{{ "name": "J", "between": ["ground.O", "b.P"], {joint} }}], "initial": {{ {initial} }} }}"#
    ))
}

#[track_caller]
fn starts_at(ready: &Ready, expected: &[(&str, f64)]) {
    let at = state(ready);
    for (name, value) in expected {
        assert!((at(name) - value).abs() < 1e-12, "{name} is {}, not {value}", at(name));
    }
}

#[test]
fn joints_in_space_have_their_coordinates() {
    let (s, c) = (0.25f64).sin_cos();
    let hinge = spatial(r#""type": "revolute", "axis": [1, 0, 0]"#, r#""J.angle": 0.5, "J.angle'": -2"#);
    starts_at(&hinge, &[("b.qw", c), ("b.qx", s), ("b.qy", 0.0), ("b.x", 0.1), ("b.wx", -2.0), ("b.wy", 0.0)]);
    let slider = spatial(r#""type": "prismatic", "axis": [0, 1, 0]"#, r#""J.position": 0.7, "J.position'": 3"#);
    starts_at(&slider, &[("b.x", 0.1), ("b.y", 0.9), ("b.z", 0.3), ("b.y'", 3.0), ("b.qw", 1.0)]);
    let both = spatial(r#""type": "cylindrical""#, r#""J.position": -1, "J.angle": 0.5, "J.position'": 1"#);
    starts_at(&both, &[("b.z", -0.7), ("b.qw", c), ("b.qz", s), ("b.z'", 1.0), ("b.wz", 0.0)]);
    let planar = spatial(r#""type": "planar""#, r#""J.x": 1, "J.y": 2, "J.angle": 0.5, "J.angle'": 4"#);
    starts_at(&planar, &[("b.x", 1.1), ("b.y", 2.2), ("b.z", 0.3), ("b.qz", s), ("b.wz", 4.0)]);
    // R_x(0.4) R_y(-0.6)
    let ((sx, cx), (sy, cy)) = (0.2f64.sin_cos(), (-0.3f64).sin_cos());
    let cross = spatial(r#""type": "universal""#, r#""J.angle1": 0.4, "J.angle2": -0.6"#);
    starts_at(&cross, &[("b.qw", cx * cy), ("b.qx", sx * cy), ("b.qy", cx * sy), ("b.qz", sx * sy)]);
    let ball = r#"{ "name": "s", "dimension": 3, "bodies": [{ "name": "b", "type": "rigid", "mass": 1, "inertia": [1, 1, 1] }],
        "joints": [{ "name": "J", "type": "spherical", "between": ["ground", "b"] }], "initial": { "J.angle": 1 } }"#;
    let message = Scene::parse(ball, &[]).map(|_| ()).unwrap_err().to_string();
    assert!(message.contains("a joint of type `spherical` has no coordinate of its own"), "{message}");
}

#[test]
fn a_sweep_over_a_start_angle_is_a_position_curve() {
    let family = Family::parse_with(&four_bar(r#""A.angle": "theta""#), &Overrides::default()).unwrap();
    let swept = family.sweep(&"theta=0.6..1.8:7".parse().unwrap(), |_| ()).unwrap();
    assert_eq!(swept.points.len(), 7);
    for point in &swept.points {
        assert!((point.outputs[0] - rocker(point.value)).abs() < 1e-11, "{} {}", point.value, point.outputs[0]);
        assert_eq!(point.lambda.len(), 8);
    }
}

#[test]
fn a_body_is_aimed_by_its_axes() {
    let body = |initial: &str| {
        let text = format!(
            r#"{{ "name": "s", "dimension": 3, "bodies": [{{ "name": "b", "type": "rigid", "mass": 1, "inertia": [1, 1, 1],
                "initial": {{ {initial} }} }}] }}"#
        );
        Scene::parse(&text, &[]).map(|scene| scene.q).map_err(|error| error.to_string())
    };
    let turned = body(&format!(r#""rotation": [0, {}, 0]"#, PI / 2.0)).unwrap();
    let aimed = body(r#""z_axis": [2, 0, 0], "x_axis": [7, 0, -1]"#).unwrap();
    assert!(turned.iter().zip(&aimed).all(|(a, b)| (a - b).abs() < 1e-15), "{turned:?} {aimed:?}");
    assert!(body(r#""z_axis": [0, 0, 0]"#).unwrap_err().contains("at bodies[0].initial.z_axis (`b`): the axis has no"));
    let both = body(r#""z_axis": [0, 0, 1], "rotation": [0, 0, 0]"#).unwrap_err();
    assert!(both.contains("at bodies[0].initial (`b`): both a rotation and axes are given"), "{both}");
    let planar = r#"{ "name": "s", "dimension": 2, "bodies": [{ "name": "b", "type": "rigid", "mass": 1, "inertia": 1,
        "initial": { "x_axis": [1, 0] } }] }"#;
    let message = Scene::parse(planar, &[]).map(|_| ()).unwrap_err().to_string();
    assert!(message.contains("at bodies[0].initial.x_axis (`b`): a planar body turns by an angle"), "{message}");
}
