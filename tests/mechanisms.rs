//! Shipped mechanisms against references computed with 34 digits, closed loops and balances of power and force.

use crate::scenes::{Run, dop853, shipped};
use holonom::math::{Dual, Scalar, Taylor};
use holonom::method_spec::MethodSpec;
use holonom::report::check;
use holonom::simulate::{Method, Span};
use std::f64::consts::{PI, TAU};

/// theta1, theta2, omega1, omega2 and lambda of the robot arm at t = 1, 2, ... 10 s: extrapolation with 34 digits, by
/// two formulations that agree in 23.
const ROBOT_ARM: [[f64; 5]; 10] = [
    [-0.20642744756529702, 0.6562584530951424, -5.1419763981015665, 11.19796745297128, -674.3666994724398],
    [3.0576302141690714, -0.5901569754859715, 6.184750424076582, -14.655218270181251, -1593.1212511358094],
    [1.0545673268907656, 1.961385534255837, 4.990199962613437, -2.5785677597910244, -19.577372498778665],
    [0.1943592114243899, 0.4919469131850226, -7.316383253177764, 16.106838842955895, -1973.3750344843797],
    [3.8209681742893684, -2.085524577121453, 2.4417740544603053, -11.106296466727086, -2646.310462111629],
    [1.4522884940027099, -2.7904889046172445, -0.7794456848261592, 0.5731441685366739, -307.5620470647918],
    [-0.47865529655014966, 1.1018531954076636, -4.822300513825954, 10.498098487454305, -699.0957236357779],
    [3.4322504500602005, -1.3246208564926991, 4.379027536742729, -13.549681315999788, -1914.6654079659445],
    [1.5761245279572516, 1.609903421298295, 5.341005449362771, -5.575754225845745, -0.21700019672176674],
    [1.1065356342522548, 2.0096713719642834, 5.597507174666239, -2.8182508678092315, 17.319605343733983],
];

#[test]
fn robot_arm_follows_the_reference() {
    let method = Method { projection: MethodSpec::named("exact"), ..dop853(1e-13) };
    let run = shipped("robot_arm", &[]).run(&method, Span { start: 0.0, end: 10.0, output_step: 1.0 });
    // A perturbation grows about 1e4 times over the 10 s; omega changes by up to 15 1/s^2, the force by 1e3 N s.
    let bounds = [("theta1", 2e-10), ("theta2", 2e-10), ("omega1", 1e-9), ("omega2", 1e-9), ("drive_force", 3e-7)];
    for (k, (name, bound)) in bounds.into_iter().enumerate() {
        // M v' + G^T lambda = f: the drive pushes with -lambda.
        let sign = if name == "drive_force" { -1.0 } else { 1.0 };
        let error = errors(&run, name, |row| sign * ROBOT_ARM[row - 1][k]);
        assert!(error < bound, "{name} is off by {error:e}");
    }
    assert!(run.worst("end_y", |t| (0.5 * t).sin().powi(2)) < 1e-14, "held to round-off by the projection");
}

/// Largest error of a column over the rows after the start.
fn errors(run: &Run, name: &str, expected: impl Fn(usize) -> f64) -> f64 {
    let rows = run.column(name).into_iter().enumerate().skip(1);
    rows.map(|(row, found)| (found - expected(row)).abs()).fold(0.0, f64::max)
}

/// t, then alpha, beta, their rates and the points P1 to P4 of Bricard's mechanism: the single equation of motion in
/// alpha, with 34 digits, that agrees in 24 with the closure equations of five angles.
const BRICARD: [(usize, [f64; 16]); 3] = [
    (
        1,
        [
            1.035028459518062,
            -0.48062110417718473,
            2.0364153809699697,
            -0.33893339921577864,
            0.5105014611872197,
            0.0,
            -0.8598768854468142,
            0.27448131926462305,
            -0.886707938734672,
            -0.46233000268737606,
            0.5105014611872197,
            -1.6491675993948063,
            0.14012311455318582,
            0.0,
            -0.886707938734672,
            0.537669997312624,
        ],
    ),
    (
        5,
        [
            6.725995973259376e-05,
            -6.725543613466414e-05,
            0.016229914864180062,
            -0.016227731837584206,
            0.9999999977380489,
            0.0,
            -6.725995968188085e-05,
            0.999932742302117,
            -0.9999999977383531,
            -6.725543608396145e-05,
            0.9999999977380489,
            -1.0000672576978828,
            0.9999327400403181,
            0.0,
            -0.9999999977383531,
            0.999932744563916,
        ],
    ),
    (
        10,
        [
            0.00026904888332464653,
            -0.0002689765154926398,
            0.03246201174099792,
            -0.03244455105154236,
            0.9999999638063494,
            0.0,
            -0.00026904888007869273,
            0.9997309873038354,
            -0.9999999638258172,
            -0.0002689765122493046,
            0.9999999638063494,
            -1.0002690126961633,
            0.9997309511199213,
            0.0,
            -0.9999999638258172,
            0.9997310234877507,
        ],
    ),
];

