//! The element itself: objective, with wrenches that are the gradient of its energy, exact where it should be.

use holonom::body::flexible::Section;
use holonom::body::{Frame, Wrench};
use holonom::force::{Action, Beam, ForceKernel};
use holonom::math::rotation::{axes_from_quaternion, quaternion_from_vector};
use holonom::math::{Regime, Scalar, Taylor, Time};

const SECTION: Section = Section { ea: 1e4, ga: [4e3, 3e3], gj: 60.0, ei: [100.0, 300.0], rho_a: 1.0, rho_i: [0.1; 2] };
const CURVATURE: [f64; 3] = [0.3, -0.2, 0.5];
const LENGTH: f64 = 0.7;

fn beam(damping: f64) -> Beam {
    Beam::new::<3>(&SECTION, LENGTH, CURVATURE, damping)
}

/// The frame at r, turned by the rotation vector a.
fn frame(r: [f64; 3], a: [f64; 3]) -> Frame<f64, 3> {
    Frame { r, axes: axes_from_quaternion(&quaternion_from_vector(&a)), turn: 0.0 }
}

fn add(a: [f64; 3], b: [f64; 3], part: f64) -> [f64; 3] {
    std::array::from_fn(|i| a[i] + part * b[i])
}

/// The frame after a rotation by w about axes of the world through its origin and a shift by v.
fn moved(frame: &Frame<f64, 3>, v: [f64; 3], w: [f64; 3]) -> Frame<f64, 3> {
    Frame { r: add(frame.r, v, 1.0), axes: frame.axes.map(|axis| turned(axis, w)), turn: 0.0 }
}

fn turned(x: [f64; 3], w: [f64; 3]) -> [f64; 3] {
    let r = axes_from_quaternion(&quaternion_from_vector(&w));
    std::array::from_fn(|i| (0..3).map(|j| r[j][i] * x[j]).sum())
}

fn act<const D: usize>(beam: &Beam, frames: [Frame<Taylor<f64>, D>; 2]) -> ([Wrench<f64, D>; 2], Action<f64>) {
    let mut out = [Wrench::zero(); 2];
    let action = beam.act(&frames, Time { t: Taylor::time(0.0), regime: Regime::FREE }, &mut out);
    (out, action)
}

fn at_rest(frames: &[Frame<f64, 3>; 2]) -> ([Wrench<f64, 3>; 2], Action<f64>) {
    act(&beam(0.0), [frames[0].map(Taylor::fixed), frames[1].map(Taylor::fixed)])
}

/// Two ends of a strongly deformed element; the second turned by up to `turn` against the first.
fn deformed(turn: f64) -> [Frame<f64, 3>; 2] {
    let a = frame([0.3, -0.2, 0.5], [0.4, 0.9, -0.3]);
    let gap = turned([0.75, 0.05, -0.08], [0.4, 0.9, -0.3]);
    let axis = [0.48 * turn, -0.6 * turn, 0.64 * turn];
    [a, Frame { r: add(a.r, gap, 1.0), ..moved(&a, [0.0; 3], axis) }]
}

/// From no turn at all, through the bounds of the series and of the choice of a quaternion's divisor.
const TURNS: [f64; 10] = [0.0, 1e-8, 1e-3, 0.19, 0.21, 0.5, 0.6, 1.5, 2.2, 3.0];

#[test]
fn energy_and_magnitude_do_not_change_in_a_rigid_motion() {
    for turn in TURNS {
        let ends = deformed(turn);
        let (_, action) = at_rest(&ends);
        let pivot = [1.0, 2.0, -3.0];
        let w = [1.1, -2.0, 0.6];
        let carried = ends.map(|end| {
            let r = add(pivot, turned(add(end.r, pivot, -1.0), w), 1.0);
            Frame { r: add(r, [5.0, 0.3, -7.0], 1.0), axes: end.axes.map(|axis| turned(axis, w)), turn: 0.0 }
        });
        let (_, other) = at_rest(&carried);
        // Positions of size 10 against strains of size 0.1 to 4.
        assert!((action.potential.x - other.potential.x).abs() < 1e-12 * action.potential.x, "{turn}");
        assert!((action.magnitude - other.magnitude).abs() < 1e-11 * SECTION.ea, "{turn}");
    }
}

