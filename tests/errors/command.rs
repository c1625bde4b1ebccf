//! The command line itself.

use crate::errors::{PENDULUM, refused};
use std::fs;
use tempfile::TempDir;

fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.json"), PENDULUM).unwrap();
    folder
}

#[test]
fn words_of_the_command_line() {
    let table: &[(&[&str], &[&str])] = &[
        (&["simulat", "scene.json"], &["unrecognized subcommand 'simulat'", "simulate"]),
        (&["simulate"], &["required arguments", "<SCENE>"]),
        (&["simulate", ""], &["a value is required for '<SCENE>'"]),
        (&["simulate", "scene.json", "--untill", "3"], &["unexpected argument '--untill'", "--until"]),
        (&["simulate", "scene.json", "more.json"], &["unexpected argument 'more.json'"]),
        (&["simulate", "scene.json", "--figures", "pdf"], &["invalid value 'pdf'", "svg, png, none"]),
        (&["generate", "chian"], &["there is no scene to generate `chian`", "did you mean `chain`?"]),
        (&["generate", "zzz"], &["there is no scene to generate `zzz`", "choose one of n_four_bar, chain"]),
        (&["generate", "chain", "--n", "0"], &["'0'", "--n", "give a whole number from 1 to 1000000"]),
        (&["generate", "chain", "--n", "-1"], &["'-1'", "--n", "give a whole number from 1 to 1000000"]),
        (&["generate", "chain", "--n", "2000000"], &["'2000000'", "give a whole number from 1 to 1000000"]),
        (&["generate", "chain", "--n", "ten"], &["'ten'", "--n", "give a whole number"]),
        (&["generate", "chain", "-o", "scene.json/x"], &["scene.json/x: cannot write: a part of this path is a file"]),
        (&["generate", "chain", "-o", "."], &[".: cannot write: this is a directory"]),
        (&["generate", "chain", "-o", "none/x.json"], &["none/x.json", "does not exist", "choose another place"]),
    ];
    for (args, pieces) in table {
        refused(folder().path(), args, pieces);
    }
}

#[test]
fn every_command_reads_scenes_with_the_same_care() {
    let folder = folder();
    fs::write(folder.path().join("bad.json"), PENDULUM.replace("gravity", "gravty")).unwrap();
    for command in ["check", "simulate", "drift"] {
        for flag in ["--json", "--quiet"] {
            let pieces = ["bad.json:5:13: at gravty: unknown key `gravty`", "help: did you mean `gravity`?"];
            refused(folder.path(), &[command, "bad.json", flag], &pieces);
        }
    }
}

#[test]
fn no_arguments_give_help() {
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_holonom")).output().unwrap();
    let help = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    ["Usage: holonom <COMMAND>", "simulate", "check", "drift", "generate", "methods", "schema"]
        .iter()
        .for_each(|word| assert!(help.contains(word), "{word}"));
}
