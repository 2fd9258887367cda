//! Numeric expressions and applications of functions.

use super::{FunctionId, Name, Term};
use crate::Span;

/// A function applied to terms; arity and types fit.
#[derive(Clone, Debug)]
pub struct Application {
    /// Which function.
    pub function: FunctionId,
    /// Its arguments.
    pub arguments: Vec<Term>,
    /// Where it stands.
    pub span: Span,
}

/// Operators of arithmetic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ArithmeticOperator {
    /// `+`
    Add,
    /// `-`, also the unary one with a single operand.
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
}

impl ArithmeticOperator {
    /// As it is written.
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
        }
    }
}

/// A numeric expression with its place.
#[derive(Clone, Debug)]
pub struct Expression {
    /// What it computes.
    pub kind: ExpressionKind,
    /// Where it stands.
    pub span: Span,
}

/// The forms of an expression.
#[derive(Clone, Debug)]
pub enum ExpressionKind {
    /// A literal. Its shortest decimal form is the source's value up to 15 digits.
    Number(f64),
    /// The value of a numeric fluent.
    Fluent(Application),
    /// An operator over one or more operands.
    Arithmetic(ArithmeticOperator, Vec<Expression>),
    /// `?duration` of the durative action around it.
    Duration,
    /// `total-time` in a metric.
    TotalTime,
    /// `(is-violated name)` in a metric: how many instances of preferences of that name are violated.
    IsViolated(Name),
}

impl Expression {
    /// Visits it and every expression in it.
    pub fn each<'e>(&'e self, visit: &mut impl FnMut(&'e Expression)) {
        visit(self);
        if let ExpressionKind::Arithmetic(_, operands) = &self.kind {
            operands.iter().for_each(|operand| operand.each(visit));
        }
    }
}
