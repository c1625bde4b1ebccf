//! Andrews' mechanism in seven angles and six constraints, with M, f, G and gamma by hand.
//!
//! Source: Hairer, Wanner, Solving Ordinary Differential Equations II, VII.7, and its data.

use super::lu::Lu;

/// Angles beta, Theta, gamma, Phi, delta, Omega, epsilon, rad.
pub const START: [f64; 7] = [
    -0.06171389001427645,
    0.0,
    0.45527981916307037,
    0.22266839016588588,
    0.48736497954384256,
    -0.22266839016588588,
    1.2305474445498212,
];

const M: [f64; 7] = [0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498];
const I: [f64; 7] = [2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5];
const XA: f64 = -0.06934;
const YA: f64 = -0.00227;
const XB: f64 = -0.03635;
const YB: f64 = 0.03273;
const XC: f64 = 0.014;
const YC: f64 = 0.072;
const C0: f64 = 4530.0;
const L0: f64 = 0.07785;
const TORQUE: f64 = 0.033;
const D: f64 = 28e-3;
const DA: f64 = 115e-4;
const E: f64 = 2e-2;
const EA: f64 = 1421e-5;
const RR: f64 = 7e-3;
const RA: f64 = 92e-5;
const SS: f64 = 35e-3;
const SA: f64 = 1874e-5;
const SB: f64 = 1043e-5;
const SC: f64 = 18e-3;
const SD: f64 = 2e-2;
const TA: f64 = 2308e-5;
const TB: f64 = 916e-5;
const U: f64 = 4e-2;
const UA: f64 = 1228e-5;
const UB: f64 = 449e-5;
const ZF: f64 = 2e-2;
const ZT: f64 = 4e-2;
const FA: f64 = 1421e-5;

/// Products of inertia of K2, K4 and K6, which other arms carry, and their inertias about their own pivots.
const CARRIED: [f64; 3] = [M[1] * DA * RR, M[3] * ZT * (E - EA), M[5] * U * (ZF - FA)];
const OWN: [f64; 3] = [M[1] * DA * DA + I[1], M[3] * (E - EA) * (E - EA) + I[3], M[5] * (ZF - FA) * (ZF - FA) + I[5]];
const FIRST: f64 = M[0] * RA * RA + M[1] * RR * RR + I[0] + OWN[0];
const THIRD: f64 = M[2] * (SA * SA + SB * SB) + I[2];
const FIFTH: f64 = M[3] * ZT * ZT + M[4] * (TA * TA + TB * TB) + I[4] + OWN[1];
const SEVENTH: f64 = M[5] * U * U + M[6] * (UA * UA + UB * UB) + I[6] + OWN[2];

/// Vectors along the arms that the constraints are made of, times their lengths.
struct Arms {
    sin: [f64; 7],
    cos: [f64; 7],
    /// rr at beta, d at beta + Theta, ss at gamma, e at Phi + delta, zt at delta, zf at Omega + epsilon, u at epsilon.
    arms: [[f64; 2]; 7],
}

impl Arms {
    fn at(q: &[f64; 7]) -> Self {
        let turns = q.map(f64::sin_cos);
        let (sin, cos) = (turns.map(|turn| turn.0), turns.map(|turn| turn.1));
        let own = |i: usize, length: f64| [length * cos[i], length * sin[i]];
        let sum = |i: usize, j: usize, length: f64| {
            [length * (cos[i] * cos[j] - sin[i] * sin[j]), length * (sin[i] * cos[j] + cos[i] * sin[j])]
        };
        let arms = [own(0, RR), sum(0, 1, D), own(2, SS), sum(3, 4, E), own(4, ZT), sum(5, 6, ZF), own(6, U)];
        Arms { sin, cos, arms }
    }

    /// The sums of the constraints, with the arms times `factors`: phi for factors of one, but for the fixed points.
    fn sums(&self, factors: [f64; 7]) -> [f64; 6] {
        let [r, d, s, e, t, f, u]: [[f64; 2]; 7] =
            std::array::from_fn(|i| [factors[i] * self.arms[i][0], factors[i] * self.arms[i][1]]);
        let (x, y) = (r[0] - d[0], r[1] - d[1]);
        [x - s[1], y + s[0], x - e[1] - t[0], y + e[0] - t[1], x - f[0] - u[1], y - f[1] + u[0]]
    }

    fn phi(&self) -> [f64; 6] {
        let fixed = [XB, YB, XA, YA, XA, YA];
        let sums = self.sums([1.0; 7]);
        std::array::from_fn(|i| sums[i] - fixed[i])
    }

