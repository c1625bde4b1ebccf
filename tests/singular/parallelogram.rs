//! A parallelogram linkage that turns through its change points, as a pendulum does that turns over.

use super::{adaptive, fixed, last};
use crate::scenes::{Ready, Run, model, parse, shipped};
use holonom::analysis::Recorder;
use holonom::simulate::{Span, simulate};

const RATE: f64 = 12.0;

/// angle'' = -k sin(angle): (m_link + m_beam)/(2/3 m_link + m_beam) g/r.
fn stiffness() -> f64 {
    (0.4 + 2.0) / (2.0 / 3.0 * 0.4 + 2.0) * 9.81 / 0.5
}

/// Jacobi's amplitude am(u, k) by arithmetic-geometric means (Abramowitz & Stegun 16.4).
fn amplitude(u: f64, modulus: f64) -> f64 {
    let mut a = 1.0;
    let mut b = (1.0 - modulus * modulus).sqrt();
    let mut ratios = Vec::new();
    while (a - b) / a > 1e-15 {
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
        // c = sqrt(a^2 - b^2), which is half the difference before.
        ratios.push((a * a - b * b).max(0.0).sqrt() / a);
    }
    let start = f64::from(1 << ratios.len()) * a * u;
    ratios.iter().rev().fold(start, |angle, ratio| (angle + (ratio * angle.sin()).asin()) / 2.0)
}

/// A pendulum that turns over: angle = 2 am(rate t/2, 2 sqrt(k)/rate).
pub fn angle(t: f64) -> f64 {
    2.0 * amplitude(RATE / 2.0 * t, 2.0 * stiffness().sqrt() / RATE)
}

fn rate(t: f64) -> f64 {
    (RATE * RATE - 4.0 * stiffness() * (angle(t) / 2.0).sin().powi(2)).sqrt()
}

fn turning(step: f64) -> Run {
    let span = Span { start: 0.0, end: 5.0, output_step: 0.05 };
    shipped("parallelogram", &[]).run(&fixed("index1", "rk4", "manifold", step), span)
}

#[test]
fn it_turns_as_a_pendulum_through_sixteen_change_points() {
    let run = turning(5e-4);
    let passed = (last(&run, "angle") / std::f64::consts::PI - 0.5).ceil();
    assert_eq!(passed, 16.0);
    let errors = [run.worst("angle", angle), run.worst("rate", rate), run.worst("beam_tilt", |_| 0.0)];
    // The error of RK4, of order four (below).
    assert!(errors[0] < 1e-9 && errors[1] < 1e-9, "{errors:?}");
    assert!(errors[2] < 1e-12, "{errors:?}");
}

/// Four orders, whatever step size: with steps that are no part of the passing times some end within 1e-5 rad of a change
/// point. What is nearly singular there must be left out: solved for, it multiplies round-off by its inverse.
#[test]
fn the_order_is_kept_wherever_steps_end() {
    let ready = shipped("parallelogram", &[]);
    // RK4's constant, about 2.6e3 in 1/s^4 at any of these steps; that of the tangent space is larger.
    for (formulation, projection, bound) in [
        ("index1", "manifold", 3.5e3),
        ("index1", "exact", 3.5e3),
        ("udwadia_kalaba", "manifold", 3.5e3),
        ("null_space", "none", 1.3e4),
    ] {
        // Steps by an irrational factor from 4 ms down, and some that end within 1e-5 rad of change points.
        for step in (0..16).map(|i| 0.004 * (-0.08 * f64::from(i)).exp()).chain([7e-4, 3.825670302663491e-4]) {
            let method = fixed(formulation, "rk4", projection, step);
            let run = ready.run(&method, Span { start: 0.0, end: 5.0, output_step: 5.0 });
            let constant = (last(&run, "angle") - angle(5.0)).abs() / step.powi(4);
            // Beside a change point what is left out costs 1e-4 of an acceleration for a step: 1e-10 with the smallest.
            assert!(constant < bound + 1e-9 / step.powi(4), "{formulation} {projection}, {step} s: {constant:e}");
        }
    }
}

