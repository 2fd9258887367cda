//! Explains why there is no plan, as far as that was proven.
//!
//! Problem: "no plan" does not help an author to mend a model. Idea: there are several proofs, and each is reported in
//! its own terms.
//! - `reasons` traces a literal that grounding never reaches, although it ignores deletes, back to the literals that no
//!   action and no axiom achieves.
//! - `analysis::intervals` bounds the numbers.
//! - Facts of one mutex group exclude each other.
//! - If the search visited every state, `space` visits them once more. It reports the goals that
//!   never held, the pairs that never held together, and the state with the most goals.
//! - `bans` reports an excluded operator only if it would otherwise be applicable.
//!
//! Invariant: an explanation claims only proven facts and leaves out the rest. Cost: bounded for
//! each proof.
//!
//! Source: Göbelbecker et al., "Coming up with good excuses", ICAPS 2010, for the question.

mod bans;
mod breadth;
mod goal;
mod oracle;
mod reasons;
mod record;
mod space;
#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test")]
mod tests;
mod wording;

pub use analysis::intervals::{Extent, NeverCompares};
pub use analysis::{Literal, Pattern};
pub use reasons::{Achiever, Need, Obstruction, Reason, ReasonId, Why};
pub use record::{Exclusive, Explanation, Never, Part};
pub use space::{Nearest, Space};
pub use wording::Wording;

use crate::ids::{FactId, OperatorId};
use crate::search::{Query, UnsolvableReason};
use crate::task::{Impossible, Operator, State, Task};
use analysis::intervals::Ranges;
use analysis::{Binding, Instance, Needs, Values};
use budget::Budget;
use goal::Walk;
use oracle::Oracle;
use pddl::model::{Action, ConditionKind, Domain, Problem};
use reasons::Reasons;
use record::MOST;

/// The most operators whose comparisons are checked.
const OPERATORS: usize = 5_000;

/// Explains why `task`, the grounding of `problem`, has no plan for the query: from its state,
/// without the operators that it excludes. The query's goal must be the problem's own. `reason` is
/// the result of the search. `budget` bounds both visits of states: the one after the search
/// exhausted them, and the one that finds out whether an excluded operator is missing.
pub fn explain(
    domain: &Domain,
    problem: &Problem,
    task: &Task,
    query: &Query<'_>,
    reason: &UnsolvableReason,
    budget: &Budget<'_>,
) -> Explanation {
    let instance = Instance { domain, problem };
    let values = values(instance, task, query.state);
    let first = Oracle::new(instance, task, *query, &[]);
    let never = out_of_range(&first, &values);
    let oracle = if never.is_empty() { first } else { Oracle::new(instance, task, *query, &never) };
    let ranges = Ranges::new(instance, &values, &oracle);
    let mut reasons = Reasons::new(&oracle, &ranges, budget);
    let walk = Walk { oracle: &oracle, ranges: &ranges };
    let parts = walk.parts(&mut reasons);
    let exclusive = exclusive(task, query.state, &walk.required(), reason);
    let space = match reason {
        UnsolvableReason::SpaceExhausted => Some(space::visit(task, query, budget)),
        UnsolvableReason::Impossible(_) => None,
    };
    Explanation { parts, reasons: reasons.finish(), exclusive, space }
}

/// The numbers in a state.
fn values(instance: Instance<'_>, task: &Task, state: &State) -> Values {
    let mut values = Values::initial(instance.domain, instance.problem);
    if !state.is_exact() {
        values.mark_incomplete();
    }
    task.numbers(state).for_each(|(fluent, value)| values.set(fluent, value));
    values
}

/// The operators whose precondition has a comparison that never holds.
fn out_of_range(oracle: &Oracle<'_>, values: &Values) -> Vec<OperatorId> {
    let (domain, task) = (oracle.instance.domain, oracle.task);
    let compares = |action: &Action| {
        let mut compares = false;
        action.precondition.each(&mut |part| compares |= matches!(part.kind, ConditionKind::Compare(..)));
        compares
    };
    let compares: Vec<bool> = domain.actions.iter().map(compares).collect();
    if !compares.contains(&true) {
        return Vec::new();
    }
    let ranges = Ranges::new(oracle.instance, values, oracle);
    let candidates = task.operators().enumerate().filter(|(_, o)| compares[o.action.0 as usize]);
    let never = |operator: &Operator| {
        let Action { variables, precondition, .. } = &domain.actions[operator.action];
        let mut binding = Binding::new(variables);
        binding.set_parameters(operator.arguments);
        let needs = Needs::of([precondition], &binding, oracle.instance);
        needs.comparisons.iter().any(|compared| ranges.never(compared, &binding).is_some())
    };
    candidates.take(OPERATORS).filter(|(_, operator)| never(operator)).map(|(id, _)| id).collect()
}

/// The pairs of facts that share a mutex group of the task.
fn exclusive(task: &Task, state: &State, facts: &[FactId], reason: &UnsolvableReason) -> Vec<Exclusive> {
    // If the groups hold in this state, every operator keeps them.
    if !task.mutexes().keep(state.words()) {
        return Vec::new();
    }
    let mut found = Vec::new();
    for (i, &a) in facts.iter().enumerate() {
        for &b in &facts[i + 1..] {
            let shared = task.mutexes().groups_of(a).find(|&g| task.mutexes().group(g).any(|f| f == b));
            if let Some(group) = shared.filter(|_| a != b && found.len() < MOST) {
                let names = task.mutexes().group(group).map(|fact| task.fact_name(fact));
                found.push(Exclusive { pair: [a, b].map(|f| task.fact_name(f)), group: names.collect() });
            }
        }
    }
    // An atom that never changes is not a fact of the task. Only grounding has then seen the group.
    if let (true, UnsolvableReason::Impossible(Impossible::Exclusive(atoms))) = (found.is_empty(), reason)
        && let [a, b] = atoms.as_slice()
    {
        let pair = [a, b].map(|atom| task.atom_name(atom));
        found.push(Exclusive { group: pair.to_vec(), pair });
    }
    found
}
