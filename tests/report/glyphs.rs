//! Symbols of joints and forces.

use holonom::{force, joint};

/// Kinds without a line of their own are drawn as those from outside the crate.
#[test]
fn every_kind_of_joint_and_force_has_a_sign() {
    let source = include_str!("../../src/report/mechanism/glyphs.rs");
    let joints = joint::registry::<3>().into_iter().map(|entry| (entry.name, "joints"));
    let forces = force::registry::<3>().into_iter().map(|entry| (entry.name, "forces"));
    let has_none = |(kind, module): &(&str, &str)| !source.contains(&format!("\"{kind}\" => ({module}::"));
    let missing: Vec<_> = joints.chain(forces).filter(has_none).collect();
    assert!(missing.is_empty(), "no sign for {missing:?}");
}
