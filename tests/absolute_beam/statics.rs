//! Equilibria by Newton's method with the exact tangent, and linear statics against beam theory.

use crate::scenes::Ready;
use holonom::study::AnyMechanism;
use holonom::system::{Loaded, MechanicalSystem, Need, Scratch, Tangent, Terms};
use nalgebra::{DMatrix, DVector};

/// q in equilibrium with the loads at t = 1, reached in `steps` equal steps of t, which the loads of the scene grow with.
pub fn equilibrium(ready: &Ready, steps: usize) -> Vec<f64> {
    let (mut q, mut lambda) = (ready.0.start().0.to_vec(), vec![0.0; ready.system().dimensions().lambda]);
    for step in 1..=steps {
        balance(ready.system(), step as f64 / steps as f64, &mut q, &mut lambda);
    }
    q
}

/// Newton's method for G^T lambda = f, phi = 0.
fn balance(system: &dyn MechanicalSystem, t: f64, q: &mut [f64], lambda: &mut [f64]) {
    let (n, structure) = (system.dimensions(), system.structure());
    let (mut terms, mut scratch) = (Terms::new(system), Scratch::default());
    let mut tangent = Tangent::new(&structure.tangent);
    let rest = vec![0.0; n.v];
    for _ in 0..40 {
        system.evaluate(t, q, &rest, Need::DYNAMICS, &mut terms, &mut scratch);
        let at = Loaded { t, q, v: &rest, vdot: &rest, lambda };
        assert!(system.tangent(at, &mut tangent, &mut scratch));
        let mut matrix = DMatrix::<f64>::zeros(n.v + n.lambda, n.v + n.lambda);
        structure.tangent.entries.iter().zip(&tangent.k).for_each(|(&place, k)| matrix[place] += k);
        for (&(row, column), g) in structure.g.entries.iter().zip(&terms.g) {
            matrix[(n.v + row, column)] += g;
            matrix[(column, n.v + row)] += g;
        }
        let mut residual = DVector::<f64>::zeros(n.v + n.lambda);
        (0..n.v).for_each(|i| residual[i] = -terms.f[i]);
        (0..n.lambda).for_each(|i| residual[n.v + i] = terms.phi[i]);
        structure.g.multiply_transposed(&terms.g, lambda, residual.rows_mut(0, n.v).as_mut_slice());
        let step = matrix.lu().solve(&-residual).expect("the equilibrium is stable");
        let mut rate = vec![0.0; n.q];
        system.rate(q, &step.as_slice()[..n.v], &mut rate);
        q.iter_mut().zip(&rate).for_each(|(q, r)| *q += r);
        system.normalize(q);
        lambda.iter_mut().zip(&step.as_slice()[n.v..]).for_each(|(l, d)| *l += d);
        if step.rows(0, n.v).amax() < 1e-11 {
            return;
        }
    }
    panic!("no equilibrium at t = {t}");
}

/// Position of a marker at q.
pub fn place(ready: &Ready, q: &[f64], marker: &str) -> [f64; 3] {
    let rest = vec![0.0; ready.system().dimensions().v];
    let mut scratch = Scratch::default();
    match &ready.0.mechanism {
        AnyMechanism::Planar(m) => {
            let r = m.frames(q, &rest, &mut scratch)[m.model().markers.find(marker).unwrap()].r;
            [r[0].x, r[1].x, 0.0]
        }
        AnyMechanism::Spatial(m) => {
            m.frames(q, &rest, &mut scratch)[m.model().markers.find(marker).unwrap()].r.map(|x| x.x)
        }
    }
}
