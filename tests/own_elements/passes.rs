//! The derivatives of own equations: one pass over jets against one pass for each derivative.

use holonom::math::{Dual, Scalar, Taylor};
use holonom::system::{Equations, MechanicalSystem, Need, Scratch, Terms};

/// Every operation of a scalar, over `0` coordinates and time.
struct Rich(usize);

impl Equations for Rich {
    fn size(&self) -> (usize, usize) {
        (self.0, 2)
    }
    fn mass<S: Scalar>(&self, _: S, q: &[S], mass: &mut [S]) {
        mass.iter_mut().enumerate().for_each(|(k, entry)| *entry = S::constant(k as f64) + q[0]);
    }
    fn force<S: Scalar>(&self, _: S, _: &[S], _: &[S], _: &mut [S]) {}
    fn phi<S: Scalar>(&self, t: S, q: &[S], phi: &mut [S]) {
        phi.fill(t.square());
        for (k, &x) in q.iter().enumerate() {
            let (sin, cos) = (x * t).sin_cos();
            let growth = (x / 3.0).exp() + (x + 2.0).ln() - x.atan() * 0.7 + (x - t).sinh();
            phi[0] += sin * growth / (cos.square() + 1.5);
            phi[1] -= -(x.square() + k as f64 + 1.0).sqrt() * (x * 2.0).cos() + q[0].sin() * (x.cosh() - 0.2).recip();
        }
    }
}

/// Seven columns fill a pass with time, eight leave time alone in a second one.
#[test]
fn one_pass_gives_what_a_pass_for_each_derivative_does() {
    for n in [1, 2, 7, 8, 9, 15, 16] {
        let system = Rich(n);
        let t = 0.4;
        let q: Vec<f64> = (0..n).map(|k| 0.3 + 0.05 * k as f64).collect();
        let v: Vec<f64> = (0..n).map(|k| 1.0 - 0.1 * k as f64).collect();
        let mut terms = Terms::new(&system);
        system.evaluate(t, &q, &v, Need::DYNAMICS, &mut terms, &mut Scratch::default());
        let along = |v: &[f64]| {
            let path: Vec<_> = q.iter().zip(v).map(|(&q, &v)| Taylor::new(q, v, 0.0)).collect();
            let mut levels = [Taylor::fixed(0.0); 2];
            system.phi(Taylor::time(t), &path, &mut levels);
            levels
        };
        let column = |j: usize| {
            let seeded = q.iter().enumerate().map(|(k, &x)| if k == j { Dual::seeded(x, 0) } else { Dual::fixed(x) });
            let mut rows = [Dual::<f64, 1>::fixed(0.0); 2];
            system.phi(Dual::fixed(t), &seeded.collect::<Vec<_>>(), &mut rows);
            rows.map(|row| row.eps[0])
        };
        let g: Vec<[f64; 2]> = (0..n).map(column).collect();
        let moving = along(&v);
        let fixed = along(&vec![0.0; n]);
        // The same operations in another order: round-off of sums of n terms of size up to 3.
        let same = |a: f64, b: f64| assert!((a - b).abs() < 1e-15 * 10.0 * n as f64, "{n}: {a} {b}");
        for i in 0..2 {
            same(terms.phi[i], moving[i].x);
            same(terms.phi_dot[i], moving[i].d);
            same(terms.gamma[i], -moving[i].dd);
            same(terms.phi_t[i], fixed[i].d);
            (0..n).for_each(|j| same(terms.g[i * n + j], g[j][i]));
        }
        let lower = (0..n).flat_map(|i| (0..=i).map(move |j| (i * n + j) as f64 + 0.3));
        assert!(lower.eq(terms.mass.iter().copied()));
    }
}
