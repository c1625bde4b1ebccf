//! The Levi-Civita connection of M(q).

use super::Equations;
use crate::math::Dual;
use crate::system::{LeviCivita, OperatingPoint};

/// A number and its rate along the motion, differentiated with respect to six coordinates.
type Rated = Dual<Dual<f64, 1>, 6>;

/// W by its definition, from dM/dq with rates along the motion, six columns per pass.
pub(super) fn christoffel<E: Equations>(system: &E, at: OperatingPoint, connection: &mut LeviCivita) {
    let n = at.q.len();
    let rated = |value: f64, rate: f64| Dual { re: value, eps: [rate] };
    let mut q: Vec<Rated> = at.q.iter().zip(at.v).map(|(&q, &v)| Dual::fixed(rated(q, v))).collect();
    let v: Vec<Dual<f64, 1>> = at.v.iter().zip(at.vdot).map(|(&v, &vdot)| rated(v, vdot)).collect();
    let mut mass = vec![Dual::fixed(rated(0.0, 0.0)); n * n];
    let mut w = vec![rated(0.0, 0.0); n * n];
    for first in (0..n).step_by(6) {
        let columns = first..n.min(first + 6);
        columns.clone().for_each(|j| q[j].eps[j - first] = rated(1.0, 0.0));
        system.mass(Dual::fixed(rated(at.t, 1.0)), &q, &mut mass);
        columns.clone().for_each(|j| q[j].eps[j - first] = rated(0.0, 0.0));
        for j in columns {
            for i in 0..n {
                // d_j M_ik v^k goes to W_ij and, as the last term, with the other sign to W_ji.
                for k in 0..n {
                    let slope = mass[i * n + k].eps[j - first];
                    let push = slope * v[k] * 0.5;
                    w[i * n + j] += push;
                    w[j * n + i] -= push;
                    w[i * n + k] += slope * v[j] * 0.5;
                }
            }
        }
    }
    connection.mass_dot.iter_mut().enumerate().for_each(|(at, rate)| *rate = mass[at % n * n + at / n].re.eps[0]);
    for i in 0..n {
        for j in 0..n {
            (connection.w[(i, j)], connection.w_dot[(i, j)]) = (w[i * n + j].re, w[i * n + j].eps[0]);
        }
    }
}
