//! How much faster than real time the five-link suspension runs, for thirty seconds within 0.1 mm: `cargo bench --bench
//! suspension`. Single thread.
//!
//! Every method takes the largest of its steps, or tolerances, with which chassis and wheel stay within [`CLOSE`] of a
//! tight solution at all hundredths of a second. A controller that calls a step at a time waits for the slow ones too:
//! the time that 99 % of the steps keep stands beside their median.

use holonom::analysis::Recorder;
use holonom::method_spec::MethodSpec;
use holonom::prepared::{Model, Overrides};
use holonom::simulate::{Method, Observation, Outcome, Sink, Span, simulate};
use std::path::Path;
use std::time::Instant;

/// Error allowed at chassis and wheel, m.
const CLOSE: f64 = 1e-4;
/// Simulated time, s.
const END: f64 = 30.0;
/// Timed runs of a method; the fastest counts.
const RUNS: usize = 3;

/// Fixed steps to try, s, and tolerances (rtol = atol).
const STEPS: [f64; 7] = [0.02, 0.0125, 0.01, 0.005, 0.0025, 0.001, 0.0005];
const TOLERANCES: [f64; 8] = [1e-2, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6, 1e-7];

#[derive(Clone, Copy)]
enum Knob {
    Step,
    Tolerance,
}
use Knob::{Step, Tolerance};

/// Formulation, integrator, projection, and what is tried.
const METHODS: [([&str; 3], Knob); 13] = [
    (["index1", "heun", "manifold"], Step),
    (["index1", "rk4", "manifold"], Step),
    (["baumgarte:alpha=100,beta=100", "rk4", "none"], Step),
    (["null_space", "rk4", "none"], Step),
    (["index1", "dopri5", "manifold"], Step),
    (["index1", "dopri5", "manifold"], Tolerance),
    (["index1", "dop853", "manifold"], Tolerance),
    (["index2", "hem4", "manifold"], Step),
    (["index3", "generalized_alpha", "none"], Step),
    (["ggl", "radau_iia", "none"], Tolerance),
    (["ggl", "tr_bdf2", "none"], Tolerance),
    (["ggl", "esdirk34", "none"], Tolerance),
    (["ggl", "bdf", "none"], Tolerance),
];

/// A sink that keeps nothing but how long each step took, s.
struct Clock {
    last: Instant,
    steps: Vec<f64>,
}

impl Sink for Clock {
    fn accepted(&mut self, _: &Observation) {
        let now = Instant::now();
        self.steps.push((now - self.last).as_secs_f64());
        self.last = now;
    }
}

fn shipped(name: &str, set: &[(&str, f64)]) -> Model {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("models").join(name);
    let set = set.iter().map(|(name, value)| (name.to_string(), (*value).into())).collect();
    Model::load_with(&path, &Overrides { set, ..Overrides::default() }).unwrap_or_else(|error| panic!("{error}"))
}

fn method([formulation, integrator, projection]: [&str; 3], knob: Knob, value: f64) -> Method {
    let [formulation, integrator, projection] = [formulation, integrator, projection]
        .map(|text| MethodSpec::parse(text).unwrap_or_else(|error| panic!("{error}")));
    let method = Method { formulation, integrator, projection, ..Method::default() };
    match knob {
        Step => Method { step: Some(value), ..method },
        Tolerance => Method { rtol: value, atol: value, ..method },
    }
}

/// Height of the chassis and position of the carrier, m, every hundredth of a second; `None` if the run fails.
fn positions(prepared: &Model, method: &Method) -> Option<Vec<[f64; 4]>> {
    let mut recorder = Recorder::new(prepared.system());
    let span = Span { start: 0.0, end: END, output_step: 0.01 };
    let outcome = simulate(prepared.system(), method, span, prepared.start(), &mut recorder);
    let completed = outcome.unwrap_or_else(|error| panic!("{error}")).failure.is_none();
    let trajectory = recorder.finish().trajectory;
    let place = |row: &Vec<f64>| -> [f64; 4] { std::array::from_fn(|i| trajectory.row_state(row).0[i]) };
    completed.then(|| trajectory.rows.iter().map(place).collect())
}

