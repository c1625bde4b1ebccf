//! How sure a linear model is: near singular states, among fast modes, over whole turns, at thresholds.

use holonom::linearize::{Chart, Kind, Linear, LinearModel, State, floquet};
use holonom::method_spec::MethodSpec;
use holonom::prepared::{Model, Overrides};
use holonom::scene::Scene;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

fn scene(text: &str) -> Model {
    Model::new(Scene::parse(text, &[]).unwrap(), &Overrides::default()).unwrap()
}

pub fn shipped(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("models/{name}.json"))
}

fn by(prepared: &Model, method: &str, chart: Option<&str>) -> Result<LinearModel, String> {
    let request = Linear { method: MethodSpec::parse(method).unwrap(), chart: chart.map(Chart::parse) };
    let state = State::start(prepared);
    let mut variation = state.variation(prepared).map_err(|error| error.to_string())?;
    variation.linearize(&request).map_err(|error| error.to_string())
}

/// A bar on parallel cranks of 0.5 m, at an angle to the line of their bearings.
fn parallelogram(cranks: usize, angle: f64) -> Model {
    let [x, y] = [angle.cos(), angle.sin()];
    let of = |i: usize| (format!("c{i}"), 0.3 * i as f64);
    let mut bodies = Vec::new();
    let mut joints = Vec::new();
    let mut ground = Vec::new();
    let mut pins = Vec::new();
    for i in 0..cranks {
        let (name, place) = of(i);
        ground.push(format!(r#""O{i}": [{place:?}, 0]"#));
        pins.push(format!(r#""P{i}": [{place:?}, 0]"#));
        bodies.push(format!(
            r#"{{ "name": "{name}", "type": "rigid", "mass": 0.7, "inertia": "0.7*0.5^2/12",
                "markers": {{ "A": [-0.25, 0], "B": [0.25, 0] }},
                "initial": {{ "position": [{:?}, {:?}], "angle": {angle:?}, "angular_velocity": 2,
                    "velocity": [{:?}, {:?}] }} }}"#,
            place + 0.25 * x,
            0.25 * y,
            -0.5 * y,
            0.5 * x
        ));
        joints.push(format!(r#"{{ "name": "a{i}", "type": "revolute", "between": ["ground.O{i}", "{name}.A"] }}"#));
        joints.push(format!(r#"{{ "name": "b{i}", "type": "revolute", "between": ["{name}.B", "bar.P{i}"] }}"#));
    }
    bodies.push(format!(
        r#"{{ "name": "bar", "type": "rigid", "mass": 2, "inertia": 0.5, "markers": {{ {} }},
            "initial": {{ "position": [{:?}, {:?}], "velocity": [{:?}, {:?}] }} }}"#,
        pins.join(", "),
        0.5 * x,
        0.5 * y,
        -y,
        x
    ));
    scene(&format!(
        r#"{{ "name": "parallelogram", "dimension": 2, "gravity": [0, -9.81], "ground": {{ "markers": {{ {} }} }},
            "bodies": [{}], "joints": [{}],
            "forces": [{{ "name": "k", "type": "torsion_spring", "between": ["ground.O0", "c0"], "stiffness": 30,
                "damping": 0.2, "free_angle": 1 }}] }}"#,
        ground.join(", "),
        bodies.join(", "),
        joints.join(", ")
    ))
}

/// The frequency of the crank, by the energies of all parts: J s^2 + 0.2 s + 30 - g S sin(angle) = 0.
fn crank_frequency(cranks: usize, angle: f64) -> f64 {
    let n = cranks as f64;
    let inertia = n * (0.7 * 0.25 / 12.0 + 0.7 * 0.0625) + 2.0 * 0.25;
    let stiffness = 30.0 - 9.81 * (n * 0.7 * 0.25 + 2.0 * 0.5) * angle.sin();
    (stiffness / inertia - (0.1 / inertia).powi(2)).sqrt()
}

/// The error that the model carries holds its true error, and far from the fold both are rounding.
#[test]
fn a_model_near_a_fold_has_an_error() {
    let mut conditions = Vec::new();
    for angle in [1.0, 0.1, 1e-2, 1e-3] {
        let prepared = parallelogram(2, angle);
        for chart in [None, Some("c0.angle")] {
            let model = match by(&prepared, "mcs", chart) {
                Ok(model) => model,
                Err(refused) => panic!("{angle} {chart:?}: {refused}"),
            };
            let found = model.modes.iter().map(|mode| mode.value.im).fold(0.0, f64::max);
            let error = (found / crank_frequency(2, angle) - 1.0).abs();
            let known = model.reduction.error;
            assert!(error <= 10.0 * known + 1e-12, "{angle} {chart:?}: {error:e} of {known:e}");
            assert!(known < 1e-6 || angle < 1e-2, "{angle} {chart:?}: {known:e}");
            assert_eq!(model.doubt().is_some(), known > 1e-6);
            conditions.push(model.reduction.condition);
        }
    }
    assert!(conditions.windows(2).all(|pair| pair[1] >= 0.99 * pair[0]), "{conditions:?}");
    assert!(conditions[0] < 30.0 && conditions[6] > 300.0, "{conditions:?}");
    // Half of the digits and more are lost: a warning, or none are left: refused.
    match by(&parallelogram(2, 1e-4), "mcs", Some("c0.angle")) {
        Ok(model) => assert!(model.doubt().unwrap().to_string().contains("nearly dependent"), "{:?}", model.reduction),
        Err(refused) => assert!(refused.contains("singular state"), "{refused}"),
    }
}

/// phi of the start is rounding, which a step of Newton's method would turn into 4e-12 rad beside this fold: eigenvalues
/// would be off by 2e-5 in the intrinsic chart at 1e-4, and by 1e-5 in a named one at 1e-3.
#[test]
fn a_start_beside_a_fold_stays() {
    for (angle, chart) in [(1e-3f64, Some("c0.angle")), (1e-3, None), (1e-4, None)] {
        let prepared = parallelogram(2, angle);
        let [x, y] = [angle.cos(), angle.sin()];
        let crank = |place: f64| [place + 0.25 * x, 0.25 * y, angle];
        let given = [crank(0.0), crank(0.3), [0.5 * x, 0.5 * y, 0.0]].concat();
        assert_eq!(prepared.start().0, given);
        let model = by(&prepared, "mcs", chart).unwrap();
        let found = model.modes.iter().map(|mode| mode.value.im).fold(0.0, f64::max);
        let error = (found / crank_frequency(2, angle) - 1.0).abs();
        assert!(error < 1e-10 && error < model.reduction.error, "{angle}: {error:e} of {:?}", model.reduction);
    }
}

/// Two of four cranks are redundant, which must not hide that all are nearly in line.
#[test]
fn redundancy_hides_no_singular_state() {
    let regular = by(&parallelogram(4, 0.5), "mcs", None).unwrap();
    let found = regular.modes.iter().map(|mode| mode.value.im).fold(0.0, f64::max);
    assert!((found / crank_frequency(4, 0.5) - 1.0).abs() < 1e-10 && regular.reduction.error < 1e-12);
    for angle in [1e-3, 1e-6] {
        match by(&parallelogram(4, angle), "mcs", None) {
            Err(refused) => assert!(refused.contains("singular state"), "{angle}: {refused}"),
            Ok(model) => {
                let found = model.modes.iter().map(|mode| mode.value.im).fold(0.0, f64::max);
                let error = (found / crank_frequency(4, angle) - 1.0).abs();
                assert!(error < 10.0 * model.reduction.error, "{angle}: {error:e} of {:?}", model.reduction);
            }
        }
    }
}

/// sqrt(0.01/2.001) = 0.070693 rad/s among springs of 1e12 N/m, whose rounding is a part of it.
#[test]
fn eigenvalues_have_their_errors() {
    let mass = |name: &str, mass: f64, x: usize| {
        format!(
            r#"{{ "name": "{name}", "type": "rigid", "mass": {mass}, "inertia": 0, "free": ["x"],
                "initial": {{ "position": [{x}, 0] }} }}"#
        )
    };
    let spring = |name: &str, ends: [&str; 2], k: &str| {
        format!(
            r#"{{ "name": "{name}", "type": "spring_damper", "between": ["{}", "{}"], "stiffness": {k},
                "free_length": 1 }}"#,
            ends[0], ends[1]
        )
    };
    let bodies = [mass("m0", 1.0, 1), mass("m1", 1.0, 2), mass("m2", 0.001, 3)].join(", ");
    let springs =
        [spring("s0", ["ground", "m0"], "0.01"), spring("s1", ["m0", "m1"], "1e12"), spring("s2", ["m1", "m2"], "1e6")];
    let text =
        format!(r#"{{ "name": "scales", "dimension": 2, "bodies": [{bodies}], "forces": [{}] }}"#, springs.join(", "));
    let model = by(&scene(&text), "mcs", None).unwrap();
    let slow = &model.modes[0];
    assert!((slow.value.norm() - 0.070693).abs() < slow.error && slow.error < 0.3, "{slow:?}");
    let fast = &model.modes[5];
    assert!(fast.error < 1e-8 * fast.value.norm() && fast.condition < 10.0, "{fast:?}");
}

