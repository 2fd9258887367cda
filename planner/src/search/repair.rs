//! A broken plan made whole again, or a new one where that is better.
//!
//! Problem: after a surprise, planning from scratch changes steps that others already count on. Idea:
//! first the longest suffix of the old plan that still reaches the goal; else a short search to a state
//! from which some suffix does (its kernel: the goal regressed through it), nearest kernels first; else
//! the old plan as far as its steps can be taken, and a search for the rest. What is found is set
//! beside a plan from scratch, with what each took and how far it is from the old plan, and the caller's
//! preference decides. Invariant: every plan is simulated before it is given out, so kernels need not be
//! exact (what axioms, numbers and conditional effects need is not followed back). Cost: a few searches
//! of bounded work, and where it is asked for, one from scratch. Nothing here depends on a clock: with a
//! configuration that is deterministic, so is the choice.
//!
//! Source: Fox, Gerevini, Long & Serina, "Plan stability: replanning versus plan repair", ICAPS 2006;
//! kernels: Fikes, Hart & Nilsson, "Learning and executing generalized robot plans", AIJ 1972.

use super::distance::Distance;
use super::elimination::without_needless;
use super::{Limit, Outcome, Plan, Query, Report, SearchConfiguration, Statistics, solve};
use crate::ids::OperatorId;
use crate::task::{Goal, Kernel, Literals, State, Task};
use budget::Budget;

/// What decides between a repaired plan and a new one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preference {
    /// The first plan: from scratch only where nothing can be reused.
    Fastest,
    /// The smallest distance, then the fewest moved steps, then the least cost.
    Stability,
    /// The least cost, then the smallest distance.
    Cost,
}

/// One way to a plan, and what came of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Attempt {
    /// The plan, or why no plan was found, with the statistics.
    pub report: Report,
    /// How far the plan is from the old one; `None` without a plan.
    pub distance: Option<Distance>,
}

impl Attempt {
    /// The plan with its distance.
    pub fn plan(&self) -> Option<(&Plan, Distance)> {
        match (&self.report.outcome, self.distance) {
            (Outcome::Solved(plan), Some(distance)) => Some((plan, distance)),
            _ => None,
        }
    }
}

/// Where a plan came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Way {
    /// The old plan was reused.
    Reuse,
    /// It was planned from scratch.
    Scratch,
}

/// What repair came to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Repaired {
    /// Which plan was chosen; `None` without a plan.
    pub way: Option<Way>,
    /// The attempt to reuse the old plan.
    pub reused: Attempt,
    /// The plan from scratch, if one was looked for.
    pub fresh: Option<Attempt>,
}

impl Repaired {
    /// Decides between the two. A plan from scratch has to be better to win.
    pub fn of(preference: Preference, reused: Attempt, fresh: Option<Attempt>) -> Self {
        let key = |(plan, distance): (&Plan, Distance)| {
            let (cost, steps, moved) = (plan.cost, distance.steps() as u64, distance.moved as u64);
            match preference {
                Preference::Cost => [cost, steps, moved],
                Preference::Stability => [steps, moved, cost],
                Preference::Fastest => [0; 3],
            }
        };
        let new = fresh.as_ref().and_then(Attempt::plan).map(key);
        let way = match (reused.plan().map(key), new) {
            (Some(old), Some(new)) if new < old => Some(Way::Scratch),
            (Some(_), _) => Some(Way::Reuse),
            (None, Some(_)) => Some(Way::Scratch),
            (None, None) => None,
        };
        Self { way, reused, fresh }
    }

    /// The attempt whose plan was chosen, or the one that explains why no plan was found.
    pub fn chosen(&self) -> &Attempt {
        match (self.way, &self.fresh) {
            (Some(Way::Scratch) | None, Some(fresh)) => fresh,
            _ => &self.reused,
        }
    }

    /// The outcome, and what both attempts took.
    pub fn report(&self) -> Report {
        let fresh = self.fresh.as_ref().map_or_else(Statistics::default, |fresh| fresh.report.statistics);
        let statistics = self.reused.report.statistics + fresh;
        Report { outcome: self.chosen().report.outcome.clone(), statistics }
    }
}

/// Expansions for each gap that is filled, where they are cheap.
const GAP: u64 = 1000;
/// Expansions times nodes of the relaxation, where they are not.
const WORK: usize = 1 << 26;
/// Gaps that are tried.
const GAPS: usize = 4;

/// A plan for another state or goal, to be repaired for the query.
#[derive(Clone, Copy, Debug)]
pub struct Repair<'a> {
    /// The task.
    pub task: &'a Task,
    /// From where, to what, without which operators.
    pub query: Query<'a>,
    /// What is left of the old plan.
    pub broken: &'a [OperatorId],
}

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
    let repair = Repair { task, query: *query, broken };
    let reused = repair.reuse(budget);
    let fresh = (reused.plan().is_none() || preference != Preference::Fastest).then(|| {
        let spent = reused.report.statistics.expanded;
        let left = budget.work.map(|most| most.saturating_sub(spent));
        repair.afresh(configuration, &Budget { work: left, ..*budget })
    });
    Repaired::of(preference, reused, fresh)
}

