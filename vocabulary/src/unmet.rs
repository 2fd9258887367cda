//! Why a condition does not hold: the first part that fails.
//!
//! Idea: walk the outermost conjuncts in the order of the source, and keep the bindings that satisfy all conjuncts so
//! far. The conjunct that leaves no binding is the reason. If all variables are bound, it is the first false conjunct; if
//! some are free, it is the first that cannot hold together with those before it.

use std::fmt;

use dsr::Snapshot;
use pddl::Span;
use serde::Serialize;

use crate::binding::Binding;
use crate::condition::{Condition, completions, first_span};
use crate::formula::Formula;
use crate::sentence::{Sentence, Speaker};

/// The most bindings that are followed. Beyond that number, an explanation may name a later conjunct.
const FRONTIER: usize = 256;

/// The first part of a condition that fails.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Unmet {
    /// What the graph shows: "person is not with robot".
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
        // Every conjunct can hold, so a parameter that no conjunct mentions has no node of its type.
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