    /// [M G^T; G 0]
    fn matrix(&self, a: &mut [[f64; 13]; 13]) {
        *a = [[0.0; 13]; 13];
        let swing = [-self.cos[1] * CARRIED[0], self.sin[3] * CARRIED[1], -self.sin[5] * CARRIED[2]];
        a[2][2] = THIRD;
        for ((carrier, carried, whole), k) in [(0, 1, FIRST), (4, 3, FIFTH), (6, 5, SEVENTH)].into_iter().zip(0..) {
            a[carrier][carrier] = whole + 2.0 * swing[k];
            a[carrier][carried] = OWN[k] + swing[k];
            a[carried][carrier] = OWN[k] + swing[k];
            a[carried][carried] = OWN[k];
        }
        for (row, column, entry) in self.gradient() {
            a[7 + row][column] = entry;
            a[column][7 + row] = entry;
        }
    }

    fn gradient(&self) -> [(usize, usize, f64); 22] {
        let [r, d, s, e, t, f, u] = self.arms;
        let (x0, y0) = (d[1] - r[1], r[0] - d[0]);
        [
            (0, 0, x0),
            (0, 1, d[1]),
            (0, 2, -s[0]),
            (1, 0, y0),
            (1, 1, -d[0]),
            (1, 2, -s[1]),
            (2, 0, x0),
            (2, 1, d[1]),
            (2, 3, -e[0]),
            (2, 4, t[1] - e[0]),
            (3, 0, y0),
            (3, 1, -d[0]),
            (3, 3, -e[1]),
            (3, 4, -t[0] - e[1]),
            (4, 0, x0),
            (4, 1, d[1]),
            (4, 5, f[1]),
            (4, 6, f[1] - u[0]),
            (5, 0, y0),
            (5, 1, -d[0]),
            (5, 5, -f[0]),
            (5, 6, -f[0] - u[1]),
        ]
    }

    fn force(&self, v: &[f64; 7]) -> [f64; 7] {
        let (sin, cos) = (self.sin[2], self.cos[2]);
        let (ax, ay) = (SD * cos + SC * sin, SD * sin - SC * cos);
        let (x, y) = (XB - XC + ax, YB - YC + ay);
        let tension = C0 * (L0 / (x * x + y * y).sqrt() - 1.0);
        let pull = [self.sin[1] * CARRIED[0], self.cos[3] * CARRIED[1], self.cos[5] * CARRIED[2]];
        [
            TORQUE - pull[0] * v[1] * (v[1] + 2.0 * v[0]),
            pull[0] * v[0] * v[0],
            tension * (y * ax - x * ay),
            pull[1] * v[4] * v[4],
            -pull[1] * v[3] * (v[3] + 2.0 * v[4]),
            -pull[2] * v[6] * v[6],
            pull[2] * v[5] * (v[5] + 2.0 * v[6]),
        ]
    }
}

/// y' = (v, v') at y = (q, v); leaves the factors in `lu`.
pub fn derivative(y: &[f64; 14], lu: &mut Lu) -> [f64; 14] {
    let (q, v) = split(y);
    let arms = Arms::at(q);
    arms.matrix(&mut lu.matrix);
    lu.factor();
    let rates = [v[0], v[0] + v[1], v[2], v[3] + v[4], v[4], v[5] + v[6], v[6]];
    let solution = lu.solve(joined(arms.force(v), arms.sums(rates.map(|rate| rate * rate))));
    std::array::from_fn(|i| if i < 7 { v[i] } else { solution[i - 7] })
}

/// Projects y onto phi = 0 and G v = 0 with the mass matrix as metric: one factorization, two solutions.
pub fn project(y: &mut [f64; 14], lu: &mut Lu) {
    let (q, v) = split(y);
    let arms = Arms::at(q);
    arms.matrix(&mut lu.matrix);
    let mut open = [0.0; 6];
    arms.gradient().into_iter().for_each(|(row, column, entry)| open[row] += entry * v[column]);
    lu.factor();
    let dq = lu.solve(joined([0.0; 7], arms.phi()));
    let dv = lu.solve(joined([0.0; 7], open));
    for i in 0..7 {
        y[i] -= dq[i];
        y[7 + i] -= dv[i];
    }
}

fn split(y: &[f64; 14]) -> (&[f64; 7], &[f64; 7]) {
    let (q, v) = y.split_at(7);
    (q.try_into().expect("7 of 14"), v.try_into().expect("7 of 14"))
}

fn joined(top: [f64; 7], bottom: [f64; 6]) -> [f64; 13] {
    std::array::from_fn(|i| if i < 7 { top[i] } else { bottom[i - 7] })
}
