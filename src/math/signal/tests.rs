use super::*;
use crate::math::{Dual, Interval, Taylor};

const UNEVEN: [f64; 8] = [-1.0, -0.7, 0.4, 0.5, 2.0, 3.5, 3.6, 5.0];

fn signal(points: &[[f64; 2]], interpolation: Interpolation, beyond: Beyond) -> Signal {
    Signal::new("test", points, interpolation, beyond).unwrap()
}

fn sampled(f: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    UNEVEN.iter().map(|x| [*x, f(*x)]).collect()
}

/// f, f' and f''.
fn jet(signal: &Signal, x: f64) -> [f64; 3] {
    let y: Taylor<f64> = signal.apply(Taylor::time(x));
    [y.x, y.d, y.dd]
}

fn near(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance * (1.0 + b.abs()), "{a} and not {b}");
}

#[test]
fn a_spline_reproduces_polynomials() {
    let cubic = |x: f64| [((2.0 * x - 3.0) * x + 1.0) * x - 4.0, (6.0 * x - 6.0) * x + 1.0, 12.0 * x - 6.0];
    let spline = signal(&sampled(|x| cubic(x)[0]), Interpolation::Cubic, Beyond::Hold);
    let samples = (0..60).map(|k| -0.999 + 0.0999 * f64::from(k));
    samples.for_each(|x| (0..3).for_each(|k| near(jet(&spline, x)[k], cubic(x)[k], 1e-12)));
    // Third derivatives, through nested numbers.
    let x = Dual::<Taylor<f64>, 1>::seeded(Taylor::new(1.3, 2.0, 0.5), 0);
    let y = spline.apply(x);
    near(y.eps[0].dd, 12.0 * 4.0 + (12.0 * 1.3 - 6.0) * 0.5, 1e-12);
    // A parabola through three points, a line through two.
    let parabola = signal(&[[0.0, 1.0], [1.0, 2.0], [3.0, 10.0]], Interpolation::Cubic, Beyond::Hold);
    near(parabola.apply(2.0), 5.0, 1e-14);
    assert_eq!(signal(&[[0.0, 1.0], [2.0, 5.0]], Interpolation::Cubic, Beyond::Hold).apply(0.5), 2.0);
}

/// Between neighbouring cubics value, slope and curvature agree, and at the ends as the kind of spline says.
#[test]
fn splines_are_smooth_at_their_points() {
    let rough = sampled(|x| (7.0 * x).sin() + (13.0 * x).cos());
    let spline = signal(&rough, Interpolation::Cubic, Beyond::Hold);
    let third = |row: usize| spline.cubics[row][3];
    near(third(0), third(1), 1e-11);
    near(third(5), third(6), 1e-11);
    let mut ring = rough.clone();
    ring[7][1] = ring[0][1];
    let ring = signal(&ring, Interpolation::Cubic, Beyond::Repeat);
    for (k, curve) in [&spline, &ring].into_iter().enumerate() {
        let count = curve.cubics.len();
        let scale = 1e-11;
        for row in 0..count - 1 + k {
            let h = UNEVEN[row + 1] - UNEVEN[row];
            let next = &curve.cubics[(row + 1) % count];
            for order in 0..3 {
                near(value(&derived(&curve.cubics[row], order), h), derived(next, order)[0], scale);
            }
        }
    }
    // Periods of six.
    for x in [-13.1, -6.7, 0.2, 4.9, 11.0, 600.3] {
        let back = x - 6.0 * ((x + 1.0) / 6.0_f64).floor();
        (0..3).for_each(|k| near(jet(&ring, x)[k], jet(&ring, back)[k], 1e-9));
    }
    let pair = signal(&[[0.0, 1.0], [1.0, 3.0], [2.0, 1.0]], Interpolation::Cubic, Beyond::Repeat);
    [0.0, 1.0, 7.0].into_iter().for_each(|x| near(jet(&pair, x)[1], 0.0, 1e-14));
}

#[test]
fn a_spline_converges_with_the_fourth_power() {
    let error = |n: i32| {
        let points: Vec<_> = (0..=n).map(|k| 3.0 * f64::from(k) / f64::from(n)).map(|x| [x, (2.0 * x).sin()]).collect();
        let spline = signal(&points, Interpolation::Cubic, Beyond::Hold);
        (0..500).map(|k| 0.006 * f64::from(k)).map(|x| (spline.apply(x) - (2.0 * x).sin()).abs()).fold(0.0, f64::max)
    };
    let rate = (error(40) / error(80)).log2();
    assert!((3.7..4.5).contains(&rate), "{rate}");
}

