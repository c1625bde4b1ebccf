use super::*;

pub fn model(name: &str) -> Place {
    Place::new(fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("models/{name}.json"))).unwrap())
}

/// A column of `loci.csv` by its heading.
fn column(csv: &str, name: &str) -> Vec<String> {
    let mut rows = csv.lines().map(|line| line.split(',').map(str::to_string).collect::<Vec<_>>());
    let place = rows.next().unwrap().iter().position(|heading| heading == name).unwrap();
    rows.map(|row| row[place].clone()).collect()
}

fn numbers(csv: &str, name: &str) -> Vec<f64> {
    column(csv, name).iter().map(|cell| cell.parse().unwrap()).collect()
}

pub fn refused(place: &Place, args: &[&str], parts: &[&str]) {
    let output = place.run(args);
    assert_eq!(output.status.code(), Some(2), "{args:?}: {}", err(&output));
    parts.iter().for_each(|part| assert!(err(&output).contains(part), "{args:?}: no `{part}` in {}", err(&output)));
}

#[test]
fn along_the_motion() {
    let place = model("two_mass");
    let text = place.done(&["loci", "scene.json", "-o", "here"]);
    // A motion is drawn over time: 61 eigenvalues in the complex plane would be loose dots.
    assert_eq!(place.files("here"), ["loci.csv", "loci.json", "loci_modes.svg"]);
    let figure = place.text("here/loci_modes.svg");
    assert!(figure.contains("time (s)") && figure.contains("frequency Im λ/2π (Hz)"), "{figure}");
    assert!(text.contains("61 of 61 states") && text.contains("mode1  0.79577") && text.contains("written to here"));
    let csv = place.text("here/loci.csv");
    assert!(csv.starts_with("t,mode1.re,mode1.im,mode1.frequency_hz,mode1.damping_ratio\n0,"), "{csv}");
    assert_eq!(numbers(&csv, "t")[60], 5.0);
    assert!(numbers(&csv, "mode1.im").iter().all(|im| (im - 5.0).abs() < 1e-9));
    let json = place.json("here/loci.json");
    assert_eq!((&json["method"], &json["chart"]), (&"mcs".into(), &"intrinsic".into()));
    assert_eq!((&json["along"]["name"], &json["along"]["unit"]), (&"t".into(), &"s".into()));
    assert_eq!(json["branches"][0]["points"].as_array().unwrap().len(), 61);
    assert_eq!((&json["branches"][0]["kind"], &json["branches"][0]["pair"]), (&"physical".into(), &true.into()));
    assert_eq!(json["states"][0]["equilibrium"], Value::Bool(false));
    let part = ["loci", "scene.json", "--every", "0.5", "--from", "1", "--until", "2.2", "--json", "--figures", "none"];
    let json: Value = serde_json::from_str(&place.done(&part)).unwrap();
    assert_eq!((&json["along"]["from"], &json["along"]["to"], &json["reached"]), (&1.0.into(), &2.0.into(), &3.into()));
    assert!(json.get("branches").is_none() && json["modes"][0]["growing"].as_array().unwrap().is_empty());
}

#[test]
fn over_a_parameter() {
    let place = model("two_mass");
    for state in [&[][..], &["--at", "0.3"], &["--equilibrium"]] {
        let args = ["loci", "scene.json", "--sweep", "k1=10..1000:6:log", "-o", "here", "--figures", "none", "--quiet"];
        assert_eq!(place.done(&[&args, state].concat()), "");
        let csv = place.text("here/loci.csv");
        let k1 = numbers(&csv, "k1");
        let im = numbers(&csv, "mode1.im");
        assert_eq!((k1.len(), k1[0], k1[5]), (6, 10.0, 1000.0));
        assert!(k1.iter().zip(im).all(|(k1, im)| (im - (k1 / 4.0).sqrt()).abs() < 1e-9), "{csv}");
        let json = place.json("here/loci.json");
        assert_eq!((&json["along"]["name"], &json["along"]["log"]), (&"k1".into(), &true.into()));
    }
}

