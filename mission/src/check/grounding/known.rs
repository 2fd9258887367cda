//! What is known of facts: those that may hold, with some of a rule's own, and those that hold for ever.

use super::classes::Classes;
use super::facts::{Fact, Facts};

/// The facts of a moment of a run that any run may reach.
pub(in crate::check) struct Known<'a> {
    pub(super) classes: &'a Classes,
    /// Everything that may hold at any time.
    pub(super) facts: &'a Facts,
    /// What holds besides: what the rule itself has just written.
    pub(super) own: Option<&'a Facts>,
    /// The facts that hold at the start.
    pub(super) initial: &'a Facts,
}

impl Known<'_> {
    /// Whether a fact may have the truth value `wanted`.
    pub(in crate::check) fn may(&self, fact: &Fact, wanted: bool) -> bool {
        if wanted {
            return self.facts.may_hold(fact) || self.own.is_some_and(|own| own.may_hold(fact));
        }
        !self.is_permanent(fact)
    }

    /// Whether the fact holds at the start, of single nodes, and nothing ever takes it away.
    fn is_permanent(&self, fact: &Fact) -> bool {
        self.initial.may_hold(fact)
            && !self.facts.may_cease(fact)
            && fact.arguments.iter().all(|&class| self.classes.is_single(class))
    }
}
