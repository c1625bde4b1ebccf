//! Two suspensions under one chassis: mirror images, and each a half of the whole.

use super::*;

/// The parameters that give both wheels the bump of the single suspension, or each its own.
fn bumps(left: [f64; 3], right: [f64; 3]) -> Vec<(&'static str, f64)> {
    let names = ["left_bump", "left_time", "left_width", "right_bump", "right_time", "right_width"];
    names.into_iter().zip(left.into_iter().chain(right)).collect()
}

const HIGH: [f64; 3] = [0.08, 0.5, 0.07];
const LOW: [f64; 3] = [0.05, 0.8, 0.1];

/// The state of a carrier in a mirror at y = 0: of a vector y changes sign, of a turn x and z.
fn mirrored(carrier: &[f64]) -> Vec<f64> {
    let signs: &[f64] = match carrier.len() {
        7 => &[1.0, -1.0, 1.0, 1.0, -1.0, 1.0, -1.0],
        _ => &[1.0, -1.0, 1.0, -1.0, 1.0, -1.0],
    };
    carrier.iter().zip(signs).map(|(x, sign)| x * sign).collect()
}

fn state(run: &Run, row: usize) -> (&[f64], &[f64]) {
    let (q, v, _) = run.record.trajectory.row_state(&run.record.trajectory.rows[row]);
    (q, v)
}

#[test]
fn equal_bumps_move_two_mirror_images_without_roll() {
    let run = shipped("full_axle", &bumps(HIGH, HIGH)).tight(1e-12, 2.5, 0.05);
    let single = shipped("five_link_suspension", &[("dip", 0.0)]).tight(1e-12, 2.5, 0.05);
    for row in 0..run.times().len() {
        let ((q, v), (one, rate)) = (state(&run, row), state(&single, row));
        let roll = q[1].abs().max(v[1].abs());
        let position = apart(&q[2..9], &mirrored(&q[9..16]));
        let velocity = apart(&v[2..8], &mirrored(&v[8..14]));
        // Round-off of a step's solution, which the springs of 2e5 N/m do not amplify.
        assert!(roll < 1e-12 && position < 1e-12 && velocity < 1e-11, "{row}: {roll:e} {position:e} {velocity:e}");
        // Both take steps of their own.
        let half = (q[0] - 0.5 - one[0]).abs().max(apart(&q[2..9], &one[1..8]));
        let half_rate = (v[0] - rate[0]).abs().max(apart(&v[2..8], &rate[1..7]));
        assert!(half < 1e-10 && half_rate < 1e-9, "{row}: {half:e} {half_rate:e}");
    }
}

#[test]
fn exchanged_bumps_give_the_mirror_image() {
    let [run, other] = [(HIGH, LOW), (LOW, HIGH)]
        .map(|(left, right)| shipped("full_axle", &bumps(left, right)).tight(1e-12, 2.5, 0.05));
    let (low, high) = extremes(&run.column("roll"));
    assert!(low < -0.05 && high > 0.05, "it rolls: {low} {high}");
    for row in 0..run.times().len() {
        let q = state(&run, row).0;
        let mirror = state(&other, row).0;
        let chassis = (q[0] - mirror[0]).abs().max((q[1] + mirror[1]).abs());
        let wheels = apart(&q[2..9], &mirrored(&mirror[9..16])).max(apart(&q[9..16], &mirrored(&mirror[2..9])));
        assert!(chassis < 1e-11 && wheels < 1e-11, "{row}: {chassis:e} {wheels:e}");
    }
    for (name, mirror) in [("left_camber", "right_camber"), ("left_toe", "right_toe"), ("left_travel", "right_travel")]
    {
        assert!(apart(&run.column(name), &other.column(mirror)) < 1e-11, "{name}");
    }
    assert!(apart(&run.column("right_tyre_force"), &other.column("left_tyre_force")) < 1e-6);
}

/// At 0.1 s the bump at 0.5 s is exp(-32) high.
#[test]
fn it_rests_until_the_first_bump() {
    let run = shipped("full_axle", &[]).tight(1e-12, 0.1, 0.01);
    for name in ["chassis_height", "roll", "left_travel", "right_travel"] {
        assert!(run.worst(name, |_| 0.0) < 1e-12, "{name}");
    }
}

/// The wheel that the bump of one side does not reach moves by the roll of the chassis alone; its camber against the
/// road is that of its travel, and the roll.
#[test]
fn camber_against_the_road_is_that_of_the_travel_and_the_roll() {
    let run = shipped("full_axle", &[]).tight(1e-10, 1.0, 0.1);
    for row in 0..run.times().len() {
        let roll = run.column("roll")[row];
        // The right wheel leans outward as its side sinks.
        for (side, outward) in [("left", roll), ("right", -roll)] {
            let travel = run.column(&format!("{side}_travel"))[row];
            let held = shipped("five_link_kinematics", &[("travel", travel), ("stroke", 0.0)]).tight(1e-9, 0.1, 0.1);
            let camber = held.column("camber")[0];
            let toe = held.column("toe")[0];
            // The spindle turned about x, exactly.
            let tilt = (camber.sin() * outward.cos() + camber.cos() * toe.cos() * outward.sin()).asin();
            let off = (run.column(&format!("{side}_camber"))[row] - tilt).abs();
            assert!(off < 1e-9, "{side} at {} s: {off:e}", run.times()[row]);
        }
    }
}
