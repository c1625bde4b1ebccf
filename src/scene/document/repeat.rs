//! Elements that are written once and repeated.
//!
//! An object with `"repeat": { "i": "1..6" }`, in a list or as an entry of another object, stands for one copy a value
//! of i. In its text and keys `{EXPRESSION}` is replaced by the value of the expression over the parameters and i:
//! `leg{i}`, `2*pi*{i}/6`, `leg{mod(i, 6) + 1}.end`.

use super::budget::Budget;
use crate::error::{Error, Result, excerpt, short};
use crate::math::expression::{Expression, Name, Names, Number, Parameters};
use serde_json::{Map, Value};
use std::collections::HashMap;

/// Keys of a scene in which elements may be repeated.
const KEYS: [&str; 7] = ["ground", "bodies", "joints", "forces", "states", "inputs", "outputs"];

/// True if something in the scene is repeated.
pub fn is_used(scene: &Value) -> bool {
    KEYS.iter().filter_map(|key| scene.get(key)).any(has_repeat)
}

fn has_repeat(json: &Value) -> bool {
    match json {
        Value::Object(map) => map.contains_key("repeat") || map.values().any(has_repeat),
        Value::Array(items) => items.iter().any(has_repeat),
        _ => false,
    }
}

/// Puts copies in the place of what is repeated, and returns the places where they are written.
pub fn expand(scene: &mut Value, parameters: &Parameters, budget: &mut Budget) -> Result<Written> {
    let mut expansion = Expansion { parameters, budget, written: Written::default() };
    for key in KEYS {
        if let Some(value) = scene.get_mut(key) {
            *value = expansion.value(value.take(), &Vec::new(), &WrittenPath::default().entry(key, key))?;
        }
    }
    Ok(expansion.written)
}

/// Places of copies in the scene as it is written.
#[derive(Default)]
pub struct Written {
    places: HashMap<String, String>,
    variables: Vec<String>,
}

impl Written {
    /// The error with the path as it is written.
    pub fn place(&self, error: Error) -> Error {
        let Error::Input(mut input) = error else { return error };
        let ends = input.path.match_indices(['.', '[']).map(|(at, _)| at).chain([input.path.len()]);
        let found = ends.filter_map(|end| Some((end, self.places.get(&input.path[..end])?))).max();
        if let Some((end, written)) = found {
            input.path = format!("{written}{}", &input.path[end..]);
        }
        let is_bare = |name: &&String| input.message.contains(&format!("unknown name `{name}`"));
        if let Some(name) = self.variables.iter().find(is_bare) {
            input.hint = Some(format!("write `{{{name}}}` for the value of `{name}` in \"repeat\""));
        }
        Error::Input(input)
    }
}

/// Path of a value after the expansion, and as it is written.
#[derive(Default)]
struct WrittenPath {
    path: String,
    written: String,
}

impl WrittenPath {
    fn entry(&self, key: &str, written: &str) -> WrittenPath {
        let join = |path: &str, key: &str| if path.is_empty() { key.to_string() } else { format!("{path}.{key}") };
        WrittenPath { path: join(&self.path, key), written: join(&self.written, written) }
    }

    fn item(&self, index: usize, written: usize) -> WrittenPath {
        WrittenPath { path: format!("{}[{index}]", self.path), written: format!("{}[{written}]", self.written) }
    }
}

/// Values of the variables around a place.
type Variables = Vec<(String, f64)>;

struct Scope<'a> {
    parameters: &'a Parameters,
    variables: &'a Variables,
}

impl Names for Scope<'_> {
    fn resolve(&self, name: &str) -> Option<Name> {
        let variable = self.variables.iter().find(|(known, _)| known == name);
        variable.map(|(_, value)| *value).or_else(|| self.parameters.get(name)).map(Name::Constant)
    }
    fn known(&self) -> Vec<String> {
        self.variables.iter().map(|(name, _)| name.clone()).chain(self.parameters.known()).collect()
    }
}