/// Ziegler's column at a load P, with damping c.
pub fn ziegler(p: f64, c: f64) -> String {
    format!(
        r#"{{ "name": "ziegler", "dimension": 2, "parameters": {{ "P": {p:?}, "c": {c:?} }},
            "ground": {{ "markers": {{ "O": [0, 0] }} }},
            "bodies": [
                {{ "name": "r1", "type": "rigid", "mass": 2, "inertia": 0, "initial": {{ "position": [1, 0] }},
                    "markers": {{ "A": [-1, 0], "B": [0, 0] }} }},
                {{ "name": "r2", "type": "rigid", "mass": 1, "inertia": 0, "initial": {{ "position": [2, 0] }},
                    "markers": {{ "A": [-1, 0], "B": [0, 0] }} }}],
            "joints": [{{ "name": "O", "type": "revolute", "between": ["ground.O", "r1.A"] }},
                {{ "name": "E", "type": "revolute", "between": ["r1.B", "r2.A"] }}],
            "forces": [
                {{ "name": "k1", "type": "torsion_spring", "between": ["ground.O", "r1.A"], "stiffness": 1, "damping": "c" }},
                {{ "name": "k2", "type": "torsion_spring", "between": ["r1.B", "r2.A"], "stiffness": 1, "damping": "c" }},
                {{ "name": "follow", "type": "applied_force", "at": "r2.B", "axes": "marker", "force": ["-P", 0] }}] }}"#
    )
}