fn error(found: &[[f64; 4]], exact: &[[f64; 4]]) -> f64 {
    assert_eq!(found.len(), exact.len());
    let pairs = found.iter().flatten().zip(exact.iter().flatten());
    // A NaN must not pass for the smallest error.
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, |worst, off| if off <= worst { worst } else { off })
}

/// What a run took.
struct Cost {
    outcome: Outcome,
    /// s
    wall: f64,
    /// What half of the steps, and 99 % of them, do not exceed, s.
    steps: [f64; 2],
}

/// The fastest of some runs.
fn time(prepared: &Model, method: &Method) -> Cost {
    let span = Span { start: 0.0, end: END, output_step: END };
    let run = || {
        let begin = Instant::now();
        let mut clock = Clock { last: begin, steps: Vec::with_capacity(100_000) };
        let outcome = simulate(prepared.system(), method, span, prepared.start(), &mut clock);
        let wall = begin.elapsed().as_secs_f64();
        clock.steps.sort_by(f64::total_cmp);
        let steps = [50, 99].map(|part| clock.steps[clock.steps.len() * part / 100]);
        Cost { outcome: outcome.unwrap_or_else(|error| panic!("{error}")), wall, steps }
    };
    (1..RUNS).map(|_| run()).fold(run(), |best, next| if next.wall < best.wall { next } else { best })
}

/// The line of a method, with the first of its steps or tolerances that is close enough; its wall time.
fn line(prepared: &Model, names: [&str; 3], knob: Knob, exact: &[[f64; 4]]) -> Option<(f64, String)> {
    let values: &[f64] = match knob {
        Step => &STEPS,
        Tolerance => &TOLERANCES,
    };
    let off = |value: f64| positions(prepared, &method(names, knob, value)).map(|found| error(&found, exact));
    let (value, off) = values.iter().find_map(|&value| Some((value, off(value).filter(|off| *off < CLOSE)?)))?;
    let Cost { outcome, wall, steps: [half, most] } = time(prepared, &method(names, knob, value));
    let steps = outcome.statistics.steps + outcome.statistics.rejected;
    let knob = match knob {
        Step => format!("h = {:.1} ms", 1e3 * value),
        Tolerance => format!("tol {value:.0e}"),
    };
    let times = format!("{:9.1} {:8.1} {:8.1} {:8.0}", 1e3 * wall, 1e6 * half, 1e6 * most, END / wall);
    Some((wall, format!("{:<46} {knob:<12} {steps:6} {off:9.1e} {times}", names.join(" + "))))
}

/// All methods on one scene, the fastest first.
fn table(title: &str, prepared: &Model) {
    let exact = method(["index1", "dop853", "exact"], Tolerance, 1e-11);
    let exact = positions(prepared, &exact).unwrap_or_else(|| panic!("{title}: the tight run failed"));
    println!("\n{title}");
    let names = ["steps", "error/m", "ms", "us/step", "99 %", "x real"];
    println!(
        "{:<59} {:>6} {:>9} {:>9} {:>8} {:>8} {:>8}",
        "", names[0], names[1], names[2], names[3], names[4], names[5]
    );
    let mut reached: Vec<(f64, String)> = Vec::new();
    for (names, knob) in METHODS {
        match line(prepared, names, knob, &exact) {
            Some(line) => reached.push(line),
            None => println!("{:<46} fails, or does not come so close", names.join(" + ")),
        }
    }
    reached.sort_by(|a, b| a.0.total_cmp(&b.0));
    reached.iter().for_each(|(_, line)| println!("{line}"));
}

fn main() {
    // The scene's bump and dip, after which the car comes to rest; and a road that never ends, near both resonances.
    let roads: [(&str, &[(&str, f64)]); 2] =
        [("bump and dip", &[]), ("wavy road", &[("bump", 0.0), ("dip", 0.0), ("swell", 0.02), ("ripple", 0.004)])];
    for (name, level) in [("five_link_suspension", "massless rods"), ("five_link_suspension_rods", "rods as bodies")] {
        for (road, set) in roads {
            let prepared = shipped(&format!("{name}.json"), set);
            table(&format!("{level}, {road}, {END} s within {CLOSE} m"), &prepared);
        }
    }
}