/// A mass on a spring along an arm that turns: w^2 = k/m - W^2.
const ARM: &str = r#"{ "name": "arm", "dimension": 2, "parameters": { "speed": 2 }, "ground": { "markers": { "O": [0, 0] } },
    "bodies": [
        { "name": "hub", "type": "rigid", "mass": 1, "inertia": 1, "markers": { "O": [0, 0] } },
        { "name": "mass", "type": "point_mass", "mass": 1, "initial": { "position": [1, 0] } }],
    "joints": [
        { "name": "bearing", "type": "revolute", "between": ["ground.O", "hub.O"] },
        { "name": "drive", "type": "driver", "between": ["ground.O", "hub.O"], "coordinate": "angle", "value": "speed*t" },
        { "name": "arm", "type": "point_on_line", "between": ["hub.O", "mass"] }],
    "forces": [{ "name": "spring", "type": "spring_damper", "between": ["hub.O", "mass"], "stiffness": 100, "free_length": 1 }],
    "simulation": { "t_end": 1 } }"#;

#[test]
fn a_campbell_diagram_knows_the_unit_of_its_speed() {
    let place = Place::new(ARM);
    let text = place.done(&["loci", "scene.json", "--sweep", "speed=0..6:4", "--equilibrium", "-o", "here"]);
    assert!(text.contains("speed from 0 to 6 rad/s") && text.contains("growing at speed (rad/s)"), "{text}");
    let csv = place.text("here/loci.csv");
    for (speed, im) in numbers(&csv, "speed").into_iter().zip(numbers(&csv, "mode1.im")) {
        assert!((im - (100.0 - speed * speed).sqrt()).abs() < 1e-9, "{csv}");
    }
    let json = place.json("here/loci.json");
    assert_eq!((&json["along"]["unit"], &json["states"][3]["turning"]), (&"rad/s".into(), &6.0.into()));
    let figure = place.text("here/loci_modes.svg");
    let parts = [">speed (rad/s)<", ">1×<", ">2×<", "in axes that turn along"];
    parts.iter().for_each(|part| assert!(figure.contains(part), "{part}: {figure}"));
    // Where no steady rotation tells it, the unit is given.
    let given = ["loci", "scene.json", "--sweep", "speed=60..120:4", "--unit", "rpm", "-o", "given"];
    place.done(&given);
    let figure = place.text("given/loci_modes.svg");
    assert!(figure.contains(">speed (rpm)<") && figure.contains(">2×<"), "{figure}");
    place.done(&["loci", "scene.json", "--sweep", "speed=1..2:3", "-o", "bare"]);
    assert!(!place.text("bare/loci_modes.svg").contains(">1×<"));
}

#[test]
fn a_stability_limit_over_a_parameter() {
    let place = model("four_bar_spring");
    let args = ["loci", "scene.json", "--sweep", "k1=10..1000:50", "--equilibrium", "-o", "here"];
    let text = place.done(&args);
    assert!(text.contains("all are equilibria") && text.contains("10 to 30.2041"), "{text}");
    let json = place.json("here/loci.json");
    assert_eq!((&json["equilibria"], &json["modes"][0]["growing"][0]["from"]), (&50.into(), &10.0.into()));
    let csv = place.text("here/loci.csv");
    assert!(numbers(&csv, "mode2.re").iter().zip(numbers(&csv, "mode1.re")).all(|(low, high)| *low <= high));
    let again = place.text("here/loci.csv");
    place.done(&args);
    assert_eq!(place.text("here/loci.csv"), again);
}

#[test]
fn values_without_a_model_are_gaps_with_their_reason() {
    let place = model("two_mass");
    let args = ["loci", "scene.json", "--sweep", "m1=-2..4:4", "-o", "here", "--figures", "none"];
    let output = place.run(&args);
    let text = out(&output);
    // What was found is written, and what failed is a failure.
    assert!(output.status.code() == Some(1) && err(&output).contains("1 of 4 values have no eigenvalues"), "{text}");
    assert!(text.contains("NO EIGENVALUES at m1 = -2"), "{text}");
    assert_eq!(column(&place.text("here/loci.csv"), "mode1.re")[0], "");
    assert!(place.json("here/loci.json")["failures"][0]["reason"].as_str().unwrap().len() > 10);
    let output = place.run(&["loci", "scene.json", "--sweep", "m1=-4..-2:3", "-o", "none"]);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    assert!(err(&output).contains("no state has eigenvalues; at m1 = -4"), "{}", err(&output));
    assert!(place.files("none").is_empty());
}