fn bricard_columns() -> Vec<String> {
    let angles = ["alpha", "beta", "alpha_rate", "beta_rate"].map(str::to_string);
    let points = (1..=4).flat_map(|i| ["x", "y", "z"].map(|axis| format!("P{i}_{axis}")));
    angles.into_iter().chain(points).collect()
}

fn bricard_agrees(method: &Method, bound: f64) {
    bricard_agrees_until(10.0, method, bound);
}

fn bricard_agrees_until(end: f64, method: &Method, bound: f64) {
    let run = shipped("bricard", &[]).run(method, Span { start: 0.0, end, output_step: 1.0 });
    for (row, expected) in BRICARD.into_iter().filter(|(row, _)| *row as f64 <= end) {
        for (name, expected) in bricard_columns().iter().zip(expected) {
            let error = (run.column(name)[row] - expected).abs();
            let formulation = &method.formulation;
            let integrator = &method.integrator;
            assert!(error < bound, "{name} at {row} s is off by {error:e} with {formulation} {integrator}");
        }
    }
    // The hinge angles keep to their curve.
    for (alpha, beta) in run.column("alpha").into_iter().zip(run.column("beta")) {
        let a = alpha.sin();
        let b = beta.sin();
        assert!((a + b + a * b).abs() < bound, "at {alpha}, {beta}");
    }
    // One row too many at every accepted state; penalties do not ask.
    if !method.formulation.name.contains("penalty") && !method.formulation.name.contains("augmented") {
        assert_eq!(run.outcome.statistics.rank_deficient, run.outcome.statistics.steps + 1);
    }
}

/// Minimal coordinates, with a base that stays through a step.
#[test]
fn bricard_follows_the_reference_in_minimal_coordinates() {
    let method =
        Method { formulation: MethodSpec::named("null_space"), projection: MethodSpec::named("none"), ..dop853(1e-12) };
    bricard_agrees(&method, 2e-11);
}

/// Reactions too: the row that is redundant on the manifold only is left out of the stages beside it.
#[test]
fn bricard_follows_the_reference_with_multipliers() {
    bricard_agrees(&dop853(1e-12), 2e-11);
    bricard_agrees(&Method { formulation: MethodSpec::named("udwadia_kalaba"), ..dop853(1e-12) }, 2e-11);
    bricard_agrees(&shipped("bricard", &[]).0.method, 1e-7);
}

/// Each at its accuracy: errors of velocities are some ten times those of the points.
#[test]
fn bricard_follows_the_reference_with_every_kind_of_method() {
    let method = |formulation: &str, integrator: &str, projection: &str| Method {
        formulation: MethodSpec::parse(formulation).unwrap(),
        integrator: MethodSpec::parse(integrator).unwrap(),
        projection: MethodSpec::named(projection),
        ..dop853(1e-8)
    };
    let fixed = |formulation: &str, integrator: &str, projection: &str, step: f64| Method {
        step: Some(step),
        ..method(formulation, integrator, projection)
    };
    // Some hundred tolerances in the rates, by what steps add up to over 10 s.
    for (formulation, integrator) in [("index1", "dopri5"), ("index2", "phem56"), ("index1", "radau_iia")] {
        bricard_agrees(&method(formulation, integrator, "manifold"), 5e-6);
    }
    // Orders 4 and 5: about h^4 and h^5 over 1 s.
    bricard_agrees_until(1.0, &fixed("index1", "rk4", "manifold", 0.002), 1e-9);
    bricard_agrees_until(1.0, &fixed("index1", "rk4", "none", 0.002), 1e-8);
    bricard_agrees_until(1.0, &fixed("index2", "hem5", "manifold", 0.005), 1e-9);
    // O(1/penalty) of the accelerations.
    bricard_agrees_until(1.0, &fixed("penalty", "rk4", "none", 0.001), 1e-3);
    bricard_agrees_until(1.0, &fixed("augmented_lagrangian", "rk4", "manifold", 0.001), 1e-6);
}

