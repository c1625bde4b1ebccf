//! The architecture as tests: who may use whom, and what no source file may contain.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// From the lowest to the highest; a module uses those of its own layer and of lower ones. The same order as DESIGN.md, section 3.
const LAYERS: &[&[&str]] = &[
    &["abandoned", "clock", "forward", "tolerances"],
    &["error", "files", "method_spec", "math"],
    &["modes"],
    &["body"],
    &["joint", "force"],
    &["scene"],
    &["import"],
    &["system"],
    &["formulation", "projection", "initial"],
    &["integrator"],
    &["simulate", "trajectory", "prepared", "sweep"],
    &["analysis"],
    &["run"],
    &["linearize", "validate"],
    &["study"],
    &["simplify"],
    &["plot"],
    &["report", "guide"],
    &["view"],
    &["linear", "methods", "parts"],
    &["cli"],
    &["python"],
    &["research"],
];

const LONGEST: usize = 400;

struct Source {
    path: PathBuf,
    /// `["body", "rigid"]` for src/body/rigid.rs; empty for lib.rs and main.rs.
    module: Vec<String>,
    /// Lines with their numbers, comments and tests left out.
    code: Vec<(usize, String)>,
    lines: usize,
}

impl Source {
    fn place(&self, line: usize) -> String {
        format!("{}:{line}", self.path.display())
    }

    /// Paths that `text` names, from the root of the crate.
    fn paths(&self, text: &str) -> Vec<Vec<String>> {
        let mut found = Vec::new();
        for (at, _) in text.match_indices("crate::").filter(|(at, _)| starts_word(text, *at)) {
            found.extend(expanded(&text[at + "crate::".len()..]));
        }
        for (at, _) in text.match_indices("super::").filter(|(at, _)| starts_path(text, *at)) {
            let mut rest = &text[at..];
            let mut up = 0;
            while let Some(tail) = rest.strip_prefix("super::") {
                (rest, up) = (tail, up + 1);
            }
            if let Some(from) = self.module.len().checked_sub(up) {
                found.extend(expanded(rest).into_iter().map(|path| [&self.module[..from], &path].concat()));
            }
        }
        found
    }
}

fn starts_word(text: &str, at: usize) -> bool {
    !text[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_')
}

fn starts_path(text: &str, at: usize) -> bool {
    starts_word(text, at) && !text[..at].ends_with("::")
}

/// The path `a::b`, or each of `{a::b, c}`.
fn expanded(text: &str) -> Vec<Vec<String>> {
    if let Some(group) = text.strip_prefix('{') {
        return members(group).into_iter().flat_map(expanded).collect();
    }
    let text = text.trim_start();
    let head: String = text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    match text[head.len()..].strip_prefix("::") {
        Some(rest) => expanded(rest).into_iter().map(|tail| [vec![head.clone()], tail].concat()).collect(),
        None => vec![vec![head]],
    }
}

/// What stands between the commas of a group, up to its closing brace.
fn members(group: &str) -> Vec<&str> {
    let mut depth = 0;
    let mut members = Vec::new();
    let mut start = 0;
    for (i, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => return [members, vec![&group[start..i]]].concat(),
            '}' => depth -= 1,
            ',' if depth == 0 => {
                members.push(&group[start..i]);
                start = i + 1;
            }
            _ => {}
        }
    }
    members
}

fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut paths = Vec::new();
    collect(&root, &mut paths);
    paths.sort();
    paths.iter().map(|path| read(&root, path)).collect()
}

fn collect(folder: &Path, paths: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        match path.is_dir() {
            // Tests may use what they like.
            true if name != "tests" => collect(&path, paths),
            false if name.ends_with(".rs") && name != "tests.rs" => paths.push(path),
            _ => {}
        }
    }
}

