//! Own methods by their names, in scenes and in settings.

use crate::examples::own_formulation::BRAKED;
use crate::examples::own_integrator::MIDPOINT;
use crate::examples::own_projection::VELOCITIES;
use holonom::methods::Method;
use holonom::parts::Elements;
use holonom::research::methods::{IntegratorEntry, Listed};
use holonom::run::{Family, Model, Overrides, Record, simulate};
use holonom::{Result, prepared};

const PENDULUM: &str = r#"{
    "name": "pendulum", "dimension": 2, "gravity": [0, -9.81],
    "bodies": [{ "name": "bob", "type": "point_mass", "mass": 1, "initial": { "position": [1, 0] } }],
    "joints": [{ "name": "rod", "type": "distance", "between": ["ground", "bob"], "length": 1 }],
    "simulation": { "t_end": 1, "step": 0.01, "rtol": 1e-6, METHOD } }"#;

fn elements() -> Elements {
    let with_two = Elements::default().with_method(&MIDPOINT).and_then(|known| known.with_method(&BRAKED));
    with_two.and_then(|known| known.with_method(&VELOCITIES)).unwrap()
}

fn pendulum(simulation: &str, overrides: Overrides) -> Result<Model> {
    Family::parse_with(&PENDULUM.replace("METHOD", simulation), &overrides)?.model()
}

fn with_elements() -> Overrides {
    Overrides { elements: elements(), ..Overrides::default() }
}

fn bits(record: &Record) -> Vec<u64> {
    record.trajectory.rows.iter().flatten().map(|value| value.to_bits()).collect()
}

#[test]
fn a_scene_names_own_methods_as_built_in_ones() -> Result<()> {
    let method = Method {
        formulation: BRAKED.spec().with("rate", "2"),
        integrator: MIDPOINT.spec(),
        projection: VELOCITIES.spec(),
        step: Some(0.01),
        rtol: 1e-6,
        ..Method::default()
    };
    let own = r#""formulation": { "braked": { "rate": 2 } }, "integrator": "midpoint", "projection": "velocities""#;
    let model = pendulum(own, with_elements())?;
    let in_code = bits(&simulate(model.system(), &method, model.start(), model.span()?)?.record);
    assert!(in_code.len() > 100);
    let mut by_scene = model.run();
    by_scene.to(1.0)?;
    assert_eq!(bits(by_scene.record()), in_code);

    let other = pendulum(r#""integrator": "rk4""#, with_elements())?;
    let mut by_text = other.run().method("braked:rate=2 + midpoint + velocities");
    by_text.to(1.0)?;
    assert_eq!(bits(by_text.record()), in_code);

    let set = Overrides {
        formulation: Some("braked:rate=2".parse()?),
        integrator: Some("midpoint".parse()?),
        projection: Some("velocities".parse()?),
        ..with_elements()
    };
    let by_overrides = pendulum(r#""integrator": "rk4""#, set)?;
    let mut by_overrides = by_overrides.run();
    by_overrides.to(1.0)?;
    assert_eq!(bits(by_overrides.record()), in_code);
    Ok(())
}

/// Other formulations with an error estimate leave the fixed step of the scene.
#[test]
fn a_text_keeps_the_tolerances_of_the_scene() -> Result<()> {
    let model = pendulum(r#""integrator": "rk4""#, Overrides::default())?;
    let mut by_text = model.run().method("ggl + radau_iia");
    by_text.to(1.0)?;
    let method = Method { rtol: 1e-6, atol: model.method.atol, ..Method::try_from("ggl + radau_iia")? };
    let in_code = simulate(model.system(), method, model.start(), model.span()?)?.record;
    assert_eq!(bits(by_text.record()), bits(&in_code));
    Ok(())
}

#[test]
fn names_that_are_not_known_are_refused_with_own_ones_to_choose_from() {
    let refusal = |simulation: &str| pendulum(simulation, with_elements()).err().unwrap().to_string();
    let table = [
        (r#""integrator": "midpont""#, "there is no integrator `midpont`\n  help: did you mean `midpoint`?"),
        (r#""formulation": "brakd""#, "there is no formulation `brakd`\n  help: did you mean `braked`?"),
        (r#""projection": "velocitie""#, "there is no projection `velocitie`\n  help: did you mean `velocities`?"),
        (r#""formulation": "braked:rat=1""#, "formulation braked has no option `rat`\n  help: did you mean `rate`?"),
        (r#""projection": "qqq""#, "choose one of velocities, none,"),
    ];
    for (simulation, expected) in table {
        let found = refusal(simulation);
        assert!(found.contains(expected), "{found}\nand not\n{expected}");
    }
    let unknown = pendulum(r#""integrator": "midpoint""#, Overrides::default()).err().unwrap().to_string();
    assert!(unknown.contains("there is no integrator `midpoint`"), "{unknown}");
    let model = pendulum(r#""integrator": "midpoint""#, with_elements()).unwrap();
    let late = model.run().method("index1 + midpont").to(1.0).unwrap_err().to_string();
    assert!(late.contains("did you mean `midpoint`?"), "{late}");
}

static TAKEN: IntegratorEntry = IntegratorEntry { name: "dop853", ..MIDPOINT_AGAIN };
const MIDPOINT_AGAIN: IntegratorEntry = IntegratorEntry::new("midpoint", "", 2, |_| unreachable!());
static AGAIN: IntegratorEntry = MIDPOINT_AGAIN;

#[test]
fn a_name_is_given_to_one_method() {
    for (entry, name) in [(&TAKEN, "dop853"), (&AGAIN, "midpoint")] {
        let error = elements().with_method(entry).err().unwrap().to_string();
        assert!(error.contains(&format!("the integrator `{name}` is there already")), "{error}");
    }
}

#[test]
fn the_schema_has_own_methods() {
    let has = |elements: &Elements| {
        let schema = prepared::schema(elements)["$defs"]["Simulation"].to_string();
        ["midpoint", "braked", "velocities"].map(|name| schema.contains(name))
    };
    assert_eq!((has(&elements()), has(&Elements::default())), ([true; 3], [false; 3]));
}