/// Velocities at a change point decide which motion goes on there: links alike, or the antiparallelogram, whose second
/// link turns three times as fast the other way, 3/4 turn(1) + 1/4 turn(2) = 0. Others are of no motion.
#[test]
fn from_a_change_point_it_follows_its_velocities() {
    let span = Span { start: 0.0, end: 1.0, output_step: 0.05 };
    let method = fixed("index1", "rk4", "manifold", 5e-4);
    let level = std::f64::consts::FRAC_PI_2;
    let start = (0.5 * 9.81 * 2.4, 0.5 * (0.4 / 3.0 * 2.0 + 2.0) * 0.25);
    let run = shipped("parallelogram", &[("angle0", level)]).run(&method, span);
    for (angle, rate) in run.column("angle").iter().zip(run.column("rate")) {
        // Energy: weights fall by r cos(angle), rotation as of a pendulum.
        let energy = start.1 * (rate * rate - RATE * RATE) - start.0 * angle.cos();
        assert!(energy.abs() < 1e-7, "at {angle}: {energy:e}");
    }
    assert!(run.worst("beam_tilt", |_| 0.0) < 1e-12);
    assert!(turned(-3.0).run(&method, span).worst("beam_tilt", |_| 0.0) > 1.0);
    let ready = turned(0.5);
    let failure = {
        let mut recorder = Recorder::new(ready.system());
        simulate(ready.system(), &method, span, ready.0.start(), &mut recorder).unwrap().failure.unwrap()
    };
    assert!(failure.t == 0.0 && failure.reason.contains("no motion"), "{failure:?}");
}

/// Released level, it falls as a pendulum: gravity pushes it along the motion of links alike. With unlike masses gravity
/// pushes it along neither motion.
#[test]
fn from_rest_at_a_change_point_it_goes_where_it_is_pushed_or_says_why_not() {
    let span = Span { start: 0.0, end: 5.0, output_step: 0.05 };
    let start = [("angle0", std::f64::consts::FRAC_PI_2), ("rate0", 0.0)];
    for (integrator, tolerance) in
        [("dopri5", 1e-6), ("dopri5", 1e-8), ("dopri5", 1e-9), ("dopri5", 1e-10), ("dopri5", 1e-12), ("dop853", 1e-9)]
    {
        let run = shipped("parallelogram", &start).run(&adaptive("index1", integrator, "manifold", tolerance), span);
        // Until the row that depends on others there counts again, errors of steps tilt the beam.
        assert!(run.worst("beam_tilt", |_| 0.0) < 1e-8_f64.max(10.0 * tolerance), "{integrator} {tolerance:e}");
        for (angle, rate) in run.column("angle").iter().zip(run.column("rate")) {
            let energy = 0.5 * rate * rate - stiffness() * angle.cos();
            assert!(energy.abs() < 1e-7_f64.max(1e3 * tolerance), "{integrator} {tolerance:e} at {angle}: {energy:e}");
        }
    }
    let text = std::fs::read_to_string(model("parallelogram")).unwrap();
    let (first, second) = text.split_once("\"link2\"").unwrap();
    let second = second.replacen("\"mass\": \"m_link\"", "\"mass\": \"3*m_link\"", 1);
    let text = format!("{first}\"link2\"{second}").replace("\"angle0\": 0", "\"angle0\": \"pi/2\"");
    let ready = parse(&text.replace("\"rate0\": 12", "\"rate0\": 0"));
    for method in [fixed("index1", "rk4", "manifold", 5e-4), adaptive("index1", "dopri5", "manifold", 1e-8)] {
        let mut recorder = Recorder::new(ready.system());
        let failure = simulate(ready.system(), &method, span, ready.0.start(), &mut recorder).unwrap().failure.unwrap();
        assert!(failure.t == 0.0 && failure.reason.contains("not determined"), "{failure:?}");
    }
}

