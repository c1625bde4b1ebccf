//! Licences and versions of the packages that are built in.

use serde_json::Value;
use std::collections::BTreeMap;
use std::process::Command;

/// Licences under which a package may be used in a program with the licence MIT.
const ALLOWED: [&str; 9] = [
    "MIT",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
    "0BSD",
];

/// Packages of which several versions are resolved here, and who keeps the older ones.
const SEVERAL: [(&str, &str); 7] = [
    ("equator", "faer and its parts"),
    ("equator-macro", "faer and its parts"),
    ("foldhash", "hashbrown 0.15"),
    ("glam", "optional conversions of nalgebra, not built"),
    ("hashbrown", "diffsol"),
    ("miniz_oxide", "png"),
    ("syn", "macros of several packages, at build time alone"),
];

/// The packages of this system: a fresh machine has downloaded no others.
fn packages() -> Vec<Value> {
    let cargo = std::env::var("CARGO").unwrap_or("cargo".to_string());
    let platform = ["--filter-platform", "host-tuple"];
    let arguments = ["metadata", "--format-version", "1", "--offline", "--manifest-path"];
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml");
    let output = Command::new(cargo).args(arguments).arg(manifest).args(platform).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    metadata["packages"].as_array().unwrap().clone()
}

/// True if an expression such as `MIT OR (Apache-2.0 AND Unicode-3.0)` can be met by the allowed licences.
fn is_allowed(expression: &str) -> bool {
    let plain = expression.replace('/', " OR ").replace(['(', ')'], "");
    let all_of = |part: &str| part.split(" OR ").any(|name| ALLOWED.contains(&name.trim()));
    plain.split(" AND ").all(all_of)
}

#[test]
fn licences_are_permissive() {
    assert!(is_allowed("MIT OR GPL-2.0-only") && !is_allowed("GPL-3.0-only") && !is_allowed("MIT AND GPL-2.0-only"));
    let packages = packages();
    assert!(packages.len() > 100);
    for package in packages {
        let license = package["license"].as_str().unwrap_or_default();
        assert!(is_allowed(license), "{}: {license}", package["name"]);
    }
}

#[test]
fn several_versions_have_a_reason() {
    let mut versions: BTreeMap<String, usize> = BTreeMap::new();
    for package in packages() {
        *versions.entry(package["name"].as_str().unwrap().to_string()).or_default() += 1;
    }
    for (name, count) in versions {
        assert!(count == 1 || SEVERAL.iter().any(|(known, _)| *known == name), "{count} versions of {name}");
    }
}

/// The stated version of Rust is enough for every package.
#[test]
fn no_package_wants_a_newer_rust() {
    let version = |text: &str| -> Vec<u32> { text.split('.').map(|part| part.parse().unwrap_or(0)).collect() };
    let stated = version(env!("CARGO_PKG_RUST_VERSION"));
    for package in packages() {
        if let Some(needed) = package["rust_version"].as_str() {
            assert!(version(needed)[..2] <= stated[..2], "{} wants Rust {needed}", package["name"]);
        }
    }
}
