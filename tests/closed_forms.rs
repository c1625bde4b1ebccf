//! Shipped scenes against closed forms, elliptic functions and equations in minimal coordinates.

use crate::scenes::{Run, dop853, load, models, parse, shipped};
use holonom::analysis::Recorder;
use holonom::math::Scalar;
use holonom::simulate::{Span, simulate};
use holonom::system::Equations;

/// What errors of 1e-13 a step add up to over some hundred steps of motions that amplify them mildly.
const CLOSE: f64 = 1e-10;

/// x, y and the force in the rod at t = 0.5, 1, ... 10 s, by Jacobi's elliptic functions (mpmath, 60 digits).
const PENDULUM: [[f64; 3]; 20] = [
    [0.3910487915505464, -0.9203699487851922, 27.086487592748206],
    [-0.9862917511318753, -0.16501085312554117, 4.856269407484676],
    [-0.8841323602843036, -0.4672365241482158, 13.750770905681993],
    [0.7935661953433217, -0.6084839304437916, 17.907682072960785],
    [0.9963344039582815, -0.0855438804888806, 2.5175564027877564],
    [-0.1766517899228382, -0.9842734097378926, 28.96716644858618],
    [-0.9999136401476614, -0.013142003144616169, 0.3867691525460538],
    [-0.5775636282486314, -0.8163456714678389, 24.025053111298497],
    [0.963293017703455, -0.2684521596928791, 7.900547059761432],
    [0.9423054350437573, -0.3347543384140006, 9.851820179524037],
    [-0.6652925965551312, -0.7465827221205508, 21.971929512007808],
    [-0.9994975399393528, -0.03169649278992706, 0.9328277828075535],
    [-0.05119453982595532, -0.9986886997918865, 29.391408434875217],
    [0.9986187791754798, -0.052540782998298716, 1.5462752436399312],
    [0.7274587213083755, -0.6861514474169557, 20.193437097481006],
    [-0.9198579831077385, -0.39225156585151255, 11.543963583010015],
    [-0.975625999871729, -0.2194399880930752, 6.458118849579203],
    [0.49837370905755896, -0.8669623095153627, 25.514700769037123],
    [0.999991915252911, -0.004021122830114612, 0.11834164489027303],
    [0.2750874625761169, -0.961419205099125, 28.29456720606725],
];

#[test]
fn pendulum_follows_the_elliptic_functions() {
    let run = shipped("pendulum", &[]).tight(1e-13, 10.0, 0.5);
    rows_agree(&run, &["x", "y"], &PENDULUM.map(|[x, y, _]| vec![x, y]), CLOSE);
    // The force falls with the square of the speed, so it carries ten times the error.
    rows_agree(&run, &["rod_force"], &PENDULUM.map(|[_, _, force]| vec![force]), 10.0 * CLOSE);
}

/// The rows after the start hold these values of the named columns.
fn rows_agree(run: &Run, names: &[&str], expected: &[Vec<f64>], tolerance: f64) {
    assert_eq!(run.times().len(), expected.len() + 1);
    for (i, name) in names.iter().enumerate() {
        for (row, (t, value)) in run.times().into_iter().zip(run.column(name)).enumerate().skip(1) {
            let error = (value - expected[row - 1][i]).abs();
            assert!(error < tolerance, "{name} at {t} s is off by {error:e}");
        }
    }
}

