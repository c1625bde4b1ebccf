//! States of scenes: controllers, filters, actuators and oil.

use crate::linearize::models::{model, values};
use crate::linearize::reference::distance;
use crate::scenes::{Ready, dop853, parse, shipped};
use holonom::linearize::{Chart, Complex, Kind, Linear, State, Variation, at_rest};
use holonom::method_spec::MethodSpec;
use holonom::simulate::{Method, Span};
use holonom::validate::{Settings, validate};
use nalgebra::{DMatrix, SMatrix, SVector};

const MASS: f64 = 2.0;
const LENGTH: f64 = 0.8;
const INERTIA: f64 = MASS * LENGTH * LENGTH / 3.0;
const WEIGHT: f64 = MASS * 9.81 * LENGTH / 2.0;
const KP: f64 = 60.0;
const KI: f64 = 80.0;
const KD: f64 = 12.0;
const TAU: f64 = 0.02;
const FILTER: f64 = 0.005;
const REF: f64 = 0.6;

/// Rates of (angle, speed, integral, filtered rate, torque).
fn pid([angle, speed, integral, rate, torque]: [f64; 5]) -> [f64; 5] {
    let error = REF - angle;
    let command = KP * error + KI * integral - KD * rate;
    [speed, (torque - WEIGHT * angle.cos()) / INERTIA, error, (speed - rate) / FILTER, (command - torque) / TAU]
}

/// Their derivatives at an angle.
fn pid_slopes(angle: f64) -> SMatrix<f64, 5, 5> {
    SMatrix::from_row_slice(&[
        0.0,
        1.0,
        0.0,
        0.0,
        0.0,
        WEIGHT * angle.sin() / INERTIA,
        0.0,
        0.0,
        0.0,
        1.0 / INERTIA,
        -1.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        1.0 / FILTER,
        0.0,
        -1.0 / FILTER,
        0.0,
        -KP / TAU,
        0.0,
        KI / TAU,
        -KD / TAU,
        -1.0 / TAU,
    ])
}

/// The classical Runge-Kutta method: its error at these steps is 1e-11 and less.
fn integrated<const N: usize>(
    rates: impl Fn(f64, [f64; N]) -> [f64; N],
    start: [f64; N],
    end: f64,
    h: f64,
) -> [f64; N] {
    let rates = |t: f64, y: SVector<f64, N>| SVector::from(rates(t, y.into()));
    let steps = (end / h).round() as usize;
    let step = |y: SVector<f64, N>, i: usize| {
        let t = i as f64 * h;
        let a = rates(t, y);
        let b = rates(t + 0.5 * h, y + a * (0.5 * h));
        let c = rates(t + 0.5 * h, y + b * (0.5 * h));
        let d = rates(t + h, y + c * h);
        y + (a + (b + c) * 2.0 + d) * (h / 6.0)
    };
    (0..steps).fold(SVector::from(start), step).into()
}

fn last(scene: &Ready, method: &Method, end: f64, columns: &[&str]) -> Vec<f64> {
    let run = scene.run(method, Span { start: 0.0, end, output_step: end });
    columns.iter().map(|name| *run.column(name).last().unwrap()).collect()
}

fn off(found: &[f64], exact: &[f64]) -> f64 {
    found.iter().zip(exact).map(|(found, exact)| (found - exact).abs() / (1.0 + exact.abs())).fold(0.0, f64::max)
}

const PID: [&str; 5] = ["arm.angle", "arm.angle'", "integral", "rate", "torque"];

/// Errors within a tolerance; of `bdf` and `esdirk34` a hundred, as their errors add up; of fixed steps some times what
/// their order leaves.
#[test]
fn every_method_carries_a_controller() {
    let scene = shipped("pid_arm", &[]);
    let exact = integrated(|_, y| pid(y), [0.0; 5], 0.5, 1e-5);
    for (formulation, integrator, step, allowed) in [
        ("index1", "dop853", None, 1e-10),
        ("null_space", "dopri5", None, 1e-10),
        ("baumgarte:alpha=5,beta=5", "rk4", Some(1e-3), 5e-10),
        ("index2", "hem5", Some(1e-3), 5e-12),
        ("index2", "phem56", None, 1e-10),
        ("ggl", "radau_iia", None, 1e-10),
        ("ggl", "generalized_alpha", Some(1e-4), 2e-7),
        ("stabilized_index1", "bdf", None, 1e-9),
        ("index1", "esdirk34", None, 1e-8),
    ] {
        let [formulation, integrator] = [formulation, integrator].map(|text| MethodSpec::parse(text).unwrap());
        let projection = MethodSpec::named("none");
        let method = Method { formulation, integrator, projection, step, ..dop853(1e-10) };
        let error = off(&last(&scene, &method, 0.5, &PID), &exact);
        println!("{}: {error:.1e}", method.triple());
        assert!(error < allowed, "{}: {error:e}", method.triple());
    }
}

