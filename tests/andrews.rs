//! Andrews' squeezing mechanism as seven rigid bodies, against the seven angles of the IVP test set.

use crate::common::equations::andrews::Andrews;
use crate::scenes::shipped;
use holonom::math::{Scalar, Taylor};
use holonom::system::{MechanicalSystem, Need, Scratch, Terms};

const ANGLES: [&str; 7] = ["beta", "Theta", "gamma", "Phi", "delta", "Omega", "epsilon"];

/// A state of the reference: t, the seven angles, their rates. Binary128 computation of the test set's equations.
type State = (f64, [f64; 7], [f64; 7]);

const REFERENCE: [State; 3] = [
    (
        0.01,
        [
            2.1601131315315265,
            -1.8833642311070444,
            0.1585167580012267,
            -0.3286410751746703,
            0.5251547747977294,
            0.3286410751746703,
            1.068427204632401,
        ],
        [
            711.923152831104,
            -786.7700808599398,
            -136.4381913781197,
            -240.29302926786454,
            4.791548225371054,
            240.29302926786454,
            -41.14056696161049,
        ],
    ),
    (
        0.02,
        [
            8.184905889661676,
            -7.890505363730449,
            0.20953691338469757,
            -0.23832559659585126,
            0.5225369171559964,
            0.23832559659585126,
            1.0862751085998732,
        ],
        [
            726.5583426091277,
            -748.6324206323291,
            -145.73923758440472,
            -259.50079947677506,
            9.79050185516307,
            259.50079947677506,
            -57.75747174274601,
        ],
    ),
    (
        0.03,
        [
            15.810771195153707,
            -15.756371058411839,
            0.0408222401196458,
            -0.5347301163420796,
            0.524409965879954,
            0.5347301163420796,
            1.048080741041938,
        ],
        [
            1139.9203022591062,
            -1424.3792951775401,
            11.032911910618594,
            19.29337410503204,
            0.5735699148295025,
            -19.29337410503204,
            0.3231791492491309,
        ],
    ),
];

#[test]
fn angles_agree_with_the_reference() {
    let run = shipped("andrews", &[]).tight(1e-12, 0.03, 0.01);
    println!("{:?}\n{:?}", run.outcome.statistics, run.record.drift);
    for (row, (t, angles, _)) in REFERENCE.iter().enumerate() {
        assert_eq!(run.times()[row + 1], *t);
        for (name, angle) in ANGLES.iter().zip(angles) {
            let error = (run.column(name)[row + 1] - angle).abs();
            // The local errors of some hundred steps at 1e-12, on a motion that hardly amplifies them.
            assert!(error < 1e-10, "{name} at {t} s is off by {error:e}");
        }
    }
    let drift = &run.record.drift;
    assert!(drift.position.max < 1e-12 && drift.velocity.max < 1e-9, "{drift:?}");
    // A bound on the work: about three times what it takes today, 2998.
    assert!(run.outcome.statistics.rhs_evaluations < 9_000, "{:?}", run.outcome.statistics);
}

#[test]
fn the_rigid_bodies_are_those_of_the_test_set() {
    let ready = shipped("andrews", &[]);
    let system = ready.system();
    let mut scratch = Scratch::default();
    for (t, angles, rates) in REFERENCE {
        let bodies = places(std::array::from_fn(|i| Taylor::new(angles[i], rates[i], 0.0)));
        let q = bodies.map(|x| x.x);
        let v = bodies.map(|x| x.d);
        let mut terms = Terms::new(system);
        system.evaluate(t, &q, &v, Need::CONSTRAINTS, &mut terms, &mut scratch);
        // Angles and rates are given to 16 digits: round-off of lengths below 0.07 m and speeds below 50 m/s.
        assert!(terms.phi.iter().all(|gap| gap.abs() < 1e-15), "{:?}", terms.phi);
        assert!(terms.phi_dot.iter().all(|rate| rate.abs() < 1e-12), "{:?}", terms.phi_dot);
        let kinetic = system.energy(t, &q, &v, &mut scratch).unwrap().kinetic;
        let expected = MechanicalSystem::energy(&Andrews, t, &angles, &rates, &mut Scratch::default()).unwrap().kinetic;
        assert!((kinetic - expected).abs() < 1e-14 * expected, "{kinetic} is not {expected}");
    }
}

/// x, y and angle of the seven bodies from the seven angles. The moving pivots are those of the test set's constraints.
fn places<S: Scalar>([beta, theta, gamma, phi, delta, omega, epsilon]: [S; 7]) -> [S; 21] {
    let along = |angle: S, x: f64, y: f64| [angle.cos() * x - angle.sin() * y, angle.sin() * x + angle.cos() * y];
    let from = |[x, y]: [S; 2], angle: S, [a, b]: [f64; 2]| {
        let [u, v] = along(angle, a, b);
        [x + u, y + v, angle]
    };
    let at = |x: f64, y: f64| [S::constant(x), S::constant(y)];
    let o = at(0.0, 0.0);
    let a = at(-0.06934, -0.00227);
    let b = at(-0.03635, 0.03273);
    let pivot = |[x, y]: [S; 2], angle: S, [u, v]: [f64; 2]| {
        let [x, y, _] = from([x, y], angle, [u, v]);
        [x, y]
    };
    let f = pivot(o, beta, [7e-3, 0.0]);
    let h = pivot(a, delta, [4e-2, 0.0]);
    let g = pivot(a, epsilon, [0.0, -4e-2]);
    let all = [
        from(o, beta, [92e-5, 0.0]),
        from(f, beta + theta, [-115e-4, 0.0]),
        from(b, gamma, [1043e-5, -1874e-5]),
        from(h, phi + delta, [0.0, -(2e-2 - 1421e-5)]),
        from(a, delta, [2308e-5, 916e-5]),
        from(g, omega + epsilon, [2e-2 - 1421e-5, 0.0]),
        from(a, epsilon, [449e-5, -1228e-5]),
    ];
    std::array::from_fn(|i| all[i / 3][i % 3])
}
