//! Plan repair: reuses a broken plan, or replaces it if a new plan is better.
//!
//! Problem: when the state or the goal has changed, planning from scratch changes steps that others
//! already rely on. Idea: try three ways to reuse the old plan. First, the longest suffix that
//! still reaches the goal. Second, a short search for a state from which some suffix reaches the
//! goal (the suffix's kernel: the goal regressed through it), nearest kernels first. Third, the
//! steps of the old plan that are still applicable, and a search for the rest. The reused plan is
//! compared with a plan from scratch by the caller's preference: by work, by cost or by distance
//! from the old plan. Invariant: every plan is simulated before it is returned, so kernels need not
//! be exact (they ignore the needs of axioms, numbers and conditional effects). Cost: a few
//! searches of bounded work, and one from scratch if the preference asks for it. No decision reads
//! a clock, so a deterministic configuration makes a deterministic choice.
//!
//! Source: Fox, Gerevini, Long & Serina, "Plan stability: replanning versus plan repair", ICAPS 2006;
//! kernels: Fikes, Hart & Nilsson, "Learning and executing generalized robot plans", AIJ 1972.

use super::distance::Distance;
use super::elimination::without_needless;
use super::{Limit, Outcome, Plan, Query, Report, SearchConfiguration, Statistics, solve};
use crate::ids::OperatorId;
use crate::task::{Goal, Kernel, Literals, State, Task};
use budget::Budget;

/// How to choose between a repaired plan and a new one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preference {
    /// The first plan found: plan from scratch only if nothing can be reused.
    Fastest,
    /// The smallest distance, then the fewest moved steps, then the least cost.
    Stability,
    /// The least cost, then the smallest distance.
    Cost,
}

/// One attempt to find a plan, and its result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Attempt {
    /// The plan, or why no plan was found, with the statistics.
    pub report: Report,
    /// The distance of the plan from the old one; `None` without a plan.
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

/// The result of a repair.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Repaired {
    /// Which plan was chosen; `None` without a plan.
    pub way: Option<Way>,
    /// The attempt that reuses the old plan.
    pub reused: Attempt,
    /// The attempt from scratch, if there was one.
    pub fresh: Option<Attempt>,
}

impl Repaired {
    /// Chooses between the two attempts. The plan from scratch wins only if it is strictly better.
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

    /// The attempt with the chosen plan, or the one that explains why no plan was found.
    pub fn chosen(&self) -> &Attempt {
        match (self.way, &self.fresh) {
            (Some(Way::Scratch) | None, Some(fresh)) => fresh,
            _ => &self.reused,
        }
    }

    /// The chosen outcome, with the statistics of both attempts.
    pub fn report(&self) -> Report {
        let fresh = self.fresh.as_ref().map_or_else(Statistics::default, |fresh| fresh.report.statistics);
        let statistics = self.reused.report.statistics + fresh;
        Report { outcome: self.chosen().report.outcome.clone(), statistics }
    }
}

/// Expansions for each gap, if the relaxation is small.
const GAP: u64 = 1000;
/// Expansions times nodes of the relaxation, if it is large.
const WORK: usize = 1 << 26;
/// The number of gaps that are tried.
const GAPS: usize = 4;

/// A plan for another state or goal, to be repaired for the query.
#[derive(Clone, Copy, Debug)]
pub struct Repair<'a> {
    /// The task.
    pub task: &'a Task,
    /// The state, the goal and the excluded operators.
    pub query: Query<'a>,
    /// The remaining steps of the old plan.
    pub broken: &'a [OperatorId],
}

/// Repairs `broken`, a plan for another state or goal, to answer the query. The plan from scratch
/// uses `configuration`.
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
    /// Searches for a plan that reuses as much of the old one as possible, with a few searches of
    /// bounded work. A failure proves nothing.
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

    /// Plans from scratch.
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

    /// Finds an applicable operator for a step: the step's own operator, or another one of the same
    /// action and arguments (each stands for one disjunct of the precondition). Returns it with the
    /// state after it.
    fn taken(&self, state: &State, step: OperatorId) -> Option<(OperatorId, State)> {
        self.task
            .ways(step)
            .filter(|o| !self.query.excluded.contains(o))
            .find_map(|o| Some((o, self.task.successor(state, o)?)))
    }

    /// Simulates the steps. Returns the operators if they lead from the query's state to its goal.
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

    /// Searches for the kernel of a suffix. Returns the path to it and the suffix.
    fn gap(&mut self) -> Option<Vec<OperatorId>> {
        let Repair { task, query, broken } = *self.repair;
        // A suffix can be kept only if it starts behind the last excluded step.
        let free = broken.iter().rposition(|o| query.excluded.contains(o)).map_or(0, |last| last + 1);
        let mut nearest: Vec<(usize, usize, Literals)> = Vec::new();
        let mut kernel = Kernel::new(task, &query.goal.literals);
        for start in (free..=broken.len()).rev() {
            if let Some(&step) = broken.get(start) {
                kernel.before(step);
            }
            let missing = kernel.missing(query.state);
            // Every suffix was simulated before. If the kernel misses nothing and the suffix still
            // failed, the kernel ignores the reason, so there is no gap to search.
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

    /// Takes the applicable steps of the old plan, then searches for the rest.
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
