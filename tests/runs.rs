//! Runs that one can hold: events, inputs, pauses and restarts, against closed forms.

use holonom::linear::Matrix;
use holonom::prelude::*;
use holonom::research::results::{Recorder, Span};
use holonom::run::Run;
use holonom::simulate::{Observation, Sink, Start};
use holonom::system::{Column, Dimensions, MechanicalSystem, Need, Scratch, SystemFacts, Terms};
use std::borrow::Cow;
use std::cell::Cell;
use std::f64::consts::PI;

/// x'' = -w^2 x + u, with x at rest at 1.
struct Oscillator {
    stiffness: f64,
}

impl Equations for Oscillator {
    fn size(&self) -> (usize, usize) {
        (1, 0)
    }
    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass[0] = S::one();
    }
    fn force<S: Scalar>(&self, _t: S, q: &[S], _v: &[S], f: &mut [S]) {
        f[0] = q[0] * -self.stiffness;
    }
    fn phi<S: Scalar>(&self, _t: S, _q: &[S], _phi: &mut [S]) {}
    fn potential(&self, _t: f64, q: &[f64]) -> Option<f64> {
        Some(0.5 * self.stiffness * q[0] * q[0])
    }
    fn input_names(&self) -> Vec<String> {
        vec!["u".to_string()]
    }
    fn input_forces<S: Scalar>(&self, _t: S, _q: &[S], forces: &mut [S]) {
        forces[0] = S::one();
    }
    fn output_names(&self) -> Vec<String> {
        vec!["x".to_string()]
    }
    fn outputs<S: Scalar>(&self, _t: S, q: &[S], _v: &[S], out: &mut [S]) {
        out[0] = q[0];
    }
}

const SWINGING: Oscillator = Oscillator { stiffness: 1.0 };
const FREE: Oscillator = Oscillator { stiffness: 0.0 };

fn method(text: &str) -> Method {
    let method: Method = text.parse().unwrap();
    let step = ["rk4", "heun"].contains(&method.integrator.name.as_str()).then_some(0.01);
    Method { rtol: 1e-9, atol: 1e-9, step, ..method }
}

fn from_one<'a>(system: &'a Oscillator, text: &str) -> Run<'a> {
    Run::new(system, method(text), 0.0, &([1.0], [0.0]))
}

const BALL: &str = r#"{ "name": "fall", "dimension": 2, "gravity": [0, -9.81],
    "bodies": [{ "name": "ball", "type": "point_mass", "mass": 2, "initial": { "position": [0, 3] } }],
    "forces": [{ "name": "thrust", "type": "applied_force", "at": "ball", "force": [0, "if(t > 1, 5, 0)"] }],
    "inputs": [{ "name": "thrust", "force": "thrust", "component": "y" }],
    "outputs": [{ "name": "height", "measure": "position", "of": "ball", "component": "y" },
                { "name": "push", "measure": "force", "of": "thrust", "component": "y" },
                { "name": "a", "measure": "acceleration", "of": "ball", "component": "y" }],
    "simulation": { "rtol": 1e-10, "atol": 1e-10 } }"#;

#[test]
fn a_fall_ends_at_the_ground() {
    let model = Model::parse(BALL).unwrap();
    let exact = (2.0 * 1.0 / 9.81_f64).sqrt();
    for name in ["index1 + dop853", "index1 + adams", "index1 + rk4", "ggl + radau_iia", "ggl + bdf", "index1 + tsit45"]
    {
        let (q, v) = model.start();
        let mut run = Run::new(model.system(), method(name), 0.0, (q, v));
        let end = run.until(|x| x.output("height") - 2.0, 5.0).unwrap();
        let End::Event(t) = end else { panic!("{name}: {end:?}") };
        // bdf adds up the errors of its steps.
        assert!((t - exact).abs() < 1e-7, "{name}: {t} for {exact}");
        let last = run.record().output("height").unwrap().last();
        assert!((last - 2.0).abs() < 1e-9, "{name}: {last}");
        assert_eq!(run.state().unwrap().t, t);
    }
}

