//! Tapered beams: sections as expressions of s, against closed forms of statics.

use crate::flexible::beams::{FRAMES, THEORIES, at_rest, scene};
use crate::flexible::brief;
use crate::scenes::parse;
use holonom::scene::Scene;

/// A cantilever whose height falls along it from H to half of it.
const LENGTH: f64 = 2.0;
const H: f64 = 0.1;
const WIDTH: f64 = 0.05;
const E: f64 = 1e9;
/// So soft that shear is a third of a deflection.
const G: f64 = 4e5;
const RHO: f64 = 1000.0;
const GRAVITY: f64 = 9.81;

fn height(s: f64) -> f64 {
    H * (1.0 - s / (2.0 * LENGTH))
}

/// EI about z.
fn bending(s: f64) -> f64 {
    E * WIDTH * height(s).powi(3) / 12.0
}

/// `rod` with these keys beside its material and section, with `rest` of the scene.
fn text(frame: &str, theory: &str, elements: usize, rest: &str) -> String {
    let kind = match frame {
        "absolute" => r#""frame": "absolute""#.to_string(),
        frame => format!(r#""frame": "floating", "frame_conditions": "{frame}""#),
    };
    let rod = format!(
        r#"{{ "name": "rod", "type": "flexible_beam", {kind}, "length": {LENGTH}, "elements": {elements},
        "theory": "{theory}", "material": {{ "E": {E}, "G": {G}, "rho": {RHO} }},
        "section": {{ "rectangle": {{ "height": "{H}*(1 - s/{})", "width": {WIDTH} }} }},
        "markers": {{ "root": [0, 0], "tip": [{LENGTH}, 0] }} }}"#,
        2.0 * LENGTH
    );
    scene(
        2,
        &rod,
        &format!(
            r#""joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.wall", "rod.root"] }} ], {rest}"#
        ),
    )
}

/// Where the tip is under a force on it.
fn tip(frame: &str, theory: &str, elements: usize, force: [f64; 2]) -> [f64; 2] {
    let rest = format!(
        r#""forces": [ {{ "name": "load", "type": "applied_force", "at": "rod.tip", "force": [{}, {}] }} ],
        "outputs": [ {{ "name": "x", "measure": "deflection", "of": "rod", "at": {LENGTH}, "component": "x" }},
            {{ "name": "y", "measure": "position", "of": "rod.tip", "component": "y" }},
            {{ "name": "long", "measure": "position", "of": "rod.tip", "component": "x" }} ]"#,
        force[0], force[1]
    );
    let found = at_rest(&parse(&text(frame, theory, elements, &rest)), &["long", "y"]);
    [found[0] - LENGTH, found[1]]
}

/// Prints errors and their orders, and checks these and the last error.
#[track_caller]
fn converges(what: &str, exact: f64, order: f64, last: f64, found: [f64; 4]) {
    let errors = found.map(|found| (found / exact - 1.0).abs());
    let orders = [0, 1, 2].map(|i| (errors[i] / errors[i + 1]).log2());
    println!("{what}: errors {}, orders {orders:.2?}", brief(&errors));
    assert!(orders.iter().all(|found| (found - order).abs() < 0.25), "{what}: {errors:?} {orders:?}");
    assert!(errors[3] < last, "{what}: {errors:?}");
}

/// A force P at the tip, with u = 1 - s/(2 L) and c = 1/2 there: int P (L - s)^2/EI ds = 8 P L^3/EI_0 int (u - c)^2/u^3 du,
/// which is -ln c - 2 (1 - c) + (1 - c^2)/2, and of shear int P/GA ds = -2 P L/GA_0 ln c.
#[test]
fn the_tip_of_a_tapered_cantilever() {
    // The slope is 1e-6, and its square what linear statics leave out.
    let force = 1e-3;
    let c = 0.5f64;
    let bent = 8.0 * force * LENGTH.powi(3) / bending(0.0) * (-c.ln() - 2.0 * (1.0 - c) + (1.0 - c * c) / 2.0);
    let sheared = -2.0 * force * LENGTH * c.ln() / (G * WIDTH * H * 5.0 / 6.0);
    for (frame, theory) in FRAMES.into_iter().flat_map(|frame| THEORIES.map(|theory| (frame, theory))) {
        let exact = bent + if theory == "timoshenko" { sheared } else { 0.0 };
        let found = [4, 8, 16, 32].map(|elements| tip(frame, theory, elements, [0.0, force])[1]);
        // The shear of an element is constant, as that of an absolute one is, but in mean stiffness.
        let (order, last) = match (frame, theory) {
            ("absolute", _) => (2.0, 1e-3),
            (_, "timoshenko") => (2.0, 1e-3),
            _ => (4.0, 2e-7),
        };
        let what = format!("tip, {theory} {frame}");
        converges(&what, exact, order, last, found);
    }
}

