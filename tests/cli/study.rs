use super::*;

/// A mass on a spring over a bump: the motion is simulated, and fails where the mass is not positive.
const OSCILLATOR: &str = r#"{
  "name": "oscillator", "dimension": 2, "parameters": { "m": 2, "k": 50, "c": 1 },
  "ground": { "markers": { "O": [0, 0] } },
  "bodies": [{ "name": "mass", "type": "point_mass", "mass": "m", "initial": { "position": [0.5, 0] } }],
  "joints": [{ "name": "rail", "type": "point_on_line", "between": ["ground.O", "mass"] }],
  "forces": [{ "name": "spring", "type": "spring_damper", "between": ["ground.O", "mass"],
               "stiffness": "k", "damping": "c", "free_length": 0.3 }],
  "outputs": [{ "name": "x", "measure": "position", "of": "mass", "component": "x" },
              { "name": "pull", "measure": "force", "of": "spring" }],
  "simulation": { "t_end": 0.5, "output_step": 0.05 }
}"#;

const GRID: [&str; 10] = [
    "study",
    "scene.json",
    "--vary",
    "k=20..80:4",
    "--vary",
    "m=1..3:3",
    "--record",
    "max(x),rms(pull),x,cost",
    "--figures",
    "none",
];

fn grid<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&GRID, more].concat()
}

/// Cells of a table, row by row, with the headings first.
fn cells(text: &str) -> Vec<Vec<String>> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_bytes());
    reader.records().map(|row| row.unwrap().iter().map(str::to_string).collect()).collect()
}

#[test]
fn rows_do_not_depend_on_threads_parts_or_interruptions() {
    let place = Place::new(OSCILLATOR);
    let text = place.done(&grid(&["-o", "whole"]));
    assert!(text.contains("oscillator: 12 of 12 variants") && text.contains("max(x)"), "{text}");
    assert_eq!(place.files("whole"), ["study.csv", "study.json", "study.npz"]);
    let whole = place.text("whole/study.csv");
    assert_eq!(cells(&whole)[0], ["row", "k", "m", "max(x)", "rms(pull)", "x", "cost", "failure"]);
    assert_eq!((cells(&whole).len(), &cells(&whole)[5][..3]), (13, &["4", "40", "2"].map(String::from)[..]));

    for threads in ["1", "2"] {
        let output = place.command(&grid(&["-o", "threads"])).env("RAYON_NUM_THREADS", threads).output().unwrap();
        assert_eq!((output.status.code(), place.text("threads/study.csv")), (Some(0), whole.clone()), "{threads}");
    }

    place.done(&grid(&["--shard", "1/2", "-o", "a"]));
    place.done(&grid(&["--shard", "2/2", "-o", "b"]));
    assert_eq!(place.json("a/study.json")["rows"], 6);
    place.done(&["study", "scene.json", "-o", "merged", "--figures", "none", "--merge", "a", "b"]);
    assert_eq!(place.text("merged/study.csv"), whole);
    assert_eq!(fs::read(place.path("merged/study.npz")).unwrap(), fs::read(place.path("whole/study.npz")).unwrap());

    let output = place.run(&["study", "scene.json", "-o", "half", "--merge", "b"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("unfinished: 6 of 12 variants are there"), "{}", err(&output));
    place.done(&grid(&["-o", "half", "--resume"]));
    assert_eq!(place.text("half/study.csv"), whole);
}

#[test]
fn a_budget_leaves_rows_to_a_later_run() {
    let place = Place::new(OSCILLATOR);
    place.done(&grid(&["-o", "whole"]));
    // Each thread counts its own readings of the clock.
    let mut command = place.command(&grid(&["-o", "here", "--budget", "10ms"]));
    let output = command.env("RAYON_NUM_THREADS", "1").output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("variants are there\n  help: go on with --resume"), "{}", err(&output));
    let begun = place.text("here/study.csv");
    assert!(cells(&begun).len() < 13, "{begun}");
    place.done(&grid(&["-o", "here", "--resume"]));
    assert_eq!(place.text("here/study.csv"), place.text("whole/study.csv"));
}

