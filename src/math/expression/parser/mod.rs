//! Precedence climbing from tokens to a program.

mod messages;

use super::builder::Builder;
use super::error::ExpressionError;
use super::function::{self, ArgumentForm};
use super::lexer::{Token, TokenKind, tokens};
use super::operation::{One, Two};
use super::program::{MAX_STACK, Op, Program};
use super::{Name, Names};
use crate::math::signal::{Beyond, Interpolation, PointsError, Signal};
use std::sync::Arc;

/// Largest depth of nested operations; a parenthesis in a sum counts twice.
const MAX_NESTING: usize = 150;

/// Largest length of an expression, bytes, tables of points included.
const MAX_LENGTH: usize = 1_000_000;

type Result<T> = std::result::Result<T, ExpressionError>;

/// Binding levels of operators. A prefix takes an operand of at least its own level.
mod level {
    pub const LOWEST: u8 = 0;
    pub const OR: u8 = 1;
    pub const AND: u8 = 2;
    pub const NOT: u8 = 3;
    pub const COMPARISON: u8 = 4;
    pub const SUM: u8 = 5;
    pub const PRODUCT: u8 = 6;
    pub const SIGN: u8 = 7;
    pub const POWER: u8 = 8;
}

/// Compiles `text`; returns the program, and indices and names of the variables in the order of first mention.
pub(super) fn parse(text: &str, names: &dyn Names) -> Result<(Program, Vec<(usize, String)>)> {
    if text.len() > MAX_LENGTH {
        return Err(ExpressionError::whole(text, format!("expression longer than {MAX_LENGTH} bytes")));
    }
    let mut parser = Parser::new(text, names)?;
    parser.everything()?;
    let program = parser.builder.finish().ok_or_else(|| {
        let message = format!("expression needs more than {MAX_STACK} intermediate results at once");
        ExpressionError::whole(text, message).hint("take a part of it out into a parameter, or nest it less")
    })?;
    let mut variables = parser.variables;
    variables.retain(|(index, _)| program.ops.contains(&Op::Variable(*index)));
    Ok((program, variables))
}

struct Parser<'a> {
    text: &'a str,
    tokens: Vec<Token>,
    next: usize,
    names: &'a dyn Names,
    builder: Builder,
    nesting: usize,
    variables: Vec<(usize, String)>,
}

/// An argument of a call: its beginning in the program and in the text.
#[derive(Clone, Copy)]
struct Argument {
    operand: usize,
    start: usize,
}

impl<'a> Parser<'a> {
    fn new(text: &'a str, names: &'a dyn Names) -> Result<Self> {
        let tokens = tokens(text)?;
        let builder = Builder::default();
        Ok(Parser { text, tokens, next: 0, names, builder, nesting: 0, variables: Vec::new() })
    }

    fn everything(&mut self) -> Result<()> {
        if self.peek().kind == TokenKind::End {
            let error = ExpressionError::whole(self.text, "empty expression");
            return Err(error.hint("expected a number or a formula such as `2*l`"));
        }
        self.operation(level::LOWEST)?;
        let rest = self.peek();
        match rest.kind {
            TokenKind::End => Ok(()),
            TokenKind::Close => Err(self.error(rest, "unmatched ')'", "")),
            TokenKind::Comma => {
                Err(self.error(rest, "unexpected ','", "").hint("decimals are written with a point: `0.5`"))
            }
            _ => Err(self.missing_operator(rest)),
        }
    }

    /// Parses an operand followed by all operators that bind at least as tightly as `minimum`.
    fn operation(&mut self, minimum: u8) -> Result<()> {
        self.nesting += 1;
        if self.nesting > MAX_NESTING {
            return Err(self.error(self.peek(), format!("nested more than {MAX_NESTING} levels deep"), ""));
        }
        let left = self.builder.here();
        self.operand()?;
        while let Some((two, binding)) = binary(self.peek().kind).filter(|(_, binding)| *binding >= minimum) {
            self.take();
            let right = self.builder.here();
            // A power associates to the right, all others to the left.
            self.operation(if two == Two::Pow { binding } else { binding + 1 })?;
            self.builder.two(two, left, right);
            self.refuse_chain(binding)?;
        }
        self.nesting -= 1;
        Ok(())
    }

    /// Refuses a < b < c, which would compare a truth value with c.
    fn refuse_chain(&self, binding: u8) -> Result<()> {
        let again = binary(self.peek().kind).is_some_and(|(_, next)| next == binding);
        if binding == level::COMPARISON && again {
            let error = self.error(self.peek(), "chained comparison", "");
            return Err(error.hint("write `a < b and b < c`"));
        }
        Ok(())
    }

    fn operand(&mut self) -> Result<()> {
        let token = self.take();
        match token.kind {
            TokenKind::Number(value) => self.builder.push(Op::Constant(value)),
            TokenKind::Name if self.peek().kind == TokenKind::Open => return self.call(token),
            TokenKind::Name => return self.name(token),
            TokenKind::Infix(Two::Add) => return self.operation(level::SIGN),
            TokenKind::Infix(Two::Sub) => return self.prefix(One::Neg, level::SIGN),
            TokenKind::Bang => return self.prefix(One::Not, level::SIGN),
            TokenKind::Not => return self.prefix(One::Not, level::NOT),
            TokenKind::Open => {
                self.operation(level::LOWEST)?;
                return self.close();
            }
            _ => return Err(self.missing_operand(token)),
        }
        Ok(())
    }

    fn prefix(&mut self, function: One, minimum: u8) -> Result<()> {
        let start = self.builder.here();
        self.operation(minimum)?;
        self.builder.one(function, start);
        Ok(())
    }

