//! Numbers of a beam's section as expressions.

use serde_json::Value;

/// Area of a section, and the square of its polar radius of gyration.
pub fn area(section: &Value) -> Option<(String, String)> {
    match (&section["rectangle"], &section["circle"]) {
        (Value::Object(sides), _) => {
            let [height, width] = [expression(sides.get("height")?)?, expression(sides.get("width")?)?];
            Some((format!("{height}*{width}"), format!("({height}^2 + {width}^2)/12")))
        }
        (_, Value::Object(circle)) => {
            let outer = expression(circle.get("radius")?)?;
            let inner = circle.get("inner_radius").map_or(Some("0".to_string()), expression)?;
            Some((format!("pi*({outer}^2 - {inner}^2)"), format!("({outer}^2 + {inner}^2)/2")))
        }
        _ => None,
    }
}

/// A number of the scene as a part of an expression.
pub fn expression(number: &Value) -> Option<String> {
    match number {
        Value::String(text) => Some(format!("({text})")),
        Value::Number(number) => Some(number.to_string()),
        _ => None,
    }
}