fn read(root: &Path, path: &Path) -> Source {
    let relative = path.strip_prefix(root).unwrap().with_extension("");
    let mut module: Vec<String> = relative.iter().map(|part| part.to_string_lossy().into_owned()).collect();
    if ["mod", "lib", "main"].contains(&module.last().unwrap().as_str()) {
        module.pop();
    }
    let text = fs::read_to_string(path).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let tests = |i: usize| lines[i] == "#[cfg(test)]" && lines.get(i + 1).is_some_and(|next| next.ends_with('{'));
    let end = (0..lines.len()).find(|&i| tests(i)).unwrap_or(lines.len());
    let code = lines[..end].iter().enumerate().map(|(i, line)| (i + 1, without_comment(line)));
    let path = Path::new("src").join(path.strip_prefix(root).unwrap());
    Source { path, module, code: code.collect(), lines: end }
}

fn without_comment(line: &str) -> String {
    let comment =
        line.match_indices("//").map(|(at, _)| at).find(|&at| line[..at].matches('"').count().is_multiple_of(2));
    line[..comment.unwrap_or(line.len())].to_string()
}

fn layer(module: &str) -> Option<usize> {
    LAYERS.iter().position(|layer| layer.contains(&module))
}

/// Top-level modules with the ones they use, and where.
fn dependencies() -> BTreeMap<(String, String), String> {
    let mut found = BTreeMap::new();
    for source in sources().iter().filter(|source| !source.module.is_empty()) {
        for (line, text) in statements(source) {
            for used in source.paths(&text).into_iter().filter_map(|path| path.into_iter().next()) {
                if used != source.module[0] {
                    found.entry((source.module[0].clone(), used)).or_insert_with(|| source.place(line));
                }
            }
        }
    }
    found
}

/// Lines, with imports over several lines joined.
fn statements(source: &Source) -> Vec<(usize, String)> {
    let mut joined: Vec<(usize, String)> = Vec::new();
    let mut open = false;
    for (line, text) in &source.code {
        match joined.last_mut() {
            Some((_, last)) if open => last.push_str(text),
            _ => joined.push((*line, text.clone())),
        }
        let statement = &joined.last().unwrap().1;
        let import = statement.trim_start().trim_start_matches("pub ").starts_with("use ");
        open = import && !statement.contains(';');
    }
    joined
}

/// Functions and constants at the root of the crate (`crate::Error`) are re-exports, not modules.
fn is_module(name: &str) -> bool {
    name.starts_with(|c: char| c.is_lowercase())
}

#[test]
fn every_module_has_a_layer() {
    let modules: BTreeSet<String> = sources().iter().filter_map(|source| source.module.first().cloned()).collect();
    let homeless: Vec<&String> = modules.iter().filter(|module| layer(module).is_none()).collect();
    assert!(homeless.is_empty(), "give these a place in LAYERS: {homeless:?}");
}

#[test]
fn no_layer_uses_a_higher_one() {
    let upward: Vec<String> = dependencies()
        .iter()
        .filter(|((from, to), _)| is_module(to) && layer(to) > layer(from))
        .map(|((from, to), place)| format!("{place}: {from} uses {to}"))
        .collect();
    assert!(upward.is_empty(), "upward imports:\n{}", upward.join("\n"));
}

#[test]
fn joints_and_forces_do_not_know_each_other() {
    let dependencies = dependencies();
    for pair in [("joint", "force"), ("force", "joint")].map(|(a, b)| (a.to_string(), b.to_string())) {
        assert_eq!(dependencies.get(&pair), None, "{} uses {}", pair.0, pair.1);
    }
}

/// Folders whose modules still use each other in circles.
const CIRCLES: &[&str] = &["force/beam", "initial/equilibrium", "plot"];

#[test]
fn modules_do_not_use_each_other_in_a_circle() {
    let sources = sources();
    let parent = |source: &Source| source.module.split_last().map(|(_, folder)| folder.to_vec());
    let folders: BTreeSet<Vec<String>> = sources.iter().filter_map(parent).collect();
    for folder in folders.iter().filter(|folder| !CIRCLES.contains(&folder.join("/").as_str())) {
        let circle = circle(&sources, folder);
        assert!(circle.is_empty(), "in {} a circle of {circle:?}", folder.join("/"));
    }
}

