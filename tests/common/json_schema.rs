//! JSON Schema (draft 2020-12) as far as the schema of scenes uses it; an unknown keyword is an error of the schema.

use serde_json::Value;

/// Faults of `value`, each with its place; empty where it is valid.
///
/// # Panics
/// On a keyword that is not known here.
pub fn faults(schema: &Value, value: &Value) -> Vec<String> {
    Schema { root: schema }.faults(schema, value, "")
}

struct Schema<'a> {
    root: &'a Value,
}

impl Schema<'_> {
    fn faults(&self, schema: &Value, value: &Value, place: &str) -> Vec<String> {
        let Some(keywords) = schema.as_object() else {
            return if schema == &Value::Bool(true) { vec![] } else { vec![format!("{place}: not allowed")] };
        };
        let rule = |(key, rule): (&String, &Value)| self.rule(schema, key, rule, value, place);
        keywords.iter().flat_map(rule).collect()
    }

    fn rule(&self, schema: &Value, key: &str, rule: &Value, value: &Value, place: &str) -> Vec<String> {
        let valid = |schema: &Value| self.faults(schema, value, place).is_empty();
        let limit = rule.as_u64().unwrap_or(0) as usize;
        let items = value.as_array();
        let is_right = match key {
            "$ref" => return self.faults(self.definition(rule), value, place),
            "properties" => return self.properties(rule, value, place),
            "additionalProperties" => return self.others(schema, rule, value, place),
            "items" => {
                let place = |i: usize| format!("{place}/{i}");
                let items = items.into_iter().flatten().enumerate();
                return items.flat_map(|(i, item)| self.faults(rule, item, &place(i))).collect();
            }
            "type" => rule.as_array().map_or_else(|| is(rule, value), |types| types.iter().any(|one| is(one, value))),
            "enum" => rule.as_array().is_some_and(|values| values.contains(value)),
            "const" => rule == value,
            "pattern" => value.as_str().is_none_or(|text| matches(rule.as_str().unwrap(), text)),
            "allOf" => {
                return rule.as_array().unwrap().iter().flat_map(|rule| self.faults(rule, value, place)).collect();
            }
            "if" if valid(rule) => return self.faults(&schema["then"], value, place),
            "if" | "then" => true,
            "anyOf" => rule.as_array().is_some_and(|schemas| schemas.iter().any(valid)),
            "oneOf" => {
                rule.as_array().is_some_and(|schemas| schemas.iter().filter(|schema| valid(schema)).count() == 1)
            }
            "required" => value.as_object().is_none_or(|object| {
                rule.as_array()
                    .is_some_and(|names| names.iter().all(|name| object.contains_key(name.as_str().unwrap())))
            }),
            "minItems" => items.is_none_or(|items| items.len() >= limit),
            "maxItems" => items.is_none_or(|items| items.len() <= limit),
            "minProperties" => value.as_object().is_none_or(|object| object.len() >= limit),
            "maxProperties" => value.as_object().is_none_or(|object| object.len() <= limit),
            "minLength" => value.as_str().is_none_or(|text| text.chars().count() >= limit),
            "$schema" | "$defs" | "title" | "description" | "default" | "examples" | "format" => true,
            unknown => panic!("the schema uses `{unknown}`"),
        };
        if is_right { vec![] } else { vec![format!("{place}: {value} is not {key} {rule}")] }
    }

    fn definition(&self, pointer: &Value) -> &Value {
        let pointer = pointer.as_str().and_then(|text| text.strip_prefix('#')).unwrap();
        self.root.pointer(pointer).unwrap_or_else(|| panic!("the schema has no {pointer}"))
    }

    fn properties(&self, rules: &Value, value: &Value, place: &str) -> Vec<String> {
        let Some(object) = value.as_object() else { return vec![] };
        let known = object.iter().filter_map(|(name, value)| Some((name, rules.get(name)?, value)));
        known.flat_map(|(name, rule, value)| self.faults(rule, value, &format!("{place}/{name}"))).collect()
    }

    /// Of properties that `schema` does not name.
    fn others(&self, schema: &Value, rule: &Value, value: &Value, place: &str) -> Vec<String> {
        let Some(object) = value.as_object() else { return vec![] };
        let named = |name: &str| schema["properties"].get(name).is_some();
        let others = object.iter().filter(|(name, _)| !named(name));
        others.flat_map(|(name, value)| self.faults(rule, value, &format!("{place}/{name}"))).collect()
    }
}

/// Patterns of the form `^(one|[-_]|other)(:.*)?$`, as those of methods are.
fn matches(pattern: &str, text: &str) -> bool {
    let names = pattern.strip_prefix("^(").and_then(|rest| rest.strip_suffix(")(:.*)?$"));
    let names = names.unwrap_or_else(|| panic!("the schema uses the pattern `{pattern}`"));
    let name = text.split(':').next().unwrap_or_default().replace('-', "_");
    names.replace("[-_]", "_").split('|').any(|known| known == name)
}

fn is(kind: &Value, value: &Value) -> bool {
    match kind.as_str().unwrap() {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "object" => value.is_object(),
        "array" => value.is_array(),
        "number" => value.is_number(),
        "integer" => value.as_f64().is_some_and(|number| number.fract() == 0.0),
        "string" => value.is_string(),
        unknown => panic!("the schema uses the type `{unknown}`"),
    }
}