/// The work of the motor is what the arm gains; the states have no energy of their own.
#[test]
fn the_energy_balance_counts_what_states_drive() {
    for name in ["pid_arm", "hydraulic_boom"] {
        let run = shipped(name, &[]).tight(1e-10, 1.0, 0.1);
        let energy = run.record.energy.expect("a scene has an energy");
        assert!(energy.relative_max_error.is_some_and(|error| error < 1e-8), "{name}: {energy:?}");
    }
}

fn start(scene: &Ready) -> State {
    let (q, v) = scene.0.start();
    State { t: 0.0, q: q.to_vec(), v: v.to_vec() }
}

fn rest(scene: &Ready) -> State {
    at_rest(&scene.0, &start(scene)).unwrap().state
}

/// The integral holds the arm where the error is zero.
#[test]
fn states_take_part_in_the_static_equilibrium() {
    let state = rest(&shipped("pid_arm", &[]));
    let torque = WEIGHT * REF.cos();
    assert!((state.q[2] - REF).abs() < 1e-14 && off(&state.v, &[0.0, 0.0, 0.0, torque / KI, 0.0, torque]) < 1e-13);
}

/// Five eigenvalues by each method, and no zero for the integral of a state.
#[test]
fn every_linear_model_has_the_modes_of_the_controller() {
    let scene = shipped("pid_arm", &[]);
    let state = rest(&scene);
    let mut variation = Variation::new(scene.system(), 0.0, &state.q, &state.v).unwrap();
    let known: Vec<Complex<f64>> = pid_slopes(REF).complex_eigenvalues().iter().copied().collect();
    for method in [
        "mcs",
        "rcs",
        "rcs:form=index2",
        "rcs:form=index1",
        "rcs:form=ggl",
        "rcs:solver=qz",
        "baumgarte:alpha=7,beta=30",
        "baumgarte:alpha=7,beta=30,projected=yes",
        "force_projection:alpha=7,beta=30",
    ] {
        let found = model(&mut variation, method, None);
        let error = distance(&values(&found, Kind::Physical), &known);
        println!("{method}: {error:.1e}");
        assert!(error < 1e-13, "{method}: {error:e}, {:?}", found.modes.iter().map(|m| m.value).collect::<Vec<_>>());
        assert_eq!(found.states.len(), found.a.nrows());
    }
}

/// In the angle as chart A is the derivative of the equations in the angle, at rest and in motion.
#[test]
fn a_linear_model_in_motion_is_that_of_the_angle() {
    let scene = shipped("pid_arm", &[]);
    for state in scene.0.states_at(&[0.0, 0.2]).unwrap() {
        let mut variation = Variation::new(scene.system(), state.t, &state.q, &state.v).unwrap();
        let found = model(&mut variation, "mcs", Some(Chart::Independent(vec!["arm.angle".to_string()])));
        assert_eq!(found.states, PID);
        let exact = pid_slopes(state.q[2]);
        let error = (&found.a - DMatrix::from_iterator(5, 5, exact.iter().copied())).amax();
        assert!(error < 1e-12 * exact.amax(), "{error:e}");
        // u adds to the torque; y = (theta in deg, error, command ..).
        let [b, command] = [found.b.column(0).clone_owned(), found.c.row(2).transpose()];
        assert!(off(b.as_slice(), &[0.0, 1.0 / INERTIA, 0.0, 0.0, 0.0]) < 1e-13);
        assert!(off(command.as_slice(), &[-KP, 0.0, KI, -KD, 0.0]) < 1e-13);
    }
}

#[test]
fn linear_models_with_states_are_those_of_small_perturbations() {
    for (name, at) in [("pid_arm", 0.2), ("hydraulic_boom", 0.45)] {
        let scene = shipped(name, &[]);
        let state = &scene.0.states_at(&[at]).unwrap()[0];
        let found = validate(scene.system(), state, &Settings::default()).unwrap();
        assert!(found.verdict.ltv && found.verdict.lti, "{name}: {:?} {:?}", found.verdict, found.sequences);
    }
}

