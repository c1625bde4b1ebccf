//! The verdict on a linear model: right ones are blessed, and terms that are spoilt on purpose are condemned with their
//! size, in the entry where they are.

use holonom::linearize::{Chart, LinearMatrices, Matrix, State};
use holonom::prepared::{Model, Overrides};
use holonom::validate::{Deviation, Reason, Settings, Validation, horizon, validate, validate_changed};
use std::path::Path;

fn load(path: &Path) -> Model {
    let mut prepared = Model::load_with(path, &Overrides::default()).unwrap();
    prepared.method.rtol = prepared.method.rtol.min(1e-10);
    prepared.method.atol = prepared.method.atol.min(1e-10);
    prepared
}

fn model(name: &str) -> Model {
    load(&Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("models/{name}.json")))
}

fn scene(json: &serde_json::Value) -> Model {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    std::fs::write(&path, json.to_string()).unwrap();
    load(&path)
}

fn state(prepared: &Model, t: f64) -> State {
    prepared.states_at(&[t]).unwrap().remove(0)
}

/// This is about the entries: no motion is followed.
fn entries() -> Settings {
    Settings { horizon: Some(1e-3), directions: Vec::new(), ..Settings::default() }
}

/// Small scenes that move, with a time.
const SCENES: [(&str, f64); 24] = [
    ("andrews", 0.01),
    ("bead_in_bowl", 0.3),
    ("bennett", 0.2),
    ("bevel_differential", 0.2),
    ("bushing_block", 0.05),
    ("chebyshev_lambda", 0.2),
    ("double_pendulum", 0.4),
    ("flyball_governor", 0.5),
    ("four_bar_spring", 0.3),
    ("gear_pair", 0.1),
    ("half_car", 0.4),
    ("hoeken", 0.2),
    ("hydraulic_boom", 0.2),
    ("pantograph", 0.3),
    ("pendulum", 0.3),
    ("pid_arm", 1.0),
    ("quarter_car", 0.4),
    ("robot_arm", 0.3),
    ("rope_slider", 0.1),
    ("slider_crank_offset", 0.1),
    ("spatial_slider_crank", 0.2),
    ("spinning_top", 0.3),
    ("tower_crane", 5.0),
    ("universal_shaft", 0.2),
];

fn matrix(built: &mut LinearMatrices, name: char) -> &mut Matrix {
    match name {
        'A' => &mut built.a,
        'B' => &mut built.b,
        'C' => &mut built.c,
        _ => &mut built.d,
    }
}

fn deviation(found: &Validation, name: char) -> Option<&Deviation> {
    found.measured.all().find(|(own, _)| *own == name).map(|(_, deviation)| deviation)
}

/// Adds to the entry a part of the largest entry of its row, or of its matrix. Returns its size and the entry's place.
fn spoil(built: &mut LinearMatrices, name: char, (i, j): (usize, usize), part: f64) -> f64 {
    let own = matrix(built, name);
    let size = part * Some(own.row(i).amax()).filter(|x| *x > 0.0).unwrap_or(own.amax().max(1e-3));
    own[(i, j)] += size;
    size
}

/// Validates the model with a spoilt entry at `place` of a matrix. Returns the size that was added, and what is found.
fn validate_spoilt(prepared: &Model, state: &State, name: char, place: usize, part: f64) -> (f64, Validation) {
    let mut size = 0.0;
    let found = validate_changed(prepared.system(), state, &entries(), &|| false, |built| {
        let (rows, columns) = matrix(built, name).shape();
        size = spoil(built, name, ((place * 7 + 3) % rows, (place * 5 + 1) % columns), part);
    });
    (size, found.unwrap())
}

/// True if the matrix is wrong by that size, and no other is.
fn is_condemned(found: &Validation, name: char, size: f64) -> bool {
    let is_own = |deviation: &Deviation| {
        let off = (deviation.difference - size).abs();
        !deviation.is_right && off <= 0.01 * size + 3.0 * deviation.uncertainty
    };
    !found.verdict.lti
        && found
            .measured
            .all()
            .all(|(other, deviation)| if other == name { is_own(deviation) } else { deviation.is_right })
}

#[test]
fn spoilt_terms_are_condemned_with_their_size() {
    let mut count = 0;
    for (place, (name, t)) in SCENES.into_iter().enumerate() {
        let prepared = model(name);
        let state = state(&prepared, t);
        let right = validate(prepared.system(), &state, &entries()).unwrap();
        assert!(right.verdict.lti, "{name}: {}", right.verdict.text);
        for (matrix_name, _) in right.measured.all() {
            let (size, found) = validate_spoilt(&prepared, &state, matrix_name, place, 1e-5);
            assert!(is_condemned(&found, matrix_name, size), "{name}: {matrix_name} {size:e}: {:?}", found.measured);
            count += 1;
        }
    }
    assert!(count >= 40, "{count}");
}

