//! Own equations: M, f and phi, from which all derivatives follow.

use holonom::prelude::*;

/// A point mass on a massless rod, in Cartesian coordinates; kg, m, s.
pub struct Pendulum {
    pub mass: f64,
    pub length: f64,
}

impl Equations for Pendulum {
    fn size(&self) -> (usize, usize) {
        (2, 1)
    }
    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass.copy_from_slice(&[self.mass, 0.0, 0.0, self.mass].map(S::constant));
    }
    fn force<S: Scalar>(&self, _t: S, _q: &[S], _v: &[S], f: &mut [S]) {
        f.copy_from_slice(&[0.0, -9.81 * self.mass].map(S::constant));
    }
    fn phi<S: Scalar>(&self, _t: S, q: &[S], phi: &mut [S]) {
        phi[0] = (q[0].square() + q[1].square()).sqrt() - self.length;
    }
    fn potential(&self, _t: f64, q: &[f64]) -> Option<f64> {
        Some(9.81 * self.mass * q[1])
    }
}

fn main() -> Result<()> {
    let system = Pendulum { mass: 2.0, length: 0.5 };
    // The start is consistent: `initial::assemble` makes one that is not.
    let start = ([0.5, 0.0], [0.0, 0.0]);
    let record = simulate(&system, "index1 + dop853 + manifold", &start, 0.0..3.0)?.record;
    assert!(record.drift.position.max < 1e-14);
    assert_eq!(record.trajectory.rows.len(), 501);
    println!("drift {:.1e} m, energy {:.1e}", record.drift.position.max, record.energy_error());
    Ok(())
}

#[test]
fn own_equations_are_simulated() -> holonom::Result<()> {
    main()
}
