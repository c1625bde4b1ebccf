//! Random formulas against a plain evaluator that walks their tree.

use super::parse;

/// A formula as a tree.
enum Tree {
    Number(f64),
    X,
    Y,
    Minus(Box<Tree>),
    Of(&'static str, One, Box<Tree>),
    Two(&'static str, Two, Box<Tree>, Box<Tree>),
    If(Box<Tree>, Box<Tree>, Box<Tree>),
}

type One = fn(f64) -> f64;
type Two = fn(f64, f64) -> f64;

const FUNCTIONS: [(&str, One); 6] = [
    ("sin", f64::sin),
    ("cos", f64::cos),
    ("exp", f64::exp),
    ("abs", f64::abs),
    ("tanh", f64::tanh),
    ("atan", f64::atan),
];
const OPERATORS: [(&str, Two); 5] =
    [("+", |a, b| a + b), ("-", |a, b| a - b), ("*", |a, b| a * b), ("/", |a, b| a / b), ("^", |a, b| a.powf(b))];

/// The numbers of a linear congruential sequence (Knuth's MMIX).
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((self.0 >> 33) % n as u64) as usize
    }
}

impl Tree {
    fn grow(random: &mut Random, depth: usize) -> Tree {
        let mut next = || Box::new(Tree::grow(random, depth - 1));
        if depth == 0 {
            return match random.below(3) {
                0 => Tree::Number(random.below(40) as f64 / 8.0),
                1 => Tree::X,
                _ => Tree::Y,
            };
        }
        let a = next();
        let b = next();
        let c = next();
        match random.below(8) {
            0 => Tree::Minus(a),
            1 | 2 => {
                let (name, function) = FUNCTIONS[random.below(FUNCTIONS.len())];
                Tree::Of(name, function, a)
            }
            3 => Tree::If(a, b, c),
            _ => {
                let (name, operator) = OPERATORS[random.below(OPERATORS.len())];
                Tree::Two(name, operator, a, b)
            }
        }
    }

    fn value(&self, x: f64, y: f64) -> f64 {
        match self {
            Tree::Number(value) => *value,
            Tree::X => x,
            Tree::Y => y,
            Tree::Minus(a) => -a.value(x, y),
            Tree::Of(_, function, a) => function(a.value(x, y)),
            // The language takes powers of numbers below zero only where a whole exponent is constant.
            Tree::Two("^", ..) if self.is_power_below_zero(x, y) => f64::NAN,
            // Unlike `powf`, which takes NaN^0 for 1.
            Tree::Two(_, _, a, b) if a.value(x, y).is_nan() || b.value(x, y).is_nan() => f64::NAN,
            Tree::Two(_, operator, a, b) => operator(a.value(x, y), b.value(x, y)),
            Tree::If(a, ..) if a.value(x, y).is_nan() => f64::NAN,
            Tree::If(a, b, c) => {
                if a.value(x, y) > 0.5 {
                    b.value(x, y)
                } else {
                    c.value(x, y)
                }
            }
        }
    }

    fn is_power_below_zero(&self, x: f64, y: f64) -> bool {
        matches!(self, Tree::Two("^", _, a, b) if a.value(x, y) < 0.0 && !matches!(**b, Tree::Number(_)))
    }

    fn text(&self) -> String {
        match self {
            Tree::Number(value) => format!("{value}"),
            Tree::X => "x".to_string(),
            Tree::Y => "y".to_string(),
            Tree::Minus(a) => format!("(-{})", a.text()),
            Tree::Of(name, _, a) => format!("{name}({})", a.text()),
            Tree::Two(name, _, a, b) => format!("({} {name} {})", a.text(), b.text()),
            Tree::If(a, b, c) => format!("if({} > 0.5, {}, {})", a.text(), b.text(), c.text()),
        }
    }
}

/// Values agree to round-off; powers of whole numbers may be products, which differ from `powf` by some units in the
/// last place, and conditions at their threshold are left out with the rest that is not finite.
#[test]
fn formulas_have_the_values_of_their_trees() {
    let mut random = Random(1);
    let mut compared = 0;
    for number in 0..4000 {
        let tree = Tree::grow(&mut random, 1 + number % 4);
        let text = tree.text();
        let x = random.below(64) as f64 / 16.0 - 1.96875;
        let y = random.below(64) as f64 / 16.0 - 1.03125;
        let expected = tree.value(x, y);
        let found = parse(&text).eval(&[x, y, 0.0, 0.0]);
        if expected.is_finite() && expected.abs() < 1e100 {
            let error = (found - expected).abs() / expected.abs().max(1.0);
            assert!(error < 1e-9, "{text} at {x}, {y}: {found}, expected {expected}");
            compared += 1;
        }
    }
    assert!(compared > 3000, "{compared}");
}
