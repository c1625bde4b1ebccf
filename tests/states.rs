//! States xi of controllers, filters and actuators, xi' = r(t, q, v, xi), through own equations: every method takes
//! them at its full order.

use crate::common::motor::{MOTOR, Motor, exact, start};
use crate::common::orders::{self, END, Rows, steps};
use crate::common::{adaptive, fixed, run, until};
use holonom::analysis::Recorder;
use holonom::initial::{assemble, equilibrium};
use holonom::integrator::{IntegratorEntry, Steps, registry};
use holonom::simulate::{Method, Span, simulate};
use holonom::system::{Dimensions, MechanicalSystem, Need, OperatingPoint, Scratch, Tangent, Terms};
use std::ops::Range;

const LEVELS: [(&str, Range<usize>); 5] = [("q", 1..3), ("v", 3..5), ("xi", 5..6), ("lambda", 6..7), ("work", 7..8)];

/// t, q, v, xi and lambda at eight times.
fn solution(method: &Method) -> Rows {
    let (q, v) = start();
    let span = Span { output_step: END / 8.0, ..until(END) };
    run(&MOTOR, method, span, (&q, &v)).completed().record.trajectory.rows
}

fn reference() -> Rows {
    exact(&(0..=8).map(|k| f64::from(k) * END / 8.0).collect::<Vec<f64>>())
}

/// Of order 8 the next term still counts at steps that leave errors of 1e-12, and so does round-off: found 7.56 to
/// 8.20, all of 7.8 and less in lambda.
#[test]
fn every_triple_has_the_order_of_its_integrator() {
    let of = |entry: &IntegratorEntry| match entry.order {
        8 => ([32, 40], 0.5),
        _ => (steps(entry), 0.3),
    };
    orders::check(&LEVELS, &reference(), of, solution);
}

/// As in tests/orders.rs.
#[test]
fn rows_between_steps_have_the_order_of_the_steps() {
    let of = |entry: &IntegratorEntry| match entry.order {
        8 => ([41, 49], 0.55),
        _ => (steps(entry).map(|n| n + 1), 0.3),
    };
    orders::check(&LEVELS, &reference(), of, solution);
}

/// As in tests/stiff.rs: the power of the mean step that the error falls with.
#[test]
fn methods_that_choose_their_steps_have_their_order() {
    let reference = reference();
    for entry in registry().iter().filter(|entry| entry.steps == Steps::Own) {
        // At an order that rules at both tolerances.
        let (integrator, order, tolerances, slack) = match entry.name {
            "bdf" => ("bdf", entry.order, [1e-6, 1e-11], 1.3),
            "diffsol" => ("diffsol", entry.order, [1e-6, 1e-11], 1.3),
            "adams" => ("adams:order=4", 4, [1e-6, 1e-10], 0.4),
            // Its leading error is small, and that of order 6 counts, too.
            "tsit45" => ("tsit45", entry.order, [1e-7, 1e-11], 1.1),
            name => (name, entry.order, [1e-4, 1e-9], 0.3),
        };
        for formulation in entry.accepts() {
            let found = tolerances.map(|tolerance| {
                let method = adaptive(&orders::gentle(formulation), integrator, "none", tolerance);
                let (q, v) = start();
                let span = Span { output_step: END / 8.0, ..until(END) };
                let run = run(&MOTOR, &method, span, (&q, &v)).completed();
                (run.outcome.statistics.steps as f64, run.record.trajectory.rows)
            });
            for (name, columns) in &LEVELS {
                let errors = [0, 1].map(|k| orders::error(&found[k].1, &reference, columns));
                let found_order = (errors[0] / errors[1]).ln() / (found[1].0 / found[0].0).ln();
                let what = format!("{formulation} + {integrator}: order {found_order:.2} in {name}, {errors:?}");
                assert!((found_order - order as f64).abs() < slack, "{what}");
            }
        }
    }
}

