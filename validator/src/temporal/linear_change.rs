//! Linear continuous change, computed only where a condition reads it.
//!
//! Problem: with thousands of continuous effects at once, updating each fluent at each happening is quadratic. Idea:
//! if rates are numbers that nothing changes, a fluent is linear until an effect on it begins or ends, or another
//! effect assigns it. The state stores the line ([`crate::state::Line`]) and computes the value on demand. The time
//! at which a condition can change is computed once for each line that the condition reads, and waits in a queue.
//!
//! Invariant: `flow_linearly` evaluates the same conditions at the same times as `flow_to`, except for conditions
//! that cannot have changed. In other cases linear change stops for good and the state stores all values: processes,
//! events, axioms, constraints and traces read everything; rates may change; an instant may be irrational.
//!
//! Cost: per happening, the lines that it changes and the conditions that read them.

use super::watch::Ticket;
use crate::number::Number;
use pddl::model::{
    Domain, Effect, EffectKind, ExpressionKind, FunctionId, GroundApplication, Problem, TimedChange,
};
use rustc_hash::{FxHashMap, FxHashSet};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The linear changes that run.
#[derive(Debug, Default)]
pub(super) struct LinearChange {
    /// By fluent: its rate and the number of effects that contribute.
    pub(super) rates: FxHashMap<GroundApplication, (Number, usize)>,
    /// The contribution of each action to rates.
    pub(super) shares: FxHashMap<Ticket, Vec<(GroundApplication, Number)>>,
    /// Fluents whose lines must be computed again.
    pub(super) bent: FxHashSet<GroundApplication>,
    /// The times at which conditions may change; valid only for the last round of their action.
    pub(super) calls: BinaryHeap<Reverse<(Number, Ticket, u64)>>,
    pub(super) rounds: FxHashMap<Ticket, u64>,
    /// The number of calls after outdated ones were last removed.
    pub(super) kept: usize,
}

/// The functions that some effect changes.
fn changing(domain: &Domain, problem: &Problem) -> FxHashSet<FunctionId> {
    let mut found = FxHashSet::default();
    let mut changed_by = |effect: &Effect| {
        effect.each(&mut |part| {
            if let EffectKind::Assign(_, application, _) = &part.kind {
                found.insert(application.function);
            }
        });
    };
    domain.actions.iter().for_each(|action| changed_by(&action.effect));
    let timed = domain.durative_actions.iter().flat_map(|action| &action.effects);
    timed.for_each(|timed| changed_by(&timed.effect));
    for action in &domain.durative_actions {
        found.extend(action.continuous.iter().map(|effect| effect.fluent.function));
    }
    for timed in &problem.timed {
        match &timed.change {
            TimedChange::Assign(fact) => found.insert(fact.application.function),
            TimedChange::Undefine(fluent) => found.insert(fluent.function),
            TimedChange::Add(_) | TimedChange::Delete(_) => false,
        };
    }
    found
}

impl LinearChange {
    /// `None` unless all continuous effects of the domain have constant rates and no feature of the
    /// task reads all fluents.
    pub(super) fn open(domain: &Domain, problem: &Problem) -> Option<Self> {
        let continuous = || domain.durative_actions.iter().flat_map(|action| &action.continuous);
        if !domain.processes.is_empty()
            || !domain.events.is_empty()
            || !domain.axioms.is_empty()
            || continuous().next().is_none()
        {
            return None;
        }
        let changing = changing(domain, problem);
        let mut steady = true;
        for effect in continuous() {
            steady &= effect.functions.is_empty();
            effect.rate.each(&mut |part| {
                steady &= match &part.kind {
                    ExpressionKind::Fluent(application) => !changing.contains(&application.function),
                    ExpressionKind::TotalTime | ExpressionKind::IsViolated(_) => false,
                    ExpressionKind::Number(_) | ExpressionKind::Duration | ExpressionKind::Arithmetic(..) => {
                        true
                    }
                };
            });
        }
        steady.then(Self::default)
    }

    /// Another effect may have set the fluent.
    pub(super) fn wrote(&mut self, fluent: &GroundApplication) {
        if self.rates.contains_key(fluent) {
            self.bent.insert(fluent.clone());
        }
    }

    /// Ends the changes of an action; `None` if the remaining rate is not a fraction.
    pub(super) fn leave(&mut self, ticket: Ticket) -> Option<()> {
        self.rounds.remove(&ticket);
        for (fluent, share) in self.shares.remove(&ticket).into_iter().flatten() {
            let (rate, effects) = self.rates.get_mut(&fluent)?;
            *rate = rate.minus(share).ok().filter(|rate| rate.is_exact())?;
            *effects -= 1;
            self.bent.insert(fluent);
        }
        Some(())
    }
}