impl Repair<'_> {
    /// A plan that has as much of the old one as is found within some searches of bounded work. That there is
    /// none proves nothing.
    pub fn reuse(&self, budget: &Budget<'_>) -> Attempt {
        let mut work = Work { repair: self, budget, statistics: Statistics::default() };
        let outcome = match work.reused() {
            Some(operators) => {
                let plan = Plan::of(self.task, operators);
                Outcome::Solved(without_needless(self.task, &self.query, &plan, budget.interrupted))
            }
            None if (budget.interrupted)() => Outcome::LimitReached(Limit::Interrupted),
            None => Outcome::LimitReached(Limit::Incomplete),
        };
        let statistics = work.statistics;
        self.attempt(Report { outcome, statistics })
    }

    /// A new plan.
    pub fn afresh(&self, configuration: &SearchConfiguration, budget: &Budget<'_>) -> Attempt {
        self.attempt(solve(self.task, &self.query, configuration, budget))
    }

    fn attempt(&self, report: Report) -> Attempt {
        let distance = match &report.outcome {
            Outcome::Solved(plan) => Some(Distance::between(self.task, self.broken, &plan.operators)),
            _ => None,
        };
        Attempt { report, distance }
    }

    /// The step in a state: the operator, or another one of the same action and arguments that is
    /// applicable (each stands for one part of a disjunction), and the state after it.
    fn taken(&self, state: &State, step: OperatorId) -> Option<(OperatorId, State)> {
        let operators = self.task.operators();
        let own = operators.get(step);
        let after = (step.0 + 1..).map(OperatorId).take_while(|o| (o.0 as usize) < operators.len());
        let before = (0..step.0).rev().map(OperatorId);
        let same = |o: &OperatorId| {
            let other = operators.get(*o);
            other.action == own.action && other.arguments == own.arguments
        };
        let copies = after.take_while(same).chain(before.take_while(same));
        std::iter::once(step)
            .chain(copies)
            .filter(|o| !self.query.excluded.contains(o))
            .find_map(|o| Some((o, self.task.successor(state, o)?)))
    }

    /// The steps as operators, if they lead from the query's state to its goal.
    fn simulated(&self, steps: &[OperatorId]) -> Option<Vec<OperatorId>> {
        let mut state = self.query.state.clone();
        let mut done = Vec::with_capacity(steps.len());
        for &step in steps {
            let (operator, next) = self.taken(&state, step)?;
            state = next;
            done.push(operator);
        }
        self.task.satisfies(&state, self.query.goal).then_some(done)
    }
}

struct Work<'a> {
    repair: &'a Repair<'a>,
    budget: &'a Budget<'a>,
    statistics: Statistics,
}

impl Work<'_> {
    fn reused(&mut self) -> Option<Vec<OperatorId>> {
        let broken = self.repair.broken;
        if self.repair.query.goal.impossible.is_some() {
            return None;
        }
        let mut suffixes = (0..=broken.len()).map(|start| &broken[start..]);
        if let Some(whole) = suffixes.find_map(|steps| self.repair.simulated(steps)) {
            return Some(whole);
        }
        self.gap().or_else(|| self.completed())
    }

    /// A way to the kernel of a suffix, and the suffix.
    fn gap(&mut self) -> Option<Vec<OperatorId>> {
        let Repair { task, query, broken } = *self.repair;
        // Only suffixes behind the last step that is excluded can be kept.
        let free = broken.iter().rposition(|o| query.excluded.contains(o)).map_or(0, |last| last + 1);
        let mut nearest: Vec<(usize, usize, Literals)> = Vec::new();
        let mut kernel = Kernel::new(task, &query.goal.literals);
        for start in (free..=broken.len()).rev() {
            if let Some(&step) = broken.get(start) {
                kernel.before(step);
            }
            let missing = kernel.missing(query.state);
            // Every suffix was simulated before. Where nothing is missing and it did not lead to the goal, what stands in
            // its way is nothing that the kernel tells: there is no gap to search a way over.
            if missing > 0 {
                nearest.push((missing, start, kernel.literals()));
            }
        }
        nearest.sort_by_key(|&(missing, start, _)| (missing, start));
        for (_, start, kernel) in nearest.into_iter().take(GAPS) {
            let goal = Goal::new(kernel);
            let found = self.search(&Query { goal: &goal, ..query });
            let whole = found.and_then(|mut steps| {
                steps.extend_from_slice(&broken[start..]);
                self.repair.simulated(&steps)
            });
            if whole.is_some() {
                return whole;
            }
        }
        None
    }

    /// The old plan as far as its steps can be taken, and a way on from there.
    fn completed(&mut self) -> Option<Vec<OperatorId>> {
        let query = self.repair.query;
        let mut state: State = query.state.clone();
        let mut steps = Vec::new();
        for &step in self.repair.broken {
            if let Some((operator, next)) = self.repair.taken(&state, step) {
                state = next;
                steps.push(operator);
            }
        }
        if steps.is_empty() {
            return None;
        }
        steps.extend(self.search(&Query { state: &state, ..query })?);
        self.repair.simulated(&steps)
    }

    fn search(&mut self, query: &Query<'_>) -> Option<Vec<OperatorId>> {
        let task = self.repair.task;
        let most = GAP.min((WORK / task.relaxation.nodes().max(1)) as u64).max(16);
        let left = self.budget.work.map_or(most, |e| most.min(e.saturating_sub(self.statistics.expanded)));
        let budget = Budget { work: Some(left), ..*self.budget };
        let report = solve(task, query, &SearchConfiguration::default(), &budget);
        self.statistics += report.statistics;
        match report.outcome {
            Outcome::Solved(plan) => Some(plan.operators),
            _ => None,
        }
    }
}
