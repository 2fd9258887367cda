//! A broken plan made whole again, or a new one where that is better.
//!
//! Problem: after a surprise, planning from scratch forgets what everybody was told would happen. Idea:
//! first the longest suffix of the old plan that still reaches the goal; else a short search to a state
//! from which some suffix does (its kernel: the goal regressed through it), nearest kernels first; else
//! the old plan as far as its steps can be taken, and a search for the rest. What is found is set
//! beside a plan from scratch, with the cost of each and how many steps it changes, and the caller's
//! preference decides. Invariant: every plan is simulated before it is given out. Cost: a few
//! searches of bounded expansions, and where it is asked for, one from scratch.
//!
//! Source: Fox, Gerevini, Long & Serina, "Plan stability: replanning versus plan repair", ICAPS 2006;
//! kernels: Fikes, Hart & Nilsson, "Learning and executing generalized robot plans", AIJ 1972. We count
//! changed steps along the order of the plan (insertions and deletions), not as sets of actions.

use super::elimination::without_needless;
use super::{Budget, Outcome, Plan, Query, Report, SearchConfiguration, Statistics, solve};
use crate::ids::{FactId, OperatorId};
use crate::task::{Goal, Literals, State, Task};
use std::collections::BTreeMap;

/// What decides between a repaired plan and a new one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preference {
    /// The first plan: from scratch only where nothing can be reused.
    Fastest,
    /// Fewest changed steps, then least cost.
    Stability,
    /// Least cost, then fewest changed steps.
    Cost,
}

/// A plan with its distance from the old one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Candidate {
    /// The plan; it reaches the goal.
    pub plan: Plan,
    /// Steps of the old plan that it lacks, and steps that the old plan lacks.
    pub changed: usize,
}

/// What repair came to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Repaired {
    /// The chosen plan, or why there is none; what was searched for all candidates.
    pub report: Report,
    /// The plan by reuse, if one was found.
    pub reused: Option<Candidate>,
    /// The plan from scratch, if one was looked for and found.
    pub fresh: Option<Candidate>,
}

/// Expansions for each gap that is filled.
const GAP: u64 = 1000;
/// Gaps that are tried.
const GAPS: usize = 4;

/// Repairs `broken`, a plan for another state or goal, for the query. `configuration` is for the plan
/// from scratch.
pub fn repair(
    task: &Task,
    query: &Query<'_>,
    broken: &[OperatorId],
    configuration: &SearchConfiguration,
    preference: Preference,
    budget: &Budget<'_>,
) -> Repaired {
    let mut statistics = Statistics::default();
    let mut work = Work { task, query, broken, budget, statistics: &mut statistics };
    let reused = work.reused().map(|operators| {
        let plan = without_needless(task, query, &Plan::of(task, operators));
        Candidate { changed: changed(broken, &plan.operators), plan }
    });
    let mut report = match &reused {
        Some(candidate) => {
            Report { outcome: Outcome::Solved(candidate.plan.clone()), statistics: Statistics::default() }
        }
        None => Report {
            outcome: Outcome::LimitReached(super::Limit::Incomplete),
            statistics: Statistics::default(),
        },
    };
    let mut fresh = None;
    if reused.is_none() || preference != Preference::Fastest {
        let left = budget.expansions.map(|most| most.saturating_sub(statistics.expanded));
        let scratch = solve(task, query, configuration, &Budget { expansions: left, ..*budget });
        statistics += scratch.statistics;
        if let Outcome::Solved(plan) = &scratch.outcome {
            let candidate = Candidate { changed: changed(broken, &plan.operators), plan: plan.clone() };
            let key = |c: &Candidate| match preference {
                Preference::Cost => (c.plan.cost, c.changed as u64),
                Preference::Stability | Preference::Fastest => (c.changed as u64, c.plan.cost),
            };
            if reused.as_ref().is_none_or(|old| key(&candidate) < key(old)) {
                report.outcome = scratch.outcome;
            }
            fresh = Some(candidate);
        } else if reused.is_none() {
            report.outcome = scratch.outcome;
        }
    }
    report.statistics = statistics;
    Repaired { report, reused, fresh }
}

struct Work<'a> {
    task: &'a Task,
    query: &'a Query<'a>,
    broken: &'a [OperatorId],
    budget: &'a Budget<'a>,
    statistics: &'a mut Statistics,
}

