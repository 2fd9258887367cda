//! An explanation of why there is no plan.

use super::reasons::{Reason, ReasonId};
use super::space::Space;
use analysis::intervals::NeverCompares;
use pddl::Span;

/// Parts of the goal, groups and pairs that are reported.
pub(super) const MOST: usize = 32;

/// A part of the goal that no reachable state satisfies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Where it stands in the problem.
    pub span: Span,
    /// It would take one of these, and none of them is ever so.
    pub never: Vec<Never>,
}

/// What is never so.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Never {
    /// A literal.
    Literal(ReasonId),
    /// A comparison of numbers.
    Number(NeverCompares),
    /// What no action has any influence on.
    Condition(Span),
}

/// Two atoms of the goal of which at most one ever holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exclusive {
    /// The two, as PDDL writes them.
    pub pair: [String; 2],
    /// A group of which at most one holds, both included.
    pub group: Vec<String>,
}

/// Why there is no plan.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Explanation {
    /// Every part of the goal that is never so by itself.
    pub parts: Vec<Part>,
    /// The reasons of literals, each once; [`ReasonId`] is the position.
    pub reasons: Vec<Reason>,
    /// Pairs of the goal that exclude each other.
    pub exclusive: Vec<Exclusive>,
    /// What a visit of the states showed, where that was the proof.
    pub space: Option<Space>,
}

impl Explanation {
    /// A reason.
    pub fn reason(&self, id: ReasonId) -> &Reason {
        &self.reasons[id.0 as usize]
    }
}
