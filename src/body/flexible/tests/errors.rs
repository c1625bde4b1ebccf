//! Errors for beams that are not valid.

use super::*;

#[track_caller]
fn says(more: Value, expected: &str) {
    let error = build::<2>(&beam(more), &[0.0, 1.5]).err().unwrap();
    assert_eq!(error.to_string(), expected);
}

#[test]
fn keys_that_do_not_fit() {
    says(
        json!({ "elements": null }),
        "the key `elements` is missing\n  help: give the number of finite elements, such as \"elements\": 8, or \
         displacement functions as \"ritz\"",
    );
    says(
        json!({ "elements": 0 }),
        "at elements: elements is 0, but must be above zero\n  help: 4 to 16 are enough for most beams",
    );
    says(json!({ "length": 0 }), "at length: length is 0, but must be above zero\n  help: give a number above zero");
    for key in ["elements", "modes", "frame_conditions", "axial"] {
        let mut more = json!({ "ritz": { "bending": ["x^2"] }, "elements": null });
        more[key] = match key {
            "frame_conditions" => json!("chord"),
            "axial" => json!("linear"),
            _ => json!(3),
        };
        says(
            more,
            &format!(
                "at {key}: `{key}` is for finite elements, whose place `ritz` takes\n  help: remove `{key}`, or `ritz`"
            ),
        );
    }
    says(
        json!({ "ritz": { "bending": ["x^2"] }, "elements": null, "theory": "timoshenko",
            "stiffness": { "EA": 1, "EI": 1, "GA": 1 } }),
        "at theory: displacement functions have no shear\n  help: leave `theory` out, or give \"elements\" instead of \
         `ritz`",
    );
}

#[test]
fn modes_that_are_not_there() {
    says(
        json!({ "modes": 10 }),
        "at modes: modes is 10, but the mesh has 9 of them\n  help: give fewer modes, or more elements",
    );
    let lonely = build::<2>(&beam(json!({ "modes": 0 })), &[0.0]).err().unwrap();
    assert_eq!(lonely.to_string(), "at modes: no elastic coordinate is left\n  help: give one mode or more");
    says(
        json!({ "modes": 1, "elements": 2000 }),
        "at elements: a mesh of 6000 coordinates is too large to compute its modes\n  help: give fewer elements: at \
         most 4000 coordinates are possible",
    );
    let beside = build::<2>(&beam(json!({})), &[1.6]).err().unwrap();
    assert_eq!(
        beside.to_string(),
        "at markers: a marker is at s = 1.6, beside the beam\n  help: the beam is from s = 0 to 1.5"
    );
}

#[test]
fn damping_that_does_not_fit() {
    says(
        json!({ "damping": { "modal": 0.02 } }),
        "at damping.modal: a beam of finite elements has no modal coordinates\n  help: give \"modes\", the number of \
         modes to keep, or damp it by \"rayleigh\"",
    );
    says(
        json!({ "damping": { "modal": -0.02 }, "modes": 2 }),
        "at damping.modal: modal is -0.02, but cannot be negative\n  help: give zero or more",
    );
    says(
        json!({ "damping": { "modal": [0.02] }, "modes": 2 }),
        "at damping.modal: expected 5 damping ratios, found 1\n  help: give one for each elastic coordinate, or one \
         number for all",
    );
    says(
        json!({ "damping": { "rayleigh": { "mass": -1 } } }),
        "at damping.rayleigh.mass: mass is -1, but cannot be negative\n  help: give zero or more",
    );
}

