//! Curved beams in a floating frame: closed forms of arcs and rings, and absolute beams of the same curvature.

use crate::flexible::beams::{at_rest, largest};
use crate::flexible::brief;
use crate::flexible::rotating::{assert_has, driven, frequencies, frequencies_at_start};
use crate::scenes::{Ready, parse};
use std::f64::consts::{FRAC_PI_2, PI};

const EI: f64 = 100.0;
const GJ: f64 = 60.0;
const EA: f64 = 1e6;
const FRAMES: [&str; 3] = [
    r#""frame": "floating""#,
    r#""frame": "floating", "frame_conditions": "mean""#,
    r#""frame": "floating", "frame_conditions": "mean", "modes": 2"#,
];

/// A quarter of a circle of radius 1 in the x-y plane, clamped, with a force at its tip.
fn arc(dimension: usize, frame: &str, elements: usize, force: &str) -> Ready {
    let (zero, tip, curvature, gj) = match dimension {
        2 => ("0, 0", format!("{FRAC_PI_2}, 0"), "1", String::new()),
        _ => ("0, 0, 0", format!("{FRAC_PI_2}, 0, 0"), "[0, 0, 1]", format!(r#""GJ": {GJ},"#)),
    };
    let axes = &["x", "y", "z"][..dimension];
    let outputs = axes.iter().map(|axis| {
        format!(r#"{{ "name": "{axis}", "measure": "position", "of": "rod.tip", "component": "{axis}" }}"#)
    });
    let outputs = outputs.collect::<Vec<_>>().join(", ");
    parse(&format!(
        r#"{{ "name": "arc", "dimension": {dimension}, "ground": {{ "markers": {{ "wall": [{zero}] }} }},
        "bodies": [ {{ "name": "rod", "type": "flexible_beam", {frame}, "length": {FRAC_PI_2}, "elements": {elements},
            "curvature": {curvature}, "stiffness": {{ "EA": {EA}, {gj} "EI": {EI} }},
            "inertia": {{ "rhoA": 1, "rhoI": 0.01 }}, "markers": {{ "root": [{zero}], "tip": [{tip}] }} }} ],
        "joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.wall", "rod.root"] }} ],
        "forces": [ {{ "name": "load", "type": "applied_force", "at": "rod.tip", "force": {force} }} ],
        "outputs": [ {outputs} ] }}"#
    ))
}

/// Castigliano with the moment at the angle a from the clamp: Fy (1 - sin a) - Fx cos a in the plane; across it torsion
/// Fz (1 - sin a) and bending Fz cos a.
fn tip([x, y, z]: [f64; 3]) -> [f64; 3] {
    let bend = 1.0 / EI;
    let stretch = 1.0 / EA;
    [
        x * PI / 4.0 * (bend + stretch) - y * 0.5 * (bend - stretch),
        -x * 0.5 * (bend - stretch) + y * ((0.75 * PI - 2.0) * bend + PI / 4.0 * stretch),
        z * (PI / 4.0 * bend + (0.75 * PI - 2.0) / GJ),
    ]
}

#[test]
fn a_quarter_of_a_circle_bends_as_castigliano_says() {
    let load = 1e-5;
    for (dimension, frame) in [2, 3].into_iter().flat_map(|d| FRAMES.map(|frame| (d, frame))) {
        for direction in 0..dimension {
            let force: [f64; 3] = std::array::from_fn(|k| if k == direction { load } else { 0.0 });
            let expected = tip(force);
            let force = format!("{:?}", &force[..dimension]);
            let names = &["x", "y", "z"][..dimension];
            let size = largest(expected.into_iter());
            let errors = [4, 8, 16].map(|elements| {
                let found = at_rest(&arc(dimension, frame, elements, &force), names);
                let gaps = found.iter().zip([1.0, 1.0, 0.0]).zip(expected).map(|((at, rest), moved)| at - rest - moved);
                largest(gaps) / size
            });
            println!("{dimension} {frame} along {}: {}", names[direction], brief(&errors));
            // In the plane of fourth order in what an element turns by; across it of second, as EI and GJ differ.
            let (most, fall) = if direction < 2 { (3e-4, 16.0) } else { (1e-2, 4.0) };
            assert!(errors[0] < most, "{errors:?}");
            assert!(errors.windows(2).all(|pair| (pair[0] / pair[1] / fall - 1.0).abs() < 0.1), "{errors:?}");
        }
    }
}

