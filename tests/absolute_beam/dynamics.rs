//! Motions: energy and momentum in free flight, and the rigid body as the limit.

use crate::scenes::{Ready, parse, shipped};
use holonom::method_spec::MethodSpec;
use holonom::simulate::{Method, Span};

/// From t = 2.5 on nothing acts: energy stays, the centre of mass goes on at the 2 m/s of the impulse.
#[test]
fn flying_spaghetti_keeps_energy_and_momentum() {
    let beam = shipped("flying_spaghetti", &[]);
    let run = beam.run(&beam.0.method, Span { start: 0.0, end: 12.0, output_step: 0.5 });
    let energy = run.column("energy");
    let kept = energy[6..].iter().fold(0.0, |worst: f64, e| worst.max((e / energy[6] - 1.0).abs()));
    println!("energy {:.6} J, kept to {kept:.1e}", energy[6]);
    // The tolerance is 1e-8 a step; 1700 steps.
    assert!(kept < 1e-6, "{kept:e}");
    let centre = |row: usize| -> f64 {
        let x = |node: usize| run.column(&format!("beam.n{node}.x"))[row];
        ((1..10).map(x).sum::<f64>() + 0.5 * (x(0) + x(10))) / 10.0
    };
    assert!((centre(24) - centre(6) - 18.0).abs() < 1e-6, "{}", centre(24) - centre(6));
}

/// generalized_alpha without numerical damping: the energy of a free flight swings about its value and does not drift.
#[test]
fn generalized_alpha_keeps_the_energy_in_bounds() {
    let beam = shipped("flying_spaghetti", &[]);
    let method = Method {
        formulation: MethodSpec::named("ggl"),
        integrator: MethodSpec::parse("generalized_alpha:rho_inf=1").unwrap(),
        projection: MethodSpec::named("none"),
        step: Some(0.01),
        ..Method::default()
    };
    let run = beam.run(&method, Span { start: 0.0, end: 12.0, output_step: 0.5 });
    let energy = run.column("energy");
    let worst = energy[6..].iter().fold(0.0, |worst: f64, e| worst.max((e / energy[6] - 1.0).abs()));
    println!("generalized_alpha: energy within {worst:.1e}");
    // The square of the step times that of the fast bending, 10 rad/s.
    assert!(worst < 1e-2, "{worst:e}");
}

/// A pendulum that falls from level: a beam with EI, or a rigid body with the lumped beam's inertia.
fn pendulum(ei: f64) -> Ready {
    parse(&format!(
        r#"{{ "name": "pendulum", "dimension": 2, "gravity": [0, -9.81], "ground": {{ "markers": {{ "o": [0, 0] }} }},
        "bodies": [ {{ "name": "rod", "type": "flexible_beam", "frame": "absolute", "length": 1, "elements": 4,
            "stiffness": {{ "EA": "100*{ei}", "EI": {ei} }}, "inertia": {{ "rhoA": 1, "rhoI": 1e-3 }},
            "markers": {{ "o": [0, 0], "tip": [1, 0] }} }} ],
        "joints": [ {{ "name": "o", "type": "revolute", "between": ["ground.o", "rod.o"] }} ],
        "outputs": [ {{ "name": "x", "measure": "position", "of": "rod.tip", "component": "x" }},
            {{ "name": "y", "measure": "position", "of": "rod.tip", "component": "y" }} ] }}"#
    ))
}

/// The stiffer the beam, the nearer it is to the rigid pendulum: its static deflection goes with 1/EI.
#[test]
fn a_stiff_beam_moves_like_a_rigid_body() {
    // Masses 1/8 at 1/24 from the ends, 1/4 at the nodes between them, and the rotary inertia of the sections.
    let ends = (1.0f64 / 24.0).powi(2) + (23.0f64 / 24.0).powi(2);
    let inertia = 0.25 * (0.0625 + 0.25 + 0.5625) + 0.125 * ends + 1e-3;
    let rigid = parse(&format!(
        r#"{{ "name": "rigid", "dimension": 2, "gravity": [0, -9.81], "ground": {{ "markers": {{ "o": [0, 0] }} }},
        "bodies": [ {{ "name": "rod", "type": "rigid", "mass": 1, "inertia": "{inertia} - 0.25",
            "markers": {{ "o": [-0.5, 0], "tip": [0.5, 0] }}, "initial": {{ "position": [0.5, 0] }} }} ],
        "joints": [ {{ "name": "o", "type": "revolute", "between": ["ground.o", "rod.o"] }} ] }}"#
    ));
    let angle = rigid.tight(1e-10, 1.0, 0.05).column("rod.angle");
    let deviation = |ei: f64| {
        let run = pendulum(ei).tight(1e-9, 1.0, 0.05);
        let x = run.column("x");
        let y = run.column("y");
        let gap = |i: usize| (x[i] - angle[i].cos()).hypot(y[i] - angle[i].sin());
        (0..x.len()).map(gap).fold(0.0, f64::max)
    };
    let deviations = [1e2, 1e3, 1e4].map(deviation);
    println!("from the rigid pendulum: {deviations:?}");
    assert!(deviations[0] < 5e-3 && deviations[2] < 5e-5, "{deviations:?}");
    assert!(deviations.windows(2).all(|pair| (5.0..20.0).contains(&(pair[0] / pair[1]))), "{deviations:?}");
}

/// Damping by stiffness takes energy, all of which the balance finds again as work.
#[test]
fn damping_is_counted_as_work() {
    let text = std::fs::read_to_string(crate::scenes::model("flexible_pendulum")).unwrap();
    let damped = parse(
        &text.replace("\"elements\": 12,", "\"elements\": 6, \"damping\": { \"rayleigh\": { \"stiffness\": 0.01 } },"),
    );
    let run = damped.run(&damped.0.method, Span { start: 0.0, end: 1.0, output_step: 0.1 });
    let energy = &run.record.energy;
    let energy = energy.as_ref().expect("a mechanism has energy");
    assert!(energy.last < -0.05, "{energy:?}");
    assert!(energy.max_error < 1e-5, "{energy:?}");
}

/// The load ends at 2 s; from then on the integrator alone, rho_inf = 0.9, touches the energy.
#[test]
fn the_right_angle_cantilever_swings_and_keeps_its_energy() {
    let frame = shipped("right_angle_cantilever", &[]);
    let run = frame.run(&frame.0.method, Span { start: 0.0, end: 30.0, output_step: 0.1 });
    let energy = run.column("energy");
    let worst = energy[25..].iter().fold(0.0, |worst: f64, e| worst.max((e / energy[25] - 1.0).abs()));
    // Measured as 3e-4 with steps of 0.05 s.
    assert!(worst < 1e-3, "{worst:e}");
    let tip = run.column("tip_z");
    let range = [tip.iter().copied().fold(0.0, f64::min), tip.iter().copied().fold(0.0, f64::max)];
    println!("right angle: tip {range:?}, energy kept to {worst:e}");
    // With twice the elements, half the steps and rows at each of them; 1.4e-2 and 8e-3 are left.
    assert!((range[0] + 9.7236).abs() < 0.02 && (range[1] - 8.2503).abs() < 0.01, "{range:?}");
}
