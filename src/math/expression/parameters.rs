//! The parameters of a scene: numbers by name, given in any order as numbers or in terms of one another.

use super::error::excerpt;
use super::{ExpressionError, Name, Names, Number, function, lexer};
use crate::error::{Error, suggest};
use crate::math::signal::Signal;
use std::collections::HashMap;
use std::fmt;
use std::sync::Arc;

/// Values of all parameters, in the order of the scene, and the signals beside them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parameters {
    values: Vec<(String, f64)>,
    index: HashMap<String, usize>,
    signals: Vec<Arc<Signal>>,
}

/// Origin of a parameter's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterSource {
    /// In the scene's `parameters`.
    Scene,
    /// By an override, `--set` on the command line.
    Override,
}

/// A parameter that cannot be used, with the reason.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterError {
    /// Name of the parameter.
    pub name: String,
    /// Scene or override that its value comes from.
    pub source: ParameterSource,
    /// Reason why it cannot be evaluated.
    pub problem: ExpressionError,
}

type ParameterResult<T> = std::result::Result<T, ParameterError>;

impl Parameters {
    /// Evaluates the parameters `given`, with `overrides`, numbers or expressions over the other parameters, in place
    /// of their values; the last of several overrides of one parameter counts.
    ///
    /// # Errors
    ///
    /// For names that are no plain names (a letter, then letters, digits and `_`), that are reserved
    /// (functions, `pi`, `t`, `and`, `or`, `not`) or come twice; for overrides of unknown parameters; for parameters
    /// that depend on themselves, with the cycle; for expressions that cannot be parsed and values that are not finite.
    pub fn resolve(given: &[(String, Number)], overrides: &[(String, Number)]) -> ParameterResult<Self> {
        let mut parameters = Parameters::named(given)?;
        let mut numbers: Vec<Number> = given.iter().map(|(_, number)| number.clone()).collect();
        let mut sources = vec![ParameterSource::Scene; given.len()];
        for (name, number) in overrides {
            let i = *parameters.index.get(name).ok_or_else(|| parameters.unknown(name))?;
            (numbers[i], sources[i]) = (number.clone(), ParameterSource::Override);
        }
        for i in parameters.order(&numbers, &sources)? {
            let value = numbers[i].evaluate(&parameters);
            parameters.values[i].1 = value.map_err(|problem| fault(&given[i].0, sources[i], problem))?;
        }
        Ok(parameters)
    }

    /// The value of parameter `name`.
    pub fn get(&self, name: &str) -> Option<f64> {
        self.index.get(name).map(|i| self.values[*i].1)
    }