/// Rates of (angle, speed, pA, pB) of the boom.
fn boom(t: f64, [angle, speed, pa, pb]: [f64; 4]) -> [f64; 4] {
    let smooth = |t: f64| {
        let s = t.clamp(0.0, 1.0);
        s.powi(3) * (10.0 + s * (6.0 * s - 15.0))
    };
    let opens = |at: f64| smooth((t - at) / 0.1);
    let valve = 0.5 * (opens(0.2) - opens(0.6) - opens(1.2) + opens(1.4));
    let [dx, dy] = [angle.cos() - 0.2, angle.sin() + 0.8];
    let length = dx.hypot(dy);
    // d length / d angle
    let arm = (-dx * angle.sin() + dy * angle.cos()) / length;
    let [bore, ring] = [5e-3, 2.5e-3];
    let [to_a, to_b] = if valve > 0.0 { [(16.0 - pa).sqrt(), pb.sqrt()] } else { [pa.sqrt(), (16.0 - pb).sqrt()] };
    let leak = 2e-6 * (pa - pb);
    let pull = arm * speed;
    let torque = 1e6 * (pa * bore - pb * ring) * arm - 400.0 * 9.81 * 1.5 * angle.cos();
    [
        speed,
        torque / (400.0 * 9.0 / 3.0),
        1500.0 / (2e-4 + bore * (length - 0.9)) * (3e-4 * valve * to_a - bore * pull - leak),
        1500.0 / (2e-4 + ring * (0.7 - length + 0.9)) * (-3e-4 * valve * to_b + ring * pull + leak),
    ]
}

/// Against the equations in the angle. 1e-7: the reference steps over the ends of the valve's motions, where its third
/// derivative jumps.
#[test]
fn oil_lifts_the_boom() {
    let scene = shipped("hydraulic_boom", &[]);
    let push = 400.0 * 9.81 * 1.5 / (0.8 / 1.28f64.sqrt());
    let start = [0.0, 0.0, (push / 1e6 + 2.0 * 2.5e-3) / 5e-3, 2.0];
    let exact = integrated(boom, start, 2.0, 2e-5);
    let found = last(&scene, &dop853(1e-10), 2.0, &["boom.angle", "boom.angle'", "pA", "pB"]);
    let error = off(&found, &exact);
    assert!(error < 1e-7, "{error:e}: {found:?} {exact:?}");
}

/// In space, about an axis that is not a coordinate axis of the world, with a torque in the axes of the marker.
/// The states of a chart have names that nothing else has.
#[test]
fn a_chart_has_names_of_its_own() {
    let scene = parse(
        r#"{ "name": "slider", "dimension": 2,
            "bodies": [{ "name": "a", "type": "point_mass", "mass": 1 }],
            "states": [{ "name": "u1", "initial": 0, "rate": "a.x - u1" }],
            "forces": [{ "name": "f", "type": "applied_force", "at": "a", "force": ["-u1", "-a.y"] }],
            "inputs": [{ "name": "u_2", "force": "f", "component": "x" }] }"#,
    );
    let at = start(&scene);
    let mut variation = at.variation(&scene.0).unwrap();
    let request = Linear { method: MethodSpec::named("mcs"), chart: Some(Chart::Intrinsic) };
    let model = variation.linearize(&request).unwrap();
    assert_eq!(model.states, ["u__1", "u__2", "u__1'", "u__2'", "u1"]);
}

#[test]
fn a_state_drives_a_body_in_space() {
    let scene = parse(
        r#"{ "name": "rotor", "dimension": 3,
            "ground": { "markers": { "O": { "position": [0, 0, 0], "z_axis": [1, 2, -2] } } },
            "bodies": [{ "name": "rotor", "type": "rigid", "mass": 3, "inertia": [2, 2, 2],
                         "markers": { "O": { "position": [0, 0, 0], "z_axis": [1, 2, -2] } } }],
            "joints": [{ "name": "axis", "type": "revolute", "between": ["ground.O", "rotor.O"] }],
            "states": [{ "name": "i", "initial": 0.5, "rate": "1 - i - (rotor.wx + 2*rotor.wy - 2*rotor.wz)/3" }],
            "forces": [{ "name": "motor", "type": "applied_torque", "at": "rotor.O", "torque": [0, 0, "4*i"],
                         "axes": "marker" }],
            "outputs": [{ "name": "w", "measure": "expression", "value": "(rotor.wx + 2*rotor.wy - 2*rotor.wz)/3" }] }"#,
    );
    let exact = integrated(|_, [w, i]| [2.0 * i, 1.0 - i - w], [0.0, 0.5], 2.0, 1e-4);
    assert!(off(&last(&scene, &dop853(1e-11), 2.0, &["w", "i"]), &exact) < 1e-10);
    let state = start(&scene);
    let mut variation = Variation::new(scene.system(), 0.0, &state.q, &state.v).unwrap();
    let known = SMatrix::<f64, 2, 2>::new(0.0, 2.0, -1.0, -1.0).complex_eigenvalues();
    let mut known: Vec<Complex<f64>> = known.iter().copied().collect();
    known.push(Complex::new(0.0, 0.0));
    assert!(distance(&values(&model(&mut variation, "mcs", None), Kind::Physical), &known) < 1e-12);
}
