use super::*;

const QUICK: [&str; 8] = ["--budget", "4s", "--repeats", "2", "--figures", "none", "-o", "here"];

fn tradeoff(place: &Place, more: &[&str]) -> String {
    place.done(&[&["tradeoff", "scene.json"], &QUICK[..], more].concat())
}

fn json(place: &Place, file: &str) -> Value {
    serde_json::from_str(&place.text(file)).unwrap()
}

fn models() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("models")
}

#[test]
fn a_sentence_a_table_and_a_figure() {
    let place = Place::new(PENDULUM);
    let args = ["tradeoff", "scene.json", "--budget", "5s", "-o", "here", "--formulation", "index1", "--digits", "5"];
    let text = place.done(&args);
    assert!(text.starts_with("pendulum: speed for accuracy, 0 s to 1 s\n  compared at 200 times"), "{text}");
    assert!(text.contains("  reference: index1 + dop853 + exact, rtol 1e-1"), "{text}");
    assert!(text.contains("  for 5 digits: index1 + ") || text.contains(" to 5 digits: index1 + "), "{text}");
    assert!(text.contains(" ms; "), "{text}");
    assert!(text.contains("\n  holonom simulate scene.json --formulation index1 --integrator "), "{text}");
    assert!(text.contains("  5 digits or more "), "{text}");
    assert_eq!(place.files("here"), ["tradeoff.csv", "tradeoff.json", "tradeoff.svg"]);
    let table = place.text("here/tradeoff.csv");
    let result = json(&place, "here/tradeoff.json");
    assert!(result["seconds"].as_f64().unwrap() < 5.05, "the budget binds: {} s", result["seconds"]);
    let cells = result["cells"].as_array().unwrap().len();
    assert_eq!(table.lines().count(), cells + 1);
    assert!(table.starts_with("formulation,integrator,projection,rtol,atol,step,status,digits,"));
    let cells = table.split([',', '\n']).filter_map(|cell| cell.parse::<f64>().ok());
    assert!(cells.into_iter().all(f64::is_finite));
}