    /// Names and values in the order of the scene.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&str, f64)> {
        self.values.iter().map(|(name, value)| (name.as_str(), *value))
    }

    /// Adds a signal, which expressions may then call by its name.
    ///
    /// # Errors
    /// A name that expressions use themselves, or that is one of a parameter or another signal.
    #[doc(hidden)]
    pub fn add_signal(&mut self, signal: Signal) -> std::result::Result<(), ExpressionError> {
        let name = signal.name();
        let taken = match () {
            _ if function::is_reserved(name) => "expressions use it themselves",
            _ if self.get(name).is_some() => "it is the name of a parameter",
            _ if self.signals.iter().any(|known| known.name() == name) => "it is the name of another signal",
            _ => {
                self.signals.push(Arc::new(signal));
                return Ok(());
            }
        };
        let error = ExpressionError::whole(name, format!("`{}` cannot name a signal: {taken}", excerpt(name)));
        Err(error.hint(format!("choose another name, such as `{}_1`", excerpt(name))))
    }

    /// The signals, in the order of the scene.
    #[doc(hidden)]
    pub fn signals(&self) -> &[Arc<Signal>] {
        &self.signals
    }

    /// The names, with no values yet.
    fn named(given: &[(String, Number)]) -> ParameterResult<Self> {
        let mut parameters = Parameters::default();
        for (i, (name, _)) in given.iter().enumerate() {
            check_name(name)?;
            if parameters.index.insert(name.clone(), i).is_some() {
                return Err(bad_name(
                    name,
                    format!("parameter `{}` is given twice", excerpt(name)),
                    "keep one of them",
                ));
            }
            parameters.values.push((name.clone(), f64::NAN));
        }
        Ok(parameters)
    }

    /// Indices of the parameters such that each comes after those it depends on; otherwise in the order of the scene.
    fn order(&self, numbers: &[Number], sources: &[ParameterSource]) -> ParameterResult<Vec<usize>> {
        let needs =
            (0..numbers.len()).map(|i| self.needs(i, &numbers[i], sources[i])).collect::<ParameterResult<Vec<_>>>()?;
        let mut users = vec![Vec::new(); numbers.len()];
        needs.iter().enumerate().for_each(|(i, needed)| needed.iter().for_each(|n| users[*n].push(i)));
        let mut open: Vec<usize> = needs.iter().map(Vec::len).collect();
        let mut order: Vec<usize> = (0..numbers.len()).filter(|i| open[*i] == 0).collect();
        let mut done = 0;
        while let Some(&i) = order.get(done) {
            done += 1;
            for &user in &users[i] {
                open[user] -= 1;
                if open[user] == 0 {
                    order.push(user);
                }
            }
        }
        if order.len() == numbers.len() { Ok(order) } else { Err(self.cycle(numbers, sources, &needs, &open)) }
    }

    /// Indices of the parameters that number `i` depends on.
    fn needs(&self, i: usize, number: &Number, source: ParameterSource) -> ParameterResult<Vec<usize>> {
        let Number::Text(text) = number else { return Ok(Vec::new()) };
        let names = lexer::names(text).map_err(|problem| fault(&self.values[i].0, source, problem))?;
        let mut needs: Vec<usize> = names.iter().filter_map(|name| self.index.get(*name).copied()).collect();
        needs.sort_unstable();
        needs.dedup();
        Ok(needs)
    }

    /// Error with a cycle among the unresolved parameters, each of which depends on another one.
    fn cycle(
        &self,
        numbers: &[Number],
        sources: &[ParameterSource],
        needs: &[Vec<usize>],
        open: &[usize],
    ) -> ParameterError {
        let follow = |i: &usize| needs[*i].iter().copied().find(|n| open[*n] > 0);
        let start = open.iter().position(|count| *count > 0);
        // After as many steps as there are parameters, the walk is on the cycle.
        let inside = std::iter::successors(start, follow).nth(open.len()).unwrap_or(0);
        let mut path: Vec<usize> =
            std::iter::successors(follow(&inside), follow).take_while(|i| *i != inside).collect();
        path.insert(0, inside);
        let first = (0..path.len()).min_by_key(|k| path[*k]).unwrap_or(0);
        path.rotate_left(first);
        path.push(path[0]);
        let shown: Vec<&str> = path.iter().map(|i| self.values[*i].0.as_str()).collect();
        let message = format!("parameters depend on each other in a circle: {}", chain(&shown));
        let problem = ExpressionError::whole(&numbers[path[0]].to_string(), message);
        let is_set = |i: &&usize| sources[**i] == ParameterSource::Override;
        let guilty = *path.iter().find(is_set).unwrap_or(&path[0]);
        fault(&self.values[guilty].0, sources[guilty], problem.hint("give one of them as a number"))
    }

    fn unknown(&self, name: &str) -> ParameterError {
        let problem = ExpressionError::whole(name, format!("unknown parameter `{}`", excerpt(name)));
        let known = self.values.iter().map(|(known, _)| known.as_str());
        fault(name, ParameterSource::Override, problem.hint(suggest(name, known)))
    }
}

/// The value of a text without parameters, such as `2.5` or `pi/2`.
pub fn constant(text: &str) -> Option<f64> {
    let evaluated = || Number::from(text).evaluate(&Parameters::default()).ok();
    text.trim().parse().ok().or_else(evaluated)
}