    fn name(&mut self, token: Token) -> Result<()> {
        let name = self.slice(token);
        if let Some(value) = function::constant(name) {
            self.builder.push(Op::Constant(value));
            return Ok(());
        }
        match self.names.resolve(name) {
            Some(Name::Constant(value)) => self.builder.push(Op::Constant(value)),
            Some(Name::Variable(index)) => self.variable(index, name),
            None => return Err(self.unknown_name(token)),
        }
        Ok(())
    }

    fn variable(&mut self, index: usize, name: &str) {
        self.builder.push(Op::Variable(index));
        if self.variables.iter().all(|(known, _)| *known != index) {
            self.variables.push((index, name.to_string()));
        }
    }

    fn call(&mut self, token: Token) -> Result<()> {
        let name = self.slice(token);
        let signal = self.names.signals().iter().find(|signal| signal.name() == name).cloned();
        let form = signal.map(ArgumentForm::Signal).or_else(|| function::function(name));
        let form = form.ok_or_else(|| self.unknown_function(token))?;
        self.take();
        let arguments = self.arguments()?;
        if !form.takes(arguments.len()) {
            return Err(self.wrong_arity(token, &form, arguments.len()));
        }
        self.close()?;
        self.apply(form, &arguments)
    }

    /// Parses all arguments, up to the closing parenthesis.
    fn arguments(&mut self) -> Result<Vec<Argument>> {
        let mut arguments = Vec::new();
        if self.peek().kind == TokenKind::Close {
            return Ok(arguments);
        }
        loop {
            arguments.push(Argument { operand: self.builder.here(), start: self.peek().start });
            self.operation(level::LOWEST)?;
            match self.peek().kind {
                TokenKind::Comma => self.take(),
                TokenKind::Close => return Ok(arguments),
                _ => return self.close().map(|()| arguments),
            };
        }
    }

    fn apply(&mut self, form: ArgumentForm, arguments: &[Argument]) -> Result<()> {
        match (form, arguments) {
            (ArgumentForm::One(function), [x]) => self.builder.one(function, x.operand),
            (ArgumentForm::Two(function) | ArgumentForm::Many(function), _) => {
                let pairs = arguments.windows(2).rev();
                pairs.for_each(|pair| self.builder.two(function, pair[0].operand, pair[1].operand));
            }
            (ArgumentForm::If, [condition, yes, no]) => self.builder.select(condition.operand, yes.operand, no.operand),
            (ArgumentForm::Signal(signal), [x]) => return self.signal(signal, *x, self.builder.here()),
            (ArgumentForm::Table, [x, points @ ..]) => return self.table(*x, points),
            // `call` has counted the arguments.
            _ => {}
        }
        Ok(())
    }

    fn table(&mut self, x: Argument, arguments: &[Argument]) -> Result<()> {
        let mut values = Vec::with_capacity(arguments.len());
        for (i, argument) in arguments.iter().enumerate() {
            let end = arguments.get(i + 1).map_or(self.builder.here(), |next| next.operand);
            let value = self.builder.constant(argument.operand, end).ok_or_else(|| {
                self.error_at(argument.start, "points of a table must be constant,", ", found a variable")
            })?;
            values.push(value);
        }
        let points: Vec<[f64; 2]> = values.chunks_exact(2).map(|point| [point[0], point[1]]).collect();
        let table = Signal::new("table", &points, Interpolation::Linear, Beyond::Hold);
        let table = table.map_err(|problem| match problem {
            PointsError::NotIncreasing(i) => {
                let order = format!("x of a table must increase, found {} after {},", points[i][0], points[i - 1][0]);
                self.error_at(arguments[2 * i].start, order, "")
            }
            _ => self.error_at(x.start, "points and slopes of a table must be finite, found otherwise", ""),
        })?;
        self.signal(Arc::new(table), x, arguments[0].operand)
    }

    /// Evaluates a signal at the operand before `end`.
    fn signal(&mut self, signal: Arc<Signal>, x: Argument, end: usize) -> Result<()> {
        let undefined = self.builder.constant(x.operand, end).filter(|x| !x.is_nan() && signal.apply(*x).is_nan());
        if let Some(value) = undefined {
            let ([from, to], name) = (signal.range(), signal.name());
            let error = self.error_at(x.start, format!("the signal `{name}` has no value at {value},"), "");
            return Err(error.hint(format!("it goes from {from} to {to}")));
        }
        self.builder.signal(signal, x.operand, end);
        Ok(())
    }

    fn close(&mut self) -> Result<()> {
        let token = self.peek();
        match token.kind {
            TokenKind::Close => {
                self.take();
                Ok(())
            }
            TokenKind::End | TokenKind::Comma => {
                Err(self.error(token, "expected ')'", format!(", found {}", self.show(token))))
            }
            _ => Err(self.missing_operator(token)),
        }
    }

    fn peek(&self) -> Token {
        let end = Token { kind: TokenKind::End, start: self.text.len(), end: self.text.len() };
        self.tokens.get(self.next).copied().unwrap_or(end)
    }

    fn take(&mut self) -> Token {
        let token = self.peek();
        self.next += 1;
        token
    }

    fn slice(&self, token: Token) -> &'a str {
        self.text.get(token.start..token.end).unwrap_or("")
    }
}

/// Operation and binding level of an infix operator.
fn binary(kind: TokenKind) -> Option<(Two, u8)> {
    let TokenKind::Infix(two) = kind else { return None };
    let level = match two {
        Two::Or => level::OR,
        Two::And => level::AND,
        Two::Add | Two::Sub => level::SUM,
        Two::Mul | Two::Div => level::PRODUCT,
        Two::Pow => level::POWER,
        _ => level::COMPARISON,
    };
    Some((two, level))
}
