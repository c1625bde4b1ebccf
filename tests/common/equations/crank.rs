//! Slider-crank with a flexible connecting rod, the crank driven at constant speed: three rigid coordinates p and four
//! of the rod's deformation, two lateral sine modes q1, q2 and a quadratic element along the rod, q3 in its middle and
//! q4 at its end.
//!
//! ```text
//! M(p, q) (p'', q'') = f(p, q, p', q') - (0, K q) - G^T lambda,   p = (phi1, phi2, x3)
//! 0 = l1 sin phi1 + (l2 + q4) sin phi2
//! 0 = x3 - l1 cos phi1 - (l2 + q4) cos phi2
//! 0 = phi1 - Omega t
//! ```
//!
//! Stiff by its oscillations: 1277 and 5107 rad/s across, 6841 and 24613 rad/s along the rod. Without gravity and
//! damping. Simeon, Math. Modelling of Systems 2 (1996) 1-18; IVP test set, problem `crank`, whose axial mass lacks the
//! factor 1/15 of a consistent quadratic element, and whose pi is 3.1415927: both belong to the reference.

use super::State;
use holonom::math::Scalar;
use holonom::system::Equations;
use std::array::from_fn;

/// Coordinates phi1, phi2, x3, q1, q2, q3, q4, rad and m.
pub struct Crank;

/// The published start, its dependent values made consistent: x3 = l1 + l2 + q4, phi2' = -l1 Omega/(l2 + q4), x3' =
/// q4'.
pub const START: State = State {
    t: 0.0,
    q: &[0.0, 0.0, 0.4500169327969, 0.0, 0.0, 1.03339863e-05, 1.69327969e-05],
    v: &[150.0, -74.99576703969453, -2.68938672e-06, 0.444896105, 0.00463434311, -1.78591076e-06, -2.68938672e-06],
    lambda: &[-6.552746561986863e-08, 382.4589509527683, -4.635937824772399e-09],
};

/// The motion from there. Computation in binary128; parameters rounded to double leave 12.7 digits of q.
pub const END: State = State {
    t: 0.1,
    q: &[
        15.0,
        -0.3311734988256447,
        0.16973733263995855,
        0.0001893192843020042,
        2.3757513204885726e-05,
        -5.3238967781923865e-06,
        -8.363313291666587e-06,
    ],
    v: &[
        150.0,
        60.253467551296026,
        -8.75311632672714,
        -0.03005541170950723,
        -0.005500430645925284,
        0.0004974111663674571,
        0.0011055599716078314,
    ],
    lambda: &[-62.32935927828679, -163.79209934418668, 25.298579487869894],
};

/// The published start for index 2: x3 is off by 2.03e-10, which stays; velocities moved to G v + phi_t = 0.
pub const PUBLISHED_START: State = State {
    t: 0.0,
    q: &[0.0, 0.0, 0.450016933, 0.0, 0.0, 1.03339863e-05, 1.69327969e-05],
    v: &[
        150.0,
        -74.99576703969453,
        -2.68938672e-06,
        0.4448961125815999,
        0.004634339319238302,
        -1.78591076e-06,
        -2.68938672e-06,
    ],
    lambda: &[-6.552746561986863e-08, 382.45895095549486, -4.635937824772399e-09],
};

/// The motion from there: what the published values converge to, of which q1..q4 have 10.3 correct digits.
pub const PUBLISHED_END: State = State {
    t: 0.1,
    q: &[
        15.0,
        -0.3311734988256299,
        0.16973733284307213,
        0.00018931928997009405,
        2.375751249986639e-05,
        -5.323896770748607e-06,
        -8.363313278807773e-06,
    ],
    v: &[
        150.0,
        60.25346755131835,
        -8.753116326704163,
        -0.03005541399852557,
        -0.005500431801332845,
        0.000497411179464648,
        0.0011055599936031179,
    ],
    lambda: &[-62.32935832773677, -163.79209932372473, 25.298579470003066],
};

/// As in the test set.
#[expect(clippy::approx_constant, reason = "part of the reference")]
const PI: f64 = 3.1415927;
/// Of connecting rod and slider, kg.
const M2: f64 = 0.151104;
const M3: f64 = 0.075552;
const L1: f64 = 0.15;
const L2: f64 = 0.30;
const J1: f64 = 0.002727;
const J2: f64 = 0.0045339259;
/// The rod's modulus, N/m^2, cross section, m, and density, kg/m^3.
const MODULUS: f64 = 0.2e12;
const WIDTH: f64 = 0.008;
const DENSITY: f64 = 7870.0;
/// Speed of the crank, rad/s.
const OMEGA: f64 = 150.0;

/// rho b h l2 and E b h/l2
const MASS: f64 = DENSITY * WIDTH * WIDTH * L2;
const STIFFNESS: f64 = MODULUS * WIDTH * WIDTH / L2;
/// rho times the integrals over the rod of shape functions: c1, c2, c12, c21.
const C1: [f64; 4] = [0.0, 0.0, 2.0 / 3.0 * MASS, MASS / 6.0];
const C2: [f64; 4] = [2.0 / PI * MASS, 0.0, 0.0, 0.0];
const C12: [f64; 4] = [0.0, 0.0, L2 / 3.0 * MASS, L2 / 6.0 * MASS];
const C21: [f64; 4] = [L2 / PI * MASS, -L2 / (2.0 * PI) * MASS, 0.0, 0.0];

