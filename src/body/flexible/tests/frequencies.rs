//! Natural frequencies against closed forms, and how fast they converge with the number of elements.

use super::*;
use crate::math::array::from_fn;
use std::f64::consts::PI;

const L: f64 = 1.5;
const EI: f64 = 3.0;
const EA: f64 = 2e4;
const RHO_A: f64 = 0.8;

/// Prints a table, and checks that the error falls with the order that the theory promises and ends below `last`.
#[track_caller]
fn converges(what: &str, order: f64, last: f64, exact: f64, counts: &[u32], frequency: impl Fn(u32) -> f64) {
    let errors: Vec<f64> = counts.iter().map(|&n| frequency(n) / exact - 1.0).collect();
    println!("{what}, exact {exact:.9} rad/s");
    for (i, error) in errors.iter().enumerate() {
        let measured = match i {
            0 => "    ".to_string(),
            _ => format!("{:.2}", (errors[i - 1] / error).log2() / f64::from(counts[i] / counts[i - 1]).log2()),
        };
        println!("{:6} {error:12.3e} {measured}", counts[i]);
    }
    // The finest pair whose errors are not yet round-off.
    let fine = (1..errors.len()).rev().find(|&i| errors[i] > 1e-9).unwrap();
    let measured = (errors[fine - 1] / errors[fine]).log2() / f64::from(counts[fine] / counts[fine - 1]).log2();
    assert!((measured - order).abs() < 0.1, "{what}: order {measured}");
    assert!(errors.last().unwrap().abs() < last, "{what}: {errors:?}");
}

fn bending(beta_l: f64) -> f64 {
    (beta_l / L).powi(2) * (EI / RHO_A).sqrt()
}

fn is_bending(name: &str) -> bool {
    name.ends_with("_y") || name.ends_with("_r")
}

#[test]
fn bending_of_slender_beams_is_of_order_four() {
    let counts = [2, 4, 8, 16, 32];
    let planar = |n: u32, conditions: &str| -> Elastic<2> {
        build(&beam(json!({ "elements": n, "frame_conditions": conditions })), &[0.0, L]).unwrap()
    };
    converges("clamped-free", 4.0, 1e-8, bending(1.8751040687119611), &counts, |n| {
        frequencies(&planar(n, "tangent"), is_bending)[0]
    });
    converges("clamped-free, third", 4.0, 1e-5, bending(7.854757438237613), &counts, |n| {
        frequencies(&planar(n, "tangent"), is_bending)[2]
    });
    converges("pinned-pinned", 4.0, 1e-7, bending(PI), &counts, |n| frequencies(&planar(n, "chord"), is_bending)[0]);
    converges("clamped-clamped", 4.0, 1e-6, bending(4.730040744862704), &counts, |n| {
        let end = format!("n{n}_");
        frequencies(&planar(n, "tangent"), |name| is_bending(name) && !name.starts_with(&end))[0]
    });
    converges("free-free", 4.0, 1e-6, bending(4.730040744862704), &counts, |n| {
        frequencies(&planar(n, "mean"), |_| true)[0]
    });
}

/// w = sin(k s): (EI k^2 + GA - rhoI omega^2) (GA k^2 - rhoA omega^2) = (GA k)^2.
fn timoshenko_pinned(k: f64, ei: f64, ga: f64, rho_a: f64, rho_i: f64) -> f64 {
    let a = rho_a * rho_i;
    let b = -(rho_a * (ei * k * k + ga) + rho_i * ga * k * k);
    let c = ei * ga * k.powi(4);
    (2.0 * c / (-b + (b * b - 4.0 * a * c).sqrt())).sqrt()
}