impl Work<'_> {
    fn reused(&mut self) -> Option<Vec<OperatorId>> {
        if self.query.goal.impossible.is_some() {
            return None;
        }
        let usable = |steps: &[OperatorId]| !steps.iter().any(|o| self.query.excluded.contains(o));
        let suffix = (0..=self.broken.len()).map(|start| &self.broken[start..]);
        if let Some(whole) = suffix.clone().find(|steps| usable(steps) && self.reaches(steps)) {
            return Some(whole.to_vec());
        }
        self.gap().or_else(|| self.completed())
    }

    /// Whether the steps lead from the query's state to its goal.
    fn reaches(&self, steps: &[OperatorId]) -> bool {
        let mut state = self.query.state.clone();
        for &operator in steps {
            let Some(next) = self.task.successor(&state, operator) else { return false };
            state = next;
        }
        self.task.satisfies(&state, self.query.goal)
    }

    /// A way to the kernel of a suffix, and the suffix.
    fn gap(&mut self) -> Option<Vec<OperatorId>> {
        let mut nearest: Vec<(usize, usize, Literals)> = Vec::new();
        for (start, kernel) in kernels(self.task, self.broken, self.query.goal)? {
            if self.broken[start..].iter().any(|o| self.query.excluded.contains(o)) {
                continue;
            }
            let holds = |f: &&FactId| self.query.state.contains(**f);
            let missing = kernel.positive.iter().filter(|f| !holds(f)).count()
                + kernel.negative.iter().filter(holds).count();
            nearest.push((missing, start, kernel));
        }
        nearest.sort_by_key(|&(missing, start, _)| (missing, start));
        for (_, start, kernel) in nearest.into_iter().take(GAPS) {
            let goal = Goal::new(kernel);
            let found = self.search(&Query { goal: &goal, ..*self.query });
            let whole = found.map(|mut steps| {
                steps.extend_from_slice(&self.broken[start..]);
                steps
            });
            if let Some(whole) = whole.filter(|steps| self.reaches(steps)) {
                return Some(whole);
            }
        }
        None
    }

    /// The old plan as far as its steps can be taken, and a way on from there.
    fn completed(&mut self) -> Option<Vec<OperatorId>> {
        let mut state: State = self.query.state.clone();
        let mut steps = Vec::new();
        for &operator in self.broken {
            if self.query.excluded.contains(&operator) {
                continue;
            }
            if let Some(next) = self.task.successor(&state, operator) {
                state = next;
                steps.push(operator);
            }
        }
        if steps.is_empty() {
            return None;
        }
        steps.extend(self.search(&Query { state: &state, ..*self.query })?);
        Some(steps).filter(|steps| self.reaches(steps))
    }

    fn search(&mut self, query: &Query<'_>) -> Option<Vec<OperatorId>> {
        let left =
            self.budget.expansions.map_or(GAP, |e| GAP.min(e.saturating_sub(self.statistics.expanded)));
        let budget = Budget { expansions: Some(left), ..*self.budget };
        let report = solve(self.task, query, &SearchConfiguration::default(), &budget);
        *self.statistics += report.statistics;
        match report.outcome {
            Outcome::Solved(plan) => Some(plan.operators),
            _ => None,
        }
    }
}

/// For each suffix, where it starts and what must hold before it; `None` where regression is not exact.
fn kernels(task: &Task, plan: &[OperatorId], goal: &Goal) -> Option<Vec<(usize, Literals)>> {
    let exact = |&o: &OperatorId| {
        let operator = &task.operators()[o];
        operator.conditional.is_empty() && !operator.changes_numbers()
    };
    if !task.axioms().is_empty() || !plan.iter().all(exact) {
        return None;
    }
    let mut kernel: BTreeMap<FactId, bool> = BTreeMap::new();
    let require = |kernel: &mut BTreeMap<FactId, bool>, literals: &Literals| {
        kernel.extend(literals.positive.iter().map(|&f| (f, true)));
        kernel.extend(literals.negative.iter().map(|&f| (f, false)));
    };
    let literals = |kernel: &BTreeMap<FactId, bool>| {
        let of = |wanted: bool| kernel.iter().filter(move |&(_, &b)| b == wanted).map(|(&f, _)| f).collect();
        Literals { positive: of(true), negative: of(false) }
    };
    require(&mut kernel, &goal.literals);
    let mut found = vec![(plan.len(), literals(&kernel))];
    for (start, &operator) in plan.iter().enumerate().rev() {
        let operator = &task.operators()[operator];
        kernel.retain(|fact, wanted| {
            let given = if *wanted { &operator.adds } else { &operator.deletes };
            given.binary_search(fact).is_err()
        });
        require(&mut kernel, &operator.precondition);
        found.push((start, literals(&kernel)));
    }
    Some(found)
}

/// Insertions and deletions between two plans: what a longest common subsequence leaves.
fn changed(old: &[OperatorId], new: &[OperatorId]) -> usize {
    let prefix = old.iter().zip(new).take_while(|(a, b)| a == b).count();
    let (old, new) = (&old[prefix..], &new[prefix..]);
    let suffix = old.iter().rev().zip(new.iter().rev()).take_while(|(a, b)| a == b).count();
    let (old, new) = (&old[..old.len() - suffix], &new[..new.len() - suffix]);
    let mut before = vec![0_usize; new.len() + 1];
    for a in old {
        let mut diagonal = 0;
        for (i, b) in new.iter().enumerate() {
            let above = before[i + 1];
            before[i + 1] = if a == b { diagonal + 1 } else { above.max(before[i]) };
            diagonal = above;
        }
    }
    old.len() + new.len() - 2 * before[new.len()]
}

#[cfg(test)]
mod tests {
    use super::{OperatorId, changed};

    #[test]
    fn changes_are_insertions_and_deletions() {
        let plan = |steps: &[u32]| steps.iter().map(|&s| OperatorId(s)).collect::<Vec<_>>();
        let of = |a: &[u32], b: &[u32]| changed(&plan(a), &plan(b));
        assert_eq!(of(&[1, 2, 3], &[1, 2, 3]), 0);
        assert_eq!(of(&[1, 2, 3], &[2, 3]), 1);
        assert_eq!(of(&[1, 2, 3, 4], &[1, 5, 3, 4]), 2);
        assert_eq!(of(&[], &[7, 8]), 2);
        assert_eq!(of(&[1, 2, 3, 4, 5], &[5, 1, 3, 2, 4]), 4);
    }
}