/// The mean compliance of an absolute element is exact; a floating one has the mean stiffness, and converges with the
/// square of its length.
#[test]
fn a_tapered_bar_stretches() {
    let force = 1.0;
    let exact = force * 2.0 * LENGTH * 2f64.ln() / (E * WIDTH * H);
    for frame in FRAMES {
        let found = [1, 2, 4, 8].map(|elements| tip(frame, "euler_bernoulli", elements, [force, 0.0])[0]);
        if frame == "absolute" {
            // Six Gauss points on one element leave 6e-10; positions of 2 m have the round-off 2e-16/5e-7 of this.
            assert!(found.iter().all(|found| (found / exact - 1.0).abs() < 4e-9), "{found:?} {exact}");
        } else {
            converges(&format!("bar, {frame}"), exact, 2.0, 1e-3, found);
        }
    }
}

/// The root carries all the weight, a section between the nodes what is beyond it. Weight is linear along the beam, so
/// that the cubics of absolute elements are exact.
#[test]
fn sections_carry_the_weight_beyond() {
    let beyond = |s: f64| {
        let rest = LENGTH - s;
        RHO * GRAVITY * WIDTH * rest * (height(s) + height(LENGTH)) / 2.0
    };
    // Centre of the trapezium beyond, from s.
    let moment = |s: f64| {
        let rest = LENGTH - s;
        let a = height(s);
        let b = height(LENGTH);
        beyond(s) * rest * (a + 2.0 * b) / (3.0 * (a + b))
    };
    let places = [0.0, 0.3, 1.1, 1.9];
    let output = |(i, at): (usize, &f64)| {
        format!(
            r#"{{ "name": "q{i}", "measure": "shear_force", "of": "rod", "at": {at} }},
            {{ "name": "m{i}", "measure": "bending_moment", "of": "rod", "at": {at} }}"#
        )
    };
    let outputs = places.iter().enumerate().map(output).collect::<Vec<_>>().join(", ");
    for (frame, elements) in FRAMES.into_iter().flat_map(|frame| [1, 3, 8].map(|elements| (frame, elements))) {
        let text = text(frame, "euler_bernoulli", elements, &format!(r#""outputs": [ {outputs} ]"#));
        // Stiff, so that the beam hardly bends: 1e-5 of its length.
        let text = text.replace("\"dimension\"", &format!("\"gravity\": [0, -{GRAVITY}], \"dimension\""));
        let ready = parse(&text.replace(&format!("\"E\": {E}"), "\"E\": 1e12"));
        for (i, s) in places.into_iter().enumerate() {
            let [shear, bent] = at_rest(&ready, &[&format!("q{i}"), &format!("m{i}")])[..] else { unreachable!() };
            // The slope is 2e-5; residuals of the equilibrium are round-off of EA.
            let [q, m] = [(shear / -beyond(s)) - 1.0, (bent / -moment(s)) - 1.0];
            println!("weight, {frame} {elements} at {s}: {q:.1e} {m:.1e}");
            assert!(q.abs() < 2e-9 && m.abs() < 1e-8, "{frame} {elements} at {s}: {shear} {bent}");
            assert!(i > 0 || q.abs() < 1e-12, "{frame} {elements}: {shear}");
        }
    }
}

/// Strain of an absolute beam is the bending moment over the EI of the section where it is, not of its element's mean.
#[test]
fn strain_is_that_of_the_section() {
    let force = 1e-3;
    let y = 0.01;
    for s in [0.0, 0.31, 1.0, 1.73] {
        let rest = format!(
            r#""forces": [ {{ "name": "load", "type": "applied_force", "at": "rod.tip", "force": [0, {force}] }} ],
            "outputs": [ {{ "name": "e", "measure": "strain", "of": "rod", "at": {s}, "offset": [{y}] }} ]"#
        );
        let found = at_rest(&parse(&text("absolute", "euler_bernoulli", 2, &rest)), &["e"])[0];
        let exact = -y * force * (LENGTH - s) / bending(s);
        assert!((found / exact - 1.0).abs() < 1e-6, "{found} {exact} at {s}");
    }
}

/// A shaft in two steps with a marker where they meet is exact with an element each, in both kinds.
#[test]
fn a_stepped_shaft() {
    let ei = [100.0, 20.0];
    for frame in FRAMES {
        let text = text(
            frame,
            "euler_bernoulli",
            2,
            r#""forces": [
            { "name": "load", "type": "applied_torque", "at": "rod.tip", "torque": "1e-4" } ],
            "outputs": [ { "name": "y", "measure": "position", "of": "rod.tip", "component": "y" } ]"#,
        );
        let start = text.find("\"material\"").unwrap();
        let end = text.find("\"markers\": { \"root\"").unwrap();
        let numbers =
            r#""stiffness": { "EA": 1e5, "EI": "if(s < 0.7, 100, 20)" }, "inertia": { "rhoA": "if(s < 0.7, 2, 1)" }, "#;
        let text = format!("{}{numbers}{}", &text[..start], &text[end..]);
        let text = text.replace("\"root\": [0, 0]", "\"root\": [0, 0], \"step\": [0.7, 0]");
        let found = at_rest(&parse(&text), &["y"])[0];
        // Curvatures M/EI times their length, and their arms to the tip.
        let exact = 1e-4 * (0.7 / ei[0] * 1.65 + 1.3 / ei[1] * 0.65);
        assert!((found / exact - 1.0).abs() < 1e-9, "{frame}: {found} {exact}");
    }
}

/// A conical shaft in space: its twist under a torque T is int T/GJ ds = 14/3 T L/GJ_0 where the radius falls to a half,
/// and its weight that of a frustum, 7/12 of the cylinder.
#[test]
fn a_conical_shaft() {
    let radius = 0.05f64;
    let torque = 1e-3;
    let gj = 4e8 * std::f64::consts::PI / 2.0 * radius.powi(4);
    let weight = 7.0 / 12.0 * RHO * std::f64::consts::PI * radius * radius * LENGTH * GRAVITY;
    let found = |frame: &str, elements: usize, gravity: f64, load: f64| {
        let kind = match frame {
            "absolute" => r#""frame": "absolute""#.to_string(),
            frame => format!(r#""frame": "floating", "frame_conditions": "{frame}""#),
        };
        let rod = format!(
            r#"{{ "name": "rod", "type": "flexible_beam", {kind}, "length": {LENGTH}, "elements": {elements},
            "material": {{ "E": 1e11, "G": 4e8, "rho": {RHO} }},
            "section": {{ "circle": {{ "radius": "{radius}*(1 - s/4)" }} }},
            "markers": {{ "root": [0, 0, 0], "tip": [{LENGTH}, 0, 0], "off": [{LENGTH}, 0.1, 0] }} }}"#
        );
        let rest = format!(
            r#""gravity": [0, {gravity}, 0], "forces": [
                {{ "name": "load", "type": "applied_torque", "at": "rod.tip", "torque": [{load}, 0, 0] }} ],
            "joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.wall", "rod.root"] }} ],
            "outputs": [ {{ "name": "z", "measure": "position", "of": "rod.off", "component": "z" }},
                {{ "name": "q", "measure": "shear_force", "of": "rod", "at": 0 }} ]"#
        );
        at_rest(&parse(&scene(3, &rod, &rest)), &["z", "q"])
    };
    let exact = 0.1 * 14.0 / 3.0 * torque * LENGTH / gj;
    for frame in FRAMES {
        let twisted = [2, 4, 8, 16].map(|elements| found(frame, elements, 0.0, torque)[0]);
        match frame {
            "absolute" => assert!((twisted[1] / exact - 1.0).abs() < 1e-7, "{twisted:?} {exact}"),
            _ => converges(&format!("shaft, {frame}"), exact, 2.0, 4e-3, twisted),
        }
        for elements in [1, 5] {
            let shear = found(frame, elements, -GRAVITY, 0.0)[1];
            assert!((shear / -weight - 1.0).abs() < 1e-9, "{frame} {elements}: {shear} {weight}");
        }
    }
}