/// A uniform rod of 1 kg and 1 m swings down from the horizontal: along itself its pin gives m (g sin - l w^2/2) with
/// w^2 = -3 g/l sin, across m g cos/4.
#[test]
fn a_pin_reacts_along_and_across_the_rod() {
    let output = |axis: &str| {
        format!(
            r#"{{ "name": "{axis}", "measure": "reaction", "of": "O", "relative_to": "rod", "component": "{axis}" }}"#
        )
    };
    let run = parse(&format!(
        r#"{{ "name": "rod", "dimension": 2, "gravity": [0, -9.81], "simulation": {{ "t_end": 2 }},
             "ground": {{ "markers": {{ "O": [0, 0] }} }},
             "bodies": [{{ "name": "rod", "type": "rigid", "mass": 1, "inertia": "1/12", "markers": {{ "A": [-0.5, 0] }},
                          "initial": {{ "position": [0.5, 0] }} }}],
             "joints": [{{ "name": "O", "type": "revolute", "between": ["ground.O", "rod.A"] }}],
             "outputs": [{{ "name": "angle", "measure": "angle", "of": "rod" }}, {}, {}] }}"#,
        output("x"),
        output("y")
    ))
    .tight(1e-13, 2.0, 0.05);
    for (row, angle) in run.column("angle").into_iter().enumerate() {
        let along = 2.5 * 9.81 * angle.sin();
        let across = 9.81 / 4.0 * angle.cos();
        let off = (run.column("x")[row] - along).abs().max((run.column("y")[row] - across).abs());
        assert!(off < 100.0 * CLOSE, "row {row} is off by {off:e} N");
    }
}

#[test]
fn top_precesses_steadily_at_both_roots() {
    let (g, m, l, i1, i3, theta, spin): (f64, f64, f64, f64, f64, f64, f64) = (9.81, 0.5, 0.08, 6e-4, 8e-4, 0.5, 200.0);
    // a p^2 - b p + c = 0
    let a = (i1 + m * l * l) * theta.cos();
    let b = i3 * spin;
    let c = m * g * l;
    let root = (b * b - 4.0 * a * c).sqrt();
    for rate in [2.0 * c / (b + root), (b + root) / (2.0 * a)] {
        let run = shipped("spinning_top", &[("precession", rate)]).tight(1e-13, 1.0, 0.01);
        assert!(run.worst("nutation", |_| theta) < CLOSE);
        assert!(run.worst("precession", |t| rate * t) < CLOSE);
    }
}

/// Nutation and precession angle at t = 0.1, 0.25, 0.5, 0.75, 1 s: cos(nutation) by sn^2, the precession by quadrature
/// (mpmath, 40 digits). From rest (a cusp) and from a backward rate (loops).
const TOP: [(f64, [[f64; 2]; 5]); 2] = [
    (
        0.0,
        [
            [0.559937958684942, 0.2951353056217259],
            [0.5659323678165163, 0.6465784933107043],
            [0.5000001801413989, 1.2935754208187336],
            [0.565932044105434, 1.9397354808031047],
            [0.5000007205633903, 2.5871508389381996],
        ],
    ),
    (
        -3.0,
        [
            [0.6284637134831234, 0.33004165463760127],
            [0.6415103910519837, 0.6489469183739635],
            [0.5003832078112463, 1.2718127400062256],
            [0.6408898789517824, 1.9467992526078697],
            [0.5015275872754583, 2.5438209991464613],
        ],
    ),
];

#[test]
fn top_nutates_as_the_elliptic_functions_say() {
    for (rate, rows) in TOP {
        let run = shipped("spinning_top", &[("precession", rate)]).tight(1e-13, 1.0, 0.05);
        let nutation = run.column("nutation");
        let precession = run.column("precession");
        for (row, [theta, phi]) in [2, 5, 10, 15, 20].into_iter().zip(rows) {
            let off = nutation[row] - theta;
            let ahead = precession[row] - phi;
            assert!(off.abs() < CLOSE && ahead.abs() < CLOSE, "from {rate}, row {row}: {off:e}, {ahead:e}");
        }
        assert!(run.worst("spin", |_| 200.0) < CLOSE);
    }
}