/// A ring of radius 1 in space: two halves, welded together.
fn ring(frame: &str, elements: usize) -> Ready {
    let half = |name: &str, initial: &str| {
        format!(
            r#"{{ "name": "{name}", "type": "flexible_beam", {frame}, "length": {PI}, "elements": {},
            "curvature": [0, 0, 1], "stiffness": {{ "EA": 1e9, "GJ": {GJ}, "EI": {EI} }},
            "inertia": {{ "rhoA": 1, "rhoI": 1e-8 }}, "initial": {initial},
            "markers": {{ "left": [0, 0, 0], "right": [{PI}, 0, 0] }} }}"#,
            elements / 2
        )
    };
    let bodies = [half("a", "{}"), half("b", r#"{ "position": [0, 2, 0], "rotation": [0, 0, "pi"] }"#)].join(", ");
    parse(&format!(
        r#"{{ "name": "ring", "dimension": 3, "bodies": [ {bodies} ],
        "joints": [ {{ "name": "ab", "type": "weld", "between": ["a.right", "b.left"] }},
            {{ "name": "ba", "type": "weld", "between": ["b.right", "a.left"] }} ] }}"#
    ))
}

/// Free rings with n waves: in their plane w^2 = (EI/rhoA R^4) n^2 (n^2 - 1)^2/(n^2 + 1), across it with n^2 + EI/GJ
/// below (Love, Mathematical Theory of Elasticity, section 293).
#[test]
fn rings_vibrate_as_love_says() {
    for frame in &FRAMES[..2] {
        let all = [16, 32].map(|elements| frequencies_at_start(&ring(frame, elements)));
        for n in [2.0f64, 3.0] {
            let square = n * n;
            // The stretch of the line leaves EI/EA = 1e-7.
            for (below, most, fall) in [(square + 1.0, 1e-4, 13.0), (square + EI / GJ, 1e-3, 3.0)] {
                let exact = (EI * square * (square - 1.0).powi(2) / below).sqrt();
                let errors = [0, 1].map(|i| {
                    let away = all[i].iter().map(|x| (x / exact - 1.0).abs());
                    away.fold(f64::INFINITY, f64::min)
                });
                println!("{frame}, {n} waves, {exact}: {}", brief(&errors));
                assert!(errors[1] < most && errors[0] > fall * errors[1], "{errors:?}");
            }
        }
    }
}

/// A blade that is bent and twisted at rest, on a hub in steady rotation, against the absolute beam.
#[test]
fn curved_blades_in_steady_rotation() {
    let blade = |frame: &str| {
        format!(
            r#"{frame}, "curvature": [0.3, -0.4, 0.5], "stiffness": {{ "EA": 1e6, "EI": [50, 100], "GJ": 30 }},
            "inertia": {{ "rhoA": 1, "rhoI": [1e-3, 2e-3] }}"#
        )
    };
    for speed in [0.5, 3.0] {
        let exact = frequencies(&driven(&blade(r#""frame": "absolute", "elements": 48"#), "[0, 0, 0]", speed));
        for conditions in ["tangent", "mean"] {
            let keys = r#""frame": "floating", "elements": 24, "rotary_inertia": true, "geometric_stiffening": true"#;
            let keys = format!(r#"{keys}, "frame_conditions": "{conditions}""#);
            let found = frequencies(&driven(&blade(&keys), "[0, 0, 0]", speed));
            let gaps: Vec<f64> = found.iter().zip(&exact[..4]).map(|(found, exact)| found / exact - 1.0).collect();
            println!("{speed} {conditions}: {} off by {}", brief(&exact[..4]), brief(&gaps));
            for exact in &exact[..4] {
                // 24 elements leave 1.3e-4; what deforms the blade, with the square of the speed, 6e-5 of second order.
                let most = 2e-4 + 1e-4 * speed * speed;
                assert_has(&found, *exact, most, &format!("{conditions} {speed}"));
            }
        }
    }
}
