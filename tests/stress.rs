//! Maps over extremes: the verdict of the robot arm on Baumgarte's gains, and what cells are called.

use crate::common::equations::robot_arm::{RobotArm, START};
use crate::common::{fixed, readings, until};
use holonom::clock::{self, Stopwatch, TICK};
use holonom::method_spec::MethodSpec;
use holonom::prepared::Overrides;
use holonom::study::stress::{
    AxisPlace, Cell, CellChange, CellQuantity, GainRun, Limits, Map, MapAxis, Status, StepVerdict, StressParameter,
    Stressed, Subject, find, maps, pair, stress,
};
use std::path::Path;
use std::sync::Mutex;
use std::time::Duration;

/// So many steps and rows for each cell, and no limit for all of them.
fn limits(cell: u32) -> Limits {
    Limits { cell: readings(cell), all: Duration::MAX }
}

fn parameter(name: &str) -> &'static StressParameter {
    find(name).unwrap()
}

fn scene(name: &str, overrides: Overrides) -> Subject<'static> {
    clock::count_readings();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("models").join(name).with_extension("json");
    Subject::load(&path, &overrides).unwrap()
}

fn named(subject: &Subject, map: &str) -> Map {
    maps(subject, &[map.to_string()]).unwrap().remove(0)
}

fn all(stressed: &Stressed, what: impl Fn(&Cell) -> bool) -> bool {
    stressed.cells.iter().all(what)
}

/// The numbers of the theory: equations in two angles, with the gains of the literature.
#[test]
fn the_verdict_on_baumgarte_in_numbers() {
    clock::count_readings();
    let method = fixed("index1", "rk4", "none", 0.01);
    let subject = Subject::of_equations("arm", &RobotArm, method, until(10.0), START.motion()).unwrap();
    let row = |formulation: &str, projection: &str| {
        let [formulation, projection] = [formulation, projection].map(|text| MethodSpec::parse(text).unwrap());
        AxisPlace::named("", vec![CellChange::Stabilization(formulation, projection)])
    };
    let rows = vec![
        row("baumgarte:alpha=6,beta=8.366600265340756", "none"),
        AxisPlace::named("", vec![CellChange::OwnGains]),
        row("index1", "manifold"),
    ];
    let y = MapAxis { name: "method".into(), unit: String::new(), entries: rows };
    let x = MapAxis::of(parameter("step"), vec![0.01, 0.005, 0.001]);
    let integrator = |name: &str| AxisPlace::named(name, vec![CellChange::Integrator(MethodSpec::named(name))]);
    let methods = ["heun", "rk4"].map(integrator).to_vec();
    let map = Map { methods, ..pair(&subject, x, y, CellQuantity::Velocity) };
    let stressed = stress(&subject, map, limits(200_000), &|| {});
    let expected: [(usize, usize, [f64; 3]); 5] = [
        (0, 0, [5.12e-1, 5.17e-2, 6.02e-4]),
        (0, 2, [6.21e-2, 3.82e-3, 5.59e-5]),
        (1, 0, [5.04e-3, 2.68e-4, 4.28e-7]),
        (1, 1, [8.45e-2, 4.81e-2, 9.21e-3]),
        (1, 2, [2.19e-3, 4.96e-5, 1.74e-8]),
    ];
    for (method, row, levels) in expected {
        for (column, level) in levels.into_iter().enumerate() {
            let found = CellQuantity::Velocity.of(stressed.cell(method, row, column).unwrap()).unwrap();
            assert!((found / level - 1.0).abs() < 0.01, "{method} {row} {column}: {found:e}");
        }
    }
    // Stabilized, the solution is nearer to the motion: about 40 times at h = 0.001 with RK4, and Baumgarte 10 times.
    let error = |row: usize| stressed.cell(1, row, 2).unwrap().error.unwrap();
    assert!(error(2) < error(0) && error(0) < error(1), "{} {} {}", error(0), error(1), error(2));
}