#[test]
fn a_run_goes_on_from_root_to_root() {
    for name in ["index1 + dop853", "ggl + radau_iia"] {
        let mut run = from_one(&SWINGING, name);
        for k in 0..5 {
            let End::Event(t) = run.until(|x| x.q[0], 100.0).unwrap() else { panic!("root {k}") };
            assert!((t - (0.5 + k as f64) * PI).abs() < 1e-7, "{name}: {t}");
        }
        assert_eq!(run.until(|x| x.q[0] - 2.0, 20.0).unwrap(), End::Reached);
        assert_eq!(run.t(), 20.0);
    }
}

#[test]
fn a_short_dip_is_found() {
    // cos(t) is below -0.98 for 0.4 s of 6.28 s.
    let mut run = from_one(&SWINGING, "index1 + dop853");
    let End::Event(t) = run.until(|x| x.q[0] + 0.98, 100.0).unwrap() else { panic!("it dips") };
    assert!((t - (-0.98_f64).acos()).abs() < 1e-8, "{t}");
}

#[test]
fn a_jump_over_zero_is_an_event() {
    let model = Model::parse(BALL).unwrap();
    let End::Event(t) = model.run().until(|x| x.output("a") + 9.0, 5.0).unwrap() else { panic!("it jumps") };
    assert!((t - 1.0).abs() < 1e-12, "{t}");
}

#[test]
fn a_held_input_is_that_of_the_recursion() {
    // x' = v, v' = u between samples: x += v T + u T^2/2, v += u T, exact for every method of order 2.
    let period = 0.125;
    let law = |x: f64, v: f64| -3.0 * x - 2.0 * v;
    for name in ["index1 + dop853", "ggl + radau_iia", "index1 + rk4"] {
        let mut run = from_one(&FREE, name).input("u", every(period, |x| law(x.q[0], x.v[0])));
        let (mut x, mut v) = (1.0, 0.0);
        for k in 1..=16 {
            let u = law(x, v);
            x += v * period + 0.5 * u * period * period;
            v += u * period;
            run.to(k as f64 * period).unwrap();
            let state = run.state().unwrap();
            assert!((state.q[0] - x).abs() < 1e-12 && (state.v[0] - v).abs() < 1e-12, "{name}, sample {k}");
        }
        // The work of the input is in the balance of energy.
        assert!(run.record().energy_error() < 1e-9, "{name}: {}", run.record().energy_error());
    }
}

#[test]
fn a_pause_at_a_sample_changes_nothing() {
    let law = |x: &Moment| -3.0 * x.q[0] - 2.0 * x.v[0];
    let mut whole = from_one(&SWINGING, "index1 + dop853").input("u", every(0.25, law)).planned_to(2.0);
    let mut paused = from_one(&SWINGING, "index1 + dop853").input("u", every(0.25, law)).planned_to(2.0);
    whole.to(2.0).unwrap();
    (1..=8).for_each(|k| assert_eq!(paused.to(0.25 * k as f64).unwrap(), End::Reached));
    assert_eq!(whole.state().unwrap().q, paused.state().unwrap().q);
}

#[test]
fn a_continuous_input_is_part_of_the_equations() {
    // u = -4 x turns the free mass into an oscillator of 2 rad/s.
    for name in ["index1 + dop853", "index1 + adams", "ggl + radau_iia", "index1 + tsit45"] {
        let mut run = from_one(&FREE, name).input("u", |_: f64, x: &Moment| -4.0 * x.output("x"));
        run.to(3.0).unwrap();
        let x = run.state().unwrap().q[0];
        assert!((x - 6.0_f64.cos()).abs() < 1e-7, "{name}: {x}");
        assert!(run.record().energy_error() < 1e-7, "{name}");
    }
}

