//! The same scene with a finer mesh.

use super::edit::elements_mut;
use serde_json::{Value, json};

/// Keys of a beam whose values are doubled.
const KEYS: [&str; 2] = ["elements", "modes"];

/// The text of a scene with twice the elements and modes of every beam; `None` if no beam has either key.
pub fn refined(text: &str) -> Option<String> {
    let mut scene = serde_json::from_str(text.trim_start_matches('\u{feff}')).ok()?;
    let mut is_refined = false;
    for body in elements_mut(&mut scene, "bodies").filter(|body| body["type"] == "flexible_beam") {
        for key in KEYS {
            let Some(number) = body.get_mut(key) else { continue };
            let finer = match &*number {
                Value::String(expression) => json!(format!("2*({expression})")),
                number => json!(2 * number.as_u64()?),
            };
            *number = finer;
            is_refined = true;
        }
    }
    is_refined.then(|| scene.to_string())
}

#[cfg(test)]
mod tests {
    use super::refined;

    #[test]
    fn beams_have_twice_their_elements_and_modes() {
        let scene = r#"{"bodies":[{"type":"rigid"},{"type":"flexible_beam","elements":"n","modes":3}]}"#;
        let finer = r#"{"bodies":[{"type":"rigid"},{"type":"flexible_beam","elements":"2*(n)","modes":6}]}"#;
        assert_eq!(refined(scene).as_deref(), Some(finer));
        assert_eq!(refined(r#"{"bodies":[{"type":"rigid"}]}"#), None);
    }
}