#[test]
fn bending_with_shear_meets_the_closed_form() {
    let stiffness = json!({ "EA": EA, "EI": EI, "GA": 100.0 });
    for mode in 1..=3 {
        let exact = timoshenko_pinned(f64::from(mode) * PI / L, EI, 100.0, RHO_A, 1e-3);
        converges(&format!("pinned-pinned with shear, mode {mode}"), 2.0, 2e-3, exact, &[8, 16, 32, 64, 128], |n| {
            let scene = beam(json!({
                "elements": n, "frame_conditions": "chord", "theory": "timoshenko", "stiffness": stiffness,
            }));
            frequencies(&build::<2>(&scene, &[]).unwrap(), is_bending)[mode as usize - 1]
        });
    }
}

type Square = [[f64; 4]; 4];

fn product(a: &Square, b: &Square) -> Square {
    from_fn(|i| from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum()))
}

/// How (w, turn, moment, shear force) at the right end follow from those at the left: the exponential of length times
/// w' = turn + V/GA, turn' = M/EI, M' = -V - rhoI omega^2 turn, V' = -rhoA omega^2 w.
fn transfer(omega: f64, ga: f64, rho_i: f64) -> Square {
    let step = L / 1024.0;
    let square = omega * omega;
    let a = [
        [0.0, 1.0, 0.0, 1.0 / ga],
        [0.0, 0.0, 1.0 / EI, 0.0],
        [0.0, -rho_i * square, 0.0, -1.0],
        [-RHO_A * square, 0.0, 0.0, 0.0],
    ];
    let identity: Square = from_fn(|i| from_fn(|j| if i == j { 1.0 } else { 0.0 }));
    // Horner's scheme for the series, then ten squarings.
    let mut sum = identity;
    for k in (1..=8).rev() {
        let scaled = a.map(|row| row.map(|x| x * step / f64::from(k)));
        let next = product(&scaled, &sum);
        sum = from_fn(|i| from_fn(|j| identity[i][j] + next[i][j]));
    }
    (0..10).fold(sum, |power, _| product(&power, &power))
}

/// The frequency near `guess` at which states that are free at the left end meet `zero` at the right one.
fn exact(guess: f64, free: [usize; 2], zero: [usize; 2], ga: f64, rho_i: f64) -> f64 {
    let value = |omega: f64| {
        let t = transfer(omega, ga, rho_i);
        t[zero[0]][free[0]] * t[zero[1]][free[1]] - t[zero[0]][free[1]] * t[zero[1]][free[0]]
    };
    let mut low = 0.995 * guess;
    let mut high = 1.001 * guess;
    assert!(value(low) * value(high) < 0.0);
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if value(low) * value(middle) <= 0.0 { high = middle } else { low = middle }
    }
    low
}

#[test]
fn all_supports_with_and_without_shear() {
    let supports = [
        ("clamped-free", "tangent", false, [2, 3], [2, 3]),
        ("pinned-pinned", "chord", false, [1, 3], [0, 2]),
        ("clamped-clamped", "tangent", true, [2, 3], [0, 1]),
        ("free-free", "mean", false, [0, 1], [2, 3]),
    ];
    for (theory, ga, rho_i, order) in [("euler_bernoulli", 1e300, 0.0, 4.0), ("timoshenko", 100.0, 1e-3, 2.0)] {
        for (what, conditions, clamped, free, zero) in supports {
            for mode in 0..2 {
                let frequency = |n: u32| {
                    let stiffness = json!({ "EA": 1e7, "EI": EI, "GA": 100.0 });
                    let scene = beam(json!({
                        "elements": n, "frame_conditions": conditions, "theory": theory, "stiffness": stiffness,
                    }));
                    let end = format!("n{n}_");
                    let keep = |name: &str| {
                        name.starts_with("mode") || is_bending(name) && !(clamped && name.starts_with(&end))
                    };
                    frequencies(&build::<2>(&scene, &[]).unwrap(), keep)[mode]
                };
                let exact = exact(frequency(64), free, zero, ga, rho_i);
                converges(&format!("{theory}, {what}, {}", mode + 1), order, 3e-3, exact, &[4, 8, 16, 32], frequency);
            }
        }
    }
}