/// The map of the shipped scene, on fewer gains.
#[test]
fn the_verdict_on_baumgarte_of_the_scene() {
    let subject = scene("robot_arm", Overrides::default());
    let mut map = named(&subject, "gain");
    let steps = vec![0.001, 0.002, 0.005, 0.01, 0.02, 0.05];
    map.x = MapAxis::of(parameter("step"), steps);
    let stressed = stress(&subject, map, limits(200_000), &|| {});
    let gains = stressed.gains();
    let verdict = |method: &str, quantity: CellQuantity| {
        gains.iter().find(|verdict| verdict.method == method && verdict.quantity == quantity).unwrap()
    };
    // The best gain depends on the integrator, the level and the step.
    let best =
        |method: &str, quantity: CellQuantity, step: usize| verdict(method, quantity).steps[step].best.unwrap().gain;
    assert_ne!(best("rk4", CellQuantity::Velocity, 0), best("heun", CellQuantity::Velocity, 0));
    assert_ne!(best("rk4", CellQuantity::Position, 0), best("rk4", CellQuantity::Velocity, 0));
    assert!(best("rk4", CellQuantity::Position, 0) >= 2.0 * best("rk4", CellQuantity::Position, 4));
    for verdict in &gains {
        for step in verdict.steps.iter().filter(|step| step.none.drift.is_some()) {
            let [best, twice] = [step.best.unwrap().value, step.manifold_twice.drift.unwrap()];
            assert!(best > 1e3 * twice, "{} {step:?}", verdict.method);
            // The pair (2/h, 1/h^2), which needs no search, amplifies truncation errors.
            let is_far = step.own_gains.drift.is_none_or(|own| own > 3.0 * best);
            assert!(is_far || verdict.quantity == CellQuantity::Position, "{} {step:?}", verdict.method);
        }
        // Post-stabilization completes at every step at which the integrator alone does, and at the next one or two.
        let held = |level: fn(&StepVerdict) -> &GainRun| {
            verdict.steps.iter().take_while(|step| level(step).drift.is_some()).count()
        };
        let alone = held(|s| &s.none);
        let once = held(|s| &s.manifold);
        let twice = held(|s| &s.manifold_twice);
        assert!(once > alone && twice > alone && alone > 2, "{alone} {once} {twice}");
    }
}

#[test]
fn ends_are_told_apart() {
    let subject = scene("robot_arm", Overrides { until: Some(2.0), ..Overrides::default() });
    let own = |x: MapAxis, y: MapAxis| pair(&subject, x, y, CellQuantity::Velocity);
    let axis = |text: &str| MapAxis::parse(text, &subject).unwrap();
    // Large steps without stabilization, and with a gain far beyond the stable ones.
    let wild = stress(&subject, own(axis("step=0.1..0.2:2"), axis("gain=1e3..1e4:2:log")), limits(200_000), &|| {});
    assert!(all(&wild, |cell| cell.status == Status::Diverged && cell.reason.is_some()), "{:?}", wild.cells);
    // Masses that are zero have no accelerations.
    let massless = stress(&subject, own(axis("m=0..36:2"), axis("tolerance=1e-6..1e-8:2")), limits(200_000), &|| {});
    assert!(all(&massless, |cell| (cell.status == Status::Completed) == (cell.column == 1)), "{:?}", massless.cells);
    let refused_or_failed = |cell: &Cell| matches!(cell.status, Status::Completed | Status::Failed | Status::Refused);
    assert!(all(&massless, refused_or_failed));
    // A deadline.
    let slow = stress(&subject, own(axis("step=1e-7..2e-7:2"), axis("height=1..2:2")), limits(500), &|| {});
    assert!(all(&slow, |cell| cell.status == Status::TooSlow && cell.t > 0.0 && cell.t < 2.0), "{:?}", slow.cells);
    // No time at all.
    let over = Limits { all: Duration::ZERO, ..limits(10_000) };
    let none = stress(&subject, own(axis("step=1e-3..1e-2:2"), axis("height=1..2:2")), over, &|| {});
    assert!(all(&none, |cell| cell.status == Status::LeftOut && cell.drift.is_none()));
    // An adaptive method has no fixed step in implicit codes of other libraries.
    let mut refused = own(axis("step=1e-3..1e-2:2"), axis("height=1..2:2"));
    let [formulation, none] = ["ggl", "none"].map(MethodSpec::named);
    let bdf = vec![CellChange::Integrator(MethodSpec::named("bdf")), CellChange::Stabilization(formulation, none)];
    refused.methods = vec![AxisPlace::named("bdf", bdf)];
    let refused = stress(&subject, refused, limits(200_000), &|| {});
    assert!(all(&refused, |cell| cell.status == Status::Refused && cell.steps == 0), "{:?}", refused.cells);
}

/// Everything but times is the same from run to run, whatever the threads do.
#[test]
fn maps_are_repeatable() {
    let subject = scene("slider_crank", Overrides { until: Some(0.2), ..Overrides::default() });
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let stressed = pool.install(|| stress(&subject, named(&subject, "start"), limits(200_000), &|| {}));
        let timeless = |cell: &Cell| serde_json::to_string(&Cell { seconds: 0.0, ..cell.clone() }).unwrap();
        stressed.cells.iter().map(timeless).collect::<Vec<_>>()
    };
    assert_eq!(run(1), run(3));
}