#[test]
fn check_names_the_redundant_row_of_bricard() {
    let found = check(&shipped("bricard", &[]).0);
    assert_eq!((found.velocities, found.constraints, found.rank, found.degrees_of_freedom), (30, 30, 29, 1));
    let [row] = &found.redundant[..] else { panic!("{:?}", found.redundant) };
    // Hinges are alike, the last that closes the loop is the one too many.
    assert_eq!(row.joint, "P5");
    assert_eq!(row.follows_from, ["P0", "P1", "P2", "P3", "P4"]);
}

/// The spatial slider-crank at a crank angle: moment of inertia that the crank feels, potential energy, slider.
struct Spatial {
    inertia: f64,
    potential: f64,
    slider: f64,
}

/// By the loop in closed form: rod from the pin p to the slider x = sqrt(l^2 - |p|^2), direction u; its rate of turning
/// u x u' + s u with the spin s that keeps it square to (pin of the slider, e_x) x (pin of the rod, e_x x u).
fn spatial(angle: f64) -> Spatial {
    let r = 0.08;
    let l = 0.3;
    let y0 = 0.1;
    let z0 = 0.12;
    let rod = 0.5;
    let slider = 2.0;
    let i_crank = 1e-4;
    let i_axial = 4e-4;
    let i_cross = 4e-3;
    let turned = Dual::<f64, 1>::seeded(angle, 0);
    let y = turned.sin() * -r + y0;
    let z = turned.cos() * r + z0;
    let x = (-(y.square() + z.square()) + l * l).sqrt();
    let u = [x, -y, -z].map(|part| part.re / l);
    let rate = [x, -y, -z].map(|part| part.eps[0] / l);
    let cross = [u[1] * rate[2] - u[2] * rate[1], u[2] * rate[0] - u[0] * rate[2], u[0] * rate[1] - u[1] * rate[0]];
    let spin = -(cross[1] * u[1] + cross[2] * u[2]) / (u[1] * u[1] + u[2] * u[2]);
    let squares = |of: [f64; 3]| of.iter().map(|part| part * part).sum::<f64>();
    let centre = squares([x, y, z].map(|part| 0.5 * part.eps[0]));
    Spatial {
        inertia: i_crank
            + i_cross * squares(cross)
            + i_axial * spin * spin
            + rod * centre
            + slider * x.eps[0] * x.eps[0],
        // The crank's centre of mass is its bearing.
        potential: 9.81 * (rod * 0.5 * z.re + 0.12 * z0),
        slider: x.re,
    }
}

const SPATIAL_RATE: f64 = 6.0;

fn spatial_energy() -> f64 {
    let start = spatial(0.0);
    0.5 * start.inertia * SPATIAL_RATE * SPATIAL_RATE + start.potential
}

#[test]
fn spatial_slider_crank_closes_its_loop_and_keeps_its_energy() {
    let run = shipped("spatial_slider_crank", &[]).tight(1e-12, 5.0, 0.05);
    let columns = ["crank_angle", "crank_rate", "slider_x", "energy"].map(|name| run.column(name));
    assert!(columns[0].last().is_some_and(|angle| *angle > 8.0 * TAU), "eight turns");
    for (row, (angle, rate)) in columns[0].iter().zip(&columns[1]).enumerate() {
        let Spatial { inertia, potential, slider } = spatial(*angle);
        // Round-off: positions are projected.
        assert!((columns[2][row] - slider).abs() < 1e-14, "slider at {angle}");
        assert!((columns[3][row] - spatial_energy()).abs() < 1e-11, "energy at {angle}: {:e}", columns[3][row]);
        // Rates up to 23 rad/s; the energy of 0.7 J with its error of 1e-11 over inertias from 1e-3.
        let expected = (2.0 * (spatial_energy() - potential) / inertia).sqrt();
        assert!((rate - expected).abs() < 1e-9, "rate at {angle}: {rate} against {expected}");
    }
}