#[test]
fn shear_vanishes_with_its_compliance() {
    let mut scene = beam(json!({ "elements": 8, "rotary_inertia": false }));
    let slender = frequencies(&build::<2>(&scene, &[]).unwrap(), is_bending);
    scene["theory"] = json!("timoshenko");
    scene["stiffness"]["GA"] = json!(1e12);
    let stiff = frequencies(&build::<2>(&scene, &[]).unwrap(), is_bending);
    slender.iter().zip(&stiff).for_each(|(a, b)| assert_close(b / a, 1.0, 1e-8));
}

#[test]
fn axial_and_torsional_frequencies() {
    let wave = (EA / RHO_A).sqrt() * PI / (2.0 * L);
    for (axial, order, last) in [("linear", 2.0, 2e-4), ("quadratic", 4.0, 1e-6)] {
        converges(&format!("axial, {axial}"), order, last, wave, &[2, 4, 8, 16, 32], |n| {
            let scene = beam(json!({ "elements": n, "axial": axial }));
            frequencies(&build::<2>(&scene, &[]).unwrap(), |name| name.ends_with("_x"))[0]
        });
    }
    let twist = (2.0_f64 / 3e-3).sqrt() * PI / (2.0 * L);
    converges("torsion", 2.0, 2e-4, twist, &[2, 4, 8, 16, 32], |n| {
        let scene = beam_in_space(json!({ "elements": n }));
        frequencies(&build::<3>(&scene, &[]).unwrap(), |name| name.ends_with("_rx"))[0]
    });
}

#[test]
fn both_planes_of_bending_in_space() {
    let elastic: Elastic<3> =
        build(&beam_in_space(json!({ "elements": 8, "frame_conditions": "chord" })), &[]).unwrap();
    let along_y = frequencies(&elastic, |name| name.ends_with("_y") || name.ends_with("_rz"));
    let along_z = frequencies(&elastic, |name| name.ends_with("_z") || name.ends_with("_ry"));
    assert_close(along_y[0] / bending(PI), 1.0, 2e-5);
    assert_close(along_z[0] / along_y[0], (5.0_f64 / 3.0).sqrt(), 1e-12);
}

#[test]
fn reduction_keeps_the_lowest_frequencies() {
    for conditions in ["tangent", "chord", "mean"] {
        let frequency = |modes: Value| -> Vec<f64> {
            let scene = beam_in_space(json!({ "elements": 12, "frame_conditions": conditions, "modes": modes }));
            frequencies(&build::<3>(&scene, &[0.0, 0.5, 1.5]).unwrap(), |_| true)
        };
        let full = frequency(Value::Null);
        let table: Vec<(usize, f64)> = [0, 2, 6, 12, 24]
            .into_iter()
            .map(|modes| {
                let reduced = frequency(json!(modes));
                (modes, (0..3).map(|i| reduced[i] / full[i] - 1.0).fold(0.0, f64::max))
            })
            .collect();
        println!("{conditions}: {table:?}");
        assert!(table.windows(2).all(|pair| pair[1].1 <= pair[0].1 + 1e-12), "{table:?}");
        assert!(table[4].1 < 2e-4, "{conditions}: {table:?}");
    }
}

#[test]
fn all_modes_are_the_mesh_itself() {
    for conditions in ["tangent", "chord"] {
        let frequency = |modes: Value| -> Vec<f64> {
            let scene = beam(json!({ "elements": 4, "frame_conditions": conditions, "modes": modes }));
            frequencies(&build::<2>(&scene, &[0.75]).unwrap(), |_| true)
        };
        let full = frequency(Value::Null);
        let reduced = frequency(json!(9));
        assert_eq!(full.len(), reduced.len());
        full.iter().zip(&reduced).for_each(|(a, b)| assert_close(a / b, 1.0, 1e-10));
    }
}