#[test]
fn free_body_turns_as_euler_says() {
    let body = parse(
        r#"{ "name": "free_body", "dimension": 3, "simulation": { "t_end": 10 },
             "bodies": [{ "name": "body", "type": "rigid", "mass": 1, "inertia": [1, 2, 3],
                          "initial": { "angular_velocity": [0.4, 0, 1.2] } }],
             "outputs": [{ "name": "named", "measure": "expression", "value": "body.wy" }] }"#,
    );
    let run = body.tight(1e-13, 10.0, 1.0);
    // One name means one thing in columns and in expressions.
    assert!(run.column("named").iter().zip(run.column("body.wy")).all(|(a, b)| (a - b).abs() < CLOSE));
    // (0.4 cn, 0.4 sn, 1.2 dn)(1.2 t | 1/27) at t = 1, 2, 5, 10 s, by mpmath.
    let expected = [
        (1, [0.14791503353107383, 0.37164652945440146, 1.1806606705773537]),
        (2, [-0.2875006792986565, 0.27810674102367794, 1.189209350871016]),
        (5, [0.37678538179469556, -0.13428617228078812, 1.1974928286402073]),
        (10, [0.3101702253899686, -0.25257559518198924, 1.191106707886754]),
    ];
    for (row, w) in expected {
        for (name, w) in ["body.wx", "body.wy", "body.wz"].into_iter().zip(w) {
            assert!((run.column(name)[row] - w).abs() < CLOSE, "{name} at {row} s");
        }
    }
}

#[test]
fn universal_joint_turns_unevenly_and_two_of_them_evenly() {
    let w = 10.0;
    let bend = std::f64::consts::PI / 6.0;
    let run = shipped("universal_shaft", &[]).tight(1e-12, 1.25, 0.01);
    let speed = |t: f64| w * bend.cos() / (1.0 - (bend.sin() * (w * t).cos()).powi(2));
    assert!(run.worst("cardan_speed", speed) < CLOSE);
    // tan(angle) = tan(w t)/cos(bend), as the part by which it runs ahead: no jump at a quarter turn.
    let angle = |t: f64| {
        let (s, c) = (w * t).sin_cos();
        w * t + (s * c * (1.0 / bend.cos() - 1.0)).atan2(c * c + s * s / bend.cos())
    };
    assert!(run.worst("cardan_angle", angle) < CLOSE);
    assert!(run.worst("output_angle", |t| w * t) < CLOSE);
    assert!(run.worst("output_speed", |_| w) < CLOSE);
    // The motor's power speeds up the cardan shaft, whose axial moment is 6 kg (0.03 m)^2/2.
    let moment = 6.0 * 0.03f64.powi(2) / 2.0;
    let rate = |t: f64| -(speed(t) * bend.sin()).powi(2) * (2.0 * w * t).sin() / bend.cos();
    assert!(run.worst("drive_torque", |t| moment * speed(t) * rate(t) / w) < CLOSE);
}

#[test]
fn two_masses_swing_at_five_radians_a_second() {
    let run = shipped("two_mass", &[]).tight(1e-13, 5.0, 0.05);
    assert!(run.worst("x1", |t| 0.1 * (5.0 * t).cos()) < CLOSE);
    // The link pushes the second mass: m2 x''.
    assert!(run.worst("link_force", |t| -7.5 * (5.0 * t).cos()) < 100.0 * CLOSE);
    let damped = shipped("two_mass", &[("c1", 2.0)]).tight(1e-13, 5.0, 0.05);
    let decay = 0.25;
    let omega = (25.0f64 - 0.0625).sqrt();
    let x = |t: f64| 0.1 * (-decay * t).exp() * ((omega * t).cos() + decay / omega * (omega * t).sin());
    assert!(damped.worst("x1", x) < CLOSE);
}

/// (5/3) m l^2 p'' + c l^2 sin(p/2)^2 p' + V'(p) = 0 with unit mass and length.
struct FourBar {
    damping: f64,
}

impl Equations for FourBar {
    fn size(&self) -> (usize, usize) {
        (1, 0)
    }
    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass[0] = S::constant(5.0 / 3.0);
    }
    fn force<S: Scalar>(&self, _t: S, q: &[S], v: &[S], f: &mut [S]) {
        let s = (q[0] * 0.5).sin();
        let c = (q[0] * 0.5).cos();
        let stretch = c * 2.0 - std::f64::consts::SQRT_2;
        f[0] = stretch * s * 100.0 - q[0].cos() * (2.0 * 9.81) - s * s * v[0] * self.damping;
    }
    fn phi<S: Scalar>(&self, _t: S, _q: &[S], _phi: &mut [S]) {}
}