#[track_caller]
fn says(parameters: &str, section: &str, kind: &str, message: &str) {
    let text = format!(
        r#"{{ "name": "s", "dimension": 2, "parameters": {{ {parameters} }}, "bodies": [ {{ "name": "rod",
        "type": "flexible_beam", "frame": "{kind}", "length": 2, "elements": 4,
        "material": {{ "E": 1, "rho": 1 }}, "section": {{ {section} }} }} ] }}"#
    );
    match Scene::parse(&text, &[]) {
        Ok(_) => panic!("accepted: {text}"),
        Err(error) => assert_eq!(error.to_string(), message),
    }
}

#[test]
fn sections_that_no_beam_has() {
    for kind in ["floating", "absolute"] {
        says(
            "",
            r#""rectangle": { "height": "1 - s", "width": 1 }"#,
            kind,
            "at bodies[0].section.rectangle.height (`rod`): rectangle.height is 0 at s = 1, but must be above zero on the \
             whole beam",
        );
        says(
            "",
            r#""circle": { "radius": "1/s" }"#,
            kind,
            "at bodies[0].section.circle.radius (`rod`): circle.radius, `1/s`, is not finite at s = 0",
        );
        says(
            "",
            r#""circle": { "radius": 1, "inner_radius": "0.75*s" }"#,
            kind,
            "at bodies[0].section.circle.inner_radius (`rod`): the inner radius is not smaller than the outer one at s = \
             1.334",
        );
        says(
            r#""s": 2"#,
            r#""rectangle": { "height": "1 + s", "width": 1 }"#,
            kind,
            "at bodies[0].section.rectangle.height (`rod`): `s` is the place along the beam here, but a parameter has this \
             name too\n  help: rename the parameter",
        );
    }
}
