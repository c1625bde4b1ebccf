//! The mass integrals: rigid rod, textbook mass matrix, brute force.

use super::*;
use crate::body::flexible::{Piece, gauss_legendre, on_interval};
use crate::math::array::from_fn;
use std::f64::consts::PI;

const L: f64 = 1.5;

/// Variants of a beam, all of them in space.
fn variants() -> Vec<Value> {
    let mut variants = Vec::new();
    for theory in ["euler_bernoulli", "timoshenko"] {
        for axial in ["linear", "quadratic"] {
            for conditions in ["tangent", "chord", "mean"] {
                variants.push(json!({
                    "theory": theory, "axial": axial, "frame_conditions": conditions, "rotary_inertia": true,
                }));
            }
        }
    }
    variants.push(json!({ "modes": 3, "rotary_inertia": true, "frame_conditions": "mean" }));
    variants.push(json!({ "modes": 3, "rotary_inertia": true }));
    variants.push(json!({ "elements": null, "rotary_inertia": true, "ritz": {
        "bending": ["x^2", "sin(pi*x/l)"], "bending_z": ["x^2*exp(x)"], "axial": ["x"], "torsion": ["sin(x)"],
    } }));
    variants
}

#[test]
fn without_elastic_motion_it_is_a_rigid_rod() {
    for variant in variants() {
        let rod: Elastic<3> = build(&beam_in_space(variant), &[0.0, 0.4]).unwrap();
        let Piece { mass, moments, products, .. } = whole(&rod);
        let moment = moments[0];
        let product = products[0];
        assert_close(mass, 0.8 * L, 1e-14);
        let exact = [[0.8 * L.powi(3) / 3.0, 0.0, 0.0], [0.0, 1e-3 * L, 0.0], [0.0, 0.0, 2e-3 * L]];
        for k in 0..3 {
            assert_close(moment[k], [0.8 * L * L / 2.0, 0.0, 0.0][k], 1e-14);
            (0..3).for_each(|m| assert_close(product[k][m], exact[k][m], 1e-14));
        }
    }
}

/// A semicircle: its mass at distance 2/pi of the radius from its centre, its products those of a half ring.
#[test]
fn without_elastic_motion_an_arc_is_a_rigid_one() {
    let radius = L / PI;
    for more in [json!({}), json!({ "frame_conditions": "mean" }), json!({ "modes": 2 })] {
        let mut keys = json!({ "curvature": [0, 0, "pi/l"] });
        keys.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        let arc: Elastic<3> = build(&beam_in_space(keys), &[0.0, 0.4]).unwrap();
        let mut mass = 0.0;
        let mut moment = [0.0; 3];
        let mut product = [[0.0; 3]; 3];
        for piece in &arc.inertia.pieces {
            mass += piece.mass;
            (0..3).for_each(|k| moment[k] += piece.moments[0][k]);
            add(&mut product, &piece.products[0]);
        }
        let m = 0.8 * L;
        assert_close(mass, m, 1e-14);
        // x = R sin a, y = R (1 - cos a): in x the mean of sin, in y that of 1.
        let square = m * radius * radius;
        let expected = [[0.5 * square, 2.0 / PI * square, 0.0], [2.0 / PI * square, 1.5 * square, 0.0], [0.0; 3]];
        // What six points leave of an element that turns by 0.8 rad.
        (0..3).for_each(|k| assert_close(moment[k], [2.0 / PI * m * radius, m * radius, 0.0][k], 1e-12));
        (0..3).for_each(|k| (0..3).for_each(|j| assert_close(product[k][j], expected[k][j], 1e-11)));
    }
}

