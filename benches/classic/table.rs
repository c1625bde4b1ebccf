//! Andrews' mechanism to equal digits: the classic baseline, own equations and the scene.

use crate::common::{Case, least_times};
use crate::equations::andrews::{Andrews, END, START};
use holonom::simulate::{Method, Outcome};
use holonom::system::MechanicalSystem;
use std::hint::black_box;

const TOLERANCES: std::ops::RangeInclusive<i32> = 3..=12;
const DIGITS: [f64; 7] = [3.0, 5.0, 6.0, 8.0, 9.0, 10.0, 12.0];
const INTEGRATORS: [&str; 3] = ["dop853", "adams", "dopri5"];
const RIVALS: [&str; 3] = ["classic DOP853, by hand", "own equations", "scene"];

/// A run at one tolerance: the rival, correct digits, evaluations with a factorization, and the time, s.
struct Point {
    rival: usize,
    digits: f64,
    evaluations: u64,
    time: f64,
}

/// Correct digits of the worst angle, relative to 1 + |angle|.
fn digits(angles: [f64; 7]) -> f64 {
    let errors = angles.iter().zip(END.q).map(|(angle, exact)| (angle - exact).abs() / (1.0 + exact.abs()));
    -errors.fold(1e-16, f64::max).log10()
}

/// The seven angles of own equations, or from the bodies of the scene.
fn angles(outcome: &Outcome) -> [f64; 7] {
    let q = &outcome.q;
    if let Ok(angles) = q[..].try_into() {
        return angles;
    }
    let [k1, k2, k3, k4, k5, k6, k7] = std::array::from_fn(|body| q[3 * body + 2]);
    [k1, k2 - k1, k3, k4 - k5, k5, k6 - k7, k7]
}

/// Prints time, digits and evaluations at each tolerance, then the times to equal digits with their ratios. `run`
/// makes a run with rtol = atol from a start.
pub fn compare(
    scene: (&dyn MechanicalSystem, (&[f64], &[f64])),
    adaptive: impl Fn([&str; 3], f64) -> Method,
    run: impl Fn(&dyn MechanicalSystem, (&[f64], &[f64]), &Method, f64) -> Outcome,
) {
    let (mut cases, mut points) = (Vec::<Case>::new(), Vec::new());
    for tolerance in TOLERANCES.map(|power| 10f64.powi(-power)) {
        let end = super::andrews(tolerance, END.t);
        let call = move || _ = black_box(super::andrews(black_box(tolerance), END.t));
        points.push(Point { rival: 0, digits: digits(end.q), evaluations: end.evaluations, time: 0.0 });
        cases.push((format!("{tolerance:e}, {}", RIVALS[0]), Box::new(call)));
        for integrator in INTEGRATORS {
            let method = adaptive(["index1", integrator, "manifold"], tolerance);
            for (rival, (system, start)) in [(1, (&Andrews as &dyn MechanicalSystem, START.motion())), (2, scene)] {
                let (run, method) = (&run, method.clone());
                let end = run(system, start, &method, END.t);
                let evaluations = end.statistics.rhs_evaluations + end.statistics.projections;
                points.push(Point { rival, digits: digits(angles(&end)), evaluations, time: 0.0 });
                let call = move || drop(run(system, start, &method, END.t));
                cases.push((format!("{tolerance:e}, {}, {integrator}", RIVALS[rival]), Box::new(call)));
            }
        }
    }
    let times = least_times(&mut cases);
    println!("\n{:<42} {:>7} {:>12} {:>10}", "andrews, 0.03 s", "digits", "evaluations", "us");
    for (((name, _), point), time) in cases.iter().zip(&mut points).zip(times) {
        point.time = time;
        println!("  {name:<40} {:>7.1} {:>12} {:>10.1}", point.digits, point.evaluations, 1e6 * time);
    }
    equal_digits(&points);
}

fn equal_digits(points: &[Point]) {
    println!(
        "\nandrews, us to equal digits {:>10} {:>14} {:>7} {:>7} {:>7}",
        RIVALS[0], RIVALS[1], "ratio", RIVALS[2], "ratio"
    );
    for digits in DIGITS {
        let [classic, own, scene] = [0, 1, 2].map(|rival| 1e6 * time_to(points, rival, digits));
        println!(
            "  {digits:>4} {classic:>45.0} {own:>14.0} {:>7.2} {scene:>7.0} {:>7.2}",
            own / classic,
            scene / classic
        );
    }
}

/// Time to reach the digits, with log(time) interpolated between the runs that none beats in both; s.
fn time_to(points: &[Point], rival: usize, digits: f64) -> f64 {
    let mut points: Vec<&Point> = points.iter().filter(|point| point.rival == rival).collect();
    points.sort_by(|a, b| a.time.total_cmp(&b.time));
    let mut last: Option<&Point> = None;
    for point in points {
        if last.is_some_and(|last| point.digits <= last.digits) {
            continue;
        }
        if point.digits >= digits {
            return last.map_or(point.time, |last| {
                let part = (digits - last.digits) / (point.digits - last.digits);
                last.time * (point.time / last.time).powf(part)
            });
        }
        last = Some(point);
    }
    f64::NAN
}