struct Expansion<'a> {
    parameters: &'a Parameters,
    budget: &'a mut Budget,
    written: Written,
}

impl Expansion<'_> {
    fn value(&mut self, value: Value, variables: &Variables, place: &WrittenPath) -> Result<Value> {
        match value {
            Value::String(text) if !variables.is_empty() => {
                self.text(&text, variables).map(Value::String).map_err(|error| error.under(&place.written))
            }
            Value::Array(items) => self.items(items, variables, place).map(Value::Array),
            Value::Object(map) => self.entries(map, variables, place).map(Value::Object),
            other => Ok(other),
        }
    }

    fn items(&mut self, items: Vec<Value>, variables: &Variables, place: &WrittenPath) -> Result<Vec<Value>> {
        let mut all = Vec::with_capacity(items.len());
        let mut is_shifted = false;
        for (i, item) in items.into_iter().enumerate() {
            let written = place.item(i, i);
            is_shifted |= item.get("repeat").is_some();
            for (item, variables) in self.copies(item, variables, &written)? {
                let here = place.item(all.len(), i);
                if is_shifted {
                    self.written.places.insert(here.path.clone(), here.written.clone());
                }
                all.push(self.value(item, &variables, &here)?);
            }
        }
        Ok(all)
    }

    fn entries(
        &mut self,
        map: Map<String, Value>,
        variables: &Variables,
        place: &WrittenPath,
    ) -> Result<Map<String, Value>> {
        let mut all = Map::new();
        for (key, value) in map {
            let written = place.entry(&key, &key);
            for (value, variables) in self.copies(value, variables, &written)? {
                let name = if variables.is_empty() {
                    key.clone()
                } else {
                    self.text(&key, &variables).map_err(|error| error.under(&written.written))?
                };
                let here = place.entry(&name, &key);
                if name != key {
                    self.written.places.insert(here.path.clone(), here.written.clone());
                }
                let value = self.value(value, &variables, &here)?;
                if all.insert(name.clone(), value).is_some() {
                    return Err(Error::input(format!("the name `{}` is given twice", excerpt(&name)))
                        .under(&written.written)
                        .hint("name the variable of \"repeat\" in it, as in `A{i}`"));
                }
            }
        }
        Ok(all)
    }

    /// One copy for each value of the variables of `repeat`; the value itself without it.
    fn copies(&mut self, mut value: Value, outer: &Variables, place: &WrittenPath) -> Result<Vec<(Value, Variables)>> {
        let Some(repeat) = value.as_object_mut().and_then(|map| map.shift_remove("repeat")) else {
            return Ok(vec![(value, outer.clone())]);
        };
        let all = self.assignments(repeat, outer).map_err(|error| error.under("repeat").under(&place.written))?;
        check_name(&value, all.len()).map_err(|error| error.under("name").under(&place.written))?;
        self.budget.take_text(&value, all.len()).map_err(|error| error.under("repeat").under(&place.written))?;
        Ok(all.into_iter().map(|variables| (value.clone(), variables)).collect())
    }

    /// All values of the variables, the last one varying fastest.
    fn assignments(&mut self, repeat: Value, outer: &Variables) -> Result<Vec<Variables>> {
        let Value::Object(ranges) = repeat else {
            return Err(Error::input(format!("expected an object {{...}}, found {}", crate::body::show(&repeat)))
                .hint("write \"repeat\": { \"i\": \"1..6\" }"));
        };
        let mut all = vec![outer.clone()];
        for (name, range) in &ranges {
            self.check_variable(name, outer).map_err(|error| error.under(name))?;
            let mut longer = Vec::new();
            for variables in &all {
                let (first, count) = self.range(range, variables).map_err(|error| error.under(name))?;
                self.budget.take_copies(count).map_err(|error| error.under(name))?;
                longer.extend((0..count).map(|i| {
                    variables.iter().cloned().chain([(name.clone(), first + i as f64)]).collect::<Variables>()
                }));
            }
            all = longer;
        }
        Ok(all)
    }

    fn check_variable(&mut self, name: &str, outer: &Variables) -> Result<()> {
        let is_taken = self.parameters.get(name).is_some() || outer.iter().any(|(known, _)| known == name);
        if is_taken {
            return Err(Error::input(format!("the name `{}` is taken", excerpt(name)))
                .hint("give the variable a name that no parameter and no \"repeat\" around it has"));
        }
        // A variable is named like a parameter.
        Parameters::resolve(&[(name.to_string(), Number::Value(0.0))], &[]).map_err(|error| error.problem)?;
        if !self.written.variables.iter().any(|known| known == name) {
            self.written.variables.push(name.to_string());
        }
        Ok(())
    }

    /// First value and number of values of `A..B`, both included; none where B = A - 1.
    fn range(&self, range: &Value, variables: &Variables) -> Result<(f64, usize)> {
        let Some((first, last)) = range.as_str().and_then(|text| text.split_once("..")) else {
            return Err(Error::input(format!("expected a range, found {}", crate::body::show(range)))
                .hint("write \"1..6\" for 1 to 6; the ends may be expressions over parameters"));
        };
        let [first, last] = [self.evaluate(first, variables)?, self.evaluate(last, variables)?];
        let is_whole = [first, last].iter().all(|x| x.fract() == 0.0);
        let count = last - first + 1.0;
        if is_whole && first.abs() < 1e9 && count >= 0.0 {
            Ok((first, count as usize))
        } else {
            Err(Error::input(format!("`{}..{}` is no range", short(first), short(last)))
                .hint("give two whole numbers, the smaller one first"))
        }
    }

    fn evaluate(&self, text: &str, variables: &Variables) -> Result<f64> {
        Ok(Expression::parse(text, &Scope { parameters: self.parameters, variables })?.constant()?)
    }

    /// The text with values in the place of expressions in braces.
    fn text(&self, text: &str, variables: &Variables) -> Result<String> {
        let mut out = String::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once('{') {
            let Some((expression, after)) = after.split_once('}') else {
                return Err(Error::input(format!("`{{` without `}}` in \"{}\"", excerpt(text))).hint("close the brace"));
            };
            let value = self.evaluate(expression, variables)? + 0.0;
            out += before;
            out += &if value < 0.0 { format!("({value})") } else { format!("{value}") };
            rest = after;
        }
        Ok(out + rest)
    }
}

