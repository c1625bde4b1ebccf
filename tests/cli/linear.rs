use super::loci::{model, refused};
use super::*;

#[test]
fn linearize_writes_what_it_says() {
    let place = model("five_link_suspension");
    let text = place.done(&["linearize", "scene.json", "--equilibrium", "-o", "here"]);
    assert_eq!(place.files("here"), ["linear-0.json", "linear-0.mat", "linear-0.npz", "modes-0.svg"]);
    assert!(text.contains("1.3885") && text.contains("0.2331") && text.contains("12.156"), "{text}");
    let json = place.json("here/linear-0.json");
    let keys: Vec<&str> = json.as_object().unwrap().keys().map(String::as_str).collect();
    for key in ["t", "method", "chart", "states", "inputs", "outputs", "A", "B", "C", "D", "eigenvalues", "equilibrium"]
    {
        assert!(keys.contains(&key), "{key}: {keys:?}");
    }
    assert_eq!((&json["method"], &json["equilibrium"]), (&"mcs".into(), &true.into()));
    assert_eq!(json["A"].as_array().unwrap().len(), 4);
    assert_eq!(json["C"].as_array().unwrap().len(), json["outputs"].as_array().unwrap().len());
    // The theory page's numbers have four digits.
    let modes = json["eigenvalues"].as_array().unwrap();
    let near = |mode: usize, key: &str, value: f64| (modes[mode][key].as_f64().unwrap() / value - 1.0).abs() < 3e-3;
    assert!(near(0, "frequency_hz", 1.389) && near(0, "damping_ratio", 0.233), "{modes:?}");
    assert!(near(2, "frequency_hz", 12.16) && near(2, "damping_ratio", 0.40), "{modes:?}");
}

#[test]
fn all_methods_stand_beside_each_other() {
    let place = model("four_bar_spring");
    let args = ["linearize", "scene.json", "--set", "p0=1.5", "--set", "w0=0", "--equilibrium", "--method", "all"];
    let json: Value = serde_json::from_str(&place.done(&[&args[..], &["--json", "-o", "here"]].concat())).unwrap();
    let methods = json["methods"].as_array().unwrap();
    assert!(methods.len() >= 15);
    for row in methods {
        let name = row["method"].as_str().unwrap();
        let is_penalty = name.starts_with("penalty") || name.starts_with("augmented");
        // Penalties with their default factors are off by what the factor allows.
        let most = if is_penalty { 1e-5 } else { 1e-9 };
        assert!(row["error"].as_f64().unwrap() < most && row["physical"] == 2, "{row}");
    }
    assert_eq!(place.files("here"), ["linear-0.json", "linear-0.mat", "linear-0.npz", "methods-0.json", "modes-0.svg"]);
}

/// The pencils of the modal link have no gap between finite and infinite eigenvalues; the other methods stand.
#[test]
fn a_method_without_a_model_is_left_out_of_the_comparison() {
    let place = model("modal_link");
    place.done(&["linearize", "scene.json", "--method", "all", "--figures", "none", "-o", "here"]);
    let json = place.json("here/methods-0.json");
    let left_out: Vec<&str> = json["warnings"].as_array().unwrap().iter().map(|x| x.as_str().unwrap()).collect();
    assert!(left_out.iter().any(|warning| warning.starts_with("no model by rcs")), "{left_out:?}");
    assert_eq!(json["methods"].as_array().unwrap()[0]["method"], "mcs");
}

