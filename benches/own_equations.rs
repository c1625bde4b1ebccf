//! Own equations through the library against plain loops over the same formulas: `cargo bench --bench own_equations`.

mod common;

use common::{Case, compare};
use holonom::formulation::Dynamics;
use holonom::math::Scalar;
use holonom::method_spec::MethodSpec;
use holonom::simulate::{Method, Span, simulate};
use holonom::system::{Equations, MechanicalSystem, Need};
use std::cell::{Cell, RefCell};
use std::hint::black_box;

const GRAVITY: f64 = 9.81;
const STEP: f64 = 1e-3;
const STEPS: usize = 1000;

/// Three unit masses at the ends of unit rods, by the absolute angles of these, and with them the height of the last
/// mass where it is prescribed.
struct Arm {
    is_held: bool,
}

/// Masses that a rod and those behind it carry.
const CARRIED: [f64; 3] = [3.0, 2.0, 1.0];

impl Equations for Arm {
    fn size(&self) -> (usize, usize) {
        (3, usize::from(self.is_held))
    }
    fn mass<S: Scalar>(&self, _: S, q: &[S], mass: &mut [S]) {
        for i in 0..3 {
            mass[4 * i] = S::constant(CARRIED[i]);
            for j in 0..i {
                mass[3 * i + j] = (q[i] - q[j]).cos() * CARRIED[i];
                mass[3 * j + i] = mass[3 * i + j];
            }
        }
    }
    fn force<S: Scalar>(&self, _: S, q: &[S], v: &[S], f: &mut [S]) {
        (0..3).for_each(|i| f[i] = q[i].cos() * (-GRAVITY * CARRIED[i]));
        for i in 0..3 {
            for j in 0..i {
                let sin = (q[i] - q[j]).sin() * CARRIED[i];
                f[i] -= -sin * v[j].square();
                f[j] -= sin * v[i].square();
            }
        }
    }
    fn phi<S: Scalar>(&self, t: S, q: &[S], phi: &mut [S]) {
        if self.is_held {
            phi[0] = q[0].sin() + q[1].sin() + q[2].sin() - t.sin() * 0.1;
        }
    }
}

/// A consistent start.
const Q: [f64; 3] = [0.3, -0.5, 0.18495808332069794];
const V: [f64; 3] = [0.4, -0.1, -0.1977491569536976];

/// v' with M and f of the arm, and G and gamma by hand.
fn plain(arm: &Arm, t: f64, q: &[f64; 3], v: &[f64; 3]) -> [f64; 3] {
    let mut mass = [[0.0; 3]; 3];
    let mut f = [0.0; 3];
    arm.mass(t, q, mass.as_flattened_mut());
    arm.force(t, q, v, &mut f);
    let mut g = [0.0; 3];
    let mut gamma = -0.1 * t.sin();
    if arm.is_held {
        for i in 0..3 {
            let (sin, cos) = q[i].sin_cos();
            g[i] = cos;
            gamma += sin * v[i] * v[i];
        }
    }
    acceleration(arm.is_held, mass, f, (g, gamma))
}

/// The same with sines and cosines that M, f and G share.
fn shared(arm: &Arm, t: f64, q: &[f64; 3], v: &[f64; 3]) -> [f64; 3] {
    let mut mass = [[0.0; 3]; 3];
    let mut f = [0.0; 3];
    let mut g = [0.0; 3];
    let mut gamma = -0.1 * t.sin();
    for i in 0..3 {
        let (sin, cos) = q[i].sin_cos();
        mass[i][i] = CARRIED[i];
        f[i] -= GRAVITY * CARRIED[i] * cos;
        g[i] = cos;
        gamma += sin * v[i] * v[i];
        for j in 0..i {
            let (sin, cos) = (q[i] - q[j]).sin_cos();
            mass[i][j] = CARRIED[i] * cos;
            f[i] += CARRIED[i] * sin * v[j] * v[j];
            f[j] -= CARRIED[i] * sin * v[i] * v[i];
        }
    }
    acceleration(arm.is_held, mass, f, (g, gamma))
}

fn acceleration(is_held: bool, mass: [[f64; 3]; 3], f: [f64; 3], (g, gamma): ([f64; 3], f64)) -> [f64; 3] {
    let l = factored(mass);
    let mut a = f;
    solve(&l, &mut a);
    if is_held {
        let mut x = g;
        solve(&l, &mut x);
        let of = |b: &[f64; 3]| g[0] * b[0] + g[1] * b[1] + g[2] * b[2];
        let lambda = (of(&a) - gamma) / of(&x);
        (0..3).for_each(|i| a[i] -= x[i] * lambda);
    }
    a
}