/// The words of a command as a shell reads them.
fn shell(place: &Place, line: &str) -> Output {
    let program = format!("'{}'", env!("CARGO_BIN_EXE_holonom"));
    let line = line.replacen("holonom", &program, 1);
    Command::new("sh").args(["-c", &line]).current_dir(place.path("")).output().unwrap()
}

#[test]
fn again_prints_the_command_with_the_same_numbers() {
    let place = Place::new(OSCILLATOR);
    let recorded = "max(x),min(pull),rms(pull),x,pull,steps,error(x)";
    // Of outputs that are not recorded nothing is computed, which must not change the others.
    let own: [&[&str]; 4] =
        [&["--record", recorded], &["--record", "x,pull,steps"], &["--record", "rms(pull)"], &["--method", "auto"]];
    for more in own {
        let sample = ["--vary", "m=1..3", "--vary", "k=20..80:log", "--sample", "latin:4"];
        place.done(
            &[&["study", "scene.json", "-o", "here", "--figures", "none", "--set", "c=1/3"], &sample[..], more]
                .concat(),
        );
        let table = cells(&place.text("here/study.csv"));
        let line = place.done(&["study", "scene.json", "-o", "here", "--again", "2"]);
        let output = shell(&place, &format!("{} -o alone --figures none", line.trim_end()));
        assert_eq!(output.status.code(), Some(0), "{line}: {}", err(&output));
        let alone = place.json("alone/summary.json");
        for (heading, cell) in table[0].iter().zip(&table[3]).skip(3).filter(|(heading, _)| *heading != "failure") {
            let found = match heading.trim_end_matches(')').split_once('(') {
                Some(("error", output)) => &alone["error"]["outputs"][output]["max"],
                Some((extreme, output)) => &alone["outputs"][output][extreme],
                None if heading == "steps" => &alone["statistics"]["steps"],
                None => &alone["final"]["outputs"][heading],
            };
            assert_eq!(found.as_f64().unwrap().to_bits(), cell.parse::<f64>().unwrap().to_bits(), "{heading}: {line}");
        }
    }
    let output = place.run(&["study", "scene.json", "-o", "here", "--again", "4"]);
    assert!(err(&output).contains("row 4 is not in here; there are rows from 0 to 3"), "{}", err(&output));
}

/// A ball that falls on a tyre with a damper, whose load jumps where it meets the road.
const BOUNCE: &str = r#"{
  "name": "bounce", "dimension": 2, "parameters": { "c": 20 }, "gravity": [0, -9.81],
  "bodies": [{ "name": "ball", "type": "point_mass", "mass": 1, "initial": { "position": [0, 0.5] } }],
  "forces": [{ "name": "tyre", "type": "tyre", "at": "ball", "stiffness": 1000, "damping": "c", "radius": 0.3,
               "lift_off": true }],
  "outputs": [{ "name": "y", "measure": "position", "of": "ball", "component": "y" },
              { "name": "load", "measure": "force", "of": "tyre" }],
  "simulation": { "t_end": 1, "output_step": 0.1 }
}"#;

#[test]
fn rows_at_jumps_are_those_of_simulate() {
    let place = Place::new(BOUNCE);
    for (output, recorded) in [("load", "min(load),max(load),rms(load)"), ("y", "min(y),max(y),rms(y)")] {
        let vary = ["--vary", "c=10..30:3", "--record", recorded, "-o", "here", "--quiet", "--figures", "none"];
        place.done(&[&["study", "scene.json"], &vary[..]].concat());
        let table = cells(&place.text("here/study.csv"));
        for row in &table[1..] {
            let set = format!("c={}", row[1]);
            place.done(&["simulate", "scene.json", "--set", &set, "-o", "alone", "--quiet", "--figures", "none"]);
            let alone = place.json("alone/summary.json");
            let rows = cells(&place.text("alone/trajectory.csv")).len() - 1;
            assert!(rows > 11, "there is no jump");
            for (extreme, cell) in ["min", "max", "rms"].into_iter().zip(&row[2..]) {
                let known = alone["outputs"][output][extreme].as_f64().unwrap();
                assert_eq!(known.to_bits(), cell.parse::<f64>().unwrap().to_bits(), "{extreme} of {output} at {set}");
            }
        }
    }
}

