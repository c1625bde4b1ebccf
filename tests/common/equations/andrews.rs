//! Andrews' squeezing mechanism in seven angles and six constraints: planar bodies K1..K7, driven by a torque on K1,
//! with a spring between the fixed point C and the point D of K3.
//!
//! ```text
//! M(q) v' = f(q, v) - G^T lambda,   q = (beta, Theta, gamma, Phi, delta, Omega, epsilon)
//! P = rr (cos beta, sin beta) - d (cos(beta + Theta), sin(beta + Theta))      where three arms meet
//! 0 = P - B - ss (sin gamma, -cos gamma)
//! 0 = P - A - e (sin(Phi + delta), -cos(Phi + delta)) - zt (cos delta, sin delta)
//! 0 = P - A - zf (cos(Omega + epsilon), sin(Omega + epsilon)) - u (sin epsilon, -cos epsilon)
//! ```
//!
//! Hairer, Wanner, Solving Ordinary Differential Equations II, VII.7; IVP test set, problem `andrews`.

use super::State;
use holonom::math::Scalar;
use holonom::system::Equations;

/// Angles beta, Theta, gamma, Phi, delta, Omega, epsilon, rad.
pub struct Andrews;

/// At rest.
pub const START: State = State {
    t: 0.0,
    q: &[
        -0.06171389001427645,
        0.0,
        0.45527981916307037,
        0.22266839016588588,
        0.48736497954384256,
        -0.22266839016588588,
        1.2305474445498212,
    ],
    v: &[0.0; 7],
    lambda: &[98.56687039624109, -6.122688344255662, 0.0, 0.0, 0.0, 0.0],
};

/// Computation in binary128; the published angles have 9.6 correct digits.
pub const END: State = State {
    t: 0.03,
    q: &[
        15.810771195153707,
        -15.756371058411839,
        0.0408222401196458,
        -0.5347301163420796,
        0.524409965879954,
        0.5347301163420796,
        1.048080741041938,
    ],
    v: &[
        1139.9203022591062,
        -1424.3792951775401,
        11.032911910618594,
        19.29337410503204,
        0.5735699148295025,
        -19.29337410503204,
        0.3231791492491309,
    ],
    lambda: &[
        199.17534810453864,
        -29.755309974971762,
        23.06654361162215,
        31.452725275771137,
        22.64249478639438,
        11.617392352611256,
    ],
};

const MASSES: [f64; 7] = [0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498];
const INERTIAS: [f64; 7] = [2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5];
const A: [f64; 2] = [-0.06934, -0.00227];
const B: [f64; 2] = [-0.03635, 0.03273];
const C: [f64; 2] = [0.014, 0.072];
/// Spring: stiffness, N/m, and natural length, m.
const STIFFNESS: f64 = 4530.0;
const NATURAL: f64 = 0.07785;
/// Torque on K1, N m.
const TORQUE: f64 = 0.033;
/// Lengths of K1..K7, m, with the names of the test set.
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

/// m2 da rr, m4 zt (e - ea) and m6 u (zf - fa): products of inertia of arms that carry arms.
const CARRIED: [f64; 3] = [MASSES[1] * DA * RR, MASSES[3] * ZT * (E - EA), MASSES[5] * U * (ZF - FA)];

impl Equations for Andrews {
    fn size(&self) -> (usize, usize) {
        (7, 6)
    }

    fn mass<S: Scalar>(&self, _t: S, q: &[S], mass: &mut [S]) {
        let ([_, m2, m3, m4, m5, m6, m7], [i1, i2, i3, i4, i5, i6, i7]) = (MASSES, INERTIAS);
        // Inertia of the carried arm about its own pivot, and what the swing of the pivot adds.
        let swing = [-q[1].cos() * CARRIED[0], q[3].sin() * CARRIED[1], -q[5].sin() * CARRIED[2]];
        let own = [m2 * DA * DA + i2, m4 * (E - EA).powi(2) + i4, m6 * (ZF - FA).powi(2) + i6];
        let first = MASSES[0] * RA * RA + m2 * RR * RR + i1;
        let fifth = m4 * ZT * ZT + m5 * (TA * TA + TB * TB) + i5;
        let seventh = m6 * U * U + m7 * (UA * UA + UB * UB) + i7;
        mass.fill(S::zero());
        let mut arm = |carrier: usize, carried: usize, rest: f64, k: usize| {
            mass[8 * carrier] = swing[k] * 2.0 + (own[k] + rest);
            mass[7 * carrier + carried] = swing[k] + own[k];
            mass[7 * carried + carrier] = swing[k] + own[k];
            mass[8 * carried] = S::constant(own[k]);
        };
        arm(0, 1, first, 0);
        arm(4, 3, fifth, 1);
        arm(6, 5, seventh, 2);
        mass[8 * 2] = S::constant(m3 * (SA * SA + SB * SB) + i3);
    }

    fn force<S: Scalar>(&self, _t: S, q: &[S], v: &[S], f: &mut [S]) {
        let (sin, cos) = q[2].sin_cos();
        let arm = [cos * SD + sin * SC, sin * SD - cos * SC];
        let x = arm[0] + (B[0] - C[0]);
        let y = arm[1] + (B[1] - C[1]);
        let tension = (x.square() + y.square()).sqrt().recip() * (STIFFNESS * NATURAL) - STIFFNESS;
        let centrifugal = [q[1].sin() * CARRIED[0], q[3].cos() * CARRIED[1], q[5].cos() * CARRIED[2]];
        f[0] = -centrifugal[0] * v[1] * (v[1] + v[0] * 2.0) + TORQUE;
        f[1] = centrifugal[0] * v[0].square();
        f[2] = tension * (y * arm[0] - x * arm[1]);
        f[3] = centrifugal[1] * v[4].square();
        f[4] = -centrifugal[1] * v[3] * (v[3] + v[4] * 2.0);
        f[5] = -centrifugal[2] * v[6].square();
        f[6] = centrifugal[2] * v[5] * (v[5] + v[6] * 2.0);
    }

    fn phi<S: Scalar>(&self, _t: S, q: &[S], phi: &mut [S]) {
        let turn = |angle: S, length: f64| {
            let (sin, cos) = angle.sin_cos();
            [cos * length, sin * length]
        };
        let crank = turn(q[0], RR);
        let rod = turn(q[0] + q[1], D);
        let x = crank[0] - rod[0];
        let y = crank[1] - rod[1];
        let third = turn(q[2], SS);
        phi[0] = x - third[1] - B[0];
        phi[1] = y + third[0] - B[1];
        let fourth = turn(q[3] + q[4], E);
        let fifth = turn(q[4], ZT);
        phi[2] = x - fourth[1] - fifth[0] - A[0];
        phi[3] = y + fourth[0] - fifth[1] - A[1];
        let sixth = turn(q[5] + q[6], ZF);
        let seventh = turn(q[6], U);
        phi[4] = x - sixth[0] - seventh[1] - A[0];
        phi[5] = y - sixth[1] + seventh[0] - A[1];
    }

    /// The spring's energy and that of the constant torque.
    fn potential(&self, _t: f64, q: &[f64]) -> Option<f64> {
        let (sin, cos) = q[2].sin_cos();
        let x = B[0] - C[0] + cos * SD + sin * SC;
        let y = B[1] - C[1] + sin * SD - cos * SC;
        Some(0.5 * STIFFNESS * (x.hypot(y) - NATURAL).powi(2) - TORQUE * q[0])
    }
}
