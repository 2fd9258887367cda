//! Why a condition does not hold: its first part that fails, as the graph has it.
//!
//! Idea: walk the outermost conjuncts in the order of the source and keep the bindings that satisfied those before;
//! the conjunct that leaves none is the reason. With all variables bound that is the first false conjunct; with some
//! open it is the first that cannot be true together with those before it.

use std::fmt;

use dsr::Snapshot;
use pddl::Span;
use serde::Serialize;

use crate::binding::Binding;
use crate::condition::{Condition, completions, first_span};
use crate::formula::Formula;
use crate::sentence::{Sentence, Speaker};

/// The bindings that are followed at most; beyond, an explanation may name a later conjunct.
const FRONTIER: usize = 256;

/// The first part of a condition that fails.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Unmet {
    /// What the graph shows instead: "person is not with robot".
    pub sentence: Sentence,
    /// What the condition asks for: "person is with robot".
    pub wanted: Sentence,
    /// Where the condition asks for it.
    pub span: Span,
}

impl fmt::Display for Unmet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.sentence.fmt(f)
    }
}

impl Condition {
    /// The first part that fails; `None` if it holds.
    pub fn why_not(&self, snapshot: &Snapshot, binding: &Binding) -> Option<Unmet> {
        if self.holds(snapshot, binding) { None } else { Some(Unmet::find(self, snapshot, binding)) }
    }
}

impl Unmet {
    /// For a condition that does not hold.
    fn find(condition: &Condition, snapshot: &Snapshot, binding: &Binding) -> Self {
        let mut frontier = vec![binding.clone()];
        for part in &condition.parts {
            let mut next: Vec<Binding> = Vec::new();
            for bound in &frontier {
                if next.len() < FRONTIER {
                    next.extend(completions(&part.alternatives, snapshot, bound));
                }
            }
            if next.is_empty() {
                return Self::of(condition, &part.formula, snapshot, &frontier[0]);
            }
            frontier = next;
            frontier.truncate(FRONTIER);
        }
        // A parameter that no conjunct mentions has no node to stand for.
        let all = Formula::All(condition.parts.iter().map(|part| part.formula.clone()).collect());
        Self::of(condition, &all, snapshot, binding)
    }

    fn of(condition: &Condition, wanted: &Formula, snapshot: &Snapshot, binding: &Binding) -> Self {
        let name_of = |variable| snapshot.name(binding.node(variable)?).map(str::to_owned);
        let speaker =
            Speaker { vocabulary: &condition.vocabulary, scope: &condition.scope, name_of: &name_of };
        Self {
            sentence: speaker.say(&wanted.clone().negated()),
            wanted: speaker.say(wanted),
            span: first_span(wanted),
        }
    }
}