#[test]
fn models_at_states_of_the_motion() {
    let place = model("four_bar_spring");
    let args = ["linearize", "scene.json", "--at", "0.1,0.3", "--independent", "crank.angle", "--json", "-o", "here"];
    let json: Value = serde_json::from_str(&place.done(&args)).unwrap();
    assert_eq!(json[1]["t"], 0.3);
    assert_eq!(json[1]["chart"], "crank.angle");
    assert_eq!(json[1]["states"], serde_json::json!(["crank.angle", "crank.angle'"]));
    // A state does not depend on which others are asked for, but for the steps of its integration, at 1e-10.
    let alone =
        place.done(&["linearize", "scene.json", "--at", "0.3", "--independent", "crank.angle", "--json", "-o", "x"]);
    let alone: Value = serde_json::from_str(&alone).unwrap();
    let entry = |json: &Value| json["A"][1][0].as_f64().unwrap();
    assert!((entry(&alone) / entry(&json[1]) - 1.0).abs() < 1e-7);
}

#[test]
fn what_cannot_be_linearized_is_told() {
    let place = model("four_bar_spring");
    refused(&place, &["linearize", "scene.json", "--at", "1e9"], &["outside the run", "--until"]);
    refused(&place, &["linearize", "scene.json", "--method", "mccs"], &["no method `mccs`", "mcs"]);
    refused(&place, &["linearize", "scene.json", "--method", "rcs:form=index4"], &["index4", "ggl"]);
    refused(&place, &["linearize", "scene.json", "--independent", "crank.angel"], &["no coordinate", "crank.angle"]);
    refused(
        &place,
        &["linearize", "scene.json", "--independent", "crank.angle,rocker.angle"],
        &["1 degrees of freedom", "independent here are"],
    );
    // The coupler of the rhombus does not turn.
    refused(
        &place,
        &["linearize", "scene.json", "--independent", "coupler.angle"],
        &["not independent at t = 0 s", "independent here are: coupler."],
    );
    refused(&place, &["linearize", "scene.json", "--modes", "0"], &["--modes"]);
}

#[test]
fn validate_has_a_verdict() {
    let place = model("four_bar_spring");
    let text = place.done(&["validate", "scene.json", "--at", "0.3", "-o", "here"]);
    assert!(text.contains("verdict: right") && text.contains("(chart intrinsic)"), "{text}");
    let json = place.json("here/validation-0.3.json");
    for key in ["epsilons", "errors_ltv", "order_ltv", "errors_lti", "horizons", "verdict"] {
        assert!(!json[key].is_null(), "{key}");
    }
    for key in ["a", "b", "c", "d"] {
        let number = |name: &str| json[key][name].as_f64().unwrap();
        assert!(number("difference") <= 3.0 * number("uncertainty"), "{key}: {}", json[key]);
        assert!(json[key]["entry"]["row"].is_string() && json[key]["is_right"] == true, "{key}");
    }
    assert!((json["order_ltv"].as_f64().unwrap() - 2.0).abs() < 0.1);
    assert!(json["horizons"]["1%"].as_f64().unwrap() < json["horizons"]["10%"].as_f64().unwrap());
    // The plain projection with a damper: right derivatives, wrong model.
    let frozen = ["validate", "scene.json", "--at", "0.3", "--set", "c1=5", "--chart", "frozen", "-o", "x"];
    let output = place.run(&frozen);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    refused(&place, &["validate", "scene.json", "--along", "u9"], &["no state `u9`"]);
    assert!(
        err(&output).contains("error: four_bar_spring at t = 0.3 s, chart frozen: ") && err(&output).contains("help:")
    );
}

/// Over ten seconds of a chaotic motion only the smallest perturbations follow the linear model, and these are round-off.
#[test]
fn a_horizon_that_is_too_long_is_not_called_a_wrong_model() {
    let place = model("double_pendulum");
    let output = place.run(&["validate", "scene.json", "--horizon", "10", "-o", "here"]);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    assert!(err(&output).contains("not told: along random:1") && err(&output).contains("a shorter --horizon"));
}