#[test]
fn the_mass_matrix_is_that_of_textbooks() {
    let rod: Elastic<2> = build(&beam(json!({ "elements": 2, "frame_conditions": "mean" })), &[]).unwrap();
    assert_eq!(rod.names.len(), 6);
    // One element with its left node fixed: the right half of its matrix remains.
    let rod: Elastic<2> = build(&beam(json!({ "elements": 1 })), &[]).unwrap();
    let (mass, stiffness) = matrices(&rod, |_| true);
    let m = 0.8 * L / 420.0;
    let l = L;
    let ei = 3.0;
    let expected = [[140.0 * m, 0.0, 0.0], [0.0, 156.0 * m, -22.0 * l * m], [0.0, -22.0 * l * m, 4.0 * l * l * m]];
    let k = ei / l.powi(3);
    let stiff = [[2e4 / l, 0.0, 0.0], [0.0, 12.0 * k, -6.0 * l * k], [0.0, -6.0 * l * k, 4.0 * l * l * k]];
    for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
        assert_close(mass[(i, j)], expected[i][j], 1e-15);
        assert_close(stiffness[(i, j)], stiff[i][j], 1e-11);
    }
    // Two elements share node 1: the coupling between them is the other half.
    let rod: Elastic<2> = build(&beam(json!({ "elements": 2 })), &[]).unwrap();
    let (mass, _) = matrices(&rod, |_| true);
    let m = 0.8 * L / 2.0 / 420.0;
    let l = L / 2.0;
    let coupling = [[70.0 * m, 0.0, 0.0], [0.0, 54.0 * m, -13.0 * l * m], [0.0, 13.0 * l * m, -3.0 * l * l * m]];
    for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
        assert_close(mass[(i, 3 + j)], coupling[i][j], 1e-15);
    }
}

#[test]
fn shear_stiffness_is_that_of_przemieniecki() {
    let scene =
        beam(json!({ "elements": 1, "theory": "timoshenko", "stiffness": { "EA": 2e4, "EI": 3.0, "GA": 50.0 } }));
    let (_, stiffness) = matrices(&build::<2>(&scene, &[]).unwrap(), |_| true);
    let phi = 12.0 * 3.0 / (50.0 * L * L);
    let k = 3.0 / (L.powi(3) * (1.0 + phi));
    assert_close(stiffness[(1, 1)], 12.0 * k, 1e-13);
    assert_close(stiffness[(1, 2)], -6.0 * L * k, 1e-13);
    assert_close(stiffness[(2, 2)], (4.0 + phi) * L * L * k, 1e-13);
}

/// Kinetic energy of the body that turns with `spin` about its origin, flies with `velocity` and vibrates, from the
/// velocities of points of the field itself.
fn energy_of_field(rod: &Elastic<3>, motion: &Motion) -> f64 {
    let line = rod.line.as_ref().unwrap();
    // Three points across the section have its mass and moments: one on the line, and pairs at distance 1 along y and
    // z.
    let rho_a = 0.8;
    let rho_i = [2e-3, 1e-3];
    let points = [
        ([0.0, 0.0], rho_a - rho_i[0] - rho_i[1]),
        ([1.0, 0.0], rho_i[1] / 2.0),
        ([-1.0, 0.0], rho_i[1] / 2.0),
        ([0.0, 1.0], rho_i[0] / 2.0),
        ([0.0, -1.0], rho_i[0] / 2.0),
    ];
    let rule = gauss_legendre(10);
    let mut energy = 0.0;
    for panel in 0..60 {
        let ends = [f64::from(panel), f64::from(panel + 1)].map(|k| k * L / 60.0);
        for (s, weight) in on_interval(&rule, ends) {
            for ([y, z], density) in points {
                let shape = line.point([s, y, z]);
                let mut place = [s, y, z];
                let mut velocity = motion.velocity;
                for (&dof, psi) in shape.dofs.iter().zip(&shape.translation) {
                    (0..3).for_each(|k| place[k] += psi[k] * motion.q[dof]);
                    (0..3).for_each(|k| velocity[k] += psi[k] * motion.rate[dof]);
                }
                let turning = crate::body::cross(&motion.spin, &place);
                let square: f64 = (0..3).map(|k| (velocity[k] + turning[k]).powi(2)).sum();
                energy += 0.5 * density * weight * square;
            }
        }
    }
    energy
}

struct Motion {
    velocity: [f64; 3],
    spin: [f64; 3],
    q: Vec<f64>,
    rate: Vec<f64>,
}