/// Refuses copies of one name, before they are made.
fn check_name(value: &Value, copies: usize) -> Result<()> {
    match value.get("name").and_then(Value::as_str) {
        Some(name) if copies > 1 && !name.contains('{') => {
            Err(Error::input(format!("{copies} copies have the name `{}`", excerpt(name)))
                .hint("name the variable of \"repeat\" in it, as in `leg{i}`"))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn expanded(bodies: Value) -> Result<Value> {
        let parameters = Parameters::resolve(&[("n".to_string(), 2.0.into())], &[]).unwrap();
        let mut scene = json!({ "bodies": bodies });
        expand(&mut scene, &parameters, &mut Budget::default())?;
        assert!(!is_used(&scene), "{scene}");
        Ok(scene["bodies"].take())
    }

    #[test]
    fn copies_are_in_order_with_their_values() {
        let scene = json!([
            "{i}",
            { "repeat": { "i": "1..n" }, "name": "b{i}", "x": ["2^{-i}", "{i/2}", 7, "{10*i + n}"] },
            { "repeat": { "i": "0..1", "j": "i..1" }, "k": { "m{j}": "{i}{j}" } },
            { "repeat": { "i": "1..n-2" } },
        ]);
        let expected = json!([
            "{i}",
            { "name": "b1", "x": ["2^(-1)", "0.5", 7, "12"] },
            { "name": "b2", "x": ["2^(-2)", "1", 7, "22"] },
            { "k": { "m0": "00" } }, { "k": { "m1": "01" } }, { "k": { "m1": "11" } },
        ]);
        assert_eq!(expanded(scene).unwrap(), expected);
    }

    #[test]
    fn entries_of_objects_are_repeated_too() {
        let scene = json!({ "b": { "repeat": { "i": "1..2" }, "markers": {
            "P{i}": { "x": 1 }, "Q{k}{i}": { "repeat": { "k": "1..2" }, "x": "{k}" } } } });
        let error = expanded(scene.clone()).unwrap_err().to_string();
        assert!(error.starts_with("at bodies.b: the name `b` is given twice"), "{error}");
        let markers = json!([{ "markers": { "P1": { "x": 1 }, "Q11": { "x": "1" }, "Q21": { "x": "2" } } },
            { "markers": { "P2": { "x": 1 }, "Q12": { "x": "1" }, "Q22": { "x": "2" } } }]);
        assert_eq!(expanded(json!([scene["b"]])).unwrap(), markers);
    }

    #[test]
    fn paths_are_those_of_the_text() {
        let mut scene =
            json!({ "bodies": [{}, { "repeat": { "i": "1..3" }, "markers": { "P{i}": {} } }, { "x": [1] }] });
        let written = expand(&mut scene, &Parameters::default(), &mut Budget::default()).unwrap();
        let table = [
            ("bodies[0].x", "bodies[0].x"),
            ("bodies[3].markers.P3.y", "bodies[1].markers.P{i}.y"),
            ("bodies[3].markers.P", "bodies[1].markers.P"),
            ("bodies[4].x[0]", "bodies[2].x[0]"),
            ("bodies[40]", "bodies[40]"),
        ];
        for (path, expected) in table {
            let Error::Input(input) = written.place(Error::input("").under(path)) else { unreachable!() };
            assert_eq!(input.path, expected);
        }
    }

    #[test]
    fn mistakes_are_told_where_they_are_written() {
        let table = [
            (json!([{ "repeat": 3 }]), "at bodies[0].repeat: expected an object {...}, found 3"),
            (json!([{ "repeat": { "i": 3 } }]), "at bodies[0].repeat.i: expected a range, found 3"),
            (json!([{ "repeat": { "i": "1..1e300" } }]), "at bodies[0].repeat.i: more than 1000000 copies"),
            (json!([{ "repeat": { "i": "3..1" } }]), "at bodies[0].repeat.i: `3..1` is no range"),
            (json!([{ "repeat": { "i": "1..1e7" } }]), "at bodies[0].repeat.i: more than 1000000 copies"),
            (
                json!([{ "repeat": { "i": "1..1000000" }, "about": "x".repeat(2000) }]),
                "at bodies[0].repeat: the scene grows beyond 64 MB of text",
            ),
            (
                json!([{ "repeat": { "i": "1..1000000" }, "name": "rod" }]),
                "at bodies[0].name: 1000000 copies have the name `rod`",
            ),
            (json!([{ "repeat": { "i": "1..m" } }]), "at bodies[0].repeat.i: unknown name `m`"),
            (json!([{ "repeat": { "n": "1..2" } }]), "at bodies[0].repeat.n: the name `n` is taken"),
            (json!([{ "repeat": { "sin": "1..2" } }]), "at bodies[0].repeat.sin: `sin` cannot name a parameter"),
            (json!([{ "repeat": { "i": "1..2" }, "x": ["{j}"] }]), "at bodies[0].x[0]: unknown name `j`"),
            (json!([{ "repeat": { "i": "1..2" }, "x": "{i" }]), "at bodies[0].x: `{` without `}` in \"{i\""),
            (json!([{ "repeat": { "i": "1..2" }, "x": { "{1/0}": 1 } }]), "at bodies[0].x.{1/0}: `1/0` is infinite"),
        ];
        for (scene, expected) in table {
            let message = expanded(scene).unwrap_err().to_string();
            assert!(message.starts_with(expected), "{message}");
        }
    }
}
