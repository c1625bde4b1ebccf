//! Every shipped scene loads, starts where it says, and runs with its own method.

use crate::scenes::{Ready, load, model, models};
use holonom::initial::Assembly;
use holonom::simulate::Span;
use holonom::system::{Need, Scratch, Terms};
use serde_json::Value;
use std::path::Path;

/// Scenes whose guess assembly closes.
const GUESSED: [&str; 2] = ["delta_robot", "jansen_leg"];

fn is_guessed(path: &Path) -> bool {
    GUESSED.iter().any(|name| *path == model(name))
}

#[test]
fn every_scene_starts_consistent_as_written() {
    for path in models() {
        let ready = load(&path, &[]);
        let start = ready.start();
        let as_written = if is_guessed(&path) { &start.after } else { &start.before };
        // Sums of a few terms of size one to ten, in units of the scene's scale.
        assert!(as_written.phi < 1e-14 && start.after.phi < 1e-14, "{path:?}: {:?} {:?}", start.before, start.after);
        // Speeds are up to some hundred rad/s.
        let slack = 1e-13 * speed(&start.v).max(1.0);
        assert!(rates_as_written(&path, start) < slack && start.after.phi_dot < slack, "{path:?}: {:?}", start.before);
        let coordinates = ready.system().facts().names.q.clone();
        let positions = start.moves.iter().filter(|moved| coordinates.contains(&moved.name));
        let largest = positions.map(|moved| (moved.to - moved.from).abs()).fold(0.0, f64::max);
        assert!(largest < 1e-8 || is_guessed(&path), "{path:?} moved: {:?}", start.moves);
    }
}

/// phi' as written. A scene that writes no velocities leaves them to its drivers.
fn rates_as_written(path: &Path, start: &Assembly) -> f64 {
    let writes_velocities = std::fs::read_to_string(path).unwrap().contains("velocity\":");
    if writes_velocities { start.before.phi_dot } else { start.after.phi_dot }
}

#[test]
fn every_scene_runs_with_its_own_method() {
    for path in models() {
        let ready = load(&path, &[]);
        let end = 0.2 * ready.span().end;
        let run = ready.run(&ready.0.method, Span { start: 0.0, end, output_step: end / 20.0 });
        assert_eq!(run.times().len(), 21, "{path:?}");
        assert!(run.outcome.statistics.steps < 2000, "{path:?}: {:?}", run.outcome.statistics);
        assert!(run.record.trajectory.rows.iter().flatten().all(|x| x.is_finite()), "{path:?}");
        // Manifold projection leaves the square of a step's error.
        assert!(run.record.drift.position.relative_max < 1e-9, "{path:?}: {:?}", run.record.drift);
    }
}

#[test]
fn every_scene_says_what_it_is() {
    for path in models() {
        let json = read(&path);
        assert_eq!(json["name"].as_str(), path.file_stem().and_then(|stem| stem.to_str()), "{path:?}");
        for key in ["about", "references", "outputs", "simulation"] {
            assert!(json.get(key).is_some(), "{path:?} has no {key}");
        }
    }
}

/// What is derived is written as an expression: a changed parameter leaves the start consistent.
#[test]
fn changed_parameters_keep_the_start_consistent() {
    for path in models() {
        for (name, value) in numbers(&path) {
            let ready = load(&path, &[(&name, 1.01 * value)]);
            let start = ready.start();
            // The start angles of Andrews' mechanism close its loops for its own lengths only: assembly does it.
            let is_closed_by_assembly = path == model("andrews") || is_guessed(&path);
            let level = if is_closed_by_assembly { start.after } else { start.before };
            assert!(level.phi < 1e-12, "{path:?} with {name}: {level:?}");
            let slack = 1e-12 * speed(&start.v).max(1.0);
            assert!(rates_as_written(&path, start) < slack, "{path:?} with {name}: {level:?}");
        }
    }
}