/// Mass matrix of the deformation.
fn elastic_mass<S: Scalar>(x: &[S; 4]) -> [S; 4] {
    [x[0] * (0.5 * MASS), x[1] * (0.5 * MASS), (x[2] * 8.0 + x[3]) * MASS, (x[2] + x[3] * 2.0) * MASS]
}

fn stiffness<S: Scalar>(x: &[S; 4]) -> [S; 4] {
    let bending = PI.powi(4) / 24.0 * (WIDTH / L2).powi(2) * STIFFNESS;
    let along = STIFFNESS / 3.0;
    [x[0] * bending, x[1] * (16.0 * bending), (x[2] * 16.0 - x[3] * 8.0) * along, (x[3] * 7.0 - x[2] * 8.0) * along]
}

/// rho B q: the skew matrix that couples the lateral and the axial motion of a turning rod.
fn coupling<S: Scalar>(x: &[S; 4]) -> [S; 4] {
    let b13 = -16.0 / PI.powi(3);
    let b14 = 8.0 / PI.powi(3) - 1.0 / PI;
    let b24 = 0.5 / PI;
    let rows = [x[2] * b13 + x[3] * b14, x[3] * b24, -x[0] * b13, -x[0] * b14 - x[1] * b24];
    rows.map(|row| row * MASS)
}

fn dot<S: Scalar>(weights: &[f64; 4], x: &[S; 4]) -> S {
    weights.iter().zip(x).fold(S::zero(), |sum, (&weight, &x)| sum + x * weight)
}

fn product<S: Scalar>(x: &[S; 4], y: &[S; 4]) -> S {
    x.iter().zip(y).fold(S::zero(), |sum, (&x, &y)| sum + x * y)
}

/// q1..q4 of a vector.
fn deformation<S: Scalar>(x: &[S]) -> [S; 4] {
    from_fn(|i| x[3 + i])
}

impl Equations for Crank {
    fn size(&self) -> (usize, usize) {
        (7, 3)
    }

    fn mass<S: Scalar>(&self, _t: S, q: &[S], mass: &mut [S]) {
        let x = deformation(q);
        let sin = (q[0] - q[1]).sin();
        let cos = (q[0] - q[1]).cos();
        let coupled = coupling(&x);
        mass.fill(S::zero());
        let mut set = |i: usize, j: usize, entry: S| (mass[7 * i + j], mass[7 * j + i]) = (entry, entry);
        set(0, 0, S::constant(J1 + M2 * L1 * L1));
        set(0, 1, cos * (0.5 * L1 * L2 * M2) + (sin * dot(&C2, &x) + cos * dot(&C1, &x)) * L1);
        set(1, 1, product(&x, &elastic_mass(&x)) + dot(&C12, &x) * 2.0 + J2);
        set(2, 2, S::constant(M3));
        for i in 0..4 {
            set(0, 3 + i, (cos * C2[i] - sin * C1[i]) * L1);
            // q^T B = -(B q)^T
            set(1, 3 + i, -coupled[i] + C21[i]);
            let unit: [S; 4] = from_fn(|j| S::constant(if i == j { 1.0 } else { 0.0 }));
            let column = elastic_mass(&unit);
            (0..4).for_each(|j| set(3 + j, 3 + i, column[j]));
        }
    }

    fn force<S: Scalar>(&self, _t: S, q: &[S], v: &[S], f: &mut [S]) {
        let x = deformation(q);
        let rate = deformation(v);
        let sin = (q[0] - q[1]).sin();
        let cos = (q[0] - q[1]).cos();
        let w1 = v[0];
        let w2 = v[1];
        let heavy = elastic_mass(&x);
        let turning = coupling(&rate);
        let bent = stiffness(&x);
        let lateral = sin * dot(&C1, &x) - cos * dot(&C2, &x);
        f[0] = -w2.square() * (sin * (0.5 * L1 * L2 * M2) + lateral * L1)
            - w2 * (cos * dot(&C1, &rate) + sin * dot(&C2, &rate)) * (2.0 * L1);
        f[1] = w1.square() * (sin * (0.5 * L1 * L2 * M2) + lateral * L1)
            - w2 * (dot(&C12, &rate) + product(&rate, &heavy)) * 2.0;
        f[2] = S::zero();
        for i in 0..4 {
            f[3 + i] = w2.square() * (heavy[i] + C12[i])
                + w1.square() * (cos * C1[i] + sin * C2[i]) * L1
                + w2 * turning[i] * 2.0
                - bent[i];
        }
    }

    fn phi<S: Scalar>(&self, t: S, q: &[S], phi: &mut [S]) {
        let rod = q[6] + L2;
        phi[0] = q[0].sin() * L1 + rod * q[1].sin();
        phi[1] = q[2] - q[0].cos() * L1 - rod * q[1].cos();
        phi[2] = q[0] - t * OMEGA;
    }
}