/// Modules of a folder that use each other in circles, or are between two circles. What a folder takes from one of its
/// modules, and what is used from it by the others, counts as used from that module.
fn circle(sources: &[Source], folder: &[String]) -> BTreeSet<String> {
    let inside =
        || sources.iter().filter(|source| source.module.len() > folder.len() && source.module.starts_with(folder));
    let modules: BTreeSet<&String> = inside().map(|source| &source.module[folder.len()]).collect();
    let taken: BTreeMap<String, String> =
        sources.iter().filter(|source| source.module == folder).flat_map(taken).collect();
    let mut uses = BTreeSet::new();
    for source in inside() {
        let paths = statements(source).into_iter().flat_map(|(_, text)| source.paths(&text));
        for name in paths.filter(|path| path.starts_with(folder)).filter_map(|path| path.get(folder.len()).cloned()) {
            let used = if modules.contains(&name) { Some(name) } else { taken.get(&name).cloned() };
            uses.extend(used.map(|used| (source.module[folder.len()].clone(), used)));
        }
    }
    uses.retain(|(from, to)| from != to);
    loop {
        let both = |name: &String| uses.iter().any(|(from, _)| from == name) && uses.iter().any(|(_, to)| to == name);
        let going: BTreeSet<_> = uses.iter().filter(|(from, to)| both(from) && both(to)).cloned().collect();
        if going.len() == uses.len() {
            return going.into_iter().map(|(from, _)| from).collect();
        }
        uses = going;
    }
}

/// Names that a folder takes from its modules, with the module of each.
fn taken(source: &Source) -> Vec<(String, String)> {
    let imports = statements(source)
        .into_iter()
        .filter_map(|(_, text)| text.split_once("use ").map(|(_, path)| path.to_string()));
    let paths = imports.flat_map(|path| expanded(&path)).filter(|path| path.len() > 1);
    paths.filter_map(|path| Some((path.last()?.clone(), path.first()?.clone()))).collect()
}

fn refuse(what: &str, found: impl Fn(&str) -> bool) {
    let places: Vec<String> = sources()
        .iter()
        .flat_map(|source| source.code.iter().filter(|(_, text)| found(text)).map(|(line, _)| source.place(*line)))
        .collect();
    assert!(places.is_empty(), "{what}:\n{}", places.join("\n"));
}

#[test]
fn nothing_is_unsafe() {
    refuse("unsafe code", |text| text.contains("unsafe ") || text.contains("allow(unsafe_code)"));
}

#[test]
fn nothing_panics_on_purpose() {
    let words = [".unwrap()", ".expect(", "panic!(", "todo!(", "unimplemented!("];
    refuse("use Result instead", |text| words.iter().any(|word| text.contains(word)));
}

#[test]
fn only_the_command_line_prints() {
    let printing: Vec<String> = sources()
        .iter()
        .filter(|source| source.module.first().is_none_or(|module| module != "cli"))
        .flat_map(|source| {
            let prints = |text: &str| ["println!(", "print!(", "dbg!("].iter().any(|word| text.contains(word));
            source.code.iter().filter(move |(_, text)| prints(text)).map(|(line, _)| source.place(*line))
        })
        .collect();
    assert!(printing.is_empty(), "printing belongs to src/cli:\n{}", printing.join("\n"));
}

/// Where small numbers are no thresholds: figures.
const DRAWN: &[&str] = &["src/plot", "src/report/mechanism", "src/report/figures", "src/report/stress/figure.rs"];

/// The value of `const NAME: f64 = 1e-9;`.
fn bare_number(text: &str) -> Option<f64> {
    let (_, declared) = text.split_once("const ")?;
    declared.split_once(": f64 = ")?.1.trim().strip_suffix(';')?.parse().ok()
}