#[test]
fn an_input_of_a_scene_adds_to_its_force() {
    let model = Model::parse(BALL).unwrap();
    let mut run = model.run().input("thrust", |t: f64, _: &Moment| 10.0 * t);
    run.to(1.5).unwrap();
    // m v' = -m g + 10 t, and 5 N more after 1 s.
    let exact = 3.0 - 0.5 * 9.81 * 2.25 + 10.0 * 1.5_f64.powi(3) / 12.0 + 5.0 * 0.25 / 4.0;
    let state = run.state().unwrap();
    assert!((state.output("height") - exact).abs() < 1e-9, "{} for {exact}", state.output("height"));
    assert!((state.output("push") - 20.0).abs() < 1e-12);
    assert!((state.output("a") - (20.0 / 2.0 - 9.81)).abs() < 1e-12);
    assert!((run.record().output("push").unwrap().last() - 20.0).abs() < 1e-12);
}

#[test]
fn a_saved_run_goes_on_with_its_inputs_bit_by_bit() {
    let law = |x: &Moment| -3.0 * x.q[0] - 2.0 * x.v[0];
    let run = || from_one(&SWINGING, "index1 + dop853").input("u", every(0.25, law)).planned_to(2.0);
    let mut whole = run();
    while whole.t() < 0.9 {
        whole.step().unwrap();
    }
    let saved = whole.save().unwrap();
    let mut second = run().from_saved(&saved);
    whole.to(2.0).unwrap();
    second.to(2.0).unwrap();
    assert_eq!(whole.state().unwrap().q, second.state().unwrap().q);
    assert_eq!(whole.state().unwrap().v, second.state().unwrap().v);
}

#[test]
fn a_step_is_interpolated() {
    for name in ["index1 + dop853", "index1 + adams", "ggl + radau_iia", "ggl + bdf", "index1 + tsit45"] {
        let mut run = from_one(&SWINGING, name).planned_to(3.0);
        let mut before = 0.0;
        while run.step().unwrap() == End::Reached && run.t() < 3.0 {
            let t = 0.3 * before + 0.7 * run.t();
            let x = run.interpolate(t).unwrap().q[0];
            assert!((x - t.cos()).abs() < 1e-6, "{name}: {x} at {t}");
            before = run.t();
        }
        assert!(run.interpolate(0.5 * before).is_err());
    }
}

#[test]
fn names_that_do_not_exist_are_errors() {
    let model = Model::parse(BALL).unwrap();
    let text = |result: holonom::Result<End>| format!("{:?}", result.unwrap_err());
    let unknown = text(model.run().until(|x| x.output("hight"), 1.0));
    assert!(unknown.contains("no output or coordinate `hight`") && unknown.contains("`height`?"), "{unknown}");
    let unknown = text(model.run().input("thrast", |t: f64, _: &Moment| t).to(1.0));
    assert!(unknown.contains("no input `thrast`") && unknown.contains("`thrust`?"), "{unknown}");
    let unknown = text(model.run().input("thrust", |_: f64, x: &Moment| x.output("hight")).to(1.0));
    assert!(unknown.contains("`hight`"), "{unknown}");
    let period = text(model.run().input("thrust", every(0.0, |_| 1.0)).to(1.0));
    assert!(period.contains("sampled every 0 s"), "{period}");
    assert!(text(model.run().to(-1.0)).contains("cannot go to -1 s"));
    assert!(model.set("k", 1.0).is_err());
}

#[test]
fn the_accelerations_of_a_continuous_input_are_not_known() {
    let model = Model::parse(BALL).unwrap();
    let error = model.run().input("thrust", |_: f64, x: &Moment| x.output("a")).to(1.0).unwrap_err().to_string();
    assert!(error.contains("infinite or not a number"), "{error}");
}

/// Stops when it has seen enough.
struct Enough(Cell<usize>);

impl Sink for Enough {
    fn accepted(&mut self, _: &Observation) {
        self.0.set(self.0.get() + 1);
    }

    fn is_done(&self) -> bool {
        self.0.get() > 3
    }
}

#[test]
fn a_wanted_stop_is_no_failure() {
    let span = Span::from(0.0..10.0);
    let start = ([1.0], [0.0]);
    let method = method("index1 + dop853");
    let outcome =
        holonom::simulate::simulate(&SWINGING, &method, span, (&start.0, &start.1), &mut Enough(Cell::new(0))).unwrap();
    assert!(outcome.failure.is_none() && outcome.t < 10.0);
    assert_eq!(outcome.statistics.steps, 3);
}