/// Text `a -> b -> a` of a cycle, without the middle of a long one.
fn chain(names: &[&str]) -> String {
    match names {
        [first @ .., last] if names.len() > 12 => format!("{} -> ... -> {last}", first[..10].join(" -> ")),
        _ => names.join(" -> "),
    }
}

fn check_name(name: &str) -> ParameterResult<()> {
    let shown = excerpt(name);
    if !lexer::is_plain_name(name) {
        let hint = "expected a letter, then letters, digits and `_`";
        return Err(bad_name(name, format!("`{shown}` cannot name a parameter"), hint));
    }
    if function::is_reserved(name) {
        let message = format!("`{shown}` cannot name a parameter: expressions use it themselves");
        return Err(bad_name(name, message, &format!("choose another name, such as `{shown}_1`")));
    }
    Ok(())
}

fn bad_name(name: &str, message: String, hint: &str) -> ParameterError {
    fault(name, ParameterSource::Scene, ExpressionError::whole(name, message).hint(hint))
}

fn fault(name: &str, source: ParameterSource, problem: ExpressionError) -> ParameterError {
    ParameterError { name: name.to_string(), source, problem }
}

impl Names for Parameters {
    fn resolve(&self, name: &str) -> Option<Name> {
        self.get(name).map(Name::Constant)
    }
    fn known(&self) -> Vec<String> {
        self.values.iter().map(|(name, _)| name.clone()).collect()
    }
    fn signals(&self) -> &[Arc<Signal>] {
        &self.signals
    }
}

impl fmt::Display for ParameterError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "parameter `{}`: {}", excerpt(&self.name), self.problem)
    }
}

impl std::error::Error for ParameterError {}