#[test]
fn transition_tells_growth() {
    let place = model("pendulum");
    let wrong = ["transition", "scene.json", "--period", "0.123"];
    refused(&place, &wrong, &["not its period"]);
    let args = ["transition", "scene.json", "--lyapunov", "2", "--json", "-o", "here"];
    let json: Value = serde_json::from_str(&place.done(&args)).unwrap();
    let last = json["lyapunov"]["exponents"].as_array().unwrap().last().unwrap().as_array().unwrap().len();
    assert!(last >= 2, "{json}");
    assert_eq!(place.run(&["transition", "scene.json"]).status.code(), Some(2));
}

/// What carries perturbations ends where the motion does, and says why.
#[test]
fn a_motion_that_fails_is_told_with_its_cause() {
    let place = Place::new(PENDULUM.replace(r#""force": [0, 0]"#, r#""force": ["sqrt(0.5 - t)", 0]"#));
    for command in [
        &["validate", "--at", "0.3", "--horizon", "1"][..],
        &["transition", "--period", "1"],
        &["transition", "--lyapunov", "1"],
    ] {
        let output = place.run(&[command, &["scene.json", "--figures", "none", "-o", "here"]].concat());
        assert_eq!(output.status.code(), Some(1), "{command:?}");
        let cause = "error: stopped at t = 5.000000e-1 s: the force on `rod.x` is infinite or not a number";
        assert!(err(&output).starts_with(cause), "{command:?}: {}", err(&output));
    }
}

/// Two masses on a line between a soft spring and a stiff one, and both as one body: w^2 are the roots of
/// w^4 - (k + 2 K) w^2 + k K and k/2.
pub fn chain(stiff: bool) -> String {
    let body = |name: &str, mass: f64, x: f64| {
        serde_json::json!({ "name": name, "type": "rigid", "mass": mass, "inertia": 0, "free": ["x"],
                            "initial": { "position": [x, 0], "velocity": [0.1, 0] } })
    };
    let spring = |name: &str, a: &str, b: &str, stiffness: f64| serde_json::json!({ "name": name, "type": "spring_damper", "between": [a, b], "stiffness": stiffness, "free_length": 1 });
    let bodies = if stiff { vec![body("a", 2.0, 1.0)] } else { vec![body("a", 1.0, 1.0), body("b", 1.0, 2.0)] };
    let soft = spring("soft", "ground", "a", 4.0);
    let forces = if stiff { vec![soft] } else { vec![soft, spring("between", "a", "b", 100.0)] };
    let output = |name: &str, measure: &str| serde_json::json!({ "name": name, "measure": measure, "of": "a", "component": "x" });
    serde_json::json!({ "name": if stiff { "one" } else { "two" }, "dimension": 2, "bodies": bodies, "forces": forces,
        "outputs": [output("x", "position"), output("speed", "velocity")], "simulation": { "t_end": 1 } })
    .to_string()
}

/// A scene with other names is one of something else.
#[test]
fn models_of_other_mechanisms_are_not_compared() {
    let place = Place::new(chain(false));
    let names =
        [("\"a\"", "\"p\""), ("\"b\"", "\"q\""), ("\"name\":\"x\"", "\"name\":\"px\""), ("\"speed\"", "\"pace\"")];
    let renamed = |names: &[(&str, &str)]| names.iter().fold(chain(true), |text, (from, to)| text.replace(from, to));
    fs::write(place.path("other.json"), renamed(&names)).unwrap();
    fs::write(place.path("bodies.json"), renamed(&names[..2])).unwrap();
    let against =
        |file: &str| place.run(&["linearize", "scene.json", "--equilibrium", "--against", file, "-o", "here"]);
    let other = against("other.json");
    assert!(other.status.code() == Some(2) && err(&other).contains("a scene of something else"), "{}", err(&other));
    let bodies = against("bodies.json");
    assert!(bodies.status.code() == Some(0) && err(&bodies).contains("has no body of two"), "{}", err(&bodies));
}

/// A car may roll on: the mode has no frequency, where rounding of K would give it 1e-7 Hz.
#[test]
fn zero_modes_have_no_frequency() {
    let place = Place::new("");
    let car = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/half_car.json").display().to_string();
    let text = place.done(&["linearize", &car, "--at", "0", "--modes", "4", "--figures", "none", "-o", "here"]);
    let cells = |line: &str| line.split_whitespace().take(5).map(str::to_string).collect::<Vec<_>>();
    assert!(text.lines().any(|line| cells(line) == ["1", "0", "0", "0", "-"]), "{text}");
    assert!(text.contains("1.1756"), "{text}");
    let text = place.done(&["linearize", &car, "--at", "0", "--against", &car, "--figures", "none", "-o", "against"]);
    assert!(text.lines().any(|line| cells(line) == ["0", "0", "0", "0", "0"]), "{text}");
    let modes = place.json("against/against-0.json")["modes"].clone();
    assert_eq!((&modes[0]["frequency_hz"], &modes[0]["shift"]), (&0.0.into(), &0.0.into()), "{modes}");
}

/// Of an arm on a hub that nothing holds the rotation is zero, although rounding of its stiff directions leaves
/// 4e-5 rad/s. A mode that is 1e7 times slower than another is not.
#[test]
fn a_rigid_body_mode_is_zero_and_a_slow_one_is_not() {
    let place = Place::new(FREE_ARM);
    let text = place.done(&["linearize", "scene.json", "--figures", "none", "-o", "here"]);
    let rigid: Vec<&str> = text.lines().filter(|line| line.contains("physical, rigid body")).collect();
    assert!(rigid.iter().all(|line| line.split_whitespace().skip(1).take(4).eq(["0", "0", "0", "-"])), "{text}");
    let modes = place.json("here/linear-0.json")["eigenvalues"].clone();
    for mode in &modes.as_array().unwrap()[..2] {
        assert_eq!([&mode["re"], &mode["im"], &mode["frequency_hz"]], [0.0; 3], "{mode}");
        assert!(mode["damping_ratio"].is_null() && mode["kind"] == "physical", "{mode}");
    }
    assert!(!rigid.is_empty() && modes[2]["frequency_hz"].as_f64().unwrap() > 1.0, "{text}");
    // Masses 1, 1 and 0.001 in a row on springs of 0.01, 1e12 and 1e6 N/m: sqrt(0.01/2.001) rad/s.
    let mass = |name: &str, mass: f64, x: usize| {
        format!(
            r#"{{ "name": "{name}", "type": "rigid", "mass": {mass}, "free": ["x"],
                 "initial": {{ "position": [{x}, 0] }} }}"#
        )
    };
    let spring = |name: &str, from: &str, to: &str, k: &str| {
        format!(
            r#"{{ "name": "{name}", "type": "spring_damper", "between": ["{from}", "{to}"], "stiffness": {k},
                 "free_length": 1 }}"#
        )
    };
    let bodies = [mass("a", 1.0, 1), mass("b", 1.0, 2), mass("c", 0.001, 3)].join(", ");
    let springs =
        [spring("s0", "ground", "a", "0.01"), spring("s1", "a", "b", "1e12"), spring("s2", "b", "c", "1e6")].join(", ");
    let place = Place::new(format!(
        r#"{{ "name": "scales", "dimension": 2, "bodies": [{bodies}], "forces": [{springs}],
             "simulation": {{ "t_end": 1 }} }}"#
    ));
    place.done(&["linearize", "scene.json", "--figures", "none", "-o", "here"]);
    let slowest = place.json("here/linear-0.json")["eigenvalues"][0].clone();
    let frequency = slowest["frequency_hz"].as_f64().unwrap() * std::f64::consts::TAU;
    // Entries of 1e12 round to 1e-4: 1 % of the spring of 0.01 N/m; the solver adds some ulps of 1e12.
    assert!((frequency / 0.070693 - 1.0).abs() < 0.5, "{slowest}");
}