/// The recommendation is confirmed by running its command, against the reference in the file.
#[test]
fn recommendations_of_andrews_mechanism_hold() {
    let place = Place::new(fs::read_to_string(models().join("andrews.json")).unwrap());
    let more = ["--integrator", "dop853", "--integrator", "dopri5", "--integrator", "phem56", "--budget", "10s"];
    place.done(&[&["tradeoff", "scene.json", "--figures", "none", "-o", "here", "--quiet"], &more[..]].concat());
    let result = json(&place, "here/tradeoff.json");
    let values = &result["reference"]["values"];
    let scales = values["scales"].as_array().unwrap();
    let names: Vec<&str> = values["names"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    let number = |value: &Value| value.as_f64().unwrap();
    for advice in result["recommendations"].as_array().unwrap() {
        let digits = number(&advice["digits"]);
        if digits % 3.0 != 0.0 {
            continue;
        }
        let command = advice["command"].as_str().unwrap();
        let args: Vec<&str> = command.split(' ').skip(1).collect();
        place.done(&[&args[..], &["--output-step", "0.00015", "--figures", "none", "-o", "run", "--quiet"]].concat());
        let table = place.text("run/trajectory.csv");
        let headings: Vec<&str> = table.lines().next().unwrap().split(',').collect();
        let rows: Vec<Vec<f64>> =
            table.lines().skip(2).map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
        for (i, name) in names.iter().enumerate() {
            let column = headings.iter().position(|heading| heading == name).unwrap();
            let pairs = values["rows"].as_array().unwrap().iter().zip(&rows);
            let error = pairs.fold(0.0f64, |error, (own, row)| error.max((number(&own[i]) - row[column]).abs()));
            // Rows where they were compared: the run is the same one to the last bit.
            assert!(
                error <= 1.0001 * 10f64.powf(-digits) * number(&scales[i]),
                "{name}: {error:e} for {digits} digits"
            );
        }
    }
    assert!(result["recommendations"].as_array().unwrap().len() >= 8);
}

/// A wrong table of values vouches for nothing: that is said, and no success.
#[test]
fn no_recommendation_is_no_success() {
    let scene = PENDULUM.replace(r#""t_end": 1,"#, r#""t_end": 1, "reference": "values.csv","#);
    let place = Place::new(&scene);
    fs::write(place.path("values.csv"), "t,theta\n0,0\n1,77\n").unwrap();
    let args = ["--formulation", "index1", "--integrator", "dop853", "--outputs", "theta"];
    let output = place.run(&[&["tradeoff", "scene.json"], &QUICK[..], &args].concat());
    assert_eq!(output.status.code(), Some(1));
    assert!(
        err(&output).contains("error: no recommendation: the reference has no digit that a second run confirms"),
        "{}",
        err(&output)
    );
    assert_eq!(place.files("here"), ["tradeoff.csv", "tradeoff.json"]);
}

#[test]
fn a_measurement_goes_on_where_it_was() {
    let place = Place::new(PENDULUM);
    let names = ["--formulation", "index1", "--integrator", "dopri5", "--json"];
    let own = ["tradeoff", "scene.json", "--figures", "none", "-o", "here"];
    let measure = |budget: &str, more: &[&str]| -> Value {
        let printed = place.done(&[&own[..], &names, &["--budget", budget], more].concat());
        serde_json::from_str(&printed).unwrap()
    };
    let cells = |result: &Value| result["cells"].as_array().unwrap().clone();
    let count = |result: &Value| cells(result).iter().filter(|cell| cell["status"] == "completed").count();
    // What was measured stays; what took too long, or was left out, may be measured.
    let part = measure("200ms", &[]);
    let whole = measure("20s", &["--resume"]);
    let again = measure("20s", &["--resume"]);
    assert!(0 < count(&part) && count(&part) < count(&whole), "{} {}", count(&part), count(&whole));
    for [earlier, later] in [[&part, &whole], [&whole, &again]] {
        let later = cells(later);
        for a in cells(earlier).iter().filter(|cell| cell["status"] == "completed") {
            let b = later.iter().find(|b| a["method"] == b["method"]).unwrap();
            assert_eq!((&a["error"], &a["cpu_seconds"]), (&b["error"], &b["cpu_seconds"]));
        }
    }
    let other = place.run(&["tradeoff", "scene.json", "-o", "here", "--resume", "--until", "0.5"]);
    assert_eq!(other.status.code(), Some(2));
    assert!(err(&other).contains("leave out --resume to begin anew"), "{}", err(&other));
    let none = place.run(&["tradeoff", "scene.json", "-o", "nowhere", "--resume"]);
    assert_eq!(none.status.code(), Some(2));
    assert!(err(&none).contains("there is no measurement to go on with"), "{}", err(&none));
}

#[test]
fn bad_input_is_refused_before_anything_is_run() {
    let place = Place::new(PENDULUM);
    for (args, words) in [
        (["--integrator", "dop854"], "dop853"),
        (["--formulation", "baumgarte:gain=3"], "has no option `gain`"),
        (["--projection", "manifild"], "manifold"),
        (["--outputs", "thета"], "there is no output"),
        (["--budget", "3 days"], "no unit of time"),
        (["--budget", "-3s"], "above zero"),
        (["--rows", "0"], "0"),
        (["--reference", "missing.csv"], "missing.csv"),
        (["--variants", "missing.json"], "missing.json"),
        (["--variants", "scene.json:l"], "scene.json:l"),
        (["--variants", "scene.json:l=one"], "at --variants (`l`): unknown parameter `l`"),
    ] {
        let output = place.run(&[&["tradeoff", "scene.json", "-o", "here"], &args[..]].concat());
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(err(&output).contains(words), "{args:?}: {}", err(&output));
    }
}

/// A scene may bring the values it is measured against.
#[test]
fn a_scene_brings_its_reference() {
    let scene = PENDULUM.replace(r#""t_end": 1,"#, r#""t_end": 1, "reference": "values.csv","#);
    let place = Place::new(&scene);
    let args =
        ["simulate", "scene.json", "--integrator", "dop853", "--rtol", "1e-13", "--atol", "1e-15", "--figures", "none"];
    place.done(&[&args[..], &["-o", "tight"]].concat());
    fs::copy(place.path("tight/trajectory.csv"), place.path("values.csv")).unwrap();
    let names = ["--formulation", "index1", "--integrator", "dop853", "--outputs", "theta", "--json"];
    let result: Value = serde_json::from_str(&tradeoff(&place, &names)).unwrap();
    assert!(result["reference"]["from"].as_str().unwrap().ends_with("values.csv"));
    assert!(result["reference"]["error"].as_f64().unwrap() < 1e-11);
}

#[test]
fn models_are_compared() {
    let place = Place::new(fs::read_to_string(models().join("five_link_suspension.json")).unwrap());
    let rods = models().join("five_link_suspension_rods.json").display().to_string();
    let args = ["tradeoff", "scene.json", "--until", "0.2", "--repeats", "1", "-o", "here", "--variants", &rods];
    let text = place.done(&args);
    assert!(text.starts_with("models against the full model, five_link_suspension_rods, at 200 times"), "{text}");
    assert!(text.contains("  within 10 % in all outputs: "), "{text}");
    assert!(
        text.contains("  the full model is converged: without a mesh to refine, with a hundredth of its tolerance the worst output changes"),
        "{text}"
    );
    assert_eq!(place.files("here"), ["models.csv", "models.json", "models.svg"]);
    let result = json(&place, "here/models.json");
    assert_eq!(result["richest"], 1);
    assert_eq!(result["models"][0]["velocities"], 7);
}

/// Two masses between a soft spring and a stiff one: models and methods in one figure.
#[test]
fn models_are_found_and_measured() {
    let place = Place::new(super::linear::chain(false));
    let text = tradeoff(&place, &["--models", "auto"]);
    assert!(text.starts_with("two: models and methods, errors together\n"), "{text}");
    assert_eq!(place.files("here"), ["tradeoff_models.csv", "tradeoff_models.json"]);
    let told = json(&place, "here/tradeoff_models.json");
    let models = told["models"].as_array().unwrap();
    assert!(models[0]["error"] == 0.0 && models[0]["name"] == "as it is", "{text}");
    // What is found keeps its promise, also as it is measured here.
    let error = |model: &Value| model["error"].as_f64().unwrap();
    assert!(models.len() > 1 && error(&models[1]) > 0.0 && error(&models[1]) < 0.1, "{text}");
    let run = |line: &str| line.split(',').skip(4).map(|cell| cell.parse::<f64>().unwrap()).collect::<Vec<_>>();
    for line in place.text("here/tradeoff_models.csv").lines().skip(1) {
        let [_, model, method, both] = run(line)[..] else { panic!("{line}") };
        assert!((both - model - method).abs() <= 1e-9 * both, "{line}");
    }
}
