//! Charts along motions: where they go on, and where they cease.

use super::closed_forms::{Pendulum, released};
use super::{models, off_whole, times};
use crate::linearize::systems::DoublePendulum;
use holonom::linearize::{Chart, Matrix, State, along, within};

fn double() -> State {
    State { t: 0.0, q: vec![0.6, -0.8, 1.4, -1.4], v: vec![0.0; 4] }
}

#[test]
fn products_of_transitions_are_those_of_one_span_in_every_chart() {
    for chart in ["intrinsic", "mass_orthogonal", "q1,q3"] {
        let found = models(&DoublePendulum, &double(), chart, (0.5, 26));
        let off = off_whole(&DoublePendulum, &double(), chart, &found);
        assert!(off < 1e-10, "{chart}: {off:e}");
        assert_eq!(found.models[25].chart, chart);
        assert!(
            found.measured.len() == 5 && found.measured.iter().all(|measured| measured.error < 1e-7),
            "{chart}: {:?}",
            found.measured
        );
    }
}

/// R^T M R = 1 with a continuous R, over many turns; A(t) is that of the carried basis.
#[test]
fn the_intrinsic_basis_goes_on_without_flips() {
    let found = models(&DoublePendulum, &double(), "intrinsic", (10.0, 401));
    let basis = |i: usize| &found.models[i].frame.as_ref().unwrap().coordinates.r;
    for i in 1..found.models.len() {
        let square = basis(i).tr_mul(basis(i));
        assert!((square - Matrix::identity(2, 2)).amax() < 1e-10);
        assert!((basis(i) - basis(i - 1)).amax() < 0.3, "{i}");
    }
}

/// The x of a pendulum stands still where its rod is level.
#[test]
fn named_coordinates_that_cease_are_told() {
    let start = released(2.0);
    let refused = |chart: &str| {
        along(&Pendulum, &start, Some(&Chart::parse(chart)), &times(&start, 1.0, 11), |_| {}).unwrap_err().to_string()
    };
    let text = refused("q1");
    assert!(text.contains("q1 cease to be coordinates") && text.contains("between t = "), "{text}");
    assert!(refused("frozen").contains("no model along a motion"));
}

/// With a constant M and no rotations both charts are the same.
#[test]
fn the_basis_that_moves_least_is_parallel_where_m_is_constant() {
    let [a, b] = ["intrinsic", "mass_orthogonal"].map(|chart| models(&DoublePendulum, &double(), chart, (1.0, 21)));
    for (a, b) in a.models.iter().zip(&b.models) {
        assert!((&a.a - &b.a).amax() < 1e-9 * a.a.amax(), "{}{}", a.a, b.a);
    }
}

#[test]
fn points_are_as_close_as_interpolation_needs_them() {
    let start = released(2.0);
    let found = within(&Pendulum, &start, None, &times(&start, 2.0, 5), 0.01, |_| {}).unwrap();
    let worst = found.deviations.iter().map(|found| found.error).fold(0.0, f64::max);
    assert!(worst <= 0.01 && worst > 0.002, "{worst}");
    assert!((15..70).contains(&found.models.len()), "{}", found.models.len());
    // Closer where the motion is fast.
    let spacing: Vec<f64> = found.models.windows(2).map(|pair| pair[1].point.t - pair[0].point.t).collect();
    let (least, most) = spacing.iter().fold((f64::INFINITY, 0.0f64), |(low, high), x| (low.min(*x), high.max(*x)));
    assert!(most > 1.5 * least, "{spacing:?}");
}