#[test]
fn degrees_of_freedom_are_those_of_the_mechanisms() {
    let expected = [
        ("andrews", 1),
        ("bathe_bend", 48),
        ("bead_in_bowl", 2),
        ("bennett", 0),
        ("bevel_differential", 2),
        ("bricard", 1),
        ("bushing_block", 6),
        ("cam_follower", 0),
        ("chebyshev_lambda", 0),
        ("delta_robot", 0),
        ("double_cardan", 0),
        ("double_pendulum", 2),
        ("double_wishbone", 0),
        ("excavator_arm", 0),
        ("fekete", 40),
        ("five_link_kinematics", 0),
        ("five_link_suspension", 2),
        ("five_link_suspension_rods", 2),
        ("flexible_four_bar", 69),
        ("flexible_pendulum", 37),
        ("flexible_robot_arm", 18),
        ("flexible_slider_crank", 4),
        ("flexible_slider_crank_fe", 16),
        ("flexible_slider_crank_modes", 5),
        ("flexible_slider_crank_rigid", 0),
        ("flyball_governor", 4),
        ("flying_spaghetti", 33),
        ("four_bar_spring", 1),
        ("full_axle", 4),
        ("gear_pair", 1),
        ("half_car", 5),
        ("hoeken", 0),
        ("hydraulic_boom", 1),
        ("jansen_leg", 0),
        ("klann_leg", 0),
        ("landing_gear", 1),
        ("macpherson", 0),
        ("modal_link", 4),
        ("n_four_bar", 1),
        ("pantograph", 0),
        ("parallel_gripper", 0),
        ("parallelogram", 1),
        ("parallelogram_redundant", 1),
        ("peaucellier", 0),
        ("pendulum", 1),
        ("pid_arm", 1),
        ("planetary_gear", 1),
        ("princeton_beam", 48),
        ("quarter_car", 2),
        ("right_angle_cantilever", 96),
        ("robot_arm", 1),
        ("rope_slider", 1),
        ("rotating_blade", 96),
        ("rotating_shaft", 48),
        ("sarrus", 0),
        ("scissor_lift", 0),
        ("slider_crank", 1),
        ("slider_crank_offset", 0),
        ("slider_crank_singular", 1),
        ("slider_crank_singular_2", 1),
        ("spatial_slider_crank", 1),
        ("spin_up_beam", 24),
        ("spinning_top", 3),
        ("stewart_platform", 0),
        ("suspension_on_road", 2),
        ("symmetric_gripper", 4),
        ("tower_crane", 2),
        ("tumbling_station", 6),
        ("two_mass", 1),
        ("universal_shaft", 0),
        ("v6_engine", 0),
        ("whitworth", 0),
    ];
    for path in models() {
        let name = path.file_stem().and_then(|stem| stem.to_str()).unwrap();
        let known = expected.iter().find(|(known, _)| *known == name);
        assert_eq!(Some(freedom(&load(&path, &[]))), known.map(|(_, freedom)| *freedom), "{name}");
    }
}

fn freedom(ready: &Ready) -> usize {
    let n = ready.system().dimensions();
    let g = ready.system().structure().g;
    let mut terms = Terms::new(ready.system());
    let (q, v) = ready.0.start();
    ready.system().evaluate(0.0, q, v, Need::G, &mut terms, &mut Scratch::default());
    let mut dense = nalgebra::DMatrix::<f64>::zeros(n.lambda.max(1), n.v);
    g.entries.iter().zip(&terms.g).for_each(|(&place, value)| dense[place] += value);
    // Singular values are of order 0.01 to 1 or round-off.
    n.moving() - dense.rank(1e-9)
}

fn speed(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |largest, v| largest.max(v.abs()))
}

fn read(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// Parameters that are plain numbers and not zero; `n` and `modes` count.
fn numbers(path: &Path) -> Vec<(String, f64)> {
    let json = read(path);
    let parameters = json["parameters"].as_object().expect("parameters").iter();
    parameters
        .filter_map(|(name, value)| Some((name.clone(), value.as_f64()?)))
        .filter(|(name, x)| *x != 0.0 && !["n", "modes"].contains(&name.as_str()))
        .collect()
}
