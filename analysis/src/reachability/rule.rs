//! Datalog rules with side conditions: the relaxed form of conditions and effects.

use std::rc::Rc;

use pddl::Span;
use pddl::model::{Comparison, Condition, Expression, Term};

use crate::happening::{Phase, Schema};
use crate::walk::Polarity;

use super::database::RelationId;
use super::world::Range;

/// A rule's origin: a phase of a schema, or a conditional effect in it.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Origin {
    /// The schema.
    pub schema: Schema,
    /// The phase.
    pub phase: Phase,
    /// The condition of the conditional effect.
    pub when: Option<Span>,
}

/// A relation applied to terms.
#[derive(Clone, Debug)]
pub(crate) struct Pattern {
    /// The relation.
    pub(crate) relation: RelationId,
    /// Its arguments.
    pub(crate) arguments: Vec<Term>,
    /// Its place in the source.
    pub(crate) span: Span,
}

/// A side condition on a binding.
#[derive(Clone, Debug)]
pub(crate) enum Check {
    /// The terms are the same object.
    Same(Term, Term),
    /// The terms are different objects.
    Different(Term, Term),
    /// The atom is not an initial fact. Only for relations whose atoms are never deleted.
    Absent(Pattern),
    /// The comparison may have this result.
    Compare(Polarity, Comparison, Rc<(Expression, Expression)>, Span),
    /// A condition that is evaluated when all atoms are joined.
    Residual(Polarity, Rc<Condition>),
}

/// `heads` hold for every binding that satisfies `body` and `checks`.
#[derive(Clone, Debug)]
pub(crate) struct Rule {
    /// The part of the domain that the rule represents.
    pub(crate) origin: Origin,
    /// The range of each slot.
    pub(crate) slots: Rc<[Rc<Range>]>,
    /// How many of the first slots must have an object.
    pub(crate) parameters: usize,
    /// The atoms that must hold.
    pub(crate) body: Vec<Pattern>,
    /// The checks that must succeed.
    pub(crate) checks: Vec<Check>,
    /// The free slots of each check, in the same order.
    pub(crate) needs: Vec<Vec<usize>>,
    /// The atoms that follow.
    pub(crate) heads: Vec<Pattern>,
}
