//! Whatever stands in a scene, reading and assembling it ends with a study or with a message, soon and without a panic.

use holonom::Error;
use holonom::prepared::{Model, Overrides};
use holonom::scene::Scene;
use std::panic::catch_unwind;
use std::time::{Duration, Instant};

const PLANAR: &str = r#"{
  "name": "slider", "dimension": 2, "parameters": { "l": 1.0, "m": "2*l", "k": "10*m" }, "gravity": [0, -9.81],
  "ground": { "markers": { "O": [0, 0], "Q": { "position": [0, 0], "angle": "pi/2" } } },
  "bodies": [
    { "name": "crank", "type": "rigid", "mass": "m", "inertia": "m*l^2/12", "origin": ["-l/2", 0],
      "markers": { "A": [0, 0], "B": ["l", 0] }, "initial": { "position": [0, 0], "angle": 0.5 } },
    { "name": "rod", "type": "rigid", "mass": 1, "inertia": 0.1, "markers": { "B": [-1, 0], "C": [1, 0] },
      "initial": { "position": [1.7, 0.2], "angle": -0.2, "velocity": [0, 0], "angular_velocity": 0 } },
    { "name": "bead", "type": "point_mass", "mass": 0.5, "initial": { "position": [2.5, 0] } } ],
  "joints": [
    { "name": "A", "type": "revolute", "between": ["ground.O", "crank.A"] },
    { "name": "B", "type": "revolute", "between": ["crank.B", "rod.B"] },
    { "name": "C", "type": "revolute", "between": ["rod.C", "bead"] },
    { "name": "track", "type": "equation", "expression": "bead.y - 0.1*sin(bead.x)^2" } ],
  "forces": [
    { "name": "spring", "type": "spring_damper", "between": ["ground.O", "bead"], "stiffness": "k", "free_length": 2 },
    { "name": "drive", "type": "applied_torque", "at": "crank", "torque": "table(t, 0, 0, 1, 5) - 0.1*crank.angle'" } ],
  "inputs": [ { "name": "u", "force": "drive" } ],
  "outputs": [
    { "name": "x", "measure": "position", "of": "bead", "component": "x" },
    { "name": "e", "measure": "expression", "value": "x^2 + crank.angle" } ],
  "assembly": { "hold": ["crank.angle"] },
  "simulation": { "t_end": 0.1, "output_step": 0.05, "formulation": { "baumgarte": { "alpha": 5 } }, "rtol": 1e-6 }
}"#;

const SPATIAL: &str = r#"{
  "name": "top", "dimension": 3, "gravity": [0, 0, -9.81],
  "ground": { "markers": { "O": [0, 0, 0], "W": { "position": [0, 0, 1], "z_axis": [0, 1, 0], "x_axis": [1, 0, 0] } } },
  "bodies": [
    { "name": "top", "type": "rigid", "mass": 1, "inertia": [1, 1, 0.5, 0, 0.01, 0],
      "markers": { "tip": [0, 0, -1], "rim": { "position": [0.3, 0, 0], "rotation": [0.1, 0, 0] } },
      "initial": { "position": [0, 0, 1], "rotation": [1, 0, 0, 0], "angular_velocity": [0.1, 0, 5] } },
    { "name": "block", "type": "rigid", "mass": 2, "inertia": [1, 1, 1], "free": ["x", "rz"] } ],
  "joints": [
    { "name": "tip", "type": "spherical", "between": ["ground.O", "top.tip"] },
    { "name": "slide", "type": "driver", "between": ["ground.O", "block"], "coordinate": "x", "value": "0.1*sin(3*t)" } ],
  "forces": [ { "name": "mount", "type": "bushing", "between": ["top.rim", "block"],
      "stiffness": [1, 1, 1, 2, 2, 2], "damping": [0, 0, 0, 0.1, 0.1, 0.1] } ],
  "outputs": [ { "name": "w", "measure": "angular_velocity", "of": "top", "component": "z", "relative_to": "block" } ],
  "simulation": { "t_end": 0.1, "integrator": "rk4", "step": 0.01 }
}"#;

/// xorshift64*: the same mutants everywhere and always.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n.max(1) as u64) as usize
    }

    fn pick<'a>(&mut self, all: &[&'a str]) -> &'a str {
        all[self.below(all.len())]
    }
}

