//! Decision Support: a plan from the perceived state, validated before the wheel acts on it.
//!
//! Problem: a plan from scratch may turn a mission upside down that a small repair would save. Idea: the wheel hands out a
//! [`Request`] and goes on turning; the shell calls [`decide`] in a thread of its own and hands the [`Decision`] back as
//! an event. The rest of a broken plan is repaired and compared with a plan from scratch: the one nearer to the old plan
//! wins, and of two that are equally near the repaired one. The running step is put first where the plan still reaches
//! the goal that way, so that nothing is interrupted without need. A plan then goes through the validator, which shares
//! no code with the planner: a plan that does not validate is a bug of ours, and must not reach a patient. Where there is
//! no plan, the planner's explanation is the reason. A first plan minimises the problem's metric, as far as the effort
//! goes; a repaired plan need not.
//!
//! Invariant: effort is counted in states, never in seconds, so the same request gives the same decision. Time is the
//! wheel's: it cancels a request that is moot, and starts the fallback when a decision takes too long.
//!
//! Source: Fox, Gerevini, Long & Serina, "Plan stability: replanning versus plan repair", ICAPS 2006.

use crate::outcome::{NoPlan, Unsolvable};
use crate::{Model, Step};
use budget::Cancellation;
use planner::{
    Attempt, Budget, Distance, OperatorId, Outcome, Preference, Query, Repaired, Report, SearchConfiguration,
    State, Way, explain, improve, repair, solve,
};
use serde::Serialize;
use std::sync::Arc;

/// States visited to explain why there is no plan: the fallback waits for the explanation, and more states would add
/// detail only.
const VISITED: u64 = 2_000;

/// A request for a plan.
#[derive(Clone, Debug)]
pub struct Request {
    /// Its number; a decision that answers an older one is thrown away.
    pub id: RequestId,
    /// The state to plan from.
    pub state: State,
    /// The rest of the plan that no longer fits, from the current step on; empty without a plan.
    pub broken: Vec<OperatorId>,
    /// The step that is under way, which goes on if the new plan can start with it.
    pub running: Option<OperatorId>,
    /// Steps that just failed in this very state.
    pub barred: Vec<Step>,
    /// How many states may be expanded.
    pub expansions: u64,
}

/// The number of a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
pub struct RequestId(pub u64);

/// What Decision Support answers.
#[derive(Clone, Debug)]
pub enum Decision {
    /// A plan that the validator accepts.
    Plan {
        /// The plan.
        operators: Vec<OperatorId>,
        /// States expanded.
        expanded: u64,
        /// How it compares with the rest of the old plan; `None` without one.
        repair: Option<Repair>,
    },
    /// None, and why.
    NoPlan(NoPlan),
    /// None without the barred steps, and why; with them there is one.
    Barred(NoPlan),
}

/// A repaired plan beside a new one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Repair {
    /// Which of them was chosen.
    pub by: Way,
    /// The plan by reuse of the old one; `None` if reuse found none.
    pub reused: Option<Figures>,
    /// The plan from scratch; `None` if the search found none.
    pub scratch: Option<Figures>,
}

/// A plan's effort and its distance from the old one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Figures {
    /// Its steps.
    pub steps: usize,
    /// States that were expanded for it.
    pub expanded: u64,
    /// Steps of the old plan that it lacks.
    pub removed: usize,
    /// Steps that the old plan lacks.
    pub added: usize,
    /// Common steps in another place.
    pub moved: usize,
}

impl Figures {
    fn of(attempt: &Attempt) -> Option<Self> {
        let (plan, Distance { removed, added, moved }) = attempt.plan()?;
        let expanded = attempt.report.statistics.expanded;
        Some(Self { steps: plan.operators.len(), expanded, removed, added, moved })
    }
}

impl Repair {
    fn of(repaired: &Repaired) -> Option<Self> {
        let scratch = repaired.fresh.as_ref().and_then(Figures::of);
        Some(Self { by: repaired.way?, reused: Figures::of(&repaired.reused), scratch })
    }

    /// The figures of the chosen plan.
    pub fn chosen(&self) -> Option<Figures> {
        match self.by {
            Way::Reuse => self.reused,
            Way::Scratch => self.scratch,
        }
    }

    /// The same for another order of the chosen plan's steps, at this distance.
    fn reordered(mut self, Distance { removed, added, moved }: Distance) -> Self {
        let chosen = match self.by {
            Way::Reuse => &mut self.reused,
            Way::Scratch => &mut self.scratch,
        };
        *chosen = chosen.map(|figures| Figures { removed, added, moved, ..figures });
        self
    }
}