/// A forearm of a hundred-millionth of the arm's mass: steps fall so far that times are near round-off.
#[test]
fn light_bodies_do_not_hang_the_recorder() {
    let subject = scene("robot_arm", Overrides { rtol: Some(1e-8), atol: Some(1e-8), ..Overrides::default() });
    let [x, y] = [("mass_ratio", vec![1e-8, 1.0]), ("tolerance", vec![1e-8])]
        .map(|(name, values)| MapAxis::of(parameter(name), values));
    let stressed = stress(&subject, pair(&subject, x, y, CellQuantity::Velocity), limits(20_000), &|| {});
    assert!(all(&stressed, |cell| cell.steps <= 20_000), "{:?}", stressed.cells);
    assert_eq!(stressed.cells[1].status, Status::Completed);
}

#[test]
fn every_stress_parameter_changes_some_scene() {
    for (name, model, values) in [
        ("mass_ratio", "four_bar_spring", [1e-2, 1e2]),
        ("stiffness", "four_bar_spring", [1.0, 1e3]),
        ("damping", "four_bar_spring", [0.0, 10.0]),
        ("speed", "four_bar_spring", [0.5, 2.0]),
        ("speed", "robot_arm", [0.5, 2.0]),
        ("link_ratio", "slider_crank", [0.1, 0.5]),
        ("links", "n_four_bar", [1.0, 2.0]),
        ("time", "pendulum", [0.5, 2.0]),
        ("start_error", "pendulum", [1e-6, 1e-3]),
        ("position_error", "spinning_top", [1e-6, 1e-3]),
        ("velocity_error", "spinning_top", [1e-6, 1e-3]),
        ("tolerance", "pendulum", [1e-9, 1e-3]),
    ] {
        let until = (name != "time").then_some(0.1);
        let dopri5 = Some(MethodSpec::named("dopri5"));
        let overrides = Overrides {
            until,
            integrator: dopri5,
            projection: Some(MethodSpec::named("none")),
            ..Overrides::default()
        };
        let subject = scene(model, overrides);
        assert!((parameter(name).suits)(&subject), "{name} {model}");
        let y = MapAxis::of(parameter("tolerance"), vec![1e-7]);
        let map = match name {
            "tolerance" => pair(
                &subject,
                MapAxis::of(parameter(name), values.to_vec()),
                MapAxis::of(parameter("time"), vec![2.0]),
                CellQuantity::Velocity,
            ),
            _ => pair(&subject, MapAxis::of(parameter(name), values.to_vec()), y, CellQuantity::Velocity),
        };
        let stressed = stress(&subject, map, limits(200_000), &|| {});
        let [a, b] = &stressed.cells[..] else { panic!("two cells") };
        assert!([a, b].iter().all(|cell| cell.status == Status::Completed), "{name} {model}: {a:?} {b:?}");
        let drift = |cell: &Cell| cell.drift.clone().unwrap();
        assert!(drift(a) != drift(b) || a.steps != b.steps, "{name} {model}");
    }
}

#[test]
fn scenes_get_the_maps_that_make_sense() {
    let names = |model: &str| -> Vec<String> {
        let subject = scene(model, Overrides { until: Some(0.05), ..Overrides::default() });
        maps(&subject, &[]).unwrap().into_iter().map(|map| map.name).collect()
    };
    assert_eq!(names("robot_arm"), ["gain", "start", "mass", "speed", "time"]);
    assert_eq!(names("four_bar_spring"), ["gain", "start", "stiffness", "damping", "speed", "time"]);
    assert_eq!(names("slider_crank"), ["gain", "start", "mass", "speed", "geometry", "time"]);
    assert_eq!(names("n_four_bar"), ["gain", "start", "mass", "speed", "links", "time"]);
}

/// Less time than all cells take is spent on cells of all methods, from the scene's own values on, and no more than that.
#[test]
fn no_corner_and_no_method_takes_the_budget_of_others() {
    let subject = scene("quarter_car", Overrides::default());
    let budget = Limits { cell: readings(10_000), all: readings(80_000) };
    // Read on the thread that works, after each cell.
    let watch: Mutex<Option<Stopwatch>> = Mutex::new(None);
    let spent = Mutex::new(Duration::ZERO);
    let progress = || *spent.lock().unwrap() = watch.lock().unwrap().get_or_insert_with(Stopwatch::start).wall();
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let stressed = one.install(|| stress(&subject, named(&subject, "stiffness"), budget, &progress));
    assert!(*spent.lock().unwrap() <= budget.all + 10 * TICK, "{spent:?}");
    assert!(stressed.cells.iter().any(|cell| cell.status == Status::LeftOut), "the budget binds");
    for verdict in stressed.verdicts() {
        assert!(verdict.completed >= 5, "{verdict:?}");
    }
    // The scene's own mass, at stiffnesses about its own.
    assert!((0..2).all(|method| stressed.cell(method, 4, 3).unwrap().status == Status::Completed));
}

#[test]
fn unknown_extremes_suggest_the_nearest() {
    assert!(find("mass-ratio").is_ok());
    let error = find("stifness").err().map(|error| error.to_string());
    assert!(error.is_some_and(|error| error.contains("did you mean `stiffness`?")));
}