/// At 200 random states, or as many as the variable STATES says, an entry of a random matrix is spoilt by 1e-2 to 1e-6 of
/// the largest of its row. Mechanisms that drivers move have no states, and nothing to compare.
#[test]
fn two_hundred_random_moving_scenes() {
    let count = std::env::var("STATES").ok().and_then(|count| count.parse().ok()).unwrap_or(200);
    let mut random = fastrand::Rng::with_seed(7);
    let mut compared = 0;
    let mut blessed = 0;
    let mut condemned = 0;
    while compared < count {
        let (name, t) = SCENES[random.usize(..SCENES.len())];
        let prepared = model(name);
        let state = state(&prepared, t * (0.2 + 0.8 * random.f64()));
        let part = 10f64.powf(-2.0 - 4.0 * random.f64());
        let right = validate(prepared.system(), &state, &entries()).unwrap();
        let names: Vec<char> = right.measured.all().map(|(name, _)| name).collect();
        if names.is_empty() {
            continue;
        }
        compared += 1;
        let spoilt = names[random.usize(..names.len())];
        let (size, found) = validate_spoilt(&prepared, &state, spoilt, random.usize(..100), part);
        if right.verdict.lti {
            blessed += 1;
        } else {
            println!("{name} at {} s: {}", state.t, right.verdict.text);
        }
        if is_condemned(&found, spoilt, size) {
            condemned += 1;
        } else {
            println!("{name} at {} s, {spoilt} by {size:e}: {:?}", state.t, deviation(&found, spoilt));
        }
    }
    println!(
        "{compared} models: {blessed} right ones are blessed, {condemned} spoilt ones are condemned by their size"
    );
    assert!(blessed * 100 >= compared * 99 && condemned * 100 >= compared * 99, "{blessed} {condemned}");
}

/// Models that an order over all steps condemned.
#[test]
fn right_models_are_blessed() {
    for (name, t) in [("pid_arm", 1.0), ("tower_crane", 5.0)] {
        let prepared = model(name);
        let found = validate(prepared.system(), &state(&prepared, t), &Settings::default()).unwrap();
        assert!(found.verdict.ltv && found.verdict.lti, "{name}: {}", found.verdict.text);
        assert!(found.verdict.text.starts_with("right: A right to "), "{name}: {}", found.verdict.text);
        assert!(deviation(&found, 'A').unwrap().relative_uncertainty < 1e-8, "{name}: {:?}", found.measured);
    }
}

/// A mass of 1 kg on a line, at x with a speed, under a force.
fn mass(force: &str, [x, speed]: [f64; 2]) -> Model {
    scene(&serde_json::json!({ "name": "mass", "dimension": 2,
        "bodies": [{ "name": "m", "type": "rigid", "mass": 1, "inertia": 0, "free": ["x"],
                     "initial": { "position": [x, 0], "velocity": [speed, 0] } }],
        "forces": [{ "name": "f", "type": "applied_force", "at": "m", "force": [force, 0] }],
        "outputs": [{ "name": "x", "measure": "position", "of": "m", "component": "x" }],
        "simulation": { "t_end": 1, "rtol": 1e-11, "atol": 1e-13 } }))
}

fn over(prepared: &Model, horizon: f64) -> Validation {
    let settings = Settings { horizon: Some(horizon), ..Settings::default() };
    validate(prepared.system(), &state(prepared, 0.0), &settings).unwrap()
}

/// x'' = -10 |x| from x = -0.001 m at 1 m/s: the kink is 1 ms ahead.
#[test]
fn an_event_ends_the_horizon() {
    let prepared = mass("-10*abs(m.x)", [-0.001, 1.0]);
    let found = validate(prepared.system(), &state(&prepared, 0.0), &Settings::default()).unwrap();
    assert!(found.verdict.ltv && found.verdict.lti, "{}", found.verdict.text);
    let event = found.event.unwrap();
    assert!((event.t - 1e-3).abs() < 1e-7 && event.owner.contains("`f`"), "{event:?}");
    assert_eq!(found.followed, 0.9 * event.t);
}