/// L D L^T with the inverse of D on the diagonal.
fn factored(mut m: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    for p in 0..3 {
        m[p][p] = 1.0 / m[p][p];
        for q in p + 1..3 {
            let factor = m[q][p] * m[p][p];
            (p + 1..=q).for_each(|r| m[q][r] -= factor * m[r][p]);
        }
        (p + 1..3).for_each(|q| m[q][p] *= m[p][p]);
    }
    m
}

fn solve(l: &[[f64; 3]; 3], x: &mut [f64; 3]) {
    (0..3).for_each(|p| (p + 1..3).for_each(|q| x[q] -= l[q][p] * x[p]));
    (0..3).for_each(|p| x[p] *= l[p][p]);
    (0..3).rev().for_each(|p| (p + 1..3).for_each(|q| x[p] -= l[q][p] * x[q]));
}

type Plain = fn(&Arm, f64, &[f64; 3], &[f64; 3]) -> [f64; 3];

fn plain_rk4(arm: &Arm, plain: Plain) -> [f64; 6] {
    let mut y = [Q[0], Q[1], Q[2], V[0], V[1], V[2]];
    let slope = |t: f64, y: &[f64; 6]| {
        let [a, b, c, u, v, w] = *y;
        let [x, y, z] = plain(arm, t, &[a, b, c], &[u, v, w]);
        [u, v, w, x, y, z]
    };
    let ahead = |y: &[f64; 6], h: f64, k: &[f64; 6]| std::array::from_fn(|i| y[i] + h * k[i]);
    for step in 0..STEPS {
        let t = step as f64 * STEP;
        let k1 = slope(t, &y);
        let k2 = slope(t + 0.5 * STEP, &ahead(&y, 0.5 * STEP, &k1));
        let k3 = slope(t + 0.5 * STEP, &ahead(&y, 0.5 * STEP, &k2));
        let k4 = slope(t + STEP, &ahead(&y, STEP, &k3));
        (0..6).for_each(|i| y[i] += STEP / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    y
}

fn case<'a>(name: &str, call: impl FnMut() + 'a) -> Case<'a> {
    (name.into(), Box::new(call))
}

fn rk4(arm: &Arm) -> Vec<f64> {
    let [formulation, integrator, projection] = ["index1", "rk4", "none"].map(MethodSpec::named);
    let method = Method { formulation, integrator, projection, step: Some(STEP), ..Method::default() };
    let end = STEP * STEPS as f64;
    let outcome = simulate(arm, &method, Span { start: 0.0, end, output_step: end }, (&Q, &V), &mut ());
    let outcome = outcome.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(outcome.failure, None, "a run that fails early costs little");
    [outcome.q, outcome.v].concat()
}

fn main() {
    for arm in [Arm { is_held: false }, Arm { is_held: true }] {
        let arm = &arm;
        let dynamics = RefCell::new(Dynamics::new(arm));
        let is_solved = dynamics.borrow_mut().solve(0.2, &Q, &V, |_, _| 0.0).is_ok();
        for expected in [plain, shared].map(|plain: Plain| plain(arm, 0.2, &Q, &V)) {
            let errors = dynamics.borrow().vdot.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(is_solved && errors < 1e-13, "{errors:e}");
        }
        // States that differ, so that nothing is known of the last one.
        let turn = Cell::new(0.0);
        let state = || {
            turn.set(if turn.get() < 1.0 { turn.get() + 1e-3 } else { 0.0 });
            (black_box(0.2), black_box([Q[0] + turn.get(), Q[1], Q[2]]), black_box(V))
        };
        let by_hand = |plain: Plain| {
            move || {
                let (t, q, v) = state();
                black_box(plain(arm, t, &q, &v));
            }
        };
        let evaluate = || {
            let (t, q, v) = state();
            assert!(dynamics.borrow_mut().solve(t, &q, &v, |_, _| 0.0).is_ok());
        };
        let terms = || {
            let (t, q, v) = state();
            dynamics.borrow_mut().evaluate(t, &q, &v, Need::DYNAMICS);
        };
        let constraints = arm.dimensions().lambda;
        let cases = vec![
            case("plain", by_hand(plain)),
            case("plain, with shared sines", by_hand(shared)),
            case("v' and lambda", evaluate),
            case("terms", terms),
        ];
        compare(&format!("arm of three links, {constraints} constraints"), cases);
        let cases = vec![
            case("plain", || _ = black_box(plain_rk4(arm, plain))),
            case("plain, with shared sines", || _ = black_box(plain_rk4(arm, shared))),
            case("simulate", || _ = black_box(rk4(arm))),
        ];
        compare(&format!("{STEPS} steps of rk4, {constraints} constraints"), cases);
    }
}