/// Plans. Deterministic: the same request on the same model gives the same decision, if it is not cancelled.
pub fn decide(model: &Arc<Model>, request: &Request, cancellation: &Cancellation) -> Decision {
    let task = model.task();
    let excluded: Vec<OperatorId> = if request.barred.is_empty() {
        Vec::new()
    } else {
        task.operators().ids().filter(|&o| request.barred.contains(&model.step(o))).collect()
    };
    let query = Query { state: &request.state, goal: task.goal(), excluded: &excluded };
    let interrupted = || cancellation.is_cancelled();
    let budget = Budget { work: Some(request.expansions), interrupted: &interrupted, ..Budget::default() };
    let configuration = SearchConfiguration::default();
    let (Report { outcome, statistics }, repair) = if request.broken.is_empty() {
        (cheap(model, &query, &configuration, &budget), None)
    } else {
        let broken = &request.broken;
        let repaired = repair(task, &query, broken, &configuration, Preference::Stability, &budget);
        (repaired.report(), Repair::of(&repaired))
    };
    match outcome {
        Outcome::Solved(plan) => {
            let operators = going_on(model, &query, plan.operators, request.running);
            let distance = || Distance::between(task, &request.broken, &operators);
            let repair = repair.map(|repair: Repair| repair.reordered(distance()));
            match objection(model, &request.state, &operators) {
                None => Decision::Plan { operators, expanded: statistics.expanded, repair },
                Some(finding) => Decision::NoPlan(NoPlan::Invalid(finding)),
            }
        }
        Outcome::Unsolvable(reason) => {
            let work = Some(request.expansions.saturating_sub(statistics.expanded).min(VISITED));
            let rest = Budget { work, ..budget };
            let explanation = explain(model.domain(), model.problem(), task, &query, &reason, &rest);
            let why = NoPlan::Unsolvable(Unsolvable {
                model: Arc::clone(model),
                explanation,
                barred: request.barred.clone(),
            });
            if excluded.is_empty() {
                return Decision::NoPlan(why);
            }
            let free = Query { excluded: &[], ..query };
            match solve(task, &free, &configuration, &budget).outcome {
                Outcome::Solved(_) => Decision::Barred(why),
                _ => Decision::NoPlan(why),
            }
        }
        Outcome::Unsupported(feature) => Decision::NoPlan(NoPlan::Unsupported(feature)),
        Outcome::LimitReached(_) if cancellation.is_cancelled() => Decision::NoPlan(NoPlan::Stopped),
        Outcome::LimitReached(_) => Decision::NoPlan(NoPlan::LimitReached(request.expansions)),
    }
}

/// The cheapest plan that the budget allows if the problem has a metric; otherwise the first plan.
fn cheap(
    model: &Model,
    query: &Query<'_>,
    configuration: &SearchConfiguration,
    budget: &Budget<'_>,
) -> Report {
    if model.problem().metric.is_none() {
        return solve(model.task(), query, configuration, budget);
    }
    improve(model.task(), query, configuration, budget, &mut |_| ()).report
}

/// The plan with the running step first, if it is in the plan and the goal is still reached.
fn going_on(
    model: &Model,
    query: &Query<'_>,
    plan: Vec<OperatorId>,
    running: Option<OperatorId>,
) -> Vec<OperatorId> {
    let Some(at) = running.and_then(|running| plan.iter().position(|&o| o == running)) else { return plan };
    let mut other = plan.clone();
    other[..=at].rotate_right(1);
    let task = model.task();
    let reaches = task.after(query.state, &other).is_some_and(|end| task.satisfies(&end, query.goal));
    if reaches { other } else { plan }
}

/// What the validator, which shares nothing with the planner, finds against the plan.
fn objection(model: &Model, state: &State, plan: &[OperatorId]) -> Option<validator::Finding> {
    let steps = plan
        .iter()
        .map(|&operator| {
            let operator = model.task().operator(operator);
            let arguments = operator.arguments.to_vec();
            pddl::PlanStep { action: operator.action, arguments, span: pddl::Span::default() }
        })
        .collect();
    let (problem, plan) = (model.problem_in(state), pddl::SequentialPlan::new(steps));
    let verdict = validator::validate(model.domain(), &problem, &plan);
    validator::explain(model.domain(), &problem, &plan, &verdict)
}