#[test]
fn markers_are_placed_by_name() {
    let model = Model::load("tests/examples/crane.json").unwrap();
    let mut run = model.run();
    run.to(1.5).unwrap();
    let state = run.state().unwrap();
    let [top, load] = ["rope.top", "rope"].map(|name| model.marker(name, &state).unwrap());
    let (sin, cos) = state.output("sway").sin_cos();
    assert!((top.position[0] - state.get("trolley.x")).abs() < 1e-12);
    assert!((load.position[0] - top.position[0] - 5.0 * sin).abs() < 1e-12);
    assert!((load.position[1] - top.position[1] + 5.0 * cos).abs() < 1e-12);
    assert!((load.velocity[0] - state.get("rope.x'")).abs() < 1e-12);
    assert!((load.axes[0][1] - sin).abs() < 1e-12 && load.axes[2] == [0.0, 0.0, 1.0]);
    assert!(model.marker("rope.tip", &state).unwrap_err().to_string().contains("`rope.top`?"));
}

#[test]
fn a_run_is_stopped_by_its_sink() {
    let mut run = from_one(&SWINGING, "index1 + dop853").shown_to(Enough(Cell::new(0)));
    assert_eq!(run.to(10.0).unwrap(), End::Stopped);
    assert_eq!(run.statistics().steps, 3);
    let last = run.t();
    assert_eq!(run.record().trajectory.times().last(), Some(last));
}

#[test]
fn a_closure_is_a_sink() {
    let mut steps = 0;
    let mut count = |_: &Observation| steps += 1;
    let start = Start::State(&[1.0], &[0.0]);
    let method = method("index1 + dop853");
    let (outcome, _) =
        holonom::simulate::simulate_from(&SWINGING, &method, Span::from(0.0..3.0), start, &mut count).unwrap();
    assert_eq!(steps, outcome.statistics.steps + 1);
}

#[test]
fn rows_of_a_run_are_those_of_a_simulation() {
    let model = Model::parse(&BALL.replace(r#""rtol""#, r#""t_end": 2, "method": "auto", "rtol""#)).unwrap();
    let mut recorder = Recorder::new(model.system());
    let (outcome, legs) = model.simulate(&model.method, model.span().unwrap(), &mut recorder).unwrap();
    let mut run = model.run();
    run.to(2.0).unwrap();
    assert_eq!(run.statistics().steps, outcome.statistics.steps);
    assert!(!legs.is_empty());
    assert_eq!(run.record().trajectory.rows, recorder.finish().trajectory.rows);
}

#[test]
fn a_run_that_fails_says_so_and_keeps_its_record() {
    let scene = BALL.replace("if(t > 1, 5, 0)", "sqrt(1 - t)");
    let model = Model::parse(&scene).unwrap();
    let mut run = model.run();
    let error = run.to(2.0).unwrap_err().to_string();
    assert!(error.contains("stopped at t = "), "{error}");
    assert!(run.t() > 0.9 && run.record().output("height").unwrap().last() < 0.0);
}

#[test]
fn methods_are_read_from_text() {
    let spaces: Method = "index1+dop853+manifold".parse().unwrap();
    assert_eq!(spaces, Method::default());
    let run = |method: &str| simulate(&SWINGING, method, &([1.0], [0.0]), 0.0..1.0).map(|run| run.state.q[0]);
    assert!((run("index1 + dop853").unwrap() - 1.0_f64.cos()).abs() < 1e-8);
    let error = run("index1 + dop8533").map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("did you mean `dop853`?"), "{error}");
}

/// x'' = u by its M and f, without the term of u.
struct Deaf;

impl MechanicalSystem for Deaf {
    fn dimensions(&self) -> Dimensions {
        Dimensions { q: 1, v: 1, ..Dimensions::default() }
    }
    fn facts(&self) -> Cow<'_, SystemFacts> {
        let inputs = vec![Column { name: "u".to_string(), unit: "N".to_string() }];
        Cow::Owned(SystemFacts { inputs, ..SystemFacts::new(self.dimensions()) })
    }
    fn evaluate(&self, _: f64, _: &[f64], _: &[f64], _: Need, terms: &mut Terms, _: &mut Scratch) {
        terms.mass[0] = 1.0;
        terms.f[0] = 0.0;
    }
    fn input_forces(&self, _: f64, _: &[f64], _: &[f64], f: &mut Matrix, _: &mut Scratch) {
        f[(0, 0)] = 1.0;
    }
}

