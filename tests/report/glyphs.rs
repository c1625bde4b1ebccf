//! Symbols of joints and forces.

use holonom::{force, joint};

/// Kinds without a line of their own are drawn as those from outside the crate.
#[test]
fn every_kind_of_joint_and_force_has_a_sign() {
    let source = include_str!("../../src/report/mechanism/glyphs.rs");
    let (joints, forces) = source.split_once("const FORCES: &[Glyph]").unwrap();
    let forces = forces.split_once("];").unwrap().0;
    let has_all = |known: Vec<&str>, table: &str| {
        let missing = known.into_iter().filter(|kind| !table.contains(&format!("glyph(\"{kind}\", ")));
        let missing: Vec<&str> = missing.collect();
        assert!(missing.is_empty(), "no sign for {missing:?}");
    };
    has_all(joint::registry::<3>().iter().map(|entry| entry.name).collect(), joints);
    has_all(force::registry::<3>().iter().map(|entry| entry.name).collect(), forces);
}