/// The declared constants of a file with a doc comment, by name, with the comment on one line.
fn constants(path: &Path) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut doc = String::new();
    for line in fs::read_to_string(path).unwrap().lines().map(str::trim) {
        match (line.strip_prefix("/// "), line.split_once("const ")) {
            (Some(text), _) => doc = format!("{doc} {text}"),
            (_, Some((_, item))) => found.push((item.split(':').next().unwrap().to_string(), std::mem::take(&mut doc))),
            _ => doc.clear(),
        }
    }
    found
}

/// The thresholds, which say their unit.
fn thresholds() -> Vec<(String, String)> {
    let mut paths = Vec::new();
    collect(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut paths);
    let constants = paths.iter().flat_map(|path| constants(path));
    constants.filter(|(_, doc)| doc.contains("Unit: `[")).collect()
}

#[test]
fn small_numbers_are_thresholds() {
    let known: Vec<String> = thresholds().into_iter().map(|(name, _)| name).collect();
    let is_known = |text: &str| known.iter().any(|name| text.contains(&format!("const {name}:")));
    let strays: Vec<String> = sources()
        .iter()
        .filter(|source| !DRAWN.iter().any(|place| source.path.starts_with(place)))
        .flat_map(|source| {
            let is_small = |text: &str| bare_number(text).is_some_and(|x| x != 0.0 && x.abs() <= 1e-3);
            let is_stray = move |text: &str| is_small(text) && !is_known(text);
            source.code.iter().filter(move |(_, text)| is_stray(text)).map(|(line, _)| source.place(*line))
        })
        .collect();
    assert!(strays.is_empty(), "numbers that decide say their unit and why:\n{}", strays.join("\n"));
    assert_eq!(bare_number("    pub(super) const TINY: f64 = 1e-9;"), Some(1e-9));
}

/// All text of src and tests.
fn all_text() -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders = vec![root.join("src"), root.join("tests")];
    let mut text = String::new();
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            match path.is_dir() {
                true => folders.push(path),
                false if path.extension().is_some_and(|end| end == "rs") => text += &fs::read_to_string(path).unwrap(),
                false => {}
            }
        }
    }
    text
}

#[test]
fn tests_of_thresholds_exist() {
    let thresholds = thresholds();
    let text = all_text();
    assert!(thresholds.len() > 100, "thresholds are read otherwise than they are written");
    for (name, doc) in thresholds {
        if let Some((_, test)) = doc.split_once("Test: `") {
            let test = test.split('`').next().unwrap();
            assert!(text.contains(&format!("fn {test}()")), "{name}: there is no test {test}");
        }
        assert!(text.matches(&name).count() > 1, "{name} is not used");
    }
}

#[test]
fn files_are_short() {
    let long: Vec<String> = sources()
        .iter()
        .filter(|source| source.lines > LONGEST)
        .map(|source| format!("{} has {} lines before its tests", source.path.display(), source.lines))
        .collect();
    assert!(long.is_empty(), "more than {LONGEST}:\n{}", long.join("\n"));
}

/// The name of a type that a line at the margin declares.
fn declared_type(text: &str) -> Option<&str> {
    let item = text.strip_prefix("pub(crate) ").or_else(|| text.strip_prefix("pub(super) ")).unwrap_or(text);
    let item = item.strip_prefix("pub ").unwrap_or(item);
    let (kind, rest) = item.split_once(' ')?;
    let name = rest.split(|c: char| !c.is_alphanumeric()).next()?;
    ["struct", "enum", "trait", "type"].contains(&kind).then_some(name)
}

/// Each command has its `Args`.
#[test]
fn a_type_name_has_at_most_two_meanings() {
    let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for source in sources() {
        for (line, text) in &source.code {
            if let Some(name) = declared_type(text) {
                places.entry(name.to_string()).or_default().push(source.place(*line));
            }
        }
    }
    assert!(places.contains_key("Mechanism"), "types are read otherwise than they are written");
    let many: Vec<_> = places.iter().filter(|(name, places)| *name != "Args" && places.len() > 2).collect();
    assert!(many.is_empty(), "{many:#?}");
}

