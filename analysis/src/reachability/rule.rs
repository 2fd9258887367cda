//! Datalog rules with side conditions, as conditions and effects are relaxed to.

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
    /// Which relation.
    pub(crate) relation: RelationId,
    /// Its arguments.
    pub(crate) arguments: Vec<Term>,
    /// Where it stands.
    pub(crate) span: Span,
}

/// A side condition on a binding.
#[derive(Clone, Debug)]
pub(crate) enum Check {
    /// Same object.
    Same(Term, Term),
    /// Different objects.
    Different(Term, Term),
    /// No initial fact; only for what nothing ever deletes.
    Absent(Pattern),
    /// The numbers may compare so.
    Compare(Polarity, Comparison, Rc<(Expression, Expression)>, Span),
    /// A condition that is evaluated when all atoms are joined.
    Residual(Polarity, Rc<Condition>),
}

/// `heads` hold where `body` and `checks` do.
#[derive(Clone, Debug)]
pub(crate) struct Rule {
    /// What it stands for.
    pub(crate) origin: Origin,
    /// What each slot ranges over.
    pub(crate) slots: Rc<[Rc<Range>]>,
    /// How many of the first slots must have an object.
    pub(crate) parameters: usize,
    /// All must hold.
    pub(crate) body: Vec<Pattern>,
    /// All must hold.
    pub(crate) checks: Vec<Check>,
    /// Free slots of each check, in the same order.
    pub(crate) needs: Vec<Vec<usize>>,
    /// What follows.
    pub(crate) heads: Vec<Pattern>,
}
