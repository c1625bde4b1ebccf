//! Scenes with bodies in space, controllers, drivers and floating frames.

use super::{models, off_whole};
use crate::scenes::shipped;
use holonom::linearize::State;

#[test]
fn products_of_transitions_are_those_of_one_span() {
    for (name, chart, end) in [
        ("spatial_slider_crank", "intrinsic", 0.4),
        ("spinning_top", "intrinsic", 0.2),
        ("pid_arm", "intrinsic", 0.3),
        ("four_bar_spring", "crank.angle", 0.2),
        ("modal_link", "mass_orthogonal", 0.02),
    ] {
        let scene = shipped(name, &[]);
        let (q, v) = scene.0.start();
        let start = State { t: scene.0.start_time(), q: q.to_vec(), v: v.to_vec() };
        let found = models(scene.system(), &start, chart, (start.t + end, 11));
        let off = off_whole(scene.system(), &start, chart, &found);
        assert!(off < 1e-10, "{name}: {off:e}");
        let worst = found.measured.iter().map(|measured| measured.error / (1e-9 + measured.uncertainty));
        assert!(worst.fold(0.0, f64::max) < 100.0, "{name}: {:?}", found.measured);
        assert!(found.measured.iter().all(|measured| measured.error < 1e-5), "{name}: {:?}", found.measured);
    }
}
