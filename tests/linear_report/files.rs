//! `linear-T.json`, `.npz` and `.mat`.

use super::sample::{descriptor, empty, plain, prepared};
use holonom::files::Array;
use holonom::linearize::LinearModel;
use holonom::prepared::Model;
use holonom::report::Folder;
use holonom::report::linear::{NamedModel, stem_at};
use serde_json::Value;

fn linear<'a>(prepared: &'a Model, model: &'a LinearModel, names: &'a holonom::system::Names) -> NamedModel<'a> {
    NamedModel { scene: &prepared.name, names, model }
}

fn json(model: &LinearModel) -> Value {
    let prepared = prepared("four_bar_spring");
    let names = prepared.system().facts().names.clone();
    serde_json::to_value(linear(&prepared, model, &names)).unwrap()
}

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().unwrap().keys().map(String::as_str).collect()
}

#[test]
fn keys_are_those_of_the_contract() {
    let prepared = prepared("four_bar_spring");
    let file = json(&descriptor(&prepared));
    let all = [
        "scene",
        "t",
        "method",
        "chart",
        "states",
        "inputs",
        "outputs",
        "A",
        "B",
        "C",
        "D",
        "E",
        "reduction",
        "comparable",
        "eigenvalues",
        "equilibrium",
        "operating_point",
        "cost",
    ];
    assert_eq!(keys(&file), all);
    assert_eq!(
        keys(&file["eigenvalues"][0]),
        ["re", "im", "frequency_hz", "damping_ratio", "kind", "error", "condition", "participation"]
    );
    assert_eq!(keys(&file["operating_point"]), ["q", "v", "vdot", "lambda", "u", "norms"]);
    assert_eq!(keys(&file["operating_point"]["norms"]), ["phi", "phi_dot", "v", "vdot"]);
    assert_eq!(keys(&file["cost"]), ["assembly_seconds", "eigen_seconds", "conditioning", "size", "off_constraints"]);
    assert_eq!(keys(&file["operating_point"]["q"])[..3], ["crank.x", "crank.y", "crank.angle"]);
    assert_eq!(file["operating_point"]["v"]["crank.angle'"], 1.0);
    assert_eq!(file["operating_point"]["norms"]["v"], 1.0);
    let without = json(&plain(&prepared));
    assert!(without.get("E").is_none());
}

#[test]
fn matrices_are_rows_of_numbers() {
    let prepared = prepared("four_bar_spring");
    let mut model = plain(&prepared);
    model.a[(1, 0)] = -25.0;
    let file = json(&model);
    assert_eq!((&file["A"][0][0], &file["A"][0][1], &file["A"][1][0]), (&0.0.into(), &1.0.into(), &(-25.0).into()));
    let size = |key: &str| (file[key].as_array().unwrap().len(), file[key][0].as_array().unwrap().len());
    assert_eq!(["A", "B", "C", "D"].map(size), [(2, 2), (2, 1), (2, 2), (2, 1)]);
}

#[test]
fn eigenvalues_have_kinds_and_parts() {
    let file = json(&descriptor(&prepared("four_bar_spring")));
    let kinds: Vec<&str> =
        file["eigenvalues"].as_array().unwrap().iter().map(|value| value["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, [vec!["physical"; 2], vec!["spurious"; 3], vec!["infinite"; 4]].concat());
    // From the largest part; what is below a thousandth is left out.
    assert_eq!(file["eigenvalues"][0]["participation"].to_string(), r#"{"z1'":0.5995,"z1":0.4}"#);
    let mut small = plain(&prepared("four_bar_spring"));
    small.modes[0].participation = vec![0.9995, 0.0005];
    assert_eq!(json(&small)["eigenvalues"][0]["participation"].to_string(), r#"{"z1":0.9995}"#);
    assert_eq!(file["eigenvalues"][4]["re"], -7.0);
    assert_eq!(file["eigenvalues"][4]["damping_ratio"], 1.0);
    assert_eq!(file["eigenvalues"][2]["frequency_hz"], 26f64.sqrt() / std::f64::consts::TAU);
}

#[test]
fn no_file_holds_what_is_no_number() {
    let file = json(&descriptor(&prepared("four_bar_spring")));
    for key in ["re", "im", "frequency_hz", "damping_ratio"] {
        assert_eq!(file["eigenvalues"][8][key], Value::Null);
    }
    assert_eq!(file["cost"]["conditioning"], Value::Null);
    let text = file.to_string();
    assert!(!text.contains("NaN") && !text.contains("inf,") && !text.contains("Infinity"), "{text}");
}

#[test]
fn arrays_fit_each_other() {
    let prepared = prepared("four_bar_spring");
    let model = descriptor(&prepared);
    let names = prepared.system().facts().names.clone();
    let arrays = linear(&prepared, &model, &names).arrays();
    let find = |name: &str| &arrays.iter().find(|(known, _)| *known == name).unwrap().1;
    let shape = |name: &str| match find(name) {
        Array::Real { shape, values } => {
            assert!(values.iter().all(|value| !value.is_nan()) && values.len() == shape.iter().product::<usize>());
            shape.clone()
        }
        Array::Complex { shape, values } => {
            assert!(values.iter().all(|value| !value.re.is_nan() && !value.im.is_nan()));
            shape.clone()
        }
        Array::Texts(list) => vec![list.len()],
        other => panic!("{other:?}"),
    };
    assert_eq!(["A", "B", "C", "D", "E"].map(shape), [[2, 2], [2, 1], [2, 2], [2, 1], [2, 2]]);
    assert_eq!(["eigenvalues", "kinds", "frequency_hz", "damping_ratio"].map(shape), [[9], [9], [9], [9]]);
    assert_eq!((shape("mode_shapes"), shape("participation")), (vec![9, 9], vec![2, 9]));
    assert_eq!(["q", "q_names", "v", "v_names", "vdot"].map(shape), [[9]; 5]);
    assert_eq!((shape("lambda"), shape("lambda_names")), (vec![8], vec![8]));
    assert_eq!((find("equilibrium"), find("chart")), (&Array::Flag(false), &Array::Text("frozen".to_string())));
    let Array::Complex { values, .. } = find("eigenvalues") else { panic!() };
    assert_eq!((values[2].re, values[8].re, values[8].im), (-5.0, f64::INFINITY, 0.0));
}

#[test]
fn arrays_for_both_programs_also_where_nothing_moves() {
    let prepared = prepared("four_bar_spring");
    let names = prepared.system().facts().names.clone();
    for model in [descriptor(&prepared), empty(&prepared)] {
        let place = tempfile::tempdir().unwrap();
        let mut folder = Folder::create(place.path()).unwrap();
        linear(&prepared, &model, &names).write(&mut folder, &stem_at("linear", 0.01)).unwrap();
        folder.finish().unwrap();
        let mut found: Vec<String> =
            std::fs::read_dir(place.path()).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        found.sort();
        assert_eq!(found, ["linear-0.01.mat", "linear-0.01.npz"]);
    }
}

#[test]
fn names_of_files_are_times_as_written() {
    let table =
        [(0.01, "linear-0.01"), (0.0, "linear-0"), (1.0, "linear-1"), (0.1 + 0.2, "linear-0.30000000000000004")];
    table.iter().for_each(|(t, name)| assert_eq!(stem_at("linear", *t), *name));
    assert_eq!(stem_at("linear", 2.5e-7), "linear-2.5e-7");
}
