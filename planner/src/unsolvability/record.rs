//! An explanation of why there is no plan.

use super::reasons::{Reason, ReasonId};
use super::space::Space;
use analysis::intervals::NeverCompares;
use pddl::Span;

/// The most parts of the goal, and the most pairs, that are reported.
pub(super) const MOST: usize = 32;

/// A part of the goal that no reachable state satisfies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Its place in the problem.
    pub span: Span,
    /// The part needs one of these, and none of them ever holds.
    pub never: Vec<Never>,
}

/// Something that never holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Never {
    /// A literal.
    Literal(ReasonId),
    /// A comparison of numbers.
    Number(NeverCompares),
    /// A condition that no action can influence.
    Condition(Span),
}

/// Two atoms of the goal of which at most one ever holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exclusive {
    /// The two atoms in PDDL.
    pub pair: [String; 2],
    /// The mutex group that contains both: at most one of its atoms holds at a time.
    pub group: Vec<String>,
}

/// Why there is no plan.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Explanation {
    /// Every part of the goal that never holds by itself.
    pub parts: Vec<Part>,
    /// The reasons of literals, each once. A [`ReasonId`] is a position in this list.
    pub reasons: Vec<Reason>,
    /// Pairs of the goal that exclude each other.
    pub exclusive: Vec<Exclusive>,
    /// The result of visiting the states, if that was the proof.
    pub space: Option<Space>,
}

impl Explanation {
    /// The reason with this id.
    pub fn reason(&self, id: ReasonId) -> &Reason {
        &self.reasons[id.0 as usize]
    }
}
