//! What is refused, with the exact words.

use holonom::scene::Scene;

const BEAM: &str = r#""type": "flexible_beam", "frame": "absolute", "length": 2, "elements": 4,
    "stiffness": { "EA": 1, "EI": 1 }, "inertia": { "rhoA": 1 }"#;

/// The message for a planar scene with such a beam.
fn refusal(body: &str, rest: &str) -> String {
    let text = format!(r#"{{ "name": "s", "dimension": 2, "bodies": [ {{ "name": "rod", {body} }} ] {rest} }}"#);
    match Scene::parse(&text, &[]) {
        Ok(_) => panic!("accepted: {text}"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn bad_beams_are_refused() {
    let marker = |text: &str| format!("{BEAM}, \"markers\": {{ {text} }}");
    let more = |text: &str| format!("{BEAM}, {text}");
    let cases = [
        (BEAM.replace("\"elements\": 4,", ""), "`rod`", "the key `elements` is missing"),
        (BEAM.replace("\"elements\": 4", "\"elements\": 0"), "bodies[0].elements", "elements is 0"),
        (
            BEAM.replace("\"elements\": 4", "\"elements\": -4"),
            "bodies[0].elements",
            "elements is -4, but must be a whole number",
        ),
        (BEAM.replace("\"elements\": 4", "\"elements\": 10001"), "bodies[0].elements", "from 1 to 10000"),
        (BEAM.replace("\"length\": 2", "\"length\": -2"), "bodies[0].length", "length is -2, but must be above zero"),
        (BEAM.replace("\"EI\": 1", "\"EI\": 0"), "bodies[0].stiffness.EI", "must be above zero"),
        (marker(r#""tip": [2.1, 0]"#), "bodies[0].markers.tip", "the marker is off the beam, at s = 2.1"),
        (marker(r#""tip": [-1, 0]"#), "bodies[0].markers.tip", "give [s, ...] with 0 <= s <= 2, the length"),
        (marker(r#""n3": [1, 0]"#), "bodies[0].markers.n3", "`n3` is the name of a node"),
        (more(r#""modes": 3"#), "bodies[0].modes", "an absolute beam has no `modes`"),
        (more(r#""geometric_stiffening": true"#), "bodies[0].geometric_stiffening", "\"frame\": \"floating\""),
        (more(r#""origin": [1, 0]"#), "bodies[0].origin", "the origin of a beam is its left end"),
        (more(r#""damping": { "modal": 0.1 }"#), "bodies[0].damping.modal", "has no modes to damp"),
        (
            more(r#""damping": { "rayleigh": { "mass": 1 } }"#),
            "bodies[0].damping.rayleigh.mass",
            "brake an absolute beam",
        ),
        (more(r#""curvature": [1, 0, 0]"#), "bodies[0].curvature", "expected one number"),
        (
            more(r#""initial": { "rotation": [0, 0, 1] }"#),
            "bodies[0].initial.rotation",
            "a planar body turns by an angle",
        ),
        (more(r#""theory": "timoshenko""#), "bodies[0].stiffness", "a Timoshenko beam needs `GA`"),
    ];
    for (body, place, words) in cases {
        let message = refusal(&body, "");
        assert!(message.contains(place) && message.contains(words), "expected {place} and {words}:\n{message}");
    }
}

#[test]
fn bad_massless_beams_are_refused() {
    let force = |text: &str| {
        let markers = format!(r#"{BEAM}, "markers": {{ "a": [0, 0], "b": [2, 0] }}"#);
        let force =
            format!(r#", "forces": [ {{ "name": "strut", "type": "beam", "between": ["rod.a", "rod.b"] {text} }} ]"#);
        refusal(&markers, &force)
    };
    let stiff = r#", "stiffness": { "EA": 1, "EI": 1 }"#;
    let cases = [
        (stiff.to_string(), "the key `length` is missing"),
        (format!(r#", "length": 0 {stiff}"#), "length is 0, but must be above zero"),
        (r#", "length": 1"#.to_string(), "nothing says how stiff the beam is"),
        (format!(r#", "length": 1, "damping": {{ "stiffness": -1 }} {stiff}"#), "cannot be negative"),
        (r#", "length": 1, "section": { "circle": { "radius": 1 } }"#.to_string(), "the key `material` is missing"),
    ];
    for (text, words) in cases {
        let message = force(&text);
        assert!(message.contains(words) && message.contains("forces[0]"), "expected {words}:\n{message}");
    }
}