#[test]
fn functions_that_cannot_be_used() {
    let ritz =
        |bending: Value, axial: Value| json!({ "elements": null, "ritz": { "bending": bending, "axial": axial } });
    says(
        ritz(json!([]), json!([])),
        "at ritz: there is no displacement function\n  help: give some as \"bending\" or \"axial\", such as \
         \"sin(pi*x/l)\"",
    );
    says(
        ritz(json!(["x^2", "sin(y)"]), json!([])),
        "at ritz.bending[1]: unknown name `y` at character 5 in \"sin(y)\"\n  help: choose one of x, l, n, pi",
    );
    says(
        ritz(json!(["x^2"]), json!(["sqrt(x)"])),
        "at ritz.axial[0]: `sqrt(x)` has no finite value and derivatives at x = 0\n  help: the function, its slope, and \
         for bending its curvature must be finite along the beam",
    );
    says(
        ritz(json!(["x^2", "x^3", "2*x^2 - x^3"]), json!([])),
        "at ritz.bending[2]: `2*x^2 - x^3` is a sum of the functions before it\n  help: remove it",
    );
    says(ritz(json!(["x^2", 0]), json!([])), "at ritz.bending[1]: `0` is zero everywhere\n  help: remove it");
    says(
        ritz(json!(["x"]), json!([])),
        "at ritz.bending[0]: `x` can move the beam without deforming it\n  help: the floating frame does that already: \
         remove it",
    );
    says(
        ritz(json!(["x^2", "x + x^2"]), json!([])),
        "at ritz.bending[1]: `x + x^2`, with those before it, can move the beam without deforming it\n  help: the \
         floating frame does that already: remove it",
    );
    says(
        json!({ "elements": null, "ritz": { "bending_z": ["x^2"] } }),
        "at ritz.bending_z: a beam in the plane bends along y only\n  help: give \"bending\" and \"axial\"",
    );
}

#[test]
fn damping_is_what_was_asked() {
    let ritz = json!({ "bending": ["x^2", "x^3"], "axial": ["x"] });
    let scene = beam(json!({ "elements": null, "ritz": ritz, "damping": { "modal": [0.01, 0.02, 0.03] } }));
    let elastic: Elastic<2> = build(&scene, &[]).unwrap();
    let (mass, stiffness) = matrices(&elastic, |_| true);
    let modes = Modes::of(stiffness.as_ref(), mass.as_ref()).unwrap();
    let modal = modes.vectors.transpose() * dense(3, &elastic.damping) * &modes.vectors;
    for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
        let expected = if i == j { 0.02 * (1.0 + i as f64) * modes.squares[i].sqrt() } else { 0.0 };
        assert_close(modal[(i, j)], expected, 1e-9 * modes.squares[2].sqrt());
    }
    let rayleigh = json!({ "rayleigh": { "mass": 0.5, "stiffness": 1e-3 } });
    for more in [json!({ "damping": rayleigh }), json!({ "damping": rayleigh, "modes": 2 })] {
        let elastic: Elastic<2> = build(&beam(more), &[0.0, 1.5]).unwrap();
        let n = elastic.names.len();
        let (mass, stiffness) = matrices(&elastic, |_| true);
        let damping = dense(n, &elastic.damping);
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let expected = 0.5 * mass[(i, j)] + 1e-3 * stiffness[(i, j)];
            assert_close(damping[(i, j)], expected, 1e-12 * damping[(i, i)].max(1.0));
        }
    }
    let elastic: Elastic<2> = build(&beam(json!({ "damping": { "modal": 0.02 }, "modes": 2 })), &[1.5]).unwrap();
    for (entry, stiffness) in elastic.damping.iter().zip(&elastic.stiffness) {
        assert_close(entry.2, 0.04 * stiffness.2.sqrt(), 1e-12 * entry.2);
    }
}

#[test]
fn curved_beams_that_there_are_not() {
    let bent = |more: Value| {
        let mut all = json!({ "curvature": 1 });
        all.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        all
    };
    says(
        bent(json!({ "ritz": { "bending": ["x^2"] }, "elements": null })),
        "at ritz: of a curved beam no displacement functions are known\n  help: give \"elements\" instead, or \
         \"frame\": \"absolute\"",
    );
    says(
        bent(json!({ "frame_conditions": "chord" })),
        "at frame_conditions: of a curved beam the chord is not the x axis of the frame\n  help: give \"tangent\" or \
         \"mean\", or \"frame\": \"absolute\"",
    );
    says(
        bent(json!({ "modes": 2, "geometric_stiffening": true })),
        "at geometric_stiffening: of a curved beam few modes cannot tell how axial force stiffens it\n  help: leave \
         `modes` out, or \"frame\": \"absolute\"",
    );
    says(
        bent(json!({ "curvature": 10 })),
        "at elements: an element of this curved beam turns by 3.75 rad\n  help: give 10 or more, of which none turns by \
         more than a quarter turn",
    );
    assert!(build::<2>(&beam(json!({ "curvature": 0, "frame_conditions": "chord" })), &[0.0, 1.5]).is_ok());
}
