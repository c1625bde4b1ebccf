//! Energy and momentum of beams that nothing damps.

use crate::flexible::beams::{FLOATING, FRAMES, Rod, largest, scene};
use crate::flexible::brief;
use crate::scenes::{Ready, parse};
use holonom::method_spec::MethodSpec;
use holonom::simulate::{Method, Span};
use holonom::system::{Need, Scratch, Terms};
use nalgebra::DMatrix;

/// Speeds of a free beam that set it vibrating: a tip force that acts at the start only would be no different.
fn free(dimension: usize, frame: &str, stiffening: bool, size: f64) -> Ready {
    bent(dimension, frame, stiffening, size, "")
}

fn bent(dimension: usize, frame: &str, stiffening: bool, size: f64, curvature: &str) -> Ready {
    let elastic = match (frame, dimension) {
        ("mean", _) => r#""elastic": { "mode1": 0.02, "mode2": 0.01, "mode3": -0.01 },"#,
        ("tangent", 2) => r#""elastic": { "n4_y": 0.1, "n4_r": 0.06, "n2_y": 0.03, "n3_x": 0.01 },"#,
        (_, 2) => r#""elastic": { "n2_y": 0.05, "n4_r": -0.05, "n3_x": 0.01 },"#,
        ("tangent", _) => r#""elastic": { "n4_y": 0.1, "n4_rz": 0.06, "n2_z": 0.03, "n4_rx": 0.1, "n3_x": 0.01 },"#,
        _ => r#""elastic": { "n2_y": 0.05, "n2_z": -0.03, "n4_rx": 0.1, "n3_x": 0.01 },"#,
    };
    let start = match dimension {
        2 => r#""position": [0.7, -1.3], "angle": 2.1, "velocity": [3, 5], "angular_velocity": 4"#,
        _ => {
            r#""position": [0.7, -1.3, 0.4], "rotation": [0.5, -1.1, 2.0], "velocity": [3, 5, -2], "angular_velocity": [2, -3, 4]"#
        }
    };
    let elastic = if frame == "absolute" { String::new() } else { scaled(elastic, size) };
    let stiffens = if stiffening { r#""geometric_stiffening": true,"# } else { "" };
    let more = format!(r#""initial": {{ {elastic} {start} }}, {curvature} {stiffens}"#);
    let rod = Rod { dimension, frame, theory: "timoshenko", elements: 4, stiffness: 1.0, more: &more }.json();
    parse(&scene(dimension, &rod, r#""simulation": { "t_end": 1 }"#))
}

/// The numbers of a list of keys times `size`.
fn scaled(elastic: &str, size: f64) -> String {
    let (head, tail) = elastic.split_once('{').unwrap();
    let pairs = tail.trim_end_matches("},").split(',').map(|pair| {
        let (name, value) = pair.split_once(':').unwrap();
        format!("{name}: {}", value.trim().parse::<f64>().unwrap() * size)
    });
    format!("{head}{{ {} }},", pairs.collect::<Vec<_>>().join(", "))
}

/// Linear momentum, and angular momentum about the world's origin (its third component in the plane), of one floating
/// beam.
fn momentum(ready: &Ready, q: &[f64], v: &[f64]) -> Vec<f64> {
    let system = ready.system();
    let dimension = if v.len() < ready.system().dimensions().q { 3 } else { 2 };
    let mut terms = Terms::new(system);
    system.evaluate(0.0, q, v, Need::DYNAMICS, &mut terms, &mut Scratch::default());
    let mut p = vec![0.0; v.len()];
    system.structure().mass.multiply_symmetric(&terms.mass, v, &mut p);
    if dimension == 2 {
        return vec![p[0], p[1], p[2] + q[0] * p[1] - q[1] * p[0]];
    }
    let axes = holonom::math::rotation::axes_from_quaternion(&q[3..7]);
    let own = |i: usize| -> f64 { (0..3).map(|j| axes[j][i] * p[3 + j]).sum() };
    let turning = [q[1] * p[2] - q[2] * p[1], q[2] * p[0] - q[0] * p[2], q[0] * p[1] - q[1] * p[0]];
    p[..3].iter().copied().chain((0..3).map(|i| own(i) + turning[i])).collect()
}

/// dop853 at 1e-12 a step: the balance is off by what its steps add up to.
#[test]
fn free_beams_keep_energy_and_momentum() {
    for (dimension, frame) in [2, 3].into_iter().flat_map(|d| FRAMES.map(|frame| (d, frame))) {
        for stiffening in [false, true] {
            if stiffening && frame == "absolute" {
                continue;
            }
            assert_kept(&free(dimension, frame, stiffening, 1.0), &format!("{dimension} {frame} {stiffening}"));
        }
    }
}

#[test]
fn curved_beams_keep_them_too() {
    for (dimension, curvature) in [(2, r#""curvature": 0.8,"#), (3, r#""curvature": [0.3, -0.5, 0.8],"#)] {
        for (frame, stiffening) in ["tangent", "mean"].into_iter().flat_map(|frame| [(frame, false), (frame, true)]) {
            let beam = bent(dimension, frame, stiffening, 1.0, curvature);
            assert_kept(&beam, &format!("{dimension} {frame} {stiffening} curved"));
        }
    }
}

fn assert_kept(beam: &Ready, what: &str) {
    let run = beam.tight(1e-12, 1.0, 0.1);
    let error = run.record.energy.as_ref().expect("a mechanism has energy").relative_max_error.unwrap();
    println!("{what}: energy {error:.1e}");
    assert!(error < 1e-10, "{what}: {error}");
    if what.contains("absolute") {
        return;
    }
    let (q, v) = beam.0.start();
    let before = momentum(beam, q, v);
    let after = momentum(beam, &run.outcome.q, &run.outcome.v);
    let size = largest(before.iter().copied());
    let gap = largest(before.iter().zip(&after).map(|(a, b)| a - b)) / size;
    println!("    momentum {} kept to {gap:.1e}", brief(&before));
    assert!(gap < 1e-10, "{what}: {before:?} {after:?}");
}

/// generalized_alpha without numerical damping: energy swings about its value and does not drift.
#[test]
fn generalized_alpha_keeps_the_energy_in_bounds() {
    for (dimension, frame) in [2, 3].into_iter().flat_map(|d| FLOATING.map(|frame| (d, frame))) {
        for stiffening in [false, true] {
            let beam = free(dimension, frame, stiffening, 0.1);
            let bounds = [1e-3, 5e-4].map(|step| {
                let method = Method {
                    formulation: MethodSpec::named("ggl"),
                    integrator: MethodSpec::parse("generalized_alpha:rho_inf=1").unwrap(),
                    projection: MethodSpec::named("none"),
                    step: Some(step),
                    ..Method::default()
                };
                [1.0, 2.0].map(|end| {
                    let run = beam.run(&method, Span { start: 0.0, end, output_step: 0.1 });
                    run.record.energy.as_ref().unwrap().relative_max_error.unwrap()
                })
            });
            let what = format!("{dimension} {frame} {stiffening}: {}; {}", brief(&bounds[0]), brief(&bounds[1]));
            println!("generalized_alpha {what}");
            // Of second order where the largest is met (4 to 5.6 times less by half the step), and no more than twice as large
            // over twice the time.
            let [coarse, fine] = bounds;
            assert!(coarse[1] < 1e-3 && (3.0..7.0).contains(&(coarse[1] / fine[1])), "{what}");
            assert!(coarse[1] < 2.2 * coarse[0], "{what}");
        }
    }
}

/// Sections that turn are rigid at any angle: what the twist of a fine mesh leaves of the frame's inertia about the beam is
/// that of half an element, which terms of second order in the slopes alone would make negative from slopes of 0.15 on.
#[test]
fn the_mass_matrix_is_positive_at_any_slope() {
    for frame in ["tangent", "chord"] {
        let beam = parse(&format!(
            r#"{{ "name": "blade", "dimension": 3, "gravity": [0, 0, 0], "bodies": [{{ "name": "b", "type": "flexible_beam",
            "frame": "floating", "frame_conditions": "{frame}", "length": 1, "elements": 8, "rotary_inertia": true,
            "stiffness": {{ "EA": 1e6, "EI": [50, 100], "GJ": 1 }}, "inertia": {{ "rhoA": 1, "rhoI": [1e-4, 9e-4] }} }}] }}"#
        ));
        let system = beam.system();
        let start = &beam.start().q;
        let names = system.facts().names.q.clone();
        for slope in [0.0, 0.15, 0.4, 1.0] {
            let bent = |(i, name): (usize, &String)| match name.rsplit_once('_') {
                Some((_, "rx" | "ry" | "rz")) => slope * (i as f64).sin(),
                _ => start[i],
            };
            let q: Vec<f64> = names.iter().enumerate().map(bent).collect();
            let mut terms = Terms::new(system);
            system.evaluate(0.0, &q, &vec![0.0; names.len() - 1], Need::DYNAMICS, &mut terms, &mut Scratch::default());
            let n = names.len() - 1;
            let mass = DMatrix::from_fn(n, n, |i, j| {
                let mut unit = vec![0.0; n];
                let mut column = vec![0.0; n];
                unit[j] = 1.0;
                system.structure().mass.multiply_symmetric(&terms.mass, &unit, &mut column);
                column[i]
            });
            assert!(mass.cholesky().is_some(), "{frame}: slopes of {slope}");
        }
    }
}