#[test]
fn bad_loci_are_refused() {
    let place = model("two_mass");
    let table: [(&[&str], &[&str]); 10] = [
        (&["--sweep", "k1=10..1000:1"], &["the number of values is 1"]),
        (&["--sweep", "k1=0..1000:5:log"], &["there is no constant factor"]),
        (&["--sweep", "k2=10..1000:5"], &["unknown parameter `k2`", "did you mean"]),
        (&["--sweep", "k1=10..1000:5", "--at", "9"], &["at --at", "t = 9 s is outside the run"]),
        (&["--from", "9"], &["at --from", "t = 9 s is not within the run"]),
        (&["--every", "9"], &["at --every", "states every 9 s"]),
        (&["--method", "msc"], &["at --method", "did you mean `mcs`"]),
        (&["--independent", "first.y"], &["there is no coordinate `first.y`"]),
        (&["--equilibrium"], &["--sweep"]),
        (&["--unit", "N/m"], &["--sweep"]),
    ];
    for (options, parts) in table {
        refused(&place, &[&["loci", "scene.json"], options].concat(), parts);
    }
}

#[test]
fn a_frequency_response() {
    let place = model("two_mass");
    let args = ["bode", "scene.json", "--equilibrium", "--set", "c1=2", "--output", "x2", "-o", "here"];
    let text = place.done(&args);
    assert_eq!(place.files("here"), ["bode-0.csv", "bode-0.json", "bode-0.svg"]);
    assert!(text.contains("x2 / push") && text.contains("m/N") && text.contains("an equilibrium"), "{text}");
    let csv = place.text("here/bode-0.csv");
    let f = numbers(&csv, "frequency_hz");
    let size = numbers(&csv, "x2/push.magnitude");
    let phase = numbers(&csv, "x2/push.phase_deg");
    assert!(f.is_sorted() && f.len() > 400 && (f[0] - 0.5 / TAU).abs() < 1e-9);
    for ((f, size), phase) in f.iter().zip(size).zip(phase) {
        let re = 100.0 - 4.0 * (TAU * f).powi(2);
        let im = 2.0 * TAU * f;
        assert!((size * re.hypot(im) - 1.0).abs() < 1e-11 && (phase.to_radians() + im.atan2(re)).abs() < 1e-9);
    }
    let json = place.json("here/bode-0.json");
    assert_eq!((&json["responses"][0]["input"], &json["responses"][0]["input_unit"]), (&"push".into(), &"N".into()));
    let part = ["bode", "scene.json", "--from", "1", "--to", "10", "--points", "3", "--at", "0.5,1", "--json"];
    let json: Value = serde_json::from_str(&place.done(&part)).unwrap();
    assert_eq!(json[1]["frequency_hz"].as_array().unwrap().len(), 3);
    assert_eq!((&json[0]["t"], json[0]["responses"].as_array().unwrap().len()), (&0.5.into(), 5));
}

const TAU: f64 = std::f64::consts::TAU;

#[test]
fn bad_frequency_responses_are_refused() {
    let place = model("two_mass");
    let table: [(&[&str], &[&str]); 5] = [
        (&["--input", "pull"], &["at --input", "there is no input `pull`", "there is only `push`"]),
        (&["--output", "x3"], &["at --output", "there is no output `x3`", "did you mean"]),
        (&["--from", "5", "--to", "2"], &["at --to", "from 5 Hz to 2 Hz"]),
        (&["--points", "1"], &["--points"]),
        (&["--at", "9"], &["at --at", "outside the run"]),
    ];
    for (options, parts) in table {
        refused(&place, &[&["bode", "scene.json"], options].concat(), parts);
    }
    refused(
        &Place::new(PENDULUM),
        &["bode", "scene.json"],
        &["the scene has no inputs", "add to the scene \"inputs\""],
    );
}