/// At t = 0 without a voltage the current is zero below the pivot.
#[test]
fn the_equilibrium_has_states_that_rest() {
    let (q, v) = start();
    let found = equilibrium(&MOTOR, 0.0, (&q, &v)).unwrap();
    assert!(crate::common::distance(&found.q, &[0.0, -1.0]) < 1e-14 && found.v[2].abs() < 1e-14, "{found:?}");
}

/// A start that is off the circle is closed by q and v alone.
#[test]
fn assembly_leaves_states_as_they_are() {
    let assembled = assemble(&MOTOR, 0.0, (&[0.8, -0.7], &[0.5, 0.3, 0.4]), &[]).unwrap();
    assert!(assembled.after.phi < 1e-15 && assembled.after.phi_dot < 1e-15, "{:?}", assembled.after);
    assert_eq!(assembled.v[2], 0.4);
}

#[test]
fn states_are_named_after_the_velocities() {
    let (q, v) = start();
    let run = run(&MOTOR, &fixed("index1", "rk4", "manifold", 0.1), until(END), (&q, &v));
    let headings = run.record.trajectory.headings().join(",");
    assert_eq!(headings, "t,q1,q2,v1,v2,xi1,lambda1,work of the motor");
}

#[test]
fn a_saved_run_goes_on_bit_by_bit() {
    let (q, v) = start();
    let span = Span { output_step: END / 7.0, ..until(END) };
    for entry in registry().iter().filter(|entry| entry.steps != Steps::Own) {
        for formulation in entry.accepts() {
            let method = match entry.name {
                _ if entry.steps == Steps::Fixed => fixed(formulation, entry.name, "manifold", END / 40.0),
                "generalized_alpha" => fixed(formulation, entry.name, "manifold", END / 40.0),
                _ => adaptive(formulation, entry.name, "manifold", 1e-6),
            };
            let differs = crate::common::saved::differs(&MOTOR, &method, span, (&q, &v));
            assert!(!differs, "{}", method.triple());
        }
    }
}

/// Newton's methods and their ends see states in whatever unit: 1e6 times as large a number changes rounding alone.
#[test]
fn the_unit_of_a_state_is_of_no_account() {
    let (q, v) = start();
    for (entry, formulation) in orders::integrators().flat_map(|entry| entry.accepts().map(move |name| (entry, name))) {
        let method = fixed(formulation, entry.name, "none", END / 100.0);
        let [ampere, micro] = [1.0, 1e-6].map(|unit| {
            let v = [v[0], v[1], v[2] / unit];
            let run = run(&Motor { unit }, &method, until(END), (&q, &v)).completed();
            let (q, v, lambda) = run.last();
            [q[0], q[1], v[0], v[1], unit * v[2], lambda[0]]
        });
        let off = crate::common::distance(&ampere, &micro);
        assert!(off < 1e-10, "{}: {off:e}", method.triple());
    }
}

/// A mass at rest, and a swing of two states that nothing reads, xi = (cos 20 t, -sin 20 t).
struct Unread;

const SWING: f64 = 20.0;

