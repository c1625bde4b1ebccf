//! The language as a whole: precedence, values, constants and messages.

mod derivatives;
mod enclosures;
mod hostile;
mod random;
mod switches;

use super::*;

/// x, y and t at 0, 1 and 2; k = 4, n = -1; some longer names for "did you mean".
struct Fixture;

impl Names for Fixture {
    fn resolve(&self, name: &str) -> Option<Name> {
        Some(match name {
            "x" => Name::Variable(0),
            "y" => Name::Variable(1),
            "t" => Name::Variable(2),
            "crank.angle'" => Name::Variable(3),
            "k" => Name::Constant(4.0),
            "n" => Name::Constant(-1.0),
            "stiffness" => Name::Constant(7.0),
            _ => return None,
        })
    }
    fn known(&self) -> Vec<String> {
        ["x", "y", "t", "crank.angle'", "k", "n", "stiffness"].map(String::from).to_vec()
    }
}

fn parse(text: &str) -> Expression {
    Expression::parse(text, &Fixture).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn message(text: &str) -> String {
    Expression::parse(text, &Fixture).map(|parsed| panic!("{text} parsed: {parsed:?}")).unwrap_err().to_string()
}

/// The value with x = 3, y = 2, t = 0.5, crank.angle' = 10.
fn value(text: &str) -> f64 {
    parse(text).eval(&[3.0, 2.0, 0.5, 10.0])
}

#[test]
fn precedence() {
    let table = [
        ("-2^2", -4.0),
        ("2^3^2", 512.0),
        ("2^-1", 0.5),
        ("2^-2^2", 0.0625),
        ("(-2)^2", 4.0),
        ("-x^2", -9.0),
        ("2^-1*4", 2.0),
        ("--2", 2.0),
        ("+-+2", -2.0),
        ("1-2-3", -4.0),
        ("1-(2-3)", 2.0),
        ("8/4/2", 1.0),
        ("8/4*2", 4.0),
        ("2+3*4", 14.0),
        ("2*3+4", 10.0),
        ("-2*3", -6.0),
        ("2*-3", -6.0),
        ("2--3", 5.0),
        ("-k", -4.0),
        ("2*x^2", 18.0),
        ("x-y-1", 0.0),
        ("x/y/3", 0.5),
        ("x^y^2", 81.0),
        ("-x^-1*3", -1.0),
        ("1+1 < 3", 1.0),
        ("1 < 1+1", 1.0),
        ("2*3 == 6", 1.0),
        ("1 != 1", 0.0),
        ("2 >= 2", 1.0),
        ("2 <= 1", 0.0),
        ("1 < 2 and 2 < 1", 0.0),
        ("1 or 0 and 0", 1.0),
        ("(1 or 0) and 0", 0.0),
        ("not 0 and 0", 0.0),
        ("not 1 < 0", 1.0),
        ("!1 < 0", 0.0),
        ("!0 && 1", 1.0),
        ("0 || 1", 1.0),
        ("not not 3", 1.0),
        ("x > 2 and not y > 2", 1.0),
        ("!(x > 2) || y == 2", 1.0),
        ("1 + not 0", 2.0),
        (".5 + 1e-3 + 2.5E+4", 25000.501),
        ("  1 +\t2\n", 3.0),
        ("pi", std::f64::consts::PI),
        ("π/pi", 1.0),
        ("10*crank.angle'", 100.0),
        ("2 - x", -1.0),
        ("2 * x", 6.0),
        ("2 / y", 1.0),
        ("x - 2", 1.0),
        ("2 + x", 5.0),
        ("(x)^(y)", 9.0),
        ("k^n", 0.25),
        ("n^k", 1.0),
        ("n^3", -1.0),
        ("0^0", 1.0),
        ("(x-3)^0", 1.0),
        ("4^0.5", 2.0),
        ("(((((((((((x+1)))))))))))", 4.0),
    ];
    table.iter().for_each(|(text, expected)| assert_eq!(value(text), *expected, "{text}"));
}

#[test]
fn functions_of_several_arguments() {
    let table = [
        ("min(x, y)", 2.0),
        ("max(x, y, 7, 5)", 7.0),
        ("min(4, 3, x-5)", -2.0),
        ("hypot(x, 4)", 5.0),
        ("hypot(1, hypot(2, y))", 3.0),
        ("pow(x, 2)", 9.0),
        ("pow(-2, 3)", -8.0),
        ("pow(4, t)", 2.0),
        ("if(x > 2, 10, 20)", 10.0),
        ("if(x > 2 and y > 2, 10, 20)", 20.0),
        ("if(0, 1/0, 5)", 5.0),
        ("if(x < 0, sqrt(-x), 1)", 1.0),
        ("if(k == 4, x, y)", 3.0),
        ("if(k != 4, x, y) + 1", 3.0),
        ("if(1 > 0, x, y)*if(0, x, t)", 1.5),
        ("table(x, 0, 1, 2, 5, 4, 9)", 7.0),
        ("table(-k, 0, n, 1, k)", -1.0),
        ("table(y, -k, 0, n, 1, k*2, 10)", 4.0),
        ("2*table(x, 0,0, 1,1) + table(t, 0,0, 1,10)", 7.0),
        ("log10(1000) + ln(1) + log(exp(2))", 5.0),
        ("sign(-k) + sign(0) + step(0) + step(n)", 0.0),
    ];
    table.iter().for_each(|(text, expected)| assert_eq!(value(text), *expected, "{text}"));
}
#[test]
fn constants_are_folded_and_variables_listed() {
    let constants =
        ["2*k + sin(pi)", "if(k > 3, 1, x)", "table(k, 0,0, 1,1)", "max(1, k, 3)", "-(-(k^n))", "1/0", "not k"];
    for text in constants {
        let parsed = parse(text);
        assert!(parsed.is_constant() && parsed.program.ops.len() == 1, "{text}: {parsed:?}");
    }
    let parsed = parse("y*2*k + if(k > 3, crank.angle', x) - y");
    assert_eq!(parsed.variables().collect::<Vec<_>>(), [(1, "y"), (3, "crank.angle'")]);
    assert!(parsed.depends_on(1) && parsed.depends_on(3) && !parsed.depends_on(0) && !parsed.is_constant());
    assert_eq!(parse("2*pi*k*x").program.ops.len(), 2);
    assert_eq!(Expression::from(0.1).eval::<f64>(&[]), 0.1);
    assert_eq!((parse("2*x").text(), Expression::from(0.1).to_string()), ("2*x", "0.1".to_string()));
}

#[test]
fn the_constant_must_be_finite() {
    let message = |text: &str| parse(text).constant().unwrap_err().to_string();
    assert_eq!(parse("k/2").constant(), Ok(2.0));
    assert_eq!(parse("if(k > 0, 1/k, 0)").constant(), Ok(0.25));
    assert_eq!(message("k/0"), "`k/0` is infinite; expected a finite number");
    assert_eq!(message("ln(0)"), "`ln(0)` is infinite; expected a finite number");
    assert_eq!(message("sqrt(-1)"), "`sqrt(-1)` is not a number; expected a finite number");
    assert_eq!(message("if(0/0, 1, 2)"), "`if(0/0, 1, 2)` is not a number; expected a finite number");
    assert_eq!(message("2*t"), "expected a constant, found `2*t`, which depends on `t`");
}

#[test]
fn messages() {
    let table = [
        ("", "empty expression; expected a number or a formula such as `2*l`"),
        ("  ", "empty expression; expected a number or a formula such as `2*l`"),
        ("2 * stifness", "unknown name `stifness` at character 5; did you mean `stiffness`?"),
        ("ω*Stiffness", "unknown name `ω` at character 1; choose one of x, y, t, crank.angle', k, n, stiffness, pi"),
        ("2*PI", "unknown name `PI` at character 3; did you mean `pi`?"),
        ("e^2", "unknown name `e` at character 1; Euler's number is `exp(1)`"),
        ("sine(x)", "unknown function `sine` at character 1; did you mean `sin`?"),
        ("k(x+1)", "`k` is not a function, at character 1; a product is written `k*(...)`"),
        ("sin x", "expected '(' after the function `sin` at character 4"),
        ("sqrt(1, 2)", "sqrt takes 1 argument, found 2, at character 1"),
        ("1+sin()", "sin takes 1 argument, found 0, at character 3"),
        ("atan2(x)", "atan2 takes 2 arguments, found 1, at character 1; write `atan2(y, x)`"),
        ("min(x)", "min takes 2 or more arguments, found 1, at character 1"),
        ("if(x, y)", "if takes 3 arguments, found 2, at character 1; write `if(condition, a, b)`"),
        (
            "table(x, 0, 1)",
            "table takes x and at least 2 points, found 3, at character 1; write `table(x, x0, y0, x1, y1)`",
        ),
        ("table(x, 0, 1, y, 2)", "points of a table must be constant, at character 16, found a variable"),
        ("table(x, 0, 1, 0, 2)", "x of a table must increase, found 0 after 0, at character 16"),
        ("table(x, 0, 1/0, 1, 2)", "points and slopes of a table must be finite, found otherwise at character 7"),
        ("2*(x + 1", "expected ')' at character 9, found the end"),
        ("(1, 2)", "expected ')' at character 3, found `,`"),
        ("sin(x", "expected ')' at character 6, found the end"),
        ("2*x)", "unmatched ')' at character 4"),
        ("0,5", "unexpected ',' at character 2; decimals are written with a point: `0.5`"),
        ("x +", "expected a value after `+` at character 4, found the end"),
        ("*x", "expected a value at character 1, found `*`"),
        ("max(x,)", "expected a value after `,` at character 7, found `)`"),
        ("2 + * 3", "expected a value after `+` at character 5, found `*`"),
        ("()", "expected a value after `(` at character 2, found `)`"),
        ("2x", "expected an operator at character 2, found `x`; a product is written `*`"),
        ("(2 x)", "expected an operator at character 4, found `x`; a product is written `*`"),
        ("x!", "expected an operator at character 2, found `!`"),
        ("0 < x < 1", "chained comparison at character 7; write `a < b and b < c`"),
        ("x**2", "unexpected `**` at character 2; a power is written `^`"),
        ("α+β'γ", "unknown name `α` at character 1; choose one of x, y, t, crank.angle', k, n, stiffness, pi"),
    ];
    table.iter().for_each(|(text, expected)| assert_eq!(message(text), *expected, "{text}"));
}

#[test]
fn positions_count_characters() {
    let error = Expression::parse("π*π + lenght", &Fixture).unwrap_err();
    assert_eq!((error.position, error.text.as_str()), (Some(7), "π*π + lenght"));
}

/// The page of the language has each function once, with its arguments, and no other.
#[test]
fn the_page_names_every_function() {
    let table = super::LANGUAGE.split("# Functions").nth(1).unwrap().split("\nThe points").next().unwrap();
    let cells = table.lines().filter_map(|line| line.strip_prefix("| `")?.split('|').next());
    let spans = cells.flat_map(|cell| cell.split('`').step_by(2).collect::<Vec<_>>());
    let calls = spans.flat_map(|span| if span.contains('(') { vec![span] } else { span.split(' ').collect() });
    let mut named: Vec<&str> =
        calls.filter_map(|call| call.split('(').next()).filter(|name| !name.is_empty()).collect();
    let mut known: Vec<&str> = super::function::FUNCTIONS.iter().map(|(name, _)| *name).collect();
    named.sort_unstable();
    known.sort_unstable();
    assert_eq!(named.iter().filter(|name| **name != ",").copied().collect::<Vec<_>>(), known);
}