/// Angles of bars whose mass is at their ends have no inertia, and are coordinates like the positions.
#[test]
fn directions_without_inertia_are_coordinates() {
    let prepared = scene(&ziegler(2.0, 0.0));
    let positions = by(&prepared, "mcs", Some("r1.y,r2.y")).unwrap();
    let angles = by(&prepared, "mcs", Some("r1.angle,r2.angle")).unwrap();
    let values = |model: &LinearModel, kind: Kind| -> Vec<f64> {
        let mut all: Vec<f64> = model.modes.iter().filter(|mode| mode.kind == kind).map(|mode| mode.value.im).collect();
        all.sort_by(f64::total_cmp);
        all
    };
    let known = values(&positions, Kind::Physical);
    // m l^2 [3 1; 1 1] s^2 + k [2 -1; -1 1] - P l [1 -1; 0 0]: s^2 = -1, -1/2 at P = 2.
    for (found, im) in known.iter().zip([-1.0, -0.5f64.sqrt(), 0.5f64.sqrt(), 1.0]) {
        assert!((found - im).abs() < 1e-12, "{known:?}");
    }
    assert_eq!(angles.states[..2], ["r1.angle", "r2.angle"]);
    for method in ["mcs", "rcs:form=index1", "rcs:form=index2", "force_projection", "baumgarte"] {
        let model = by(&prepared, method, None).unwrap();
        assert!(!model.has_uncertain_kinds(), "{method}");
        let off = values(&model, Kind::Physical).iter().zip(&known).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-7 && values(&model, Kind::Physical).len() == 4, "{method}: {off:e}");
    }
}

/// Off equilibrium penalties leave the constraints, so that their frozen model is none of the motion.
#[test]
fn a_penalty_is_comparable_at_rest_only() {
    let prepared = Model::load_with(&shipped("four_bar_spring"), &Overrides::default()).unwrap();
    let comparable = |method: &str| by(&prepared, method, None).unwrap().is_comparable();
    assert!(comparable("mcs") && comparable("rcs") && comparable("penalty:projected=yes"));
    assert!(!comparable("penalty") && !comparable("augmented_lagrangian"));
}

fn turning(torque: &str) -> Model {
    scene(&format!(
        r#"{{ "name": "rotor", "dimension": 2, "ground": {{ "markers": {{ "O": [0, 0] }} }},
            "bodies": [{{ "name": "rotor", "type": "rigid", "mass": 1, "inertia": 1, "free": ["angle"],
                "markers": {{ "O": [0, 0] }}, "initial": {{ "angular_velocity": 10 }} }}],
            "forces": [{{ "name": "motor", "type": "applied_torque", "at": "rotor.O", "torque": "{torque}" }}] }}"#
    ))
}