#[test]
fn eigenvalues_are_those_of_linearize() {
    let place = Place::new(OSCILLATOR);
    let vary = ["--vary", "k=20..80:3", "--linearize", "--equilibrium", "-o", "here", "--quiet", "--figures", "none"];
    place.done(&[&["study", "scene.json"], &vary[..]].concat());
    let table = cells(&place.text("here/study.csv"));
    for row in &table[1..] {
        let [k, re, frequency] = [1, 2, 4].map(|i| row[i].parse::<f64>().unwrap());
        assert!((re + 0.25).abs() < 1e-12 && (frequency - (k / 2.0).sqrt() / std::f64::consts::TAU).abs() < 1e-12);
    }
    let line = place.done(&["study", "scene.json", "-o", "here", "--again", "1"]);
    assert_eq!(line, "holonom linearize scene.json --equilibrium --set k=50\n");
    shell(&place, &format!("{} -o alone --figures none", line.trim_end()));
    let alone = place.json("alone/linear-0.json");
    let found = alone["eigenvalues"][0]["re"].as_f64().unwrap();
    assert_eq!(found.to_bits(), table[2][2].parse::<f64>().unwrap().to_bits());
}

#[test]
fn variants_that_fail_are_told() {
    let place = Place::new(OSCILLATOR);
    fs::write(place.path("list.csv"), "m, k\n2, 50\n-1, 50\n3, 60\n").unwrap();
    let output = place.run(&["study", "scene.json", "--list", "list.csv", "-o", "here"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(err(&output).contains("warning: 1 of 3 variants failed, the first in row 1: "), "{}", err(&output));
    assert!(out(&output).contains("FAILED 1 variant, the first in row 1: "), "{}", out(&output));
    let table = cells(&place.text("here/study.csv"));
    assert!(table[1][5].is_empty() && !table[2][5].is_empty() && table[2][3].is_empty(), "{table:?}");
    assert!(place.text("here/study.svg").contains("failed"));
    fs::write(place.path("list.csv"), "m\n-1\n-2\n").unwrap();
    let output = place.run(&["study", "scene.json", "--list", "list.csv", "-o", "here"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("error: all variants failed"), "{}", err(&output));
}

#[test]
fn bad_studies_are_refused_and_nothing_is_written() {
    let place = Place::new(OSCILLATOR);
    fs::write(place.path("list.csv"), "m\nx\n").unwrap();
    let table: [(&[&str], &str); 12] = [
        (&[], "--vary <NAME=A..B[:N][:log]>"),
        (&["--vary", "k=1..2"], "at --vary: `k` has no number of values\n  help: write k=1..2:N"),
        (&["--vary", "kk=1..2:3"], "unknown parameter `kk`"),
        (&["--vary", "k=1..2:3", "--vary", "k=1..2:3"], "the parameter `k` is varied twice"),
        (&["--vary", "k=1..2:3", "--set", "k=3"], "`k` is set and varied"),
        (&["--vary", "k=0..2:3:log"], "from 0 to 2 there is no constant factor"),
        (&["--vary", "k=1..2:3", "--sample", "latin:5"], "`k` has 3 values, and --sample says how many there are"),
        (&["--vary", "k=1..2", "--sample", "latin:0"], "`0` is no number of variants"),
        (&["--vary", "k=1..2:3", "--shard", "3/2"], "`3/2` is no part; write I/N"),
        (&["--vary", "k=1..2:3", "--record", "max(y)"], "at --record (`max(y)`): unknown name `y`"),
        (&["--list", "list.csv"], "row 1 has `x`, which is no number"),
        (&["--list", "none.csv"], "none.csv"),
    ];
    for (args, message) in table {
        let output = place.run(&[&["study", "scene.json", "-o", "here"], args].concat());
        assert_eq!((output.status.code(), out(&output)), (Some(2), String::new()), "{args:?}: {}", err(&output));
        assert!(err(&output).contains(message), "{args:?}: {}", err(&output));
        assert!(!place.path("here/study.csv").exists());
    }
}

#[test]
fn parts_of_other_studies_are_not_merged() {
    let place = Place::new(OSCILLATOR);
    let run = |more: &[&str]| place.done(&grid(more));
    run(&["--shard", "1/2", "-o", "a"]);
    run(&["--shard", "2/2", "-o", "b", "--rtol", "1e-5"]);
    let output = place.run(&["study", "scene.json", "-o", "merged", "--merge", "a", "b"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        err(&output).contains("b: this is another study: its `method.rtol` is 0.00001, not 1e-8"),
        "{}",
        err(&output)
    );
    fs::write(place.path("other.json"), OSCILLATOR.replace("0.3", "0.4")).unwrap();
    let output = place.run(&["study", "other.json", "-o", "merged", "--merge", "a"]);
    assert!(err(&output).contains("a: this is a study of another scene"), "{}", err(&output));
    let output = place.run(&["study", "scene.json", "-o", "merged", "--merge", "none"]);
    assert!(err(&output).contains("there is no study"), "{}", err(&output));
}

#[test]
fn figures_are_drawn_for_one_two_and_more_parameters() {
    let place = Place::new(OSCILLATOR);
    let files = |vary: &[&str]| {
        place.done(&[&["study", "scene.json", "--quiet", "-o", "here"], vary].concat());
        let mut files = place.files("here");
        files.retain(|name| name.ends_with(".svg"));
        files
    };
    assert_eq!(files(&["--vary", "k=20..80:4"]), ["study.svg"]);
    assert_eq!(files(&["--vary", "k=20..80:3", "--vary", "m=1..2:3"]), ["study-scatter.svg", "study.svg"]);
    let three = ["--vary", "k=20..80", "--vary", "m=1..2", "--vary", "c=1..2", "--sample", "sobol:8"];
    assert_eq!(files(&three), ["study-parallel.svg", "study-scatter.svg"]);
}

/// Lines whose colour is that of a number that is not there would be white, over all others.
#[test]
fn variants_without_a_number_are_drawn_in_grey() {
    let place = Place::new(OSCILLATOR);
    let vary = ["--vary", "k=20..80:log", "--vary", "m=1..2", "--vary", "c=1..2", "--sample", "sobol:8"];
    for (level, is_mixed) in [("0.2", true), ("9", false)] {
        let recorded = format!("x,time_of(x, {level})");
        let more = ["--record", recorded.as_str(), "--quiet", "-o", "here"];
        place.done(&[&["study", "scene.json"], &vary[..], &more].concat());
        let table = cells(&place.text("here/study.csv"));
        let missing = table[1..].iter().filter(|row| row[5].is_empty()).count();
        assert!(if is_mixed { (1..8).contains(&missing) } else { missing == 8 }, "{table:?}");
        let drawn = place.text("here/study-parallel.svg");
        assert!(!drawn.contains("stroke=\"#ffffff\" stroke-width=\"1\"") && !drawn.contains("inf"), "{level}");
    }
}

#[test]
fn sweep_is_another_name_of_kinematics() {
    let place = Place::new(OSCILLATOR);
    let output = place.run(&["sweep", "scene.json", "k=1..2:3", "-o", "here"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(err(&output).contains("note: `sweep` is now called `kinematics`"), "{}", err(&output));
    assert!(place.path("here/kinematics.csv").is_file());
}