impl MechanicalSystem for Unread {
    fn dimensions(&self) -> Dimensions {
        Dimensions { q: 1, v: 3, lambda: 0, states: 2, ..Dimensions::default() }
    }
    fn evaluate(&self, _: f64, _: &[f64], v: &[f64], _: Need, terms: &mut Terms, _: &mut Scratch) {
        terms.mass.copy_from_slice(&[1.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
        terms.f.copy_from_slice(&[0.0, SWING * v[2], -SWING * v[1]]);
    }
    fn tangent(&self, _: OperatingPoint, tangent: &mut Tangent, _: &mut Scratch) -> bool {
        tangent.k.fill(0.0);
        tangent.c.copy_from_slice(&[0.0, 0.0, 0.0, 0.0, 0.0, -SWING, 0.0, SWING, 0.0]);
        true
    }
}

/// Their error counts though q and v say nothing of it: a step of a second would be good for those.
#[test]
fn steps_are_controlled_by_states_too() {
    for entry in registry().iter().filter(|entry| entry.steps != Steps::Fixed) {
        for formulation in entry.accepts() {
            let method = adaptive(formulation, entry.name, "none", 1e-6);
            let start: (&[f64], &[f64]) = (&[1.0], &[0.0, 1.0, 0.0]);
            let found = run(&Unread, &method, until(1.0), start).completed();
            let (_, v, _) = found.last();
            let error = (v[1] - SWING.cos()).abs().max((v[2] + SWING.sin()).abs());
            // README: within ten tolerances.
            assert!(error < 1e-5, "{formulation} + {}: {error:e}", entry.name);
        }
    }
}

/// A rotor, q = (cos, sin) of its angle, with a motor: as many coordinates as velocities, and yet q' = N v.
struct Rotor;

impl MechanicalSystem for Rotor {
    fn dimensions(&self) -> Dimensions {
        Dimensions { q: 2, v: 2, lambda: 0, states: 1, ..Dimensions::default() }
    }
    /// w' = i, i' = 1 - i - w
    fn evaluate(&self, _: f64, _: &[f64], v: &[f64], _: Need, terms: &mut Terms, _: &mut Scratch) {
        terms.mass.copy_from_slice(&[1.0, 0.0, 1.0]);
        terms.f.copy_from_slice(&[v[1], 1.0 - v[1] - v[0]]);
    }
    fn tangent(&self, _: OperatingPoint, tangent: &mut Tangent, _: &mut Scratch) -> bool {
        tangent.k.fill(0.0);
        tangent.c.copy_from_slice(&[0.0, -1.0, 1.0, 1.0]);
        true
    }
    fn rate(&self, q: &[f64], v: &[f64], qdot: &mut [f64]) {
        qdot.copy_from_slice(&[-q[1] * v[0], q[0] * v[0]]);
    }
    fn normalize(&self, q: &mut [f64]) {
        let length = q[0].hypot(q[1]);
        q.iter_mut().for_each(|q| *q /= length);
    }
}

/// From rest: w'' + w' + w = 1, so w = 1 - exp(-t/2) (cos b t + sin(b t)/(2 b)) with b = sqrt(3)/2, and i = w'. The
/// angle is its integral, t - i - w.
#[test]
fn coordinates_are_told_from_states() {
    let t = END;
    let b = 0.75f64.sqrt();
    let (sin, cos) = (b * t).sin_cos();
    let decay = (-0.5 * t).exp();
    let w = 1.0 - decay * (cos + sin / (2.0 * b));
    let i = decay * sin / b;
    let angle = t - i - w;
    let exact = [angle.cos(), angle.sin(), w, i];
    for entry in registry().iter().filter(|entry| entry.name != "rattle") {
        for formulation in entry.accepts() {
            let method = match entry.steps {
                Steps::Own => adaptive(formulation, entry.name, "none", 1e-8),
                _ => fixed(formulation, entry.name, "none", END / 1000.0),
            };
            let found = run(&Rotor, &method, until(END), (&[1.0, 0.0], &[0.0, 0.0])).completed();
            let error = crate::common::distance(&found.record.trajectory.rows[1][1..5], &exact);
            // Order 2 in a thousand steps of a motion of unit size.
            assert!(error < 2e-6, "{formulation} + {}: {error:e}", entry.name);
        }
    }
}

/// What has no place for states says so.
#[test]
fn rattle_refuses_coordinates_with_other_rates() {
    let (q, _) = start();
    let rattle = fixed("index3", "rattle", "none", 0.1);
    let refused = simulate(&Rotor, &rattle, until(END), (&q, &[0.0, 0.0]), &mut Recorder::new(&Rotor)).unwrap_err();
    assert!(refused.to_string().contains("q' = N(q) v"), "{refused}");
}
