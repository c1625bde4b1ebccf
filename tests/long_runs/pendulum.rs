//! A pendulum swinging with an amplitude of 1 rad for very long, against its closed form.

use holonom::Result;
use holonom::prepared::{Model, Overrides};
use holonom::scene::Scene;
use holonom::simulate::{Method, Observation, Sink, Span, simulate};
use std::f64::consts::{PI, TAU};
use std::time::Instant;

pub const GRAVITY: f64 = 9.81;
pub const AMPLITUDE: f64 = 1.0;

/// 2 pi sqrt(l/g) / agm(1, cos(amplitude/2)), l = 1 m.
pub fn period() -> f64 {
    TAU / GRAVITY.sqrt() / mean(1.0, (0.5 * AMPLITUDE).cos())
}

/// The arithmetic-geometric mean, to round-off.
fn mean(a: f64, b: f64) -> f64 {
    (0..6).fold((a, b), |(a, b), _| (0.5 * (a + b), (a * b).sqrt())).0
}

/// A point of 1 kg on a rod of 1 m.
pub fn pendulum() -> Result<Model> {
    let (sin, cos) = AMPLITUDE.sin_cos();
    let scene = format!(
        r#"{{ "name": "pendulum", "dimension": 2, "gravity": [0, -{GRAVITY}],
             "ground": {{ "markers": {{ "O": [0, 0] }} }},
             "bodies": [{{ "name": "bob", "type": "point_mass", "mass": 1,
                           "initial": {{ "position": [{sin:?}, {:?}] }} }}],
             "joints": [{{ "name": "rod", "type": "distance", "between": ["ground.O", "bob"], "length": 1 }}] }}"#,
        -cos
    );
    Model::new(Scene::parse(&scene, &[])?, &Overrides::default())
}

/// The part of a period since the last passage of the lowest point to the right, in [0, 1): with sin(theta/2) = k sin a,
/// theta' = 2 omega k cos a the time since is F(a, k)/omega.
pub fn phase(q: &[f64], v: &[f64]) -> f64 {
    let theta = q[0].atan2(-q[1]);
    let rate = (q[0] * v[1] - q[1] * v[0]) / (q[0] * q[0] + q[1] * q[1]);
    let x = (0.5 * theta).sin();
    let y = 0.5 * rate / GRAVITY.sqrt();
    let angle = x.atan2(y);
    let square = x * x + y * y;
    let quarter = 0.5 * PI / mean(1.0, (1.0 - square).sqrt());
    (first_integral(angle, square) / (4.0 * quarter)).rem_euclid(1.0)
}

/// F(angle, k) = int_0^angle da / sqrt(1 - k^2 sin^2 a) by Simpson's rule.
fn first_integral(angle: f64, square: f64) -> f64 {
    let count = 4000;
    let value = |i: usize| 1.0 / (1.0 - square * (angle * i as f64 / count as f64).sin().powi(2)).sqrt();
    let weight = |i: usize| if i == 0 || i == count { 1.0 } else { 2.0 + 2.0 * (i % 2) as f64 };
    (0..=count).map(|i| weight(i) * value(i)).sum::<f64>() * angle / (3 * count) as f64
}

/// What a run has come to after some periods.
#[derive(Clone, Copy, Debug)]
pub struct Mark {
    pub periods: f64,
    /// How far it is ahead of the closed form, in periods.
    pub phase: f64,
    /// Error of the energy now and the largest so far, over what swings: g l (1 - cos amplitude).
    pub energy: f64,
    pub largest: f64,
    /// Largest |phi| and |phi'| so far, m and m/s.
    pub drift: [f64; 2],
    pub steps: u64,
    /// Wall clock so far, s.
    pub seconds: f64,
}

/// Watches every accepted step.
#[derive(Default)]
struct Watch {
    last_x: f64,
    passages: u64,
    energy: f64,
    largest: f64,
    drift: [f64; 2],
}

impl Sink for Watch {
    fn accepted(&mut self, state: &Observation) {
        let q = state.q;
        let v = state.v;
        self.passages += u64::from(self.last_x < 0.0 && q[0] >= 0.0);
        self.last_x = q[0];
        let start = -GRAVITY * AMPLITUDE.cos();
        let swing = GRAVITY + start;
        self.energy = (0.5 * (v[0] * v[0] + v[1] * v[1]) + GRAVITY * q[1] - start) / swing;
        self.largest = self.largest.max(self.energy.abs());
        self.drift = [self.drift[0].max(state.phi[0].abs()), self.drift[1].max(state.phi_dot[0].abs())];
    }
}

/// Runs to each of the given numbers of periods, in order, and tells what it has come to.
pub fn run(method: &Method, periods: &[f64], told: impl Fn(&Mark)) -> Result<Vec<Mark>> {
    let prepared = pendulum()?;
    let (q, v) = prepared.start();
    let mut q = q.to_vec();
    let mut v = v.to_vec();
    let mut watch = Watch { last_x: q[0], ..Watch::default() };
    let clock = Instant::now();
    let mut t = 0.0;
    let mut steps = 0;
    let mut marks = Vec::new();
    for &periods in periods {
        let span = Span { start: t, end: periods * period(), output_step: periods * period() };
        let outcome = simulate(prepared.system(), method, span, (&q, &v), &mut watch)?;
        if let Some(failure) = outcome.failure {
            return Err(holonom::Error::input(failure.reason));
        }
        (q, v, t, steps) = (outcome.q, outcome.v, span.end, steps + outcome.statistics.steps);
        marks.push(Mark {
            periods,
            phase: (watch.passages as f64 - periods) + (phase(&q, &v) - 0.25),
            energy: watch.energy,
            largest: watch.largest,
            drift: watch.drift,
            steps,
            seconds: clock.elapsed().as_secs_f64(),
        });
        marks.last().into_iter().for_each(&told);
    }
    Ok(marks)
}
