//! Plain sentences: short, and none that begins as half of one.

use super::{commands, readme};
use holonom::guide::CHAPTERS;

const LONGEST: usize = 30;
const MEAN: f64 = 15.0;
/// Words with which a half sentence begins, unless it is a question.
const BEGINNINGS: [&str; 5] = ["What", "Of", "Where", "Whether", "How"];

/// The sentences of a Markdown text, without blocks of code, tables, headings and targets of links.
fn sentences(text: &str) -> Vec<String> {
    let mut paragraphs = vec![String::new()];
    let mut is_code = false;
    for line in text.lines().map(str::trim) {
        is_code ^= line.starts_with("```");
        let is_target = line.starts_with('[') && line.contains("]: ");
        let is_prose = !is_code && !is_target && !line.starts_with(['|', '#', '!', '<', '`']);
        let item = line.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start_matches(['-', '*', '.']);
        let begins = line.is_empty() || item.len() < line.len() && item.starts_with(' ');
        if begins || !is_prose {
            paragraphs.push(String::new());
        }
        if is_prose || line.starts_with('`') && !line.starts_with("```") && !is_code {
            let last = paragraphs.last_mut().unwrap();
            last.push_str(if begins { item } else { line });
            last.push(' ');
        }
    }
    paragraphs.iter().flat_map(|paragraph| split(&without_code(paragraph))).collect()
}

/// The text with each piece of code as one word.
fn without_code(text: &str) -> String {
    text.split('`').enumerate().map(|(i, part)| if i % 2 == 0 { part } else { "code" }).collect()
}

fn split(text: &str) -> Vec<String> {
    let mut sentences = vec![String::new()];
    let words: Vec<&str> = text.split_whitespace().collect();
    for (i, word) in words.iter().enumerate() {
        let last = sentences.last_mut().unwrap();
        last.push_str(word);
        last.push(' ');
        let next_begins = words.get(i + 1).is_some_and(|next| {
            next.starts_with(|c: char| c.is_uppercase() || "[(".contains(c) || next.starts_with("code"))
        });
        if word.ends_with(['.', '!', '?', ':']) && next_begins {
            sentences.push(String::new());
        }
    }
    sentences.retain(|sentence| !sentence.trim().is_empty());
    sentences
}

fn check(name: &str, text: &str) {
    let all = sentences(text);
    let counts: Vec<usize> = all.iter().map(|sentence| sentence.split_whitespace().count()).collect();
    let mean = counts.iter().sum::<usize>() as f64 / counts.len().max(1) as f64;
    assert!(mean <= MEAN, "{name}: {mean:.1} words a sentence");
    for (sentence, count) in all.iter().zip(&counts) {
        assert!(*count <= LONGEST, "{name}: {count} words: {sentence}");
        let first = sentence.split_whitespace().next().unwrap();
        assert!(
            !BEGINNINGS.contains(&first) || sentence.trim_end().ends_with('?'),
            "{name}: half a sentence: {sentence}"
        );
    }
}

#[test]
fn the_guide_is_written_in_plain_sentences() {
    check("README", &readme());
    CHAPTERS.iter().for_each(|chapter| check(chapter.name, chapter.text));
}

/// Texts of `--help` but the examples: the words before and after a colon count apart, since lists follow it.
#[test]
fn help_is_written_in_plain_sentences() {
    let list = commands("holonom --help");
    let names = list.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    let names = names.lines().filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    for name in names.filter(|name| !name.is_empty() && *name != "help") {
        let help = commands(&format!("holonom {name} --help"));
        let text = help.split("Examples:\n").next().unwrap();
        let is_prose = |line: &&str| !line.trim_start().starts_with(['-', '<', '[']) && !line.starts_with("Usage");
        for paragraph in text.split("\n\n") {
            let prose: Vec<&str> = paragraph.lines().filter(is_prose).map(str::trim).collect();
            for part in prose.join(" ").split(": ").flat_map(split) {
                let count = part.split_whitespace().filter(|word| !word.ends_with(',')).count();
                assert!(count <= LONGEST, "{name}: {count} words: {part}");
                let first = part.split_whitespace().next().unwrap();
                assert!(!BEGINNINGS.contains(&first), "{name}: half a sentence: {part}");
            }
        }
    }
}

#[test]
fn sentences_are_told_apart() {
    let text = "# Title\n\nOne two `a b c` three. Four five?\n\n- Six seven\n  eight.\n- Nine.\n\n```text\nno no\n```\n| a | b |\n";
    assert_eq!(sentences(text), ["One two code three. ", "Four five? ", "Six seven eight. ", "Nine. "]);
}