/// Time of a turn: the integral of 1/rate over the angle, periodic, so that the trapezoidal rule converges like 1e-14.
#[test]
fn spatial_slider_crank_takes_its_time_for_a_turn() {
    let points = 512;
    let slowness = (0..points).map(|k| {
        let Spatial { inertia, potential, .. } = spatial(TAU * f64::from(k) / f64::from(points));
        (inertia / (2.0 * (spatial_energy() - potential))).sqrt()
    });
    let turn = slowness.sum::<f64>() * TAU / f64::from(points);
    // Rows close enough for the angle to be followed from turn to turn.
    let run = shipped("spatial_slider_crank", &[]).tight(1e-12, 4.0 * turn, turn / 16.0);
    for (turns, angle) in run.column("crank_angle").into_iter().step_by(16).enumerate() {
        let error = angle - turns as f64 * TAU;
        assert!(error.abs() < 1e-10, "after {turns} turns: {error:e}");
    }
}

/// The offset slider-crank at t: piston, direction and turning of the rod, and energy.
struct Offset<S> {
    piston: S,
    rod: [S; 2],
    rod_angle: S,
    centre: [S; 2],
}

const OFFSET: (f64, f64, f64, f64) = (0.15, 0.4, 0.1, 30.0);

fn offset<S: Scalar>(t: S) -> Offset<S> {
    let (r, l, offset, w) = OFFSET;
    let x = (t * w).cos() * r;
    let y = (t * w).sin() * r;
    let sin = (-y + offset) * (1.0 / l);
    let cos = (-sin.square() + 1.0).sqrt();
    let centre = [x + cos * (0.5 * l), y + sin * (0.5 * l)];
    Offset { piston: x + cos * l, rod: [cos * l, sin * l], rod_angle: S::atan2(sin, cos), centre }
}

/// Power of weight and inertia over the crank's rate.
fn motor_torque(t: f64) -> f64 {
    let (r, l, _, w) = OFFSET;
    let Offset { piston, rod_angle, centre, .. } = offset(Taylor::<f64>::time(t));
    let along = |of: Taylor<f64>| of.d * of.dd;
    let rod = 0.8 * (along(centre[0]) + along(centre[1]) + l * l / 12.0 * along(rod_angle) + 9.81 * centre[1].d);
    let crank = 2.0 * 9.81 * 0.5 * r * w * (w * t).cos();
    (0.5 * along(piston) + rod + crank) / w
}

/// Moments on the rod about its centre: F on the piston by the pin, F + m (a + g) on the rod at the crank.
fn side_force(t: f64) -> f64 {
    let Offset { piston, rod, rod_angle, centre } = offset(Taylor::<f64>::time(t));
    let l = OFFSET.1;
    let force_x = 0.5 * piston.dd;
    let moment = 0.8 * l * l / 12.0 * rod_angle.dd - 0.5 * rod[1].x * (2.0 * force_x + 0.8 * centre[0].dd);
    let force_y = -moment / rod[0].x - 0.5 * 0.8 * (centre[1].dd + 9.81);
    0.5 * 9.81 - force_y
}

#[test]
fn offset_slider_crank_asks_of_motor_and_guide_what_the_balances_say() {
    let run = shipped("slider_crank_offset", &[]).tight(1e-12, 0.5, 0.01);
    assert!(run.worst("crank_angle", |t| 30.0 * t) < 1e-13, "held to round-off");
    assert!(run.worst("piston_x", |t| offset(t).piston) < 1e-14, "held to round-off");
    // Forces of 1e2 N follow from angles and rates of 15 rad and 30 rad/s at round-off.
    assert!(run.worst("motor_torque", motor_torque) < 1e-11);
    assert!(run.worst("side_force", side_force) < 1e-10);
}

/// The piston turns round where crank and rod are in line.
#[test]
fn offset_slider_crank_returns_quickly() {
    let (r, l, e, w) = OFFSET;
    let out = (e / (l + r)).asin();
    let back = PI + (e / (l - r)).asin();
    for angle in [out, back] {
        let run = shipped("slider_crank_offset", &[]).tight(1e-12, angle / w, angle / w);
        // Speeds are up to 5 m/s.
        assert!(run.column("piston_speed").last().is_some_and(|speed| speed.abs() < 1e-13));
    }
}
