//! The stages of a goal's life, and why a goal passes from one to the next.

use crate::goal::GoalId;
use crate::outcome::NoPlan;
use pddl::model::Name;

/// A stage of a goal's life.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Life {
    /// Nothing makes it wanted.
    Dormant,
    /// It is to be achieved, and no plan serves it yet.
    Wanted,
    /// A plan serves it, after other goals.
    Selected,
    /// The plan is at the steps that serve it.
    Pursued,
    /// It was pursued, and something else goes first.
    Suspended,
    /// Somebody holds it.
    Held,
    /// It was seen to hold.
    Achieved,
    /// Somebody ended it.
    Dropped,
    /// It was not achieved in time, or it costs more than it is worth.
    GivenUp,
}

impl Life {
    /// Its name in records and in the graph.
    pub fn name(self) -> &'static str {
        match self {
            Self::Dormant => "dormant",
            Self::Wanted => "wanted",
            Self::Selected => "selected",
            Self::Pursued => "pursued",
            Self::Suspended => "suspended",
            Self::Held => "held",
            Self::Achieved => "achieved",
            Self::Dropped => "dropped",
            Self::GivenUp => "given_up",
        }
    }

    /// All stages.
    pub const ALL: [Self; 9] = [
        Self::Dormant,
        Self::Wanted,
        Self::Selected,
        Self::Pursued,
        Self::Suspended,
        Self::Held,
        Self::Achieved,
        Self::Dropped,
        Self::GivenUp,
    ];

    /// Whether it is still to be achieved, now or later.
    pub fn is_open(self) -> bool {
        matches!(self, Self::Held) || self.is_wanted()
    }

    /// Whether a plan should serve it now.
    pub fn is_wanted(self) -> bool {
        matches!(self, Self::Wanted | Self::Selected | Self::Pursued | Self::Suspended)
    }
}

/// Why a goal passes into another stage.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// The mission wants it from the start.
    Mission,
    /// These tokens of the graph.
    Seen(Vec<String>),
    /// What was maintained does not hold any more.
    Lost,
    /// Nobody holds it any more.
    Released,
    /// A plan serves it at once.
    Turn,
    /// A plan serves this goal first.
    After(Name),
    /// No plan serves it together with what goes first.
    NoPlan(Box<NoPlan>),
    /// The time for it is over: so many seconds.
    Late(f64),
    /// A plan without it is cheaper, by its penalty.
    Penalty(f64),
}

/// A goal that passed into another stage.
#[derive(Clone, Debug, PartialEq)]
pub struct GoalChange {
    /// Which goal.
    pub id: GoalId,
    /// Its name.
    pub goal: Name,
    /// Its new stage.
    pub life: Life,
    /// Why.
    pub why: Reason,
}