/// Central differences with steps of 1e-5 lose 1e-10 of the energy over the step, and 1e-10 of third derivatives.
#[test]
fn wrenches_are_minus_the_gradient_of_the_energy() {
    for turn in TURNS {
        let ends = deformed(turn);
        let (wrenches, action) = at_rest(&ends);
        for (end, wrench) in wrenches.iter().enumerate() {
            for k in 0..6 {
                let along = |h: f64| {
                    let mut twist = [0.0; 6];
                    twist[k] = h;
                    let [v, w] = [[twist[0], twist[1], twist[2]], [twist[3], twist[4], twist[5]]];
                    let mut ends = ends;
                    ends[end] = moved(&ends[end], v, w);
                    at_rest(&ends).1.potential.x
                };
                let slope = (along(1e-5) - along(-1e-5)) / 2e-5;
                let component = if k < 3 { wrench.force[k] } else { wrench.torque[k - 3] };
                let error = (component + slope).abs();
                assert!(error < 1e-7 * action.potential.x.max(1e3), "{turn}, end {end}, {k}: {component} {slope}");
            }
        }
    }
}

/// Ends that move anyhow: what the wrenches do is what the energy loses, and with damping more.
#[test]
fn power_of_the_wrenches_is_the_loss_of_energy() {
    let twists = [([0.3, -0.1, 0.2], [0.5, 0.1, -0.4]), ([-0.2, 0.4, 0.1], [-0.3, 0.6, 0.2])];
    for turn in TURNS {
        let ends = deformed(turn);
        let moving: [Frame<Taylor<f64>, 3>; 2] = std::array::from_fn(|i| {
            let (v, w) = twists[i];
            let rate = |e: [f64; 3]| [w[1] * e[2] - w[2] * e[1], w[2] * e[0] - w[0] * e[2], w[0] * e[1] - w[1] * e[0]];
            let path = |x: [f64; 3], d: [f64; 3]| std::array::from_fn(|j| Taylor::new(x[j], d[j], 0.0));
            let axes = ends[i].axes.map(|axis| path(axis, rate(axis)));
            Frame { r: path(ends[i].r, v), axes, turn: Taylor::constant(0.0) }
        });
        let power = |wrenches: &[Wrench<f64, 3>; 2]| -> f64 {
            let one = |(wrench, (v, w)): (&Wrench<f64, 3>, &([f64; 3], [f64; 3]))| -> f64 {
                (0..3).map(|i| wrench.force[i] * v[i] + wrench.torque[i] * w[i]).sum()
            };
            wrenches.iter().zip(&twists).map(one).sum()
        };
        let (wrenches, action) = act(&beam(0.0), moving);
        let balance = power(&wrenches) + action.potential.d;
        // Round-off of sums of powers of up to 1e4 W.
        assert!(balance.abs() < 1e-10, "{turn}: {balance:e}");
        let (wrenches, damped) = act(&beam(0.01), moving);
        assert_eq!(damped.potential, action.potential);
        assert!(power(&wrenches) + damped.potential.d < 0.0, "{turn}");
    }
}

/// In the plane the element is that of space.
#[test]
fn the_plane_lies_in_space() {
    let curvature = [0.0, 0.0, 0.5];
    let angle = 0.8;
    let flat = |x: f64, y: f64, turn: f64| {
        let (s, c) = turn.sin_cos();
        Frame { r: [x, y], axes: [[c, s], [-s, c]], turn }.map(Taylor::fixed)
    };
    let ends = [frame([0.1, 0.2, 0.0], [0.0, 0.0, -0.3]), frame([0.7, 0.3, 0.0], [0.0, 0.0, angle])];
    let space = act(&Beam::new::<3>(&SECTION, LENGTH, curvature, 0.0), ends.map(|end| end.map(Taylor::fixed)));
    let plane = Beam::new::<2>(&SECTION, LENGTH, curvature, 0.0);
    let plane = act(&plane, [flat(0.1, 0.2, -0.3), flat(0.7, 0.3, angle)]);
    for (a, b) in plane.0.iter().zip(&space.0) {
        let errors = [a.force[0] - b.force[0], a.force[1] - b.force[1], a.torque[2] - b.torque[2]];
        // Of forces of 1e3 N.
        assert!(errors.iter().all(|error| error.abs() < 1e-11), "{errors:?}");
    }
    assert!((plane.1.potential.x - space.1.potential.x).abs() < 1e-12 * space.1.potential.x);
}

