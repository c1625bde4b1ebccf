//! Studies: the numbers that are recorded of each variant, against closed forms.

use holonom::prepared::{Model, Overrides};
use holonom::study::variants::{Axis, Plan, Recorded, Shard, Study, StudyTable};
use std::f64::consts::TAU;
use std::fs;
use std::path::PathBuf;
use tempfile::TempDir;

/// A throw upwards from y = 0 at the speed v.
const THROW: &str = r#"{
  "name": "throw", "dimension": 2, "parameters": { "v": 3, "g": 9.81 }, "gravity": [0, "-g"],
  "bodies": [{ "name": "ball", "type": "point_mass", "mass": 1, "initial": { "velocity": [0, "v"] } }],
  "outputs": [
    { "name": "y", "measure": "position", "of": "ball", "component": "y" },
    { "name": "vy", "measure": "velocity", "of": "ball", "component": "y" } ],
  "simulation": { "t_end": 1, "output_step": 0.1, "formulation": "index1", "integrator": "dopri5", "projection": "none" }
}"#;

/// A pendulum of length l that hangs.
const PENDULUM: &str = r#"{
  "name": "pendulum", "dimension": 2, "parameters": { "l": 1, "g": 9.81 }, "gravity": [0, "-g"],
  "ground": { "markers": { "O": [0, 0] } },
  "bodies": [{ "name": "bob", "type": "point_mass", "mass": 2, "initial": { "position": [0, "-l"] } }],
  "joints": [{ "name": "rod", "type": "distance", "between": ["ground.O", "bob"], "length": "l" }],
  "outputs": [{ "name": "x", "measure": "position", "of": "bob", "component": "x" }],
  "simulation": { "t_end": 1 }
}"#;

struct Place(TempDir);

impl Place {
    fn new(scene: &str) -> Place {
        let place = Place(tempfile::tempdir().unwrap());
        fs::write(place.path(), scene).unwrap();
        place
    }

    fn path(&self) -> PathBuf {
        self.0.path().join("scene.json")
    }

    fn study(&self, names: &[&str], measures: &[&str], modes: bool) -> holonom::Result<Study> {
        let overrides = Overrides::default();
        let prepared = Model::load_with(&self.path(), &overrides)?;
        let names: Vec<String> = names.iter().map(|name| name.to_string()).collect();
        let measures: Vec<String> = measures.iter().map(|text| text.to_string()).collect();
        let recorded = Recorded { measures: &measures, modes, is_at_rest: false };
        Study::new(&self.path(), &prepared, &overrides, &names, recorded)
    }
}

/// The recorded numbers of the throw at a speed and an acceleration of gravity.
fn thrown([v, g]: [f64; 2], measures: &[&str]) -> Vec<f64> {
    let study = Place::new(THROW).study(&["v", "g"], measures, false).unwrap();
    study.run(&[v, g], &|| false).unwrap().unwrap()
}

/// Rounding of steps and sums.
const ROUND_OFF: f64 = 1e-12;

#[test]
fn recorded_numbers_are_those_of_the_closed_form() {
    for [v, g] in [[3.0, 9.81], [2.0, 1.62], [4.0, 24.79]] {
        let y = |t: f64| v * t - 0.5 * g * t * t;
        let rows: Vec<f64> = (0..=10).map(|k| 0.1 * f64::from(k)).collect();
        let top = rows.iter().copied().max_by(|a, b| y(*a).total_cmp(&y(*b))).unwrap();
        let reached = if v / g < 1.0 { v / g } else { f64::NAN };
        let known = [
            ("y", y(1.0)),
            ("final(vy)", v - g),
            ("max(y)", y(top)),
            ("min(y)", y(1.0).min(0.0)),
            ("time_of(max(y))", top),
            ("mean(vy)", v - 0.5 * g),
            ("rms(vy)", (v * v - v * g + g * g / 3.0).sqrt()),
            // The speed is linear, as the course between rows is taken to be.
            ("time_of(vy, 0)", reached),
            ("above(vy, 0)", (v / g).min(1.0)),
            ("above(vy, v - g/4)", 0.25),
            ("vy + g*t", v),
            ("max(abs(y), 100)", 100.0),
            ("max(y - 2*ball.y)", -y(1.0).min(0.0)),
            ("drift", 0.0),
        ];
        let found = thrown([v, g], &known.map(|(text, _)| text));
        for ((text, known), found) in known.into_iter().zip(found) {
            let is_same = (found - known).abs() < ROUND_OFF * (1.0 + known.abs()) || found.is_nan() && known.is_nan();
            assert!(is_same, "{text} of {v}, {g}: {found}, not {known}");
        }
    }
}

#[test]
fn values_at_a_time_are_those_of_its_row() {
    let found = thrown([3.0, 9.81], &["at(y, 0)", "at(y, 0.3)", "at(y, 1)", "at(y, 2*0.35)"]);
    for (t, y) in [0.0, 0.3, 1.0, 0.7].into_iter().zip(found) {
        assert!((y - (3.0 * t - 0.5 * 9.81 * t * t)).abs() < ROUND_OFF, "{t}: {y}");
    }
}

