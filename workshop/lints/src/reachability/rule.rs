//! Datalog rules with side conditions, as conditions and effects are relaxed to.

use std::rc::Rc;

use pddl::Span;
use pddl::model::{
    ActionId, Comparison, Condition, DurativeActionId, EventId, Expression, MethodId, Name, Term,
};

use crate::walk::Polarity;

use super::database::RelationId;
use super::world::Range;

/// What a rule stands for.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Schema {
    /// An instantaneous action.
    Action(ActionId),
    /// A durative action.
    Durative(DurativeActionId),
    /// An axiom, by position.
    Axiom(usize),
    /// An event of PDDL+.
    Event(EventId),
    /// A method.
    Method(MethodId),
    /// A conjunct of the goal, by position.
    Goal(usize),
    /// A subtask of the problem's network, by position.
    Initial(usize),
}

/// Which part of a schema.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Part {
    /// An action, an axiom, a method: all of it.
    Whole,
    /// The start of a durative action.
    Start,
    /// Its end.
    End,
    /// Another outcome of an agent's rule.
    Outcome(Name),
}

/// A rule's origin: a part of a schema, or a conditional effect in it.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Origin {
    /// The schema.
    pub(crate) schema: Schema,
    /// The part.
    pub(crate) part: Part,
    /// The condition of the conditional effect.
    pub(crate) when: Option<Span>,
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