/// Dry friction turns round at the largest x, 0.027 s ahead: v' jumps from -1.1 to -0.7, and small changes of v with it.
#[test]
fn small_changes_are_followed_through_an_event() {
    let prepared = mass("cos(0.7*t) - m.x - 0.2*sign(m.x')", [1.9, 0.03]);
    let found = over(&prepared, 0.2);
    assert!(found.verdict.ltv && found.verdict.lti, "{}", found.verdict.text);
    assert!(found.verdict.text.contains("; through t = 0.027"), "{}", found.verdict.text);
    let passage = found.sequences[0].passage.as_ref().unwrap();
    let order = passage.order.order.unwrap();
    assert!((order - 2.0).abs() < 0.05 && passage.t == 0.2, "{passage:?}");
}

/// Friction holds the mass after 0.1 s: nothing is followed beyond. The largest change, 0.1 m/s, stops after 0.095 s.
#[test]
fn a_motion_that_stays_on_a_threshold_ends_the_horizon() {
    let found = over(&mass("-20*sign(m.x')", [0.0, 2.0]), 0.3);
    assert!(found.verdict.ltv && found.verdict.lti, "{}", found.verdict.text);
    assert!(found.sequences[0].passage.is_none(), "{:?}", found.sequences[0].passage);
    let text = "; the horizon ends at t = 0.1 s, where the force `f` changes its form";
    assert!(found.verdict.text.contains(text), "{}", found.verdict.text);
}

/// The force of a spring without length is |k r|, which has no derivative at r = 0.
#[test]
fn an_output_with_a_kink_is_named() {
    let prepared = scene(
        &serde_json::json!({ "name": "spring", "dimension": 2, "ground": { "markers": { "O": [0, 0] } },
        "bodies": [{ "name": "m", "type": "point_mass", "mass": 1, "initial": { "position": [0, 0], "velocity": [0.3, 0] } }],
        "forces": [{ "name": "s", "type": "spring_damper", "between": ["ground.O", "m"], "stiffness": 4 }],
        "outputs": [{ "name": "tension", "measure": "force", "of": "s" },
                    { "name": "x", "measure": "position", "of": "m", "component": "x" }],
        "simulation": { "t_end": 1 } }),
    );
    let found = over(&prepared, 0.1);
    assert!(found.verdict.ltv && found.verdict.lti, "{}", found.verdict.text);
    let named: Vec<(&str, Reason)> = found.measured.unjudged.iter().map(|row| (row.row.as_str(), row.reason)).collect();
    assert_eq!(named, [("tension", Reason::Kink)]);
}

/// The plain projection belongs to no chart: its difference is that from the mass-orthogonal chart.
#[test]
fn a_projected_model_is_not_comparable() {
    let set = Overrides { set: vec![("c1".to_string(), 5.0.into())], ..Overrides::default() };
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/four_bar_spring.json");
    let prepared = Model::load_with(&path, &set).unwrap();
    let settings = Settings { chart: Some(Chart::Frozen), inputs: false, ..Settings::default() };
    let found = validate(prepared.system(), &state(&prepared, 0.3), &settings).unwrap();
    assert!(found.verdict.text.starts_with("frozen, not comparable"), "{}", found.verdict.text);
    assert!(found.measured.b.is_none() && found.measured.d.is_none());
}

/// exp(A t) against the motion by a fine table of their difference.
#[test]
fn horizons_are_first_passages() {
    let times: Vec<f64> = (1..=10).map(|i| 0.01 * 2f64.powi(i)).collect();
    let errors: Vec<f64> = times.iter().map(|t| 0.3 * t * t).collect();
    for share in [0.01, 0.1] {
        let exact = (share / 0.3f64).sqrt();
        assert!((horizon(&times, &errors, share).unwrap() / exact - 1.0).abs() < 1e-12);
    }
    // A horizon much longer than the first passage gives the same passage.
    let prepared = model("double_pendulum");
    let start = state(&prepared, 0.4);
    let passages = [0.06, 1.0].map(|horizon| {
        let settings = Settings { horizon: Some(horizon), inputs: false, ..Settings::default() };
        validate(prepared.system(), &start, &settings).unwrap().sequences.remove(0).horizons[0].unwrap()
    });
    assert!((passages[0] / passages[1] - 1.0).abs() < 0.05, "{passages:?}");
}

#[test]
fn a_frozen_response_that_is_far_off_is_told() {
    let prepared = model("four_bar_spring");
    let found = validate(prepared.system(), &state(&prepared, 0.3), &Settings::default()).unwrap();
    assert!(found.verdict.ltv && found.verdict.lti, "{}", found.verdict.text);
    assert!(found.verdict.text.contains("; frozen, it is off by up to "), "{}", found.verdict.text);
}
