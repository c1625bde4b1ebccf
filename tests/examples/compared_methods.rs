//! Methods compared on own equations: drift and energy of a double pendulum.

use holonom::prelude::*;

/// Two point masses on two rods, in Cartesian coordinates.
struct Arm {
    lengths: [f64; 2],
}

impl Arm {
    fn new() -> Self {
        Arm { lengths: [1.0, 0.5] }
    }
}

impl Equations for Arm {
    fn size(&self) -> (usize, usize) {
        (4, 2)
    }
    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass.iter_mut().enumerate().for_each(|(i, m)| *m = S::constant(if i % 5 == 0 { 1.0 } else { 0.0 }));
    }
    fn force<S: Scalar>(&self, _t: S, _q: &[S], _v: &[S], f: &mut [S]) {
        f.copy_from_slice(&[0.0, -9.81, 0.0, -9.81].map(S::constant));
    }
    fn phi<S: Scalar>(&self, _t: S, q: &[S], phi: &mut [S]) {
        phi[0] = (q[0].square() + q[1].square()).sqrt() - self.lengths[0];
        phi[1] = ((q[2] - q[0]).square() + (q[3] - q[1]).square()).sqrt() - self.lengths[1];
    }
    fn potential(&self, _t: f64, q: &[f64]) -> Option<f64> {
        Some(9.81 * (q[1] + q[3]))
    }
}

fn main() -> holonom::Result<()> {
    let start = ([1.0, 0.0, 1.5, 0.0], [0.0; 4]);
    for method in ["index1 + dop853 + manifold", "ggl + radau_iia", "baumgarte + dop853"] {
        let record = simulate(&Arm::new(), method, &start, 0.0..1.0)?.record;
        println!("{method}: {:.1e} m, {:.1e}", record.drift.position.max, record.energy_error());
        assert!(record.drift.position.max < 1e-7 && record.energy_error() < 1e-6, "{method}");
    }
    Ok(())
}

#[test]
fn three_methods_agree() -> holonom::Result<()> {
    main()
}