/// A tuple on the left takes one apart that a function returned; things that have nothing to do with each other are
/// assigned by a statement each.
#[test]
fn a_statement_assigns_one_thing() {
    let is_tuple = |line: &str| {
        let names = line.trim().strip_prefix("let (").and_then(|rest| rest.split_once(") = ("));
        names.is_some_and(|(names, _)| names.chars().all(|c| c.is_alphanumeric() || "_, ".contains(c)))
    };
    let sources = sources();
    let lines =
        sources.iter().flat_map(|source| source.code.iter().map(move |(line, text)| (source.place(*line), text)));
    let tuples: Vec<String> = lines.filter(|(_, text)| is_tuple(text)).map(|(place, _)| place).collect();
    assert!(tuples.len() <= 100, "{} of at most 100:\n{}", tuples.len(), tuples.join("\n"));
}

/// A parameter has a name that says what it is. What travels together is a struct, or comes as two parameters.
#[test]
fn parameters_are_not_taken_apart() {
    let sources = sources();
    let apart: Vec<String> = sources.iter().flat_map(parameters_taken_apart).collect();
    assert!(apart.len() <= 30, "{} of at most 30:\n{}", apart.len(), apart.join("\n"));
}

/// Places of parameters such as `(q, v): (&[f64], &[f64])`.
fn parameters_taken_apart(source: &Source) -> Vec<String> {
    let text: String = source.code.iter().map(|(_, line)| format!("{line}\n")).collect();
    let mut found = Vec::new();
    for (at, _) in text.match_indices("fn ").filter(|(at, _)| starts_word(&text, *at)) {
        let place = source.place(1 + text[..at].matches('\n').count());
        let apart =
            parameters(&text[at..]).into_iter().filter(|own| own.trim_start_matches('&').starts_with(['(', '[']));
        found.extend(apart.map(|own| format!("{place}: {own}")));
    }
    found
}

/// The parameters of the function whose declaration begins a text.
fn parameters(text: &str) -> Vec<&str> {
    let mut depth = 0;
    let mut start = None;
    let mut found = Vec::new();
    for (i, c) in text.char_indices().filter(|(i, c)| *c != '>' || !text[..*i].ends_with('-')) {
        match c {
            '(' | '[' | '<' => {
                if c == '(' && depth == 0 {
                    start = Some(i + 1);
                }
                depth += 1;
            }
            ')' | ']' | '>' => depth -= 1,
            _ => {}
        }
        let ends = c == ',' && depth == 1 || c == ')' && depth == 0;
        if let (true, Some(from)) = (ends, start) {
            found.push(text[from..i].trim());
            start = Some(i + 1);
        }
        if c == ')' && depth == 0 {
            break;
        }
    }
    found
}

/// `autotests` is off, so that tests are linked into few programs: a file that none of them names would never run.
#[test]
fn every_test_is_run() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let manifest = fs::read_to_string(folder.join("Cargo.toml")).unwrap();
    let programs: Vec<&str> =
        manifest.split("[[test]]\nname = \"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    let texts = programs.iter().filter_map(|name| fs::read_to_string(folder.join(format!("tests/{name}.rs"))).ok());
    let named: Vec<String> = texts.flat_map(|text| text.lines().map(str::to_string).collect::<Vec<_>>()).collect();
    for path in fs::read_dir(folder.join("tests")).unwrap().map(|entry| entry.unwrap().path()) {
        let name = path.file_stem().unwrap().to_string_lossy().to_string();
        let is_module = path.extension().is_some_and(|end| end == "rs") || path.join("mod.rs").exists();
        let times = named.iter().filter(|line| **line == format!("mod {name};")).count();
        let is_shared = ["common", "scenes"].contains(&name.as_str());
        let is_named = programs.contains(&name.as_str()) || times == 1 || is_shared;
        assert!(!is_module || is_named, "{name} is in {times} of {programs:?}");
    }
}