/// Values between, at and beyond the points; at a point the slope is that to its right.
#[test]
fn lines_and_steps() {
    let points = [[0.0, 1.0], [2.0, 5.0], [3.0, 4.0]];
    let expect = |signal: &Signal, all: &[[f64; 3]]| {
        all.iter().for_each(|[x, y, slope]| assert_eq!(jet(signal, *x), [*y, *slope, 0.0], "at {x}"));
        assert!(signal.apply(f64::NAN).is_nan());
    };
    let line = [[0.0, 1.0, 2.0], [1.0, 3.0, 2.0], [2.0, 5.0, -1.0]];
    let lines = signal(&points, Interpolation::Linear, Beyond::Hold);
    expect(&lines, &[&line[..], &[[-1.0, 1.0, 0.0], [3.0, 4.0, 0.0], [9.0, 4.0, 0.0]]].concat());
    let cycle = signal(&points, Interpolation::Linear, Beyond::Repeat);
    expect(&cycle, &[&line[..], &[[3.0, 1.0, 2.0], [-1.0, 5.0, -1.0], [-2.0, 3.0, 2.0], [31.0, 3.0, 2.0]]].concat());
    let steps = signal(&points, Interpolation::Previous, Beyond::Hold);
    expect(&steps, &[[-1.0, 1.0, 0.0], [1.9, 1.0, 0.0], [2.0, 5.0, 0.0], [3.0, 4.0, 0.0], [9.0, 4.0, 0.0]]);
    let held = signal(&points, Interpolation::Cubic, Beyond::Hold);
    expect(&held, &[[-1.0, 1.0, 0.0], [3.0, 4.0, 0.0], [9.0, 4.0, 0.0]]);
    let ended = signal(&points, Interpolation::Linear, Beyond::Error);
    assert!(ended.apply(-1e-9).is_nan() && ended.apply(3.0 + 1e-9).is_nan());
    assert_eq!([ended.apply(0.0), ended.apply(3.0)], [1.0, 4.0]);
    near(ended.apply(3.0_f64.next_up()), 4.0, 1e-14);
    let undefined = |x: f64| ended.is_undefined_on(ended.piece(x).unwrap());
    assert_eq!([-1.0, 0.0, 1.0, 3.0, 4.0].map(undefined), [true, false, false, false, true]);
}

/// Thresholds that repeat are counted through, whatever the rounding of the period.
#[test]
fn pieces_of_periods() {
    let cycle = signal(&[[0.1, 0.0], [0.2, 1.0], [0.4, 0.0]], Interpolation::Linear, Beyond::Repeat);
    let thresholds = cycle.thresholds();
    for k in -3000..3000 {
        let x = 0.1 + 0.037 * f64::from(k);
        let piece = thresholds.piece(x).unwrap();
        let [low, high] = [piece as usize / 2 - 1, piece as usize / 2].map(|k| thresholds.get(k).unwrap());
        assert!(piece % 2 == 1 && high == x || low < x && x < high, "{x} in {low}..{high}");
        let at = thresholds.get(piece as usize / 2).unwrap();
        assert_eq!(thresholds.piece(at).unwrap() % 2, 1, "{at}");
    }
    assert!(thresholds.piece(1e9).is_none() && cycle.piece(f64::INFINITY).is_none());
}

#[test]
fn every_interval_is_found() {
    let spline = signal(&sampled(f64::exp), Interpolation::Cubic, Beyond::Hold);
    for k in -300..800 {
        let x = 0.01 * f64::from(k);
        let naive = UNEVEN[1..7].iter().filter(|knot| **knot <= x).count();
        assert_eq!(spline.interval(x), naive, "{x}");
    }
}

#[test]
fn enclosures_contain_all_samples_and_are_tight() {
    let points: Vec<_> = (0..200).map(f64::from).map(|x| [x + 0.3 * x.sin(), (x * x).sin()]).collect();
    let mut ring = points.clone();
    ring[199][1] = ring[0][1];
    let curves = [(points, Beyond::Hold), (ring, Beyond::Repeat)].map(|(p, b)| signal(&p, Interpolation::Cubic, b));
    for curve in &curves {
        for (from, to) in [(0.5, 0.6), (3.0, 4.5), (17.0, 88.0), (150.0, 198.0), (190.0, 260.0), (-500.0, 900.0)] {
            let inside = curve.thresholds().get(0).is_none() || to < 198.5 && from > 0.0;
            let y = curve.apply(Taylor::running(Interval::new(from, to)));
            let samples = (0..=20_000).map(|k| from + (to - from) * f64::from(k) / 20_000.0);
            let mut found = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
            for x in samples.filter(|_| inside) {
                let jet = jet(curve, x);
                (0..3).for_each(|k| found[k] = hull(found[k], [jet[k]; 2]));
            }
            for (k, found) in found.into_iter().enumerate().filter(|_| inside) {
                let bounds = [y.x, y.d, y.dd][k];
                let slack = 1e-9 * (1.0 + found[1] - found[0]);
                assert!(bounds.low <= found[0] + slack && found[1] <= bounds.high + slack, "{bounds:?} {found:?}");
                // Value and slope by the formula of the chain; a curvature adds slope times t'' = 0.
                let size = bounds.width() - (found[1] - found[0]);
                assert!(size < 0.05 * (found[1] - found[0]) + 1e-9, "order {k} of {from}..{to}: {bounds:?} {found:?}");
            }
        }
    }
}

#[test]
fn bad_points_are_refused() {
    let refused = |points: &[[f64; 2]], beyond| Signal::new("x", points, Interpolation::Cubic, beyond).unwrap_err();
    assert_eq!(refused(&[], Beyond::Hold), PointsError::TooFew);
    assert_eq!(refused(&[[0.0, 1.0]], Beyond::Hold), PointsError::TooFew);
    assert_eq!(refused(&[[0.0, 1.0], [0.0, 2.0]], Beyond::Hold), PointsError::NotIncreasing(1));
    assert_eq!(refused(&[[0.0, -1e308], [1.0, 1e308]], Beyond::Hold), PointsError::NotFinite);
    assert_eq!(refused(&[[f64::NAN, 1.0], [0.0, 2.0]], Beyond::Hold), PointsError::NotFinite);
    assert_eq!(refused(&[[0.0, 1.0], [1.0, 2.0]], Beyond::Repeat), PointsError::EndsDiffer);
}