const NUMBERS: [&str; 28] = [
    "0",
    "-0",
    "1",
    "-1",
    "1e308",
    "-1e308",
    "1e-308",
    "5e-324",
    "1e400",
    "1e15",
    "-1e15",
    "1e-15",
    "NaN",
    "null",
    "true",
    "\"nan\"",
    "\"1/0\"",
    "\"0/0\"",
    "\"sqrt(-1)\"",
    "\"t\"",
    "\"1e999\"",
    "\"\"",
    "[]",
    "{}",
    "99999999999999999999999",
    "-9223372036854775808",
    "0.1",
    "\"l^l^l^l^99\"",
];
const WORDS: [&str; 22] = [
    "ground",
    "ground.O",
    "crank",
    "crank.A",
    "rod.B",
    "bead",
    "top.tip",
    "t",
    "pi",
    "x",
    "y",
    "angle",
    "rz",
    "rigid",
    "weld",
    "revolute",
    "distance",
    "gear",
    "prismatic",
    "universal",
    "\\u0000",
    "ü",
];
const SIGNS: [&str; 14] = ["{", "}", "[", "]", ",", ":", "\"", "\\", "-", "e", ".", " ", "\u{0}", "é"];

/// Byte ranges of the pieces of a text that `is_part` accepts.
fn pieces(text: &str, is_part: impl Fn(char) -> bool) -> Vec<(usize, usize)> {
    let mut found: Vec<(usize, usize)> = Vec::new();
    for (at, c) in text.char_indices().filter(|(_, c)| is_part(*c)) {
        match found.last_mut() {
            Some((_, end)) if *end == at => *end = at + c.len_utf8(),
            _ => found.push((at, at + c.len_utf8())),
        }
    }
    found
}

fn replaced(text: &str, (start, end): (usize, usize), with: &str) -> String {
    format!("{}{with}{}", &text[..start], &text[end..])
}

/// Where nothing is found, the whole.
fn or_all(text: &str, found: Vec<(usize, usize)>) -> Vec<(usize, usize)> {
    if found.is_empty() { vec![(0, text.len())] } else { found }
}