/// The same energy from the integrals: with U = psi q and W = psi q', v = velocity + spin x U + W.
fn energy_of_integrals(piece: &Piece<3>, motion: &Motion) -> f64 {
    let n = 1 + piece.dofs.len();
    let place: Vec<f64> = std::iter::once(1.0).chain(piece.dofs.iter().map(|&i| motion.q[i])).collect();
    let rate: Vec<f64> = std::iter::once(0.0).chain(piece.dofs.iter().map(|&i| motion.rate[i])).collect();
    let moment = |x: &[f64]| -> [f64; 3] { from_fn(|k| (0..n).map(|a| x[a] * piece.moments[a][k]).sum()) };
    let product = |x: &[f64], y: &[f64]| -> [[f64; 3]; 3] {
        from_fn(|k| from_fn(|m| (0..n * n).map(|i| x[i / n] * y[i % n] * piece.products[i][k][m]).sum()))
    };
    let dot = |a: [f64; 3], b: [f64; 3]| -> f64 { (0..3).map(|k| a[k] * b[k]).sum() };
    let turning = crate::body::cross(&motion.spin, &moment(&place));
    let mut energy = 0.5 * piece.mass * dot(motion.velocity, motion.velocity);
    energy += dot(motion.velocity, turning) + dot(motion.velocity, moment(&rate));
    let [uu, uw, ww] = [product(&place, &place), product(&place, &rate), product(&rate, &rate)];
    let trace = |p: &[[f64; 3]; 3]| p[0][0] + p[1][1] + p[2][2];
    let along: f64 = (0..9).map(|i| motion.spin[i / 3] * uu[i / 3][i % 3] * motion.spin[i % 3]).sum();
    energy += 0.5 * (trace(&uu) * dot(motion.spin, motion.spin) - along) + 0.5 * trace(&ww);
    energy += dot(motion.spin, from_fn(|k| uw[(k + 1) % 3][(k + 2) % 3] - uw[(k + 2) % 3][(k + 1) % 3]));
    energy
}

#[test]
fn integrals_hold_the_energy_of_the_field() {
    let mut seed = 1_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    for variant in variants() {
        let rod: Elastic<3> = build(&beam_in_space(variant.clone()), &[0.0, 0.5]).unwrap();
        let n = rod.names.len();
        let motion = Motion {
            velocity: from_fn(|_| random()),
            spin: from_fn(|_| random()),
            q: (0..n).map(|_| random()).collect(),
            rate: (0..n).map(|_| random()).collect(),
        };
        let field = energy_of_field(&rod, &motion);
        let integrals = energy_of_integrals(&whole(&rod), &motion);
        assert_close(integrals / field, 1.0, 1e-12);
    }
}

/// int rho S = 0 and int rho x_0 x S = 0, relative to the largest that a mass-normalised mode could have.
#[test]
fn mean_axes_have_no_momentum() {
    for (elements, modes) in [(4, json!(null)), (12, json!(null)), (12, json!(0)), (12, json!(5)), (40, json!(6))] {
        for theory in ["euler_bernoulli", "timoshenko"] {
            let more = json!({ "elements": elements, "modes": modes, "theory": theory, "frame_conditions": "mean" });
            for markers in [&[0.0, 0.7, 1.5][..], &[1.2][..], &[][..]] {
                if modes == json!(0) && markers.len() < 2 {
                    continue;
                }
                let rod: Elastic<3> = build(&beam_in_space(more.clone()), markers).unwrap();
                let piece = whole(&rod);
                for i in 1..piece.moments.len() {
                    (0..3).for_each(|k| assert_close(piece.moments[i][k], 0.0, 1e-12));
                    let p = piece.products[i];
                    let angular = [p[1][2] - p[2][1], p[2][0] - p[0][2], p[0][1] - p[1][0]];
                    angular.iter().for_each(|c| assert_close(*c, 0.0, 1e-12));
                }
            }
        }
    }
}

#[test]
fn nodes_are_at_markers() {
    let names = |elements: u32, markers: &[f64]| {
        build::<2>(&beam(json!({ "elements": elements })), markers).unwrap().names.len() / 3
    };
    let table = [(1, vec![], 1), (4, vec![0.0, 1.5], 4), (1, vec![0.1, 0.2, 0.3], 4), (5, vec![0.5, 0.5 + 1e-12], 5)];
    table.iter().for_each(|(elements, markers, expected)| assert_eq!(names(*elements, markers), *expected));
    let quadratic: Elastic<2> = build(&beam(json!({ "elements": 2, "axial": "quadratic" })), &[]).unwrap();
    assert_eq!(quadratic.names, ["m1_x", "n1_x", "n1_y", "n1_r", "m2_x", "n2_x", "n2_y", "n2_r"]);
    let chord: Elastic<3> = build(&beam_in_space(json!({ "elements": 1, "frame_conditions": "chord" })), &[]).unwrap();
    assert_eq!(chord.names, ["n0_ry", "n0_rz", "n1_x", "n1_rx", "n1_ry", "n1_rz"]);
}