#[test]
fn four_bar_follows_its_equation_in_the_crank_angle() {
    for damping in [0.0, 0.5] {
        let run = shipped("four_bar_spring", &[("c1", damping)]).tight(1e-13, 5.0, 0.05);
        let alone = reduced(FourBar { damping }, (1.1, 1.0), 5.0, 0.05);
        let angle = alone.column("q1");
        let rate = alone.column("v1");
        rows_agree(&run, &["crank_angle"], &rows(&angle), 1e-9);
        // Rates are five times as large.
        rows_agree(&run, &["crank_rate"], &rows(&rate), 5e-9);
    }
}

fn rows(column: &[f64]) -> Vec<Vec<f64>> {
    column[1..].iter().map(|value| vec![*value]).collect()
}

/// A motion of one coordinate without constraints.
fn reduced(equations: impl Equations, (q, v): (f64, f64), end: f64, output_step: f64) -> Run {
    let mut recorder = Recorder::new(&equations);
    let span = Span { start: 0.0, end, output_step };
    let outcome = simulate(&equations, &dop853(1e-13), span, (&[q], &[v]), &mut recorder).unwrap();
    assert_eq!(outcome.failure, None);
    Run { record: recorder.finish(), outcome }
}

/// angle'' = -stiffness sin(angle)
struct Swing {
    stiffness: f64,
}

impl Equations for Swing {
    fn size(&self) -> (usize, usize) {
        (1, 0)
    }
    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass[0] = S::one();
    }
    fn force<S: Scalar>(&self, _t: S, q: &[S], _v: &[S], f: &mut [S]) {
        f[0] = q[0].sin() * -self.stiffness;
    }
    fn phi<S: Scalar>(&self, _t: S, _q: &[S], _phi: &mut [S]) {}
}

#[test]
fn redundant_parallelogram_swings_as_a_pendulum() {
    let run = shipped("parallelogram_redundant", &[]).tight(1e-13, 5.0, 0.05);
    let stiffness = (1.5 * 0.4 + 2.0) / (0.4 + 2.0) * 9.81 / 0.5;
    let alone = reduced(Swing { stiffness }, (1.0, 0.0), 5.0, 0.05);
    rows_agree(&run, &["angle"], &rows(&alone.column("q1")), CLOSE);
    assert!(run.worst("beam_tilt", |_| 0.0) < CLOSE);
    assert_eq!(run.outcome.statistics.rank_deficient, run.outcome.statistics.steps + 1);
}

#[test]
fn gears_keep_their_ratio() {
    let run = shipped("gear_pair", &[]).tight(1e-13, 5.0, 0.05);
    let small = run.column("small_angle");
    for (small, large) in small.iter().zip(run.column("large_angle")) {
        // Round-off of angles below one.
        assert!((18.0 * small + 45.0 * large).abs() < 1e-13, "{small} {large}");
    }
    let j1 = 0.09 * 0.09 / 2.0;
    let j2 = 4.0 * 0.225 * 0.225 / 2.0;
    let omega = (1.15 / (j1 + j2 * (18.0f64 / 45.0).powi(2))).sqrt();
    assert!(run.worst("small_angle", |t| 0.5 * (omega * t).cos()) < CLOSE);
}

#[test]
fn piston_follows_the_crank() {
    let run = shipped("slider_crank", &[]).tight(1e-12, 1.0, 0.01);
    for (angle, x) in run.column("crank_angle").iter().zip(run.column("piston_x")) {
        let expected = 0.15 * angle.cos() + (0.16 - (0.15 * angle.sin()).powi(2)).sqrt();
        // Round-off: positions are projected at every row.
        assert!((x - expected).abs() < 1e-13, "at {angle} rad: {x} against {expected}");
    }
}