/// A flexible arm on a hub without a motor.
const FREE_ARM: &str = r#"{ "name": "free_arm", "dimension": 2, "ground": { "markers": { "O": [0, 0] } },
  "bodies": [
    { "name": "link", "type": "flexible_beam", "frame": "floating", "length": 1.0, "elements": 6,
      "material": { "E": 7e10, "nu": 0.33, "rho": 2700 }, "section": { "rectangle": { "height": 0.005, "width": 0.03 } },
      "frame_conditions": "tangent", "markers": { "A": [0, 0], "T": [1.0, 0] },
      "damping": { "rayleigh": { "stiffness": 1e-4 } } },
    { "name": "hub", "type": "rigid", "mass": 1, "inertia": 0.05 },
    { "name": "payload", "type": "rigid", "mass": 0.2, "inertia": 1e-6, "initial": { "position": [1, 0] } } ],
  "joints": [
    { "name": "shaft", "type": "revolute", "between": ["ground.O", "hub"] },
    { "name": "clamp", "type": "weld", "between": ["hub", "link.A"] },
    { "name": "tip", "type": "weld", "between": ["link.T", "payload"] } ],
  "simulation": { "t_end": 2 } }"#;

#[test]
fn a_simpler_model_loses_a_mode_and_shifts_another() {
    let place = Place::new(chain(false));
    fs::write(place.path("one.json"), chain(true)).unwrap();
    let text = place.done(&["linearize", "scene.json", "--equilibrium", "--against", "one.json", "-o", "here"]);
    assert!(text.contains("\nagainst one: of 2 modes 1 lost\n"), "{text}");
    let told = place.json("here/against-0.json");
    let [slow, fast] = [-1.0, 1.0].map(|sign| (102.0 + sign * (102.0f64 * 102.0 - 400.0).sqrt()).sqrt());
    let modes = told["modes"].as_array().unwrap();
    let number = |value: &Value| value.as_f64().unwrap();
    assert!((number(&modes[0]["im"]) - slow).abs() < 1e-9 && (number(&modes[1]["im"]) - fast).abs() < 1e-9, "{told}");
    assert!((number(&modes[0]["shift"]) - (2.0f64.sqrt() / slow - 1.0)).abs() < 1e-9, "{told}");
    assert!(modes[1]["there"].is_null() && told["added"].as_array().unwrap().is_empty());
    // With the same energy both modes move a, at amplitudes 1/(w sqrt(m)): position sees the slow one, velocity both.
    assert_eq!(number(&modes[0]["seen"]), 1.0);
    assert!(number(&modes[1]["seen"]) > 0.9, "{told}");
    let both =
        place.done(&["linearize", "scene.json", "--equilibrium", "--against", "one.json", "--json", "-o", "here"]);
    let both: Value = serde_json::from_str(&both).unwrap();
    assert!(both["A"].is_array() && both["against"]["modes"] == told["modes"], "{both}");
    refused(
        &place,
        &["linearize", "scene.json", "--equilibrium", "--method", "all", "--against", "one.json"],
        &["one method"],
    );
}