/// A rotor is back after a turn, with the multipliers 1 and exp(-0.2 pi); not where a spring winds up.
#[test]
fn a_turn_is_no_gap() {
    let period = TAU / 10.0;
    for torque in ["10 - rotor.angle'", "10 - rotor.angle' + 0*cos(rotor.angle)"] {
        let prepared = turning(torque);
        let found = floquet(prepared.system(), &State::start(&prepared), period).unwrap();
        assert!(found.gap < 1e-9, "{}", found.gap);
        assert!((found.multipliers[0].re - 1.0).abs() < 1e-9, "{:?}", found.multipliers);
        assert!(
            (found.multipliers[1].re - (-0.2 * std::f64::consts::PI).exp()).abs() < 1e-9,
            "{:?}",
            found.multipliers
        );
        assert!(found.errors.iter().all(|error| *error < 1e-9) && found.is_bounded(1e-5).unwrap());
    }
    let wound = turning("10 - rotor.angle' - 1e-4*rotor.angle");
    let refused = floquet(wound.system(), &State::start(&wound), period).unwrap_err().to_string();
    assert!(refused.contains("not its period"), "{refused}");
    // Only whole turns are none where the torque depends on the angle.
    let uneven = turning("10 - rotor.angle' + 1e-3*cos(rotor.angle)");
    assert!(floquet(uneven.system(), &State::start(&uneven), 0.9 * period).is_err());
}

/// A sliding body is where it was, but for a displacement on which nothing depends.
#[test]
fn a_displacement_is_no_gap() {
    let prepared = scene(
        r#"{ "name": "glider", "dimension": 2,
            "bodies": [{ "name": "glider", "type": "rigid", "mass": 1, "inertia": 1, "free": ["x"],
                "initial": { "velocity": [3, 0] } }],
            "forces": [{ "name": "drag", "type": "applied_force", "at": "glider", "force": ["3 - glider.x'", 0] }] }"#,
    );
    let found = floquet(prepared.system(), &State::start(&prepared), 0.5).unwrap();
    assert!((found.multipliers[1].re - (-0.5f64).exp()).abs() < 1e-9 && found.gap < 1e-9, "{found:?}");
}

/// A crank and its piston after a turn of their own: multipliers 1 and 0.0092079 of the motor and the load.
#[test]
fn a_machine_is_back_after_a_turn() {
    let prepared = scene(
        r#"{ "name": "machine", "dimension": 2, "ground": { "markers": { "O": [0, 0], "G": [0, 0] } },
            "parameters": { "r": 0.05, "l": 0.2, "mr": 0.4 },
            "bodies": [
                { "name": "crank", "type": "rigid", "mass": 1, "inertia": 0.02,
                  "markers": { "O": [0, 0], "P": ["r", 0] }, "initial": { "angle": 0.1, "angular_velocity": 60 } },
                { "name": "rod", "type": "rigid", "mass": "mr", "inertia": "mr*l^2/12",
                  "markers": { "P": ["-l/2", 0], "S": ["l/2", 0] }, "initial": { "position": [0.15, 0.002] } },
                { "name": "piston", "type": "rigid", "mass": 0.6, "inertia": 1e-4, "markers": { "S": [0, 0] },
                  "initial": { "position": [0.25, 0] } }],
            "joints": [
                { "name": "main", "type": "revolute", "between": ["ground.O", "crank.O"] },
                { "name": "big", "type": "revolute", "between": ["crank.P", "rod.P"] },
                { "name": "small", "type": "revolute", "between": ["rod.S", "piston.S"] },
                { "name": "guide", "type": "prismatic", "between": ["ground.G", "piston.S"] }],
            "forces": [
                { "name": "motor", "type": "applied_torque", "at": "crank.O",
                  "torque": "60*(1 - crank.angle'/(2*pi*10*1.1))" },
                { "name": "load", "type": "applied_force", "at": "piston.S", "force": ["-400*tanh(piston.x'/0.05)", 0] }],
            "simulation": { "t_end": 5, "rtol": 1e-9, "atol": 1e-11 } }"#,
    );
    let start = prepared.states_at(&[4.7411439988]).unwrap().remove(0);
    let found = floquet(prepared.system(), &start, 0.1157002336).unwrap();
    assert!((found.multipliers[0].re - 1.0).abs() < 1e-4, "{:?}", found.multipliers);
    assert!((found.multipliers[1].re - 0.0092079).abs() < 1e-5, "{:?}", found.multipliers);
}