/// The tests inside of a source file run only where the program `unit` compiles that file.
#[test]
fn tests_inside_of_files_are_run() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let unit = fs::read_to_string(folder.join("tests/unit/main.rs")).unwrap();
    let has_tests = |source: &&Source| fs::read_to_string(folder.join(&source.path)).unwrap().contains("#[cfg(test)]");
    let sources = sources();
    let tested: Vec<&Source> = sources.iter().filter(has_tests).collect();
    assert!(tested.len() > 50, "{} files with tests", tested.len());
    for source in tested {
        let [room, .., name] = source.module.as_slice() else {
            let name = &source.module[0];
            assert!(unit.contains(&format!("src/{name}.rs\"]")) || unit.contains(&format!("src/{name}/mod.rs\"]")));
            continue;
        };
        let is_whole = unit.contains(&format!("src/{room}/mod.rs\"]"));
        let part = unit.split(&format!("\nmod {room} {{")).nth(1).and_then(|rest| rest.split("\n}").next());
        let is_named = part.is_some_and(|part| part.contains(&format!("mod {name};")));
        assert!(is_whole || is_named, "tests/unit/main.rs does not compile {}", source.path.display());
    }
}

fn source(module: &[&str], text: &str) -> Source {
    let module = module.iter().map(|part| part.to_string()).collect();
    let code = text.lines().enumerate().map(|(i, line)| (i + 1, line.to_string())).collect();
    Source { path: PathBuf::new(), module, code, lines: 0 }
}

#[test]
fn circles_are_found_through_what_a_folder_takes() {
    let found = |of_b: &str| {
        let modules = [("a", "use super::b::B;"), ("b", of_b), ("c", "use crate::f::{A, b};")];
        let folder = source(&["f"], "mod a;\npub use a::{A, Other};");
        let sources: Vec<Source> =
            modules.iter().map(|(name, text)| source(&["f", name], text)).chain([folder]).collect();
        circle(&sources, &["f".to_string()]).into_iter().collect::<Vec<_>>()
    };
    assert_eq!(found("use super::A;"), ["a", "b"]);
    assert_eq!(found("let x = crate::f::a::new();"), ["a", "b"]);
    assert_eq!(found("use crate::math::A;"), [""; 0]);
}

#[test]
fn paths_are_read_as_the_compiler_does() {
    let paths = |module: &[&str], text: &str| -> Vec<String> {
        source(module, "").paths(text).iter().map(|path| path.join("::")).collect()
    };
    let deep = &["body", "rigid"];
    assert_eq!(
        paths(deep, "use crate::{error::{Error, Result}, math, joint::Joint};"),
        ["error::Error", "error::Result", "math", "joint::Joint"]
    );
    assert_eq!(paths(deep, "pub use crate::scene::Scene;"), ["scene::Scene"]);
    assert_eq!(paths(deep, "let x = crate::scene::load(crate::math::one());"), ["scene::load", "math::one"]);
    assert_eq!(paths(deep, "use super::{Built, joint};"), ["body::Built", "body::joint"]);
    assert_eq!(paths(deep, "use super::super::joint::Joint;"), ["joint::Joint"]);
    assert_eq!(paths(&["prepared"], "use super::cli;"), ["cli"]);
    assert_eq!(without_comment("let x = \"a//b\"; // crate::cli"), "let x = \"a//b\"; ");
}

/// A method that it does not pass on would be the default one.
#[test]
fn a_model_passes_on_every_method_of_its_equations() {
    let read = |path: &str| fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(path)).unwrap();
    let of_trait = read("system/mod.rs");
    let passed = read("prepared/equations.rs");
    let (_, methods) = of_trait.split_once("pub trait MechanicalSystem").unwrap();
    let names: Vec<&str> = methods.lines().filter_map(|line| line.strip_prefix("    fn ")?.split('(').next()).collect();
    assert!(names.len() > 20);
    for name in names {
        assert!(passed.contains(&format!(" fn {name}(")), "{name} in src/prepared/equations.rs");
    }
}