/// Bad input at `parameters.NAME`, or at `--set`.
impl From<ParameterError> for Error {
    fn from(ParameterError { name, source, problem }: ParameterError) -> Self {
        match source {
            ParameterSource::Scene => Error::from(problem).under(excerpt(&name)).under("parameters"),
            ParameterSource::Override => Error::from(problem).element(excerpt(&name)).under("--set"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Given<'a> = &'a [(&'a str, &'a str)];
    type Set<'a> = &'a [(&'a str, f64)];

    fn resolve(given: Given, overrides: Set) -> ParameterResult<Parameters> {
        let number = |text: &str| text.parse::<f64>().map_or_else(|_| Number::from(text), Number::Value);
        let given: Vec<_> = given.iter().map(|(name, text)| (name.to_string(), number(text))).collect();
        let overrides: Vec<_> =
            overrides.iter().map(|(name, value)| (name.to_string(), Number::Value(*value))).collect();
        Parameters::resolve(&given, &overrides)
    }

    #[test]
    fn overrides_are_expressions_like_any_other() {
        let given: Vec<(String, Number)> =
            [("l", 2.0), ("m", 3.0)].map(|(name, x)| (name.to_string(), x.into())).to_vec();
        let with = |text: &str| Parameters::resolve(&given, &[("l".to_string(), Number::from(text))]);
        assert_eq!(with("2*m").unwrap().get("l"), Some(6.0));
        assert_eq!(with("pi/2").unwrap().get("l"), Some(std::f64::consts::FRAC_PI_2));
        for wrong in ["l/2", "q", "2*"] {
            assert_eq!(with(wrong).unwrap_err().source, ParameterSource::Override, "{wrong}");
        }
    }

    fn message(given: Given, overrides: Set) -> String {
        resolve(given, overrides).unwrap_err().to_string()
    }

    #[test]
    fn parameters_may_come_in_any_order() {
        let given = [("l0", "sqrt(2)*l"), ("area", "pi*r^2"), ("l", "2*r"), ("r", "0.5"), ("n", "(-2)^m"), ("m", "3")];
        let parameters = resolve(&given, &[]).unwrap();
        let expected = [
            ("l0", 2f64.sqrt()),
            ("area", std::f64::consts::PI / 4.0),
            ("l", 1.0),
            ("r", 0.5),
            ("n", -8.0),
            ("m", 3.0),
        ];
        assert_eq!(parameters.iter().collect::<Vec<_>>(), expected);
        assert_eq!((parameters.get("l"), parameters.get("x")), (Some(1.0), None));
    }

    #[test]
    fn overrides_replace_before_anything_is_evaluated() {
        let given = [("a", "b + 1"), ("b", "2*c"), ("c", "1")];
        assert_eq!(resolve(&given, &[("c", 3.0)]).unwrap().get("a"), Some(7.0));
        assert_eq!(resolve(&given, &[("b", 5.0), ("b", 6.0)]).unwrap().get("a"), Some(7.0));
        assert_eq!(resolve(&[("a", "b"), ("b", "a")], &[("b", 2.0)]).unwrap().get("a"), Some(2.0));
    }

    #[test]
    fn bad_parameters_are_told() {
        let stiff = [("stiffness", "1"), ("mass", "2*stifness")];
        let table: [(Given, Set, &str); 11] = [
            (&stiff, &[], "parameter `mass`: unknown name `stifness` at character 3; did you mean `stiffness`?"),
            (&[("mass", "1")], &[("mas", 2.0)], "parameter `mas`: unknown parameter `mas`; did you mean `mass`?"),
            (&[], &[("k", 2.0)], "parameter `k`: unknown parameter `k`; there are none to choose from"),
            (&[("k", "1")], &[("k", f64::INFINITY)], "parameter `k`: `inf` is infinite; expected a finite number"),
            (&[("a", "1/0")], &[], "parameter `a`: `1/0` is infinite; expected a finite number"),
            (&[("a", "1"), ("a", "2")], &[], "parameter `a`: parameter `a` is given twice; keep one of them"),
            (
                &[("sin", "1")],
                &[],
                "parameter `sin`: `sin` cannot name a parameter: expressions use it themselves; \
                 choose another name, such as `sin_1`",
            ),
            (
                &[("t", "1")],
                &[],
                "parameter `t`: `t` cannot name a parameter: expressions use it themselves; \
                 choose another name, such as `t_1`",
            ),
            (
                &[("a.b", "1")],
                &[],
                "parameter `a.b`: `a.b` cannot name a parameter; expected a letter, then letters, digits and `_`",
            ),
            (&[("a", "2 $ b")], &[], "parameter `a`: unexpected `$` at character 3"),
            (&[("a", "2*")], &[], "parameter `a`: expected a value after `*` at character 3, found the end"),
        ];
        table.iter().for_each(|(given, overrides, expected)| assert_eq!(message(given, overrides), *expected));
    }

    #[test]
    fn cycles_are_shown() {
        let tail = "; give one of them as a number";
        let circle = "parameters depend on each other in a circle: ";
        let given = [("lead", "b"), ("a", "b"), ("b", "c+1"), ("c", "2*a"), ("d", "1")];
        assert_eq!(message(&given, &[]), format!("parameter `a`: {circle}a -> b -> c -> a{tail}"));
        assert_eq!(message(&[("a", "a")], &[]), format!("parameter `a`: {circle}a -> a{tail}"));
        let many: Vec<(String, Number)> =
            (0..50_000).map(|i| (format!("p{i}"), Number::Text(format!("p{}", (i + 1) % 50_000)))).collect();
        let long = Parameters::resolve(&many, &[]).unwrap_err().to_string();
        assert!(long.contains("p0 -> p1 -> p2") && long.contains("p9 -> ... -> p0"), "{long}");
    }

    #[test]
    fn errors_carry_the_path() {
        let error = |given, overrides| Error::from(resolve(given, overrides).unwrap_err()).to_string();
        assert_eq!(
            error(&[("a", "1+bb"), ("b", "1")], &[]),
            "at parameters.a: unknown name `bb` at character 3 in \"1+bb\"\n  help: did you mean `b`?"
        );
        assert_eq!(
            error(&[("mass", "1")], &[("mas", 2.0)]),
            "at set (`mas`): unknown parameter `mas`\n  help: did you mean `mass`?"
        );
    }
}