#[test]
fn bead_circles_at_a_rate_without_regard_to_the_radius() {
    let omega = (9.81f64 / 0.5).sqrt();
    for radius in [0.1, 0.3, 0.8] {
        let run = shipped("bead_in_bowl", &[("boost", 1.0), ("r0", radius)]).tight(1e-13, 5.0, 0.05);
        assert!(run.worst("bead.x", |t| radius * (omega * t).cos()) < CLOSE);
        assert!(run.worst("bead.y", |t| radius * (omega * t).sin()) < CLOSE);
    }
    let run = shipped("bead_in_bowl", &[]).tight(1e-13, 5.0, 0.05);
    assert!(run.worst("angular_momentum", |_| 0.2 * 0.3 * 1.3 * 0.3 * omega) < CLOSE);
}

#[test]
fn block_on_a_bushing_swings_along_each_axis_by_itself() {
    let run = shipped("bushing_block", &[]).tight(1e-13, 1.0, 0.01);
    let omega = 1000.0f64.sqrt();
    let sag = 9.81 / 1000.0;
    assert!(run.worst("x", |t| 0.01 * (omega * t).cos()) < CLOSE);
    assert!(run.worst("y", |t| -0.005 * (omega * t).cos()) < CLOSE);
    assert!(run.worst("z", |t| sag * ((omega * t).cos() - 1.0)) < CLOSE);
    // Torque -kr sin(a) cos(a): twice the angle swings as a pendulum.
    let twice = reduced(Swing { stiffness: 2500.0 }, (0.04, 0.0), 1.0, 0.01);
    rows_agree(&run, &["turn"], &rows(&twice.column("q1").iter().map(|x| 0.5 * x).collect::<Vec<_>>()), CLOSE);
}

#[test]
fn quarter_car_stands_still_without_a_bump() {
    let run = shipped("quarter_car", &[("bump", 0.0)]).tight(1e-12, 2.5, 0.05);
    // Round-off of forces of 4 kN on stiffnesses of 34 kN/m.
    assert!(run.worst("body_height", |_| 0.752) < 1e-14 && run.worst("wheel_height", |_| 0.352) < 1e-14);
    assert!(run.worst("tyre_load", |_| 438.0 * 9.81) < 1e-10);
    assert!(run.worst("strut_force", |_| -400.0 * 9.81) < 1e-10);
}

/// Beams whose fast waves, or the damping of these, would cost an explicit method millions of steps.
const STIFF: [&str; 7] = [
    "bathe_bend",
    // Three rows of its hinges depend on others, and which ones they are changes along the motion.
    "bennett",
    "flexible_four_bar",
    "flexible_slider_crank_fe",
    "princeton_beam",
    "right_angle_cantilever",
    "spin_up_beam",
];

/// Scenes that are followed for a tenth of their time: they swing fast, or pass many states.
const LONG: [&str; 5] = ["flexible_robot_arm", "flyball_governor", "n_four_bar", "rotating_blade", "rotating_shaft"];

fn stem(path: &std::path::Path) -> &str {
    path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default()
}

/// Kinetic + potential = initial + work, for all shipped scenes that are not stiff, also those that pass singular
/// positions, at a tolerance of 1e-11.
#[test]
fn energy_is_accounted_for() {
    let conservative = models().into_iter().filter(|path| !STIFF.contains(&stem(path))).map(|path| (path, None));
    let dissipative = [
        ("two_mass", "c1", 2.0),
        ("four_bar_spring", "c1", 0.5),
        ("gear_pair", "c", 0.02),
        ("bushing_block", "c", 5.0),
        ("slider_crank", "torque", 0.5),
    ];
    let dissipative =
        dissipative.map(|(name, parameter, value)| (crate::scenes::model(name), Some((parameter, value))));
    for (path, change) in conservative.chain(dissipative) {
        let ready = load(&path, change.as_slice());
        let end = if LONG.contains(&stem(&path)) { 0.1 } else { 1.0 } * ready.span().end;
        let run = ready.tight(1e-11, end, end / 10.0);
        let energy = run.record.energy.expect("scenes state their potential");
        // The third derivative of a measured road jumps at its points.
        let most = if stem(&path) == "half_car" { 1e-8 } else { 1e-9 };
        assert!(energy.relative_max_error.unwrap() < most, "{path:?} {change:?}: {energy:?}");
    }
}
