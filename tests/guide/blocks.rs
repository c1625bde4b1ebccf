//! The blocks of a chapter, run one after the other in one folder.

use std::fs::{self, File};
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

/// Follows a chapter and returns the number of its commands. A block with a file name (```` ```json pendulum.json ````)
/// is written to that file. In a block `console`, lines that begin with `$ ` are commands; the lines after one are lines
/// of its output, in this order, where `...` stands for any.
pub fn follow(chapter: &str) -> usize {
    let place = place();
    let mut commands = 0;
    for (info, body) in blocks(chapter) {
        match info.split_whitespace().collect::<Vec<_>>()[..] {
            [_, file] => fs::write(place.path().join(file), body).unwrap(),
            ["console"] => commands += session(place.path(), &body),
            _ => {}
        }
    }
    commands
}

/// The output of one command in a folder of its own.
pub fn commands(line: &str) -> String {
    run(place().path(), line)
}

/// An empty folder beside the shipped scenes.
pub fn place() -> TempDir {
    let place = tempfile::tempdir().unwrap();
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    copy(&models, &place.path().join("models"));
    place
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir(to).unwrap();
    for entry in fs::read_dir(from).unwrap().map(Result::unwrap) {
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &target);
        } else {
            fs::copy(entry.path(), target).unwrap();
        }
    }
}

/// Fenced blocks: the words after the fence, and the text.
pub fn blocks(chapter: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut lines = chapter.lines();
    while let Some(line) = lines.next() {
        if let Some(info) = line.strip_prefix("```") {
            let body: Vec<&str> = lines.by_ref().take_while(|line| !line.starts_with("```")).collect();
            found.push((info.to_string(), body.join("\n") + "\n"));
        }
    }
    found
}

/// Runs the commands of a block and compares their output; returns their number.
fn session(place: &Path, body: &str) -> usize {
    let all: Vec<&str> = body.split("$ ").collect();
    let is_command = |part: &&&str| part.starts_with("holonom");
    let mut count = 0;
    for part in all.iter().filter(is_command) {
        let (command, expected) = part.split_once('\n').unwrap_or((part, ""));
        let output = run(place, command);
        agree(command, expected, &output);
        count += 1;
    }
    count
}

/// Runs a command line; standard output and standard error together.
fn run(place: &Path, line: &str) -> String {
    let words = words(line);
    assert_eq!(words[0], "holonom", "{line}");
    let log = place.join(".log");
    let file = File::create(&log).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_holonom"));
    command.args(&words[1..]).current_dir(place).stderr(file.try_clone().unwrap()).stdout(file);
    let status = command.status().unwrap();
    let output = fs::read_to_string(log).unwrap();
    assert!(status.code().is_some_and(|code| code <= 2) && !output.contains("panicked"), "{line}: {output}");
    output
}

/// The words of a command line, with quotes.
fn words(line: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quote = None;
    for c in line.trim().chars() {
        match (c, quote) {
            ('\'' | '"', None) => quote = Some(c),
            (c, Some(open)) if c == open => quote = None,
            (' ', None) => words.push(String::new()),
            (c, _) => words.last_mut().unwrap().push(c),
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

fn agree(command: &str, expected: &str, output: &str) {
    let mut lines = output.lines().peekable();
    let mut is_free = false;
    for wanted in expected.trim_end().lines() {
        if wanted.trim() == "..." {
            is_free = true;
            continue;
        }
        let found = loop {
            match lines.next() {
                Some(line) if same(wanted, line) => break true,
                Some(line) if is_free || line.trim().is_empty() => {}
                _ => break false,
            }
        };
        assert!(found, "{command}: expected the line\n{wanted}\nin\n{output}");
        is_free = false;
    }
}

/// True if two lines have the same words and, to one percent, the same numbers.
fn same(a: &str, b: &str) -> bool {
    let [(words, numbers), (others, values)] = [a, b].map(taken_apart);
    let is_near = |(x, y): (&f64, &f64)| (x - y).abs() <= 0.01 * x.abs().max(y.abs()) || x.abs().max(y.abs()) < 1e-9;
    words == others && numbers.len() == values.len() && numbers.iter().zip(&values).all(is_near)
}

/// The text of a line without its numbers and repeated blanks, and the numbers.
fn taken_apart(line: &str) -> (String, Vec<f64>) {
    let mut text = String::new();
    let mut numbers = Vec::new();
    let mut rest = line.trim_end();
    while let Some(c) = rest.chars().next() {
        let before = text.chars().last();
        let begins = !before.is_some_and(|before| before.is_alphanumeric() || before == '.' || before == '_');
        let length = if begins { number(rest) } else { 0 };
        if length > 0 {
            numbers.push(rest[..length].parse().unwrap());
            text.push('#');
            rest = &rest[length..];
        } else {
            if !(c.is_whitespace() && before.is_some_and(char::is_whitespace)) {
                text.push(if c.is_whitespace() { ' ' } else { c });
            }
            rest = &rest[c.len_utf8()..];
        }
    }
    (text, numbers)
}

/// Length of the number with which a text begins; 0 without one.
fn number(text: &str) -> usize {
    let is_part = |c: char| c.is_ascii_digit() || ".eE+-".contains(c);
    let longest = text.find(|c| !is_part(c)).unwrap_or(text.len());
    let begins = text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
    (1..=longest)
        .rev()
        .find(|end| {
            begins && text[..*end].ends_with(|c: char| c.is_ascii_digit()) && text[..*end].parse::<f64>().is_ok()
        })
        .unwrap_or(0)
}

#[test]
fn lines_agree_to_one_percent() {
    assert!(same("max 1.000e-3 m,  731 steps", "max 1.004e-3 m, 732 steps"));
    assert!(!same("max 1.0e-3 m", "max 1.1e-3 m") && !same("5 m", "5 s"));
    assert!(same("|phi| 2.2e-16", "|phi| 1.1e-16"));
    assert_eq!(words("holonom a 'b c' d=\"e f\""), ["holonom", "a", "b c", "d=e f"]);
}
