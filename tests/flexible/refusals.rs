//! Beams in floating frames that cannot be meant as they stand, in the words that a user reads.

use holonom::scene::Scene;

const BEAM: &str = r#""type": "flexible_beam", "frame": "floating", "length": 2, "elements": 4,
    "stiffness": { "EA": 1, "EI": 1 }, "inertia": { "rhoA": 1 }"#;

const SOLID: &str = r#""type": "flexible_beam", "frame": "floating", "length": 2, "elements": 4,
    "material": { "E": 2e11, "rho": 7870 }, "section": { "circle": { "radius": 0.01 } }"#;

/// The message for a planar scene with such a beam.
#[track_caller]
fn says(body: &str, message: &str) {
    let text = format!(r#"{{ "name": "s", "dimension": 2, "bodies": [ {{ "name": "rod", {body} }} ] }}"#);
    match Scene::parse(&text, &[]) {
        Ok(_) => panic!("accepted: {text}"),
        Err(error) => assert_eq!(error.to_string(), message),
    }
}

/// The beam with `from` replaced.
fn with(from: &str, to: &str) -> String {
    assert!(BEAM.contains(from));
    BEAM.replace(from, to)
}

fn and(more: &str) -> String {
    format!("{BEAM}, {more}")
}

#[test]
fn stiffness_that_no_beam_has() {
    for (key, value) in [("EA", "0"), ("EA", "-3"), ("EI", "0"), ("EI", "-3")] {
        says(
            &with(&format!("\"{key}\": 1"), &format!("\"{key}\": {value}")),
            &format!(
                "at bodies[0].stiffness.{key} (`rod`): {key} is {value}, but must be above zero\n  help: give a number \
                 above zero"
            ),
        );
    }
    for value in ["0", "-2"] {
        says(
            &SOLID.replace("2e11", value),
            &format!(
                "at bodies[0].material.E (`rod`): E is {value}, but must be above zero\n  help: give a number above zero"
            ),
        );
    }
    says(
        &with("\"rhoA\": 1", "\"rhoA\": 0"),
        "at bodies[0].inertia.rhoA (`rod`): rhoA is 0, but must be above zero\n  help: give a number above zero",
    );
}

#[test]
fn elements_that_cannot_be_counted() {
    says(
        &with("\"elements\": 4", "\"elements\": 0"),
        "at bodies[0].elements (`rod`): elements is 0, but must be above zero\n  help: 4 to 16 are enough for most beams",
    );
    for value in ["-1", "2.5", "1e300"] {
        let shown = if value == "1e300" { "1e300" } else { value };
        says(
            &with("\"elements\": 4", &format!("\"elements\": {value}")),
            &format!("at bodies[0].elements (`rod`): elements is {shown}, but must be a whole number from zero on"),
        );
    }
    says(
        &with("\"elements\": 4", "\"elements\": 10001"),
        "at bodies[0].elements (`rod`): elements is 10001, but at most 10000 are possible\n  help: 4 to 16 are enough \
         for most beams",
    );
}

#[test]
fn markers_and_origin() {
    for at in ["2.1", "-0.3"] {
        says(
            &and(&format!(r#""markers": {{ "tip": [{at}, 0] }}"#)),
            &format!(
                "at bodies[0].markers (`rod`): a marker is at s = {at}, beside the beam\n  help: the beam is from s = 0 to 2"
            ),
        );
    }
    says(
        &and(r#""origin": [1, 0]"#),
        "at bodies[0].origin (`rod`): the origin of a beam is its left end\n  help: remove it",
    );
}

#[test]
fn modes_that_are_not_there() {
    says(
        &and(r#""modes": 40"#),
        "at bodies[0].modes (`rod`): modes is 40, but the mesh has 12 of them\n  help: give fewer modes, or more elements",
    );
    says(
        &with(r#""elements": 4"#, r#""ritz": { "bending": ["x^2"] }, "modes": 2"#),
        "at bodies[0].modes (`rod`): `modes` is for finite elements, whose place `ritz` takes\n  help: remove `modes`, or \
         `ritz`",
    );
    says(
        &and(r#""modes": 2, "geometric_stiffening": "cubic""#),
        "at bodies[0].geometric_stiffening (`rod`): few modes have no axial strain that the cubic law could count\n  help: \
         give true, by which the line shortens as it bends, or leave `modes` out",
    );
}

#[test]
fn starts_of_coordinates_that_are_not_there() {
    for key in ["elastic", "elastic_velocity"] {
        says(
            &and(&format!(r#""initial": {{ "{key}": {{ "n5_y": 0.1 }} }}"#)),
            &format!(
                "at bodies[0].initial.{key}.n5_y (`rod`): there is no elastic coordinate `n5_y`\n  help: did you mean \
                 `n1_y`?"
            ),
        );
    }
    says(
        &and(r#""modes": 1, "markers": { "tip": [2, 0] }, "initial": { "elastic": { "n1_y": 0.1 } }"#),
        "at bodies[0].initial.elastic.n1_y (`rod`): there is no elastic coordinate `n1_y`\n  help: choose one of mode1, \
         mode2, mode3, mode4",
    );
    says(
        &and(r#""initial": { "elastic": { "n4_y": "0.1*" } }"#),
        "at bodies[0].initial.elastic.n4_y (`rod`): expected a value after `*` at character 5, found the end in \"0.1*\"",
    );
}

#[test]
fn keys_of_the_other_kind() {
    says(
        &and(r#""frame_conditions": "corotational""#),
        "at bodies[0].frame_conditions (`rod`): `corotational` is none of the possible values\n  help: choose one of \
         tangent, chord, mean",
    );
    says(
        &with(r#""frame": "floating", "#, ""),
        "at bodies[0] (`rod`): the key `frame` is missing\n  help: add \"frame\": ...; `holonom schema` says what it means",
    );
}