#[test]
fn cost_and_error_are_recorded() {
    let place = Place::new(
        &THROW.replace("\"v\"] }", "\"v\"] } }, { \"name\": \"other\", \"type\": \"point_mass\", \"mass\": 1"),
    );
    let study = place.study(&["v"], &["error(y),cost", "steps", "energy_error"], false).unwrap();
    let found = study.run(&[2.0], &|| false).unwrap().unwrap();
    let [error, cost, steps, energy_error] = found[..] else { panic!("{found:?}") };
    assert!((0.0..1e-6).contains(&error) && cost > steps && steps >= 1.0 && energy_error < 1e-10, "{found:?}");
}

#[test]
fn the_frequency_of_a_pendulum_follows_its_length() {
    let study = Place::new(PENDULUM).study(&["l"], &[], true).unwrap();
    let names: Vec<String> = study.columns().into_iter().map(|column| column.name).collect();
    assert_eq!(names[..4], ["re", "im", "frequency", "damping"].map(|name| format!("eigenvalue1.{name}")));
    assert_eq!(names.len(), 8);
    for l in [0.1, 1.0, 7.0] {
        let found = study.run(&[l], &|| false).unwrap().unwrap();
        let known = (9.81f64 / l).sqrt();
        assert!(
            (found[2] - known / TAU).abs() < 1e-12 * known && (found[1].abs() - known).abs() < 1e-11 * known,
            "{found:?}"
        );
    }
}

#[test]
fn a_variant_that_fails_says_why() {
    let study = Place::new(PENDULUM).study(&["l"], &["x"], false).unwrap();
    let reason = study.run(&[-1.0], &|| false).unwrap().unwrap_err();
    assert!(!reason.is_empty() && !reason.contains('\n'), "{reason}");
    assert!(study.run(&[1.0], &|| true).is_none());
}

#[test]
fn wrong_measures_and_parameters_are_told() {
    let place = Place::new(THROW);
    let said = |names: &[&str], measure: &str| place.study(names, &[measure], false).err().unwrap().to_string();
    let table = [
        ("mean(y, 2)", "`mean(y, 2)`: `mean` takes one quantity"),
        ("above(y)", "`above(y)`: `above` takes a quantity and a level"),
        ("time_of(y)", "`time_of(y)`: `time_of` takes max(x), min(x), or a quantity and a level"),
        ("error(z)", "there is no output `z`"),
        ("y,,y", "there is nothing to record between two commas"),
        ("y,y", "`y` is recorded twice"),
        ("max(yy)", "unknown name `yy`"),
        ("at(y, 0.55)", "there is no row at t = 0.55 s"),
        ("at(y, 3)", "there is no row at t = 3 s"),
    ];
    for (measure, message) in table {
        let found = said(&["v"], measure);
        assert!(found.starts_with("at record") && found.contains(message), "{measure}: {found}");
    }
    assert!(said(&["w"], "y").starts_with("unknown parameter `w`"));
}

/// A table of the throw at three speeds.
fn table(place: &Place) -> (StudyTable, Study, Plan) {
    let axes: [Axis; 1] = ["v=1..3:3".parse().unwrap()];
    let study = place.study(&["v"], &["max(y)"], false).unwrap();
    let plan = Plan::grid(&axes).unwrap();
    let prepared = Model::load_with(&place.path(), &Overrides::default()).unwrap();
    (StudyTable::new(&study, &plan, &prepared, Vec::new()), study, plan)
}

#[test]
fn rows_of_another_study_are_refused() {
    let place = Place::new(THROW);
    let (blank, study, plan) = table(&place);
    let filled = |rows: &[usize]| blank.clone().filled(&study, &plan, rows.to_vec(), &|| false, |_| ());
    let mut whole = filled(&[0, 2]);
    whole.add(filled(&[1, 2]), &place.path()).unwrap();
    assert_eq!(whole.rows.keys().copied().collect::<Vec<_>>(), [0, 1, 2]);
    let mut other = filled(&[2]);
    other.rows.get_mut(&2).unwrap().values[1] += 1e-15;
    let error = whole.add(other, &place.path()).unwrap_err().to_string();
    assert!(error.contains("row 2 has other numbers than before"), "{error}");
    let mut other = filled(&[2]);
    other.identity.insert("scene_hash".to_string(), "b".into());
    let error = whole.add(other, &place.path()).unwrap_err().to_string();
    assert!(error.contains("this is another study: its `scene_hash` is \"b\", not "), "{error}");
}

#[test]
fn shards_share_all_rows() {
    let shards: Vec<Shard> = ["1/3", "2/3", "3/3"].iter().map(|text| text.parse().unwrap()).collect();
    assert!((0..20).all(|row| shards.iter().filter(|shard| shard.has(row)).count() == 1));
    for text in ["0/3", "4/3", "1", "a/b", "-1/3"] {
        let error = text.parse::<Shard>().unwrap_err().to_string();
        assert!(error.contains("is no part; write I/N"), "{text}: {error}");
    }
}