#[test]
fn a_system_that_ignores_its_inputs_is_refused() {
    let mut run = Run::new(&Deaf, method("index1 + rk4"), 0.0, &([0.0], [0.0])).input("u", every(0.1, |_| 1.0));
    let error = run.to(1.0).unwrap_err().to_string();
    assert!(error.contains("an evaluation does not add them") && error.contains("`scratch.inputs`"), "{error}");
}

/// Two unit masses on unit rods by the angles of the rods, the second tied to the first.
struct Tied;

impl Equations for Tied {
    fn size(&self) -> (usize, usize) {
        (2, 1)
    }
    fn mass<S: Scalar>(&self, _t: S, q: &[S], mass: &mut [S]) {
        let coupling = (q[0] - q[1]).cos();
        mass.copy_from_slice(&[S::constant(2.0), coupling, coupling, S::one()]);
    }
    fn force<S: Scalar>(&self, _t: S, q: &[S], v: &[S], f: &mut [S]) {
        let turning = (q[0] - q[1]).sin();
        f[0] = q[0].sin() * -19.62 - turning * v[1].square();
        f[1] = q[1].sin() * -9.81 + turning * v[0].square();
    }
    fn phi<S: Scalar>(&self, _t: S, q: &[S], phi: &mut [S]) {
        phi[0] = q[1] - q[0].square();
    }
}

#[test]
fn a_state_gives_dense_matrices_on_request() {
    let pendulum = Model::parse(
        r#"{ "name": "pendulum", "dimension": 2, "gravity": [0, -9.81],
            "bodies": [{ "name": "bob", "type": "point_mass", "mass": 2, "initial": { "position": [1.2, 1.6] } }],
            "joints": [{ "name": "rod", "type": "distance", "between": ["ground", "bob"], "length": 2 }] }"#,
    )
    .unwrap();
    let mut run = pendulum.run();
    run.to(0.7).unwrap();
    let state = run.state().unwrap();
    let close = |found: Matrix, exact: Matrix| {
        assert_eq!(found.shape(), exact.shape());
        assert!((&found - &exact).amax() < 1e-14, "{found} and not {exact}");
    };
    close(state.mass(&pendulum), Matrix::from_diagonal_element(2, 2, 2.0));
    close(state.g(&pendulum), Matrix::from_row_slice(1, 2, &[state.q[0] / 2.0, state.q[1] / 2.0]));

    let mut run = Run::new(&Tied, "ggl + radau_iia", 0.0, &([0.5, 0.25], [1.0, 1.0]));
    run.to(0.3).unwrap();
    let state = run.state().unwrap();
    let coupling = (state.q[0] - state.q[1]).cos();
    close(state.mass(&Tied), Matrix::from_row_slice(2, 2, &[2.0, coupling, coupling, 1.0]));
    close(state.g(&Tied), Matrix::from_row_slice(1, 2, &[-2.0 * state.q[0], 1.0]));
    // M v' + G^T lambda = f
    let (vdot, lambda) = (Matrix::from_column_slice(2, 1, &state.vdot), Matrix::from_column_slice(1, 1, &state.lambda));
    let left = state.mass(&Tied) * vdot + state.g(&Tied).transpose() * lambda;
    let mut f = [0.0; 2];
    Equations::force(&Tied, state.t, &state.q, &state.v, &mut f);
    assert!((left - Matrix::from_column_slice(2, 1, &f)).amax() < 1e-11);
}
