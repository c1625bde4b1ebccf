//! Files and folders that cannot be read or written. No case relies on permissions, which do not stop root.

use crate::errors::{PENDULUM, refused, scene};
use std::fs;

fn refused_in_a_folder(args: &[&str], pieces: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.json"), PENDULUM).unwrap();
    refused(folder.path(), args, pieces);
}

#[test]
fn a_missing_scene() {
    refused_in_a_folder(&["simulate", "other.json"], &["error: other.json: there is no such file\n"]);
    refused_in_a_folder(&["check", "scen.json"], &["scen.json: there is no such file; did you mean `scene.json`?"]);
    refused_in_a_folder(&["check", "no/scene.json"], &["no/scene.json: there is no such file\n"]);
}

#[test]
fn a_folder_as_the_scene() {
    refused_in_a_folder(&["simulate", "."], &["error: .: this is a directory; name a scene file"]);
}

#[test]
fn output_below_a_file() {
    for command in ["simulate", "drift"] {
        let pieces = ["scene.json/out: cannot make this folder: a part of this path is a file", "-o"];
        refused_in_a_folder(&[command, "scene.json", "-o", "scene.json/out"], &pieces);
    }
}

#[test]
fn output_onto_a_file() {
    let pieces = ["scene.json: cannot make this folder: it is a file; choose another place with -o"];
    refused_in_a_folder(&["simulate", "scene.json", "-o", "scene.json"], &pieces);
}

#[test]
fn the_default_folder_below_a_file() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.json"), PENDULUM).unwrap();
    fs::write(folder.path().join("out"), "mine").unwrap();
    refused(folder.path(), &["simulate", "scene.json"], &["out/pendulum: cannot make this folder", "-o"]);
}

#[test]
#[cfg(target_os = "linux")]
fn output_where_the_system_allows_none() {
    let pieces = ["/proc/holonom: cannot make this folder", "choose another place with -o"];
    refused_in_a_folder(&["simulate", "scene.json", "-o", "/proc/holonom"], &pieces);
}

#[test]
fn a_scene_that_is_no_text() {
    let utf16: Vec<u8> = [0xff, 0xfe].into_iter().chain(PENDULUM.encode_utf16().flat_map(u16::to_le_bytes)).collect();
    let broken = [&PENDULUM.as_bytes()[..90], b"\xff", &PENDULUM.as_bytes()[90..]].concat();
    let table = [(utf16, "1:1"), ((128..=255).collect(), "1:1"), (broken, "5:7")];
    for (text, place) in table {
        let message = format!("scene.json:{place}: this is not text in UTF-8");
        scene(text).refused_with(&[&message, "save the scene as UTF-8"]);
    }
}

#[test]
fn a_mark_of_byte_order_is_no_fault() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.json"), format!("\u{feff}{PENDULUM}")).unwrap();
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_holonom"));
    let output = command.args(["check", "scene.json", "--quiet"]).current_dir(folder.path()).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
}
