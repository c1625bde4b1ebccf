//! Velocity constraints without a position level, A v + a = 0, through own equations: every formulation with multipliers and
//! every vector field keeps them, whatever the method.

use crate::common::{adaptive, fixed, run, until};
use holonom::integrator::{Steps, registry};
use holonom::system::{Dimensions, MechanicalSystem, Need, OperatingPoint, Scratch, Structure, Tangent, Terms};

/// A skate on an inclined plane, (x, y, angle): no motion across its blade, -sin(angle) x' + cos(angle) y' = 0. Unit mass and
/// moment of inertia.
struct Skate;

/// LociVariable x, m/s^2.
const GRAVITY: f64 = 3.0;
/// Turning, rad/s, which nothing changes.
const OMEGA: f64 = 2.0;
const END: f64 = 1.5;

impl MechanicalSystem for Skate {
    fn dimensions(&self) -> Dimensions {
        Dimensions { q: 3, v: 3, lambda: 1, nonholonomic: 1, ..Dimensions::default() }
    }

    fn evaluate(&self, _: f64, q: &[f64], v: &[f64], need: Need, terms: &mut Terms, _: &mut Scratch) {
        let (sin, cos) = q[2].sin_cos();
        if need.includes(Need::MASS) {
            let mass = self.structure().mass;
            mass.entries.iter().zip(&mut terms.mass).for_each(|((i, j), mass)| *mass = f64::from(u8::from(i == j)));
        }
        terms.f.copy_from_slice(&[GRAVITY, 0.0, 0.0]);
        terms.g.copy_from_slice(&[-sin, cos, 0.0]);
        terms.phi_dot[0] = cos * v[1] - sin * v[0];
        let turning = -cos * v[0] - sin * v[1];
        terms.gamma[0] = -turning * v[2];
        terms.l.copy_from_slice(&[0.0, 0.0, turning]);
    }

    fn tangent(&self, at: OperatingPoint, tangent: &mut Tangent, _: &mut Scratch) -> bool {
        let ((sin, cos), Structure { tangent: pattern, .. }) = (at.q[2].sin_cos(), self.structure());
        let by_angle = [-cos * at.lambda[0], -sin * at.lambda[0], 0.0];
        let places = pattern.entries.iter().zip(&mut tangent.k);
        places.for_each(|(&(i, j), k)| *k = if j == 2 { by_angle[i] } else { 0.0 });
        tangent.c.fill(0.0);
        true
    }
}

/// From rest at the origin: v = g/omega sin(omega t) along the blade (Neimark, Fufaev, Dynamics of Nonholonomic Systems, 1972).
fn exact(t: f64) -> [f64; 3] {
    let angle = OMEGA * t;
    let size = GRAVITY / (2.0 * OMEGA * OMEGA);
    [size * angle.sin().powi(2), size * (angle - 0.5 * (2.0 * angle).sin()), angle]
}

#[test]
fn every_method_keeps_a_skate_on_its_blade() {
    let mut tried = 0;
    for entry in registry() {
        for formulation in entry.accepts() {
            let method = match entry.steps {
                Steps::Fixed => fixed(formulation, entry.name, "none", 2e-3),
                _ => adaptive(formulation, entry.name, "none", 1e-7),
            };
            let found = run(&Skate, &method, until(END), (&[0.0; 3], &[0.0, 0.0, OMEGA])).completed();
            let (q, v, _) = found.last();
            let error = q.iter().zip(exact(END)).fold(0.0, |worst: f64, (q, exact)| worst.max((q - exact).abs()));
            let across = (v[1] * q[2].cos() - v[0] * q[2].sin()).abs();
            // Steps of 2e-3 with order 2, 2e-3^2 of what turns at 2 rad/s; penalties leave 1e-7 of the accelerations.
            let what = format!("{formulation} + {}: {error:e} in q, {across:e} across", entry.name);
            assert!(error < 3e-5 && across < 3e-5, "{what}");
            tried += 1;
        }
    }
    assert!(tried > 50, "{tried}");
}

/// What is solved for velocities holds them to round-off, also where the formulation asks for positions, which there are none of.
#[test]
fn the_blade_holds_to_round_off_where_rows_are_solved() {
    for (formulation, integrator) in [
        ("index3", "radau_iia"),
        ("index2", "radau_iia"),
        ("ggl", "radau_iia"),
        ("stabilized_index1", "radau_iia"),
        ("ggl", "generalized_alpha"),
        ("stabilized_index1", "generalized_alpha"),
    ] {
        let found =
            run(&Skate, &fixed(formulation, integrator, "none", 0.01), until(END), (&[0.0; 3], &[0.0, 0.0, OMEGA]));
        let (_, velocity) = found.completed().drift();
        assert!(velocity < 1e-13, "{formulation} + {integrator}: {velocity:e}");
    }
}
