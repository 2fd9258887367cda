//! An invariant, compiled: conditions on one state below temporal operators, numbered.
//!
//! Idea: three operators are enough for PDDL3. `always-within T A B` is "at every moment: not A, or B within T";
//! `sometime-after A B` is the same without a limit; `hold-during` is `always` in a window. The connectives of conditions
//! are taken apart as well, so that the conditions on one state that remain are mostly single tokens, which invariants
//! share.

use dsr::{Pattern, TypeId};
use pddl::model::{Name, VariableId, Word};
use smallvec::SmallVec;
use std::sync::Arc;

/// A part of a formula, as a position in [`Formula::parts`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct PartId(pub(crate) u32);

/// A condition on one state, as a position in [`Invariants::conditions`](crate::Invariants).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct ConditionId(pub(crate) u32);

/// Nanoseconds.
pub(crate) type Span = u64;

/// A part of an invariant.
#[derive(Debug, Clone)]
pub(crate) enum Part {
    /// A condition on one state, with the variables for its own.
    Holds { condition: ConditionId, arguments: SmallVec<[VariableId; 4]> },
    /// All of them.
    All(Vec<PartId>),
    /// One of them.
    Any(Vec<PartId>),
    /// Negation.
    Not(PartId),
    /// For every node for these variables.
    Every(Vec<VariableId>, PartId),
    /// For some nodes for these variables.
    Some(Vec<VariableId>, PartId),
    /// In the last state.
    AtEnd(PartId),
    /// At every moment; or at every moment of a window, which opens after a time and may close.
    Globally { from: Option<Span>, until: Option<Span>, part: PartId },
    /// At some moment, within a time if there is a limit.
    Finally { within: Option<Span>, part: PartId },
    /// In one unbroken series of states, or never.
    AtMostOnce(PartId),
    /// The second in a state before each with the first.
    Before(PartId, PartId),
}

/// A condition on one state.
#[derive(Debug, Clone)]
pub(crate) struct Condition {
    /// It holds for the first nodes of each match of each of these; all have its variables first, in the same order.
    pub(crate) patterns: Vec<Arc<Pattern>>,
    /// How many variables it has. Further ones of a pattern are quantified.
    pub(crate) variables: usize,
}

/// One invariant.
#[derive(Debug, Clone)]
pub(crate) struct Formula {
    pub(crate) name: Name,
    pub(crate) says: Vec<Word>,
    /// The name of each variable, and the types of the nodes that it stands for.
    pub(crate) variables: Vec<(Name, Vec<TypeId>)>,
    /// How many of the variables are parameters: the first ones.
    pub(crate) parameters: usize,
    /// If the formula says nothing about a binding until a condition holds for it: that condition, with the parameters
    /// for its variables. Only bindings for which it has held have instances.
    pub(crate) trigger: Option<ConditionId>,
    pub(crate) parts: Vec<Part>,
    pub(crate) root: PartId,
    /// The conditions that occur, each with the variables for its own.
    pub(crate) uses: Vec<(ConditionId, SmallVec<[VariableId; 4]>)>,
}

impl Formula {
    pub(crate) fn part(&self, id: PartId) -> &Part {
        &self.parts[id.0 as usize]
    }
}