/// At rest at a change point it begins to fall as a pendulum, if its links are alike: that goes on. If not, what moves is no
/// motion of the linkage, which has two to choose from there.
#[test]
fn it_falls_from_rest_at_a_change_point() {
    let level = std::f64::consts::FRAC_PI_2;
    let alike = shipped("parallelogram", &[("angle0", level), ("rate0", 0.0)]);
    let end = Span { start: 0.0, end: 0.6, output_step: 0.6 };
    let exact = last(&alike.run(&fixed("index1", "rk4", "manifold", 1e-3), end), "angle");
    for (formulation, tolerance) in [("index1", 1e-6), ("index2", 1e-6), ("index1", 1e-9), ("index2", 1e-9)] {
        let run = alike.run(&adaptive(formulation, "radau_iia", "none", tolerance), end);
        let error = (last(&run, "angle") - exact).abs();
        // Beside a change point errors of the positions grow by the inverse of its rank indicator.
        assert!(error < 1e4 * tolerance, "{formulation} {tolerance:e}: {error:e}");
    }
    let text = std::fs::read_to_string(model("parallelogram")).unwrap();
    let text = text.replace("\"angle0\": 0, \"rate0\": 12", "\"angle0\": \"pi/2\", \"rate0\": 0");
    let (first, second) = text.split_once("\"link2\"").unwrap();
    let unlike = parse(&format!("{first}\"link2\"{}", second.replacen("\"m_link\"", "\"2*m_link\"", 1)));
    for method in [
        fixed("index1", "rk4", "manifold", 1e-3),
        adaptive("ggl", "radau_iia", "none", 1e-6),
        adaptive("index3", "generalized_alpha", "none", 1e-6),
    ] {
        let mut recorder = Recorder::new(unlike.system());
        let outcome = simulate(unlike.system(), &method, end, unlike.0.start(), &mut recorder).unwrap();
        let failure = outcome.failure.unwrap();
        assert!(failure.t == 0.0 && failure.reason.contains("singular state"), "{failure:?}");
    }
}

/// No implicit method stalls there, and none says that its joints contradict each other.
#[test]
fn implicit_steps_from_a_change_point_end() {
    let ready = shipped("parallelogram", &[("angle0", std::f64::consts::FRAC_PI_2), ("rate0", 0.0)]);
    let span = Span { start: 0.0, end: 5.0, output_step: 5.0 };
    for (integrator, formulations) in
        [("radau_iia", &["index1", "index2", "index3", "ggl"][..]), ("generalized_alpha", &["index3", "ggl"])]
    {
        for (formulation, projection) in formulations.iter().flat_map(|f| [(f, "none"), (f, "manifold")]) {
            for tolerance in [1e-4, 1e-6, 1e-9] {
                let method = adaptive(formulation, integrator, projection, tolerance);
                let mut recorder = Recorder::new(ready.system());
                let outcome = simulate(ready.system(), &method, span, ready.0.start(), &mut recorder).unwrap();
                let work = outcome.statistics.steps + outcome.statistics.rejected;
                println!("{} {tolerance:e}: {work} {:?}", method.triple(), outcome.failure);
                assert!(work < 100_000, "{} {tolerance:e}: {work}", method.triple());
                assert!(outcome.failure.is_none_or(|failure| !failure.reason.contains("contradict")));
            }
        }
    }
}

/// The parallelogram at a change point, its second link so many times as fast as the first.
fn turned(ratio: f64) -> Ready {
    let text = std::fs::read_to_string(model("parallelogram")).unwrap();
    let text = text.replace("\"angle0\": 0", "\"angle0\": \"pi/2\"");
    let (links, beam) = text.split_once("\"name\": \"beam\"").unwrap();
    let (first, second) = links.split_once("\"link2\"").unwrap();
    let second = second.replace("\"rate0\" }", &format!("\"{ratio}*rate0\" }}"));
    let beam = beam.replace(
        "\"r*sin(angle0)*rate0\"]",
        &format!("\"r*rate0*(1 + {ratio})/2\"], \"angular_velocity\": \"r*rate0*({ratio} - 1)/b\""),
    );
    parse(&format!("{first}\"link2\"{second}\"name\": \"beam\"{beam}"))
}

/// Just too slow to turn over, it comes to both change points and back.
#[test]
fn it_swings_past_the_change_points_and_back() {
    let run = shipped("parallelogram", &[("rate0", 9.0)])
        .run(&fixed("index1", "rk4", "manifold", 0.001), Span { start: 0.0, end: 5.0, output_step: 0.01 });
    let angles = run.column("angle");
    let (low, high) = angles.iter().fold((0.0f64, 0.0f64), |(low, high), x| (low.min(*x), high.max(*x)));
    // cos(greatest) = 1 - rate0^2/(2 k); the rows miss it by the square of their distance.
    let greatest = (1.0 - 81.0 / (2.0 * stiffness())).acos();
    assert!(high <= greatest && greatest - high < 1e-3 && (low + high).abs() < 1e-3, "{low} {high} {greatest}");
    for (angle, rate) in angles.iter().zip(run.column("rate")) {
        let energy = rate * rate - 81.0 + 4.0 * stiffness() * (angle / 2.0).sin().powi(2);
        // 1e-8 of rate0^2.
        assert!(energy.abs() < 2e-6, "at {angle}: {energy:e}");
    }
    assert!(run.worst("beam_tilt", |_| 0.0) < 1e-12);
}