fn mutant(text: &str, random: &mut Random) -> String {
    let numbers = || or_all(text, pieces(text, |c| c.is_ascii_digit() || "+-.".contains(c)));
    let words = || or_all(text, pieces(text, |c| c.is_alphanumeric() || "_.'".contains(c)));
    let anywhere = |random: &mut Random| {
        let mut at = random.below(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    };
    let length = |at: usize| text[at..].chars().next().map_or(0, char::len_utf8);
    match random.below(9) {
        0 => {
            let at = anywhere(random);
            replaced(text, (at, at + length(at)), random.pick(&SIGNS))
        }
        1 => {
            let at = anywhere(random);
            replaced(text, (at, at + length(at)), "")
        }
        2 => {
            let at = anywhere(random);
            replaced(text, (at, at), random.pick(&SIGNS))
        }
        3 => text[..anywhere(random)].to_string(),
        4 | 5 => {
            let all = numbers();
            replaced(text, all[random.below(all.len())], random.pick(&NUMBERS))
        }
        6 => {
            let all = words();
            replaced(text, all[random.below(all.len())], random.pick(&WORDS))
        }
        7 => {
            let all = words();
            let from = all[random.below(all.len())];
            let to = all[random.below(all.len())];
            replaced(text, to, &text[from.0..from.1])
        }
        _ => {
            let lines: Vec<&str> = text.lines().collect();
            let gone = random.below(lines.len());
            let twice = random.below(lines.len());
            let kept = lines.iter().enumerate().filter(|(i, _)| *i != gone);
            kept.flat_map(|(i, line)| [*line, if i == twice { line } else { "" }]).collect::<Vec<_>>().join("\n")
        }
    }
}

/// What takes so long grows beyond all bounds: reading and assembling take milliseconds.
const LONGEST: Duration = Duration::from_secs(60);

/// Reads and assembles; true for a study.
fn survive(text: &str) -> bool {
    let clock = Instant::now();
    let text_of_it = text.to_string();
    let result = catch_unwind(move || {
        let prepared = Scene::parse(&text_of_it, &[]).and_then(|scene| Model::new(scene, &Overrides::default()));
        prepared.map(|prepared| {
            let (q, v) = prepared.start();
            assert!(q.iter().chain(v).all(|x| x.is_finite()), "the start is not finite");
        })
    });
    let result = result.unwrap_or_else(|_| panic!("panicked on\n{text}"));
    assert!(clock.elapsed() < LONGEST, "took {:?} on\n{text}", clock.elapsed());
    if let Err(error) = &result {
        let message = error.to_string();
        assert!(matches!(error, Error::Input(_)) && message.len() > 10, "{message}");
        let longest = message.lines().map(|line| line.chars().count()).max().unwrap_or(0);
        assert!(longest < 600, "a message of {longest} characters:\n{message}\non\n{text}");
        for word in ["invalid type", "untagged", " variant", "struct "] {
            assert!(!message.contains(word), "{message}\non\n{text}");
        }
    }
    result.is_ok()
}

fn survive_mutants(text: &str, seed: u64, count: usize) {
    assert!(survive(text), "the scene itself");
    let mut random = Random(seed);
    let mut fine = 0;
    for _ in 0..count {
        let mut changed = mutant(text, &mut random);
        // Now and then two or three faults at once.
        while random.below(3) == 0 && !changed.is_empty() {
            changed = mutant(&changed, &mut random);
        }
        fine += usize::from(survive(&changed));
    }
    assert!(fine > count / 50, "{fine} of {count} mutants are scenes: too few to try assembly");
}

#[test]
fn mutants_of_a_planar_scene() {
    survive_mutants(PLANAR, 0x9e37_79b9_7f4a_7c15, 10_000);
}

#[test]
fn mutants_of_a_spatial_scene() {
    survive_mutants(SPATIAL, 0xd1b5_4a32_d192_ed03, 10_000);
}

#[test]
fn absurd_numbers_in_every_place() {
    for text in [PLANAR, SPATIAL] {
        let places = pieces(text, |c| c.is_ascii_digit() || "-.".contains(c));
        for place in places {
            for number in ["1e308", "-1e308", "1e-320", "1e100", "-1", "0", "1e9"] {
                survive(&replaced(text, place, number));
            }
        }
    }
}

#[test]
fn every_key_and_word_renamed() {
    for text in [PLANAR, SPATIAL] {
        for place in pieces(text, |c| c.is_alphanumeric() || "_.'".contains(c)) {
            for word in ["", "x", "ground", "crank.A"] {
                survive(&replaced(text, place, word));
            }
        }
    }
}

#[test]
fn every_truncation() {
    for text in [PLANAR, SPATIAL] {
        (0..text.len()).filter(|&end| text.is_char_boundary(end)).for_each(|end| assert!(!survive(&text[..end])));
    }
}

#[test]
fn absurd_sizes() {
    let scene = |key: &str, value: &str| {
        PLANAR.replacen("\"name\": \"slider\"", &format!("\"name\": \"s\", \"{key}\": {value}"), 1)
    };
    let nested = |open: &str, close: &str| format!("{}1{}", open.repeat(50_000), close.repeat(50_000));
    survive(&nested("[", "]"));
    survive(&nested("{\"a\":", "}"));
    survive(&scene("about", &format!("\"{}\"", "long ".repeat(200_000))));
    survive(&PLANAR.replacen("2*l", &format!("{}l{}", "(".repeat(10_000), ")".repeat(10_000)), 1));
    survive(&PLANAR.replacen("2*l", &"l+".repeat(400_000), 1));
    survive(&PLANAR.replacen("slider", &"s".repeat(100_000), 1));
    survive(&PLANAR.replacen("crank.A", &"c".repeat(100_000), 1));
    survive(&PLANAR.replacen("\"O\": [0, 0]", &format!("\"O\": [{}0]", "0,".repeat(100_000)), 1));
    let chain: Vec<String> = (0..20_000).map(|i| format!("\"p{i}\": \"p{}\"", i + 1)).collect();
    survive(&PLANAR.replacen("\"l\": 1.0", &format!("{}, \"l\": 1.0", chain.join(", ")), 1));
}

#[test]
fn a_scene_of_many_bodies_is_read_in_time() {
    let scene = holonom::scene::generate::chain(2000).to_string();
    assert!(survive(&scene));
}