/// What is known when the time is over is written, and what is missing is told.
#[test]
fn validate_ends_within_its_budget() {
    let place = Place::new("");
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/models/four_bar_spring.json");
    let said = |budget: &str| {
        let output = place.run(&["validate", scene, "--at", "0.3", "--budget", budget, "-o", "here"]);
        assert_eq!(output.status.code(), Some(0), "{}", err(&output));
        err(&output)
    };
    let short = said("5ms");
    assert!(short.contains("along random:1 the motion was followed for"), "{short}");
    assert!(short.contains("the input `torque` was not checked") && short.contains("--budget"), "{short}");
    let followed = || place.json("here/validation-0.3.json")["followed"].as_f64().unwrap();
    let verdict = place.json("here/validation-0.3.json")["verdict"]["text"].to_string();
    let not_compared = "A, B, C and D were not compared";
    assert_eq!(short.contains(not_compared), verdict.contains(not_compared), "{short}{verdict}");
    let part = followed();
    let long = said("100ms");
    assert!(!long.contains("warning"), "{long}");
    assert!(part < 0.9 * followed(), "{part}");
}

#[test]
fn models_along_the_motion_are_one_file() {
    let place = model("double_pendulum");
    let args = ["linearize", "scene.json", "--along", "0..0.4:5", "--format", "npz,mat,json", "-o", "here"];
    let text = place.done(&args);
    assert_eq!(place.files("here"), ["ltv.json", "ltv.mat", "ltv.npz", "ltv.svg"]);
    assert!(text.contains("5 linear models by mcs") && text.contains("A is right to"), "{text}");
    let json = place.json("here/ltv.json");
    let shape = |key: &str| {
        let mut shape = Vec::new();
        let mut level = &json[key];
        while let Some(list) = level.as_array() {
            shape.push(list.len());
            level = &list[0];
        }
        shape
    };
    assert_eq!(
        ["t", "q", "v", "qdot", "vdot", "y0"].map(shape),
        [vec![5], vec![5, 4], vec![5, 4], vec![5, 4], vec![5, 4], vec![5, 4]]
    );
    assert_eq!(
        ["A", "C", "R", "T", "R_left", "Phi"].map(shape),
        [[5, 4, 4], [5, 4, 4], [5, 4, 2], [5, 4, 2], [5, 2, 4], [4, 4, 4]]
    );
    assert_eq!(json["chart"], "intrinsic");
    assert_eq!(json["units"]["states"][2], "kg^0.5 m/s");
    assert!(json["error"]["A"][0]["error"].as_f64().unwrap() < 1e-8, "{}", json["error"]);
    assert_eq!(json["error"]["interpolation"][0]["of"], "A");
    // At one time the same content.
    place.done(&["linearize", "scene.json", "--at", "0.2", "-o", "here"]);
    let one = place.json("here/linear-0.2.json");
    assert_eq!(one["units"], json["units"]);
    assert_eq!(one["R"].as_array().unwrap().len(), 4);
    assert_eq!(one["operating_point"]["qdot"].as_object().unwrap().len(), 4);
}