#[test]
fn loci_of_a_simpler_model_are_drawn_and_matched() {
    let place = Place::new(super::linear::chain(false));
    fs::write(place.path("one.json"), super::linear::chain(true)).unwrap();
    let text = place.done(&["loci", "scene.json", "--every", "0.1", "--against", "one.json", "-o", "here"]);
    assert!(text.contains("\nagainst one: of 2 modes 1 lost\n"), "{text}");
    let told = place.json("here/loci.json");
    let slow = (102.0 - (102.0f64 * 102.0 - 400.0).sqrt()).sqrt();
    let shift = told["against"]["modes"][0]["shift"].as_f64().unwrap();
    // Linear: the same at all times.
    assert!((shift - (2.0f64.sqrt() / slow - 1.0)).abs() < 1e-7, "{shift}");
    assert!(told["against"]["modes"][1]["there"].is_null());
    assert!(place.text("here/loci_modes.svg").contains(">one<"));
}

/// A disc of 1 kg on a shaft of 2500 N/m: damping of 3 N s/m turns with it, and 2 N s/m does not.
const JEFFCOTT: &str = include_str!("../data/jeffcott.json");

/// A cantilever under a force P along its end, of eight elements, whose threshold is 0.08 % below 20.0509536.
const BECK: &str = r#"{ "name": "beck", "dimension": 2, "parameters": { "P": 20 }, "ground": { "markers": { "wall": [0, 0] } },
    "bodies": [{ "name": "rod", "type": "flexible_beam", "frame": "absolute", "length": 1, "elements": 8,
        "stiffness": { "EA": 1e8, "EI": 1 }, "inertia": { "rhoA": 1 }, "markers": { "root": [0, 0], "tip": [1, 0] } }],
    "joints": [{ "name": "clamp", "type": "weld", "between": ["ground.wall", "rod.root"] }],
    "forces": [{ "name": "follow", "type": "applied_force", "at": "rod.tip", "axes": "marker", "force": ["-P", 0] }],
    "simulation": { "t_end": 1 } }"#;

/// In text to eleven digits, in the file to all, in the figure to six.
#[test]
fn published_thresholds_are_told() {
    let place = Place::new(JEFFCOTT);
    let text = place.done(&["loci", "scene.json", "--sweep", "speed=40..120:5", "--equilibrium", "-o", "here"]);
    let told = "speed = 83.333333333: an eigenvalue crosses the imaginary axis at +-33.3333i 1/s, growth above";
    assert!(text.contains(told), "{text}");
    assert!(text.contains("change of each eigenvalue per unit of speed at 40"), "{text}");
    let json = place.json("here/loci.json");
    let threshold = &json["thresholds"][0];
    assert!((threshold["at"].as_f64().unwrap() - 250.0 / 3.0).abs() < 1e-10, "{threshold}");
    assert_eq!((&threshold["kind"], &threshold["growing"]), (&"crossing".into(), &serde_json::json!([0, 1])));
    assert!(
        json["branches"][0]["points"][0]["d_im"].is_number()
            && json["sensitivity"]["eigenvalues"][0]["error"].is_number()
    );
    let figure = place.text("here/loci_modes.svg");
    assert!(figure.contains(">83.3333<") && !figure.contains("83.33333"), "{figure}");

    let place = Place::new(BECK);
    let text = place.done(&["loci", "scene.json", "--sweep", "P=19..21:3", "--equilibrium", "-o", "here"]);
    assert!(
        text.contains("  P = 20.035") && text.contains("two eigenvalues meet at +-11.0099i 1/s, growth above"),
        "{text}"
    );
    let at = place.json("here/loci.json")["thresholds"][0]["at"].as_f64().unwrap();
    assert!((at / 20.0509536 - 1.0).abs() < 9e-4, "{at}");
    assert!(place.text("here/loci_modes.svg").contains(">20.0351<"));
}
