//! Errors and warnings of the library name settings; in the alternate form they name options of the command line.

use holonom::linear::{Linear, State, floquet, linearize};
use holonom::math::expression::Number;
use holonom::prelude::*;
use holonom::research::results::Chart;
use holonom::run::Overrides;
use std::fmt::Display;

const PENDULUM: &str = r#"{
    "name": "pendulum", "dimension": 2, "gravity": [0, -9.81], "parameters": { "l": 1 },
    "bodies": [{ "name": "bob", "type": "point_mass", "mass": 1, "initial": { "position": [1, 0] } }],
    "joints": [{ "name": "rod", "type": "distance", "between": ["ground", "bob"], "length": "l" }] SIMULATION }"#;

fn pendulum(simulation: &str, overrides: Overrides) -> Result<Model> {
    let simulation = format!(r#", "simulation": {{ {simulation} }}"#);
    Family::parse_with(&PENDULUM.replace("SIMULATION", &simulation), &overrides)?.model()
}

fn plain(overrides: Overrides) -> Error {
    pendulum("", overrides).err().unwrap()
}

#[test]
fn no_error_of_the_library_names_an_option() {
    let none = Overrides::default();
    let free = pendulum("", none.clone()).unwrap();
    let short = pendulum(r#""t_end": 1"#, none.clone()).unwrap();
    let start = State::start(&free);
    let chart = Linear { chart: Some(Chart::parse("bob.z")), ..Linear::default() };
    let stepped = Overrides { rtol: Some(1e-6), ..none.clone() };
    let stepped = pendulum(r#""integrator": "rk4", "step": 0.01"#, stepped).unwrap();
    let coarse = Method { rtol: 1e-9, atol: 1e-12, ..Method::try_from("ggl + tr_bdf2").unwrap() };
    let coarse = coarse.doubts(free.system()).remove(0);
    let table: Vec<(Box<dyn Display>, &str, &str)> = vec![
        (Box::new(free.span().unwrap_err()), "give `until = T`, or", "give --until T, or"),
        (Box::new(plain(Overrides { until: Some(-1.0), ..none.clone() })), "at until: ", "at --until: "),
        (Box::new(plain(Overrides { rtol: Some(-1.0), ..none.clone() })), "at rtol: ", "at --rtol: "),
        (Box::new(plain(Overrides { step: Some(-1.0), ..none.clone() })), "at step: ", "at --step: "),
        (
            Box::new(plain(Overrides { set: vec![("ll".into(), Number::Value(2.0))], ..none.clone() })),
            "at set (`ll`): ",
            "at --set (`ll`): ",
        ),
        (
            Box::new(plain(Overrides { integrator: Some("rk4".parse().unwrap()), ..none.clone() })),
            "give a fixed step: `step = H`, or",
            "give a fixed step: --step H, or",
        ),
        (
            Box::new(short.states_at(&[2.0]).unwrap_err()),
            "or run longer with `until = T`",
            "or run longer with --until T",
        ),
        (Box::new(linearize(&free, &start, &chart).unwrap_err()), "at chart: ", "at --chart: "),
        (Box::new(floquet(&free, &start, -1.0).unwrap_err()), "at period: ", "at --period: "),
        (Box::new(stepped.doubts[0].clone()), "`integrator = dop853`", "--integrator dop853"),
        (Box::new(stepped.doubts[0].clone()), "warning: `rtol` has no effect", "warning: --rtol has no effect"),
        (Box::new(coarse), "`check_error` measures errors", "--check-error measures errors"),
    ];
    for (told, setting, option) in table {
        let [library, command_line] = [format!("{told}"), format!("{told:#}")];
        assert!(library.contains(setting) && !library.contains("--"), "{library}\nand not\n{setting}");
        assert!(command_line.contains(option), "{command_line}\nand not\n{option}");
    }
}