#[test]
fn times_along_the_motion_are_checked() {
    let place = model("pendulum");
    let along = |times: &'static str| ["linearize", "scene.json", "--along", times];
    refused(&place, &along("0..1e9:5"), &["--along", "outside the run"]);
    refused(&place, &along("1..0:5"), &["--along", "A before B"]);
    refused(&place, &along("soon"), &["--along", "A..B:N"]);
    refused(&place, &["linearize", "scene.json", "--along", "0..1:5", "--at", "1"], &["--at"]);
    refused(&place, &["linearize", "scene.json", "--along", "0..1:5", "--method", "rcs"], &["--method", "mcs"]);
    refused(&place, &["linearize", "scene.json", "--along", "0..1:5", "--chart", "frozen"], &["--chart"]);
}

#[test]
fn a_transition_names_its_chart() {
    let place = model("two_mass");
    let period = std::f64::consts::TAU / 5.0;
    place.done(&["transition", "scene.json", "--set", "c1=0", "--period", &period.to_string(), "-o", "here"]);
    let floquet = &place.json("here/transition-0.json")["floquet"];
    assert_eq!((&floquet["chart"], &floquet["states"]), (&"mass_orthogonal".into(), &serde_json::json!(["u1", "u1'"])));
}

#[test]
fn models_along_the_motion_are_validated_over_the_span() {
    let place = model("double_pendulum");
    let text = place.done(&["validate", "scene.json", "--along", "0..0.5:6", "-o", "here"]);
    assert!(text.contains("verdict: right") && text.contains("order 2.0"), "{text}");
    let json = place.json("here/validation-along.json");
    assert_eq!(json["sequences"][0]["times"].as_array().unwrap().len(), 5);
    assert_eq!(json["verdict"]["ltv"], true);
}
