//! For which bindings the conditions before the rules hold, as the graph reports their matches.
//!
//! Invariant: after the news of a version these are the bindings that matching the conditions in that version gives.

use std::collections::BTreeMap;

use dsr::Changed;

use crate::rules::{Agent, Concern, Parameters, RuleId};

/// Each binding with the number of matches that give it: one for each alternative of the condition and for each choice
/// of nodes for what the condition quantifies.
#[derive(Debug, Default)]
pub(super) struct Matching(BTreeMap<RuleId, BTreeMap<Parameters, usize>>);

impl Matching {
    /// Takes in how the matches of one pattern changed, which is an alternative of a rule's condition.
    pub(super) fn update(&mut self, agent: &Agent, changed: &Changed) {
        let Concern::Start { rule, alternative } = agent.concern(changed.pattern) else { return };
        let parameters = |matched| agent.rule(rule).parameters(alternative, matched);
        let counts = self.0.entry(rule).or_default();
        for parameters in changed.appeared.iter().filter_map(parameters) {
            *counts.entry(parameters).or_default() += 1;
        }
        for parameters in changed.disappeared.iter().filter_map(parameters) {
            if let Some(count) = counts.get_mut(&parameters) {
                *count -= 1;
                if *count == 0 {
                    counts.remove(&parameters);
                }
            }
        }
    }

    /// The bindings for which a rule's condition before holds, in the order of nodes.
    pub(super) fn bindings(&self, rule: RuleId) -> impl Iterator<Item = &Parameters> {
        self.0.get(&rule).into_iter().flat_map(BTreeMap::keys)
    }
}
