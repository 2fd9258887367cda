//! Conditions: preconditions, goals, bodies of axioms, guards of methods.

use super::{Application, Expression, PredicateId, Term, TypeSet, VariableId};
use crate::Span;

/// A predicate applied to terms; arity and types fit.
#[derive(Clone, Debug)]
pub struct Atom {
    /// Which predicate.
    pub predicate: PredicateId,
    /// Its arguments.
    pub arguments: Vec<Term>,
    /// The whole list in the source.
    pub span: Span,
}

/// How two numbers are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Comparison {
    /// `<`
    Less,
    /// `<=`
    LessEqual,
    /// `=`
    Equal,
    /// `>=`
    GreaterEqual,
    /// `>`
    Greater,
}

impl Comparison {
    /// As it is written.
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Less => "<",
            Self::LessEqual => "<=",
            Self::Equal => "=",
            Self::GreaterEqual => ">=",
            Self::Greater => ">",
        }
    }
}

/// A condition with its place.
#[derive(Clone, Debug)]
pub struct Condition {
    /// Its form.
    pub kind: ConditionKind,
    /// Where it stands.
    pub span: Span,
}

/// The forms of a condition.
#[derive(Clone, Debug)]
pub enum ConditionKind {
    /// Conjunction; empty is true.
    And(Vec<Condition>),
    /// Disjunction; empty is false.
    Or(Vec<Condition>),
    /// Negation.
    Not(Box<Condition>),
    /// Implication.
    Imply(Box<Condition>, Box<Condition>),
    /// Some binding of these slots.
    Exists(Vec<VariableId>, Box<Condition>),
    /// Every binding of these slots.
    Forall(Vec<VariableId>, Box<Condition>),
    /// A predicate holds.
    Atom(Atom),
    /// An object is of one of these types: `(truck ?x)`, `(sortof ?x - truck)`.
    HasType(Term, TypeSet),
    /// Two terms are the same object.
    Same(Term, Term),
    /// Two numbers compare.
    Compare(Comparison, Box<Expression>, Box<Expression>),
    /// An object fluent has this value.
    FluentIs(Application, Term),
}

impl Condition {
    /// The condition that always holds.
    pub fn always(span: Span) -> Self {
        Self { kind: ConditionKind::And(Vec::new()), span }
    }

    /// The conditions directly inside it, in order.
    pub fn parts(&self) -> impl Iterator<Item = &Self> {
        let (list, first, second) = match &self.kind {
            ConditionKind::And(parts) | ConditionKind::Or(parts) => (parts.as_slice(), None, None),
            ConditionKind::Not(part) | ConditionKind::Exists(_, part) | ConditionKind::Forall(_, part) => {
                (&[][..], Some(&**part), None)
            }
            ConditionKind::Imply(if_, then) => (&[][..], Some(&**if_), Some(&**then)),
            ConditionKind::Atom(_)
            | ConditionKind::HasType(..)
            | ConditionKind::Same(..)
            | ConditionKind::Compare(..)
            | ConditionKind::FluentIs(..) => (&[][..], None, None),
        };
        list.iter().chain(first).chain(second)
    }

    /// Visits it and every condition in it.
    pub fn each<'c>(&'c self, visit: &mut impl FnMut(&'c Condition)) {
        visit(self);
        self.parts().for_each(|part| part.each(visit));
    }

    /// Whether it is the empty conjunction.
    pub fn is_always(&self) -> bool {
        matches!(&self.kind, ConditionKind::And(parts) if parts.is_empty())
    }
}