/// One element as a cantilever with a small force and torque at its free end: the section forces between its ends are
/// those of statics, and the line is the cubic of beam theory.
#[test]
fn stations_have_the_moments_and_the_line_of_beam_theory() {
    let length = 2.0;
    let force = [2e-7, 3e-7, -1e-7];
    let torque = [4e-7, 5e-7, -7e-7];
    let [ei_y, ei_z] = SECTION.ei;
    let [ga_y, ga_z] = SECTION.ga;
    let beam = Beam::new::<3>(&SECTION, length, [0.0; 3], 0.0);
    // Deflection at x under force f and moment m at the end, with slope' = (m + f (length - x))/ei.
    let line = |x: f64, f: f64, m: f64, ei: f64, ga: f64| {
        (m * x * x / 2.0 + f * (length * x * x / 2.0 - x.powi(3) / 6.0)) / ei + f * x / ga
    };
    let slope = |x: f64, f: f64, m: f64, ei: f64| (m * x + f * (length * x - x * x / 2.0)) / ei;
    let y = |x: f64| line(x, force[1], torque[2], ei_z, ga_y);
    // A positive slope along z is a negative turn about y.
    let z = |x: f64| line(x, force[2], -torque[1], ei_y, ga_z);
    let turn = [
        torque[0] * length / SECTION.gj,
        -slope(length, force[2], -torque[1], ei_y),
        slope(length, force[1], torque[2], ei_z),
    ];
    let stretched = |x: f64| x * (1.0 + force[0] / SECTION.ea);
    let ends = [frame([0.0; 3], [0.0; 3]), frame([stretched(length), y(length), z(length)], turn)];
    let (wrenches, action) = act(&beam, ends.map(|end| end.map(Taylor::fixed)));
    // Second-order terms are 1e-6 of the first; forces have the round-off of EA.
    let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-11, "{found} {expected}");
    (0..3).for_each(|i| near(-wrenches[1].force[i], force[i]));
    (0..3).for_each(|i| near(-wrenches[1].torque[i], torque[i]));
    near(action.magnitude, force[0]);
    let moving = ends.map(|end| end.map(Taylor::fixed));
    for x in [0.0, 0.3, 1.0, 1.7, 2.0] {
        let station = beam.station([&moving[0], &moving[1]], x);
        let rest = length - x;
        let moments = [torque[0], torque[1] - force[2] * rest, torque[2] + force[1] * rest];
        (0..3).for_each(|i| near(station.force[i], force[i]));
        (0..3).for_each(|i| near(station.force[3 + i], moments[i]));
        near(station.elastic[1] / ga_y, force[1] / ga_y);
        near(station.elastic[5] / ei_z, moments[2] / ei_z);
        [stretched(x), y(x), z(x)].iter().zip(station.r).for_each(|(expected, found)| near(found, *expected));
    }
}

/// Half a turn and more between the ends in space: the energy is finite and continuous.
#[test]
fn half_a_turn_leaves_numbers_finite() {
    let ends = |turn: f64| [frame([0.0; 3], [0.0; 3]), frame([0.1, 0.2, 0.0], [0.0, 0.0, turn])];
    let pi = std::f64::consts::PI;
    for turn in [pi - 1e-9, pi, pi + 1e-9, 2.0 * pi - 1e-9, 2.0 * pi] {
        let (wrenches, action) = at_rest(&ends(turn));
        assert!(action.potential.x.is_finite() && action.potential.d.is_finite(), "{turn}");
        assert!(wrenches.iter().all(|w| w.force.iter().chain(&w.torque).all(|x| x.is_finite())), "{turn}");
    }
}
