//! The verdict on a linear model: right ones are blessed, and terms that are spoilt on purpose are condemned with their
//! size, in the entry where they are.

use holonom::linearize::{Built, Chart, Matrix, State, states};
use holonom::prepared::{Overrides, PreparedScene};
use holonom::validate::{Deviation, Settings, Validation, horizon, validate, validate_changed};
use std::path::Path;

fn load(path: &Path) -> PreparedScene {
    let mut prepared = PreparedScene::load(path, &Overrides::default()).unwrap();
    prepared.method.rtol = prepared.method.rtol.min(1e-10);
    prepared.method.atol = prepared.method.atol.min(1e-10);
    prepared
}

fn model(name: &str) -> PreparedScene {
    load(&Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("models/{name}.json")))
}

fn scene(json: &serde_json::Value) -> PreparedScene {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    std::fs::write(&path, json.to_string()).unwrap();
    load(&path)
}

fn state(prepared: &PreparedScene, t: f64) -> State {
    states(prepared, &[t], |_| {}).unwrap().remove(0)
}

/// A short horizon: this is about the entries.
fn short() -> Settings {
    Settings { horizon: Some(1e-3), ..Settings::default() }
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

fn matrix(built: &mut Built, name: char) -> &mut Matrix {
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
fn spoil(built: &mut Built, name: char, (i, j): (usize, usize), part: f64) -> f64 {
    let own = matrix(built, name);
    let size = part * Some(own.row(i).amax()).filter(|x| *x > 0.0).unwrap_or(own.amax().max(1e-3));
    own[(i, j)] += size;
    size
}

/// Spoils the entries at `place` of each matrix in turn; returns how many were spoilt.
fn spoilt_are_condemned(prepared: &PreparedScene, state: &State, place: usize, part: f64) -> usize {
    let right = validate(prepared.system(), state, &short()).unwrap();
    let name = format!("{} at {} s", prepared.name, state.t);
    assert!(right.verdict.lti, "{name}: {}", right.verdict.text);
    let mut count = 0;
    for (matrix_name, own) in right.measured.all() {
        let mut entry = (0, 0);
        let mut size = 0.0;
        let found = validate_changed(prepared.system(), state, &short(), &|| false, |built| {
            let shape = matrix(built, matrix_name).shape();
            entry = ((place * 7 + 3) % shape.0, (place * 5 + 1) % shape.1);
            size = spoil(built, matrix_name, entry, part);
        })
        .unwrap();
        let spoilt = deviation(&found, matrix_name).unwrap();
        assert!(!found.verdict.lti && !spoilt.is_right, "{name}: {matrix_name} {entry:?} {size:e}: {spoilt:?} {own:?}");
        assert!(
            (spoilt.difference - size).abs() <= 0.01 * size + 3.0 * spoilt.uncertainty,
            "{name}: {size:e} {spoilt:?}"
        );
        assert!(right.measured.all().filter(|(other, _)| *other != matrix_name).all(|(_, other)| other.is_right));
        count += 1;
    }
    count
}

#[test]
fn spoilt_terms_are_condemned_with_their_size() {
    let mut count = 0;
    for (place, (name, t)) in SCENES.into_iter().enumerate() {
        let prepared = model(name);
        count += spoilt_are_condemned(&prepared, &state(&prepared, t), place, 1e-5);
    }
    assert!(count >= 40, "{count}");
}

/// Of 200 random states of all scenes: `cargo test --release --test linear verdict -- --ignored --nocapture`.
#[test]
#[ignore = "takes minutes"]
fn two_hundred_random_moving_scenes() {
    let mut random = fastrand::Rng::with_seed(7);
    let mut counts = [0; 2];
    for place in 0..200 {
        let (name, t) = SCENES[random.usize(..SCENES.len())];
        let prepared = model(name);
        let state = state(&prepared, t * (0.2 + 0.8 * random.f64()));
        let part = 10f64.powf(-2.0 - 4.0 * random.f64());
        counts[0] += 1;
        counts[1] += spoilt_are_condemned(&prepared, &state, place + random.usize(..100), part);
    }
    println!("{} right models blessed, {} spoilt entries condemned by their size", counts[0], counts[1]);
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

/// x'' = -10 |x| from x = -0.001 m at 1 m/s: the kink is 1 ms ahead.
#[test]
fn an_event_ends_the_horizon() {
    let prepared = scene(&serde_json::json!({ "name": "kink_ahead", "dimension": 2,
        "bodies": [{ "name": "m", "type": "rigid", "mass": 1, "inertia": 0, "free": ["x"],
                     "initial": { "position": [-0.001, 0], "velocity": [1, 0] } }],
        "forces": [{ "name": "f", "type": "applied_force", "at": "m", "force": ["-10*abs(m.x)", 0] }],
        "outputs": [{ "name": "x", "measure": "position", "of": "m", "component": "x" }],
        "simulation": { "t_end": 1, "rtol": 1e-11, "atol": 1e-13 } }));
    let found = validate(prepared.system(), &state(&prepared, 0.0), &Settings::default()).unwrap();
    assert!(found.verdict.ltv && found.verdict.lti, "{}", found.verdict.text);
    let event = found.event.unwrap();
    assert!((event.t - 1e-3).abs() < 1e-7 && event.owner.contains("`f`"), "{event:?}");
    assert_eq!(found.followed, 0.9 * event.t);
}

/// The plain projection belongs to no chart: its difference is that from the mass-orthogonal chart.
#[test]
fn a_projected_model_is_not_comparable() {
    let set = Overrides { set: vec![("c1".to_string(), 5.0.into())], ..Overrides::default() };
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/four_bar_spring.json");
    let prepared = PreparedScene::load(&path, &set).unwrap();
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
