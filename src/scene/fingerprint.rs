//! A hash by which a later run knows the mechanism of an earlier one again.

use serde_json::Value;
use std::path::Path;

/// Keys of a scene that change no motion from a given state; parameters are compared by their values.
const ASIDE: [&str; 8] = ["name", "about", "references", "tags", "parameters", "outputs", "simulation", "assembly"];

/// Hash of what a scene with its includes says of the mechanism, and of the files that it names, in hexadecimal digits:
/// FNV-1a of 64 bits. It tells changes by mistake, not by intent.
pub fn fingerprint(scene: &Value, folder: &Path) -> String {
    let mut hash = Fnv::default();
    for (key, value) in scene.as_object().into_iter().flatten().filter(|(key, _)| !ASIDE.contains(&key.as_str())) {
        hash.add(key.as_bytes());
        hash.add(value.to_string().as_bytes());
        hash.add_files(value, folder);
    }
    format!("{:016x}", hash.0)
}

struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Self {
        Fnv(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    fn add(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    /// Adds the content of the files of signals and flexible bodies.
    fn add_files(&mut self, value: &Value, folder: &Path) {
        match value {
            Value::Array(items) => items.iter().for_each(|item| self.add_files(item, folder)),
            Value::Object(entries) => {
                for (key, value) in entries {
                    match value {
                        // One that cannot be read is an error of the scene.
                        Value::String(name) if key == "file" => {
                            self.add(&crate::files::read(&folder.join(name)).unwrap_or_default());
                        }
                        value => self.add_files(value, folder),
                    }
                }
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn of(scene: Value) -> String {
        fingerprint(&scene, Path::new(""))
    }

    /// Test vectors of FNV-1a: draft-eastlake-fnv.
    #[test]
    fn the_hash_is_fnv_1a() {
        let of = |text: &str| {
            let mut hash = Fnv::default();
            hash.add(text.as_bytes());
            hash.0
        };
        assert_eq!([of(""), of("a"), of("foobar")], [0xcbf29ce484222325, 0xaf63dc4c8601ec8c, 0x85944171f73967e8]);
    }

    #[test]
    fn what_changes_the_motion_changes_the_hash() {
        let scene =
            json!({ "name": "a", "gravity": [0, -9.81], "bodies": [{ "name": "b", "mass": 1 }], "outputs": [] });
        let with = |key: &str, value: Value| {
            let mut other = scene.clone();
            other[key] = value;
            of(other)
        };
        for key in ["name", "outputs", "about", "simulation"] {
            assert_eq!(with(key, json!("other")), of(scene.clone()), "{key}");
        }
        assert_ne!(with("gravity", json!([0, -1.62])), of(scene.clone()));
        assert_ne!(with("bodies", json!([{ "name": "b", "mass": 2 }])), of(scene.clone()));
    }
}
