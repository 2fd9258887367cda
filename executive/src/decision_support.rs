//! Decision Support: a plan from the perceived state, checked before anybody acts on it.
//!
//! Idea: the wheel hands out a [`Request`] and goes on turning; whoever holds it calls [`decide`], in a
//! thread of its own or not, and hands the [`Decision`] back as an event. What is left of a broken plan is
//! repaired and set beside a plan from scratch: the one that is nearer to what everybody was told wins, and
//! of two that are as near the repaired one. What is running is put first where the plan still reaches the
//! goal that way, so that nobody is interrupted without need. A plan is first put through the
//! validator, which shares no code with the planner: a plan that does not validate is a bug of ours, and
//! must not reach a patient. Where there is no plan, the planner's explanation says why. Invariant: effort is counted in states, never in seconds, so the same request
//! gives the same decision.
//!
//! Source: Fox, Gerevini, Long & Serina, "Plan stability: replanning versus plan repair", ICAPS 2006.

use crate::{Model, Step};
use planner::{
    Attempt, Budget, Distance, OperatorId, Outcome, Preference, Query, Repaired, Report, SearchConfiguration,
    State, UnsolvableReason, Way, Wording, explain, repair, solve,
};
use serde::Serialize;

/// Reasons told below the sentence that says why there is no plan.
const REASONS: usize = 4;

/// States visited for these reasons: whoever asked waits for them before the fallback begins, and what more of them would
/// add is detail.
const VISITED: u64 = 2_000;

/// A request for a plan.
#[derive(Clone, Debug)]
pub struct Request {
    /// Its number; a decision that answers an older one is thrown away.
    pub id: RequestId,
    /// From where.
    pub state: State,
    /// What was left of the plan that no longer fits, from the step at hand on; empty where there was none.
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

/// What Decision Support says.
#[derive(Clone, Debug)]
pub enum Decision {
    /// A plan that the validator accepts.
    Plan {
        /// The plan.
        operators: Vec<OperatorId>,
        /// States expanded.
        expanded: u64,
        /// How it compares with what was left of the old plan; `None` where there was none.
        repair: Option<Repair>,
    },
    /// There is none, and why.
    NoPlan(String),
    /// None was found within this many expansions.
    LimitReached(u64),
    /// The planner's plan does not validate: a bug of ours, with the validator's words.
    Rejected(String),
}

/// A repaired plan beside a new one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Repair {
    /// Which of them was chosen.
    pub by: Way,
    /// What reuse of the old plan came to; `None` where it found nothing.
    pub reused: Option<Figures>,
    /// What planning from scratch came to; `None` where it found nothing.
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

    /// The figures of the plan that was chosen.
    pub fn chosen(&self) -> Option<Figures> {
        match self.by {
            Way::Reuse => self.reused,
            Way::Scratch => self.scratch,
        }
    }

    /// The same where the steps of the plan that was chosen are in another order, at this distance.
    fn reordered(mut self, Distance { removed, added, moved }: Distance) -> Self {
        let chosen = match self.by {
            Way::Reuse => &mut self.reused,
            Way::Scratch => &mut self.scratch,
        };
        *chosen = chosen.map(|figures| Figures { removed, added, moved, ..figures });
        self
    }
}

/// Plans. Deterministic: the same request on the same model gives the same decision.
pub fn decide(model: &Model, request: &Request) -> Decision {
    let task = model.task();
    let excluded: Vec<OperatorId> = if request.barred.is_empty() {
        Vec::new()
    } else {
        task.operators().ids().filter(|&o| request.barred.contains(&model.step(o))).collect()
    };
    let query = Query { state: &request.state, goal: task.goal(), excluded: &excluded };
    let budget = Budget { work: Some(request.expansions), ..Budget::default() };
    let configuration = SearchConfiguration::default();
    let (Report { outcome, statistics }, repair) = if request.broken.is_empty() {
        (solve(task, &query, &configuration, &budget), None)
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
                Some(why) => Decision::Rejected(why),
            }
        }
        Outcome::Unsolvable(reason) => {
            let work = Some(request.expansions.saturating_sub(statistics.expanded).min(VISITED));
            let rest = Budget { work, ..budget };
            Decision::NoPlan(unsolvable(model, &query, &reason, &request.barred, &rest))
        }
        Outcome::Unsupported(feature) => {
            Decision::Rejected(format!("the planner does not support {feature}"))
        }
        Outcome::LimitReached(_) => Decision::LimitReached(request.expansions),
    }
}

/// The plan with what is running first, if it is in the plan and the goal is reached that way, too.
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

/// What the validator, which shares nothing with the planner, says against the plan.
fn objection(model: &Model, state: &State, plan: &[OperatorId]) -> Option<String> {
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
    validator::explain(model.domain(), &problem, &plan, &verdict).map(|finding| finding.sentence)
}

/// Says why there is no plan: what can never hold, what of it nothing gives, and what had to be left out.
fn unsolvable(
    model: &Model,
    query: &Query<'_>,
    reason: &UnsolvableReason,
    barred: &[Step],
    budget: &Budget<'_>,
) -> String {
    let explanation = explain(model.domain(), model.problem(), model.task(), query, reason, budget);
    let words = Wording::new(model.task(), &explanation);
    let mut why = words.sentence();
    let (chain, lines) = (words.chain(), words.lines());
    let reasons = match chain.as_slice() {
        [] => lines.iter().map(|line| line.trim_start()).take(REASONS).collect::<Vec<_>>().join("; "),
        [first, .., before, last] if chain.len() > REASONS => format!("{first}; …; {before}; {last}"),
        all => all.join("; "),
    };
    if !reasons.is_empty() {
        why = format!("{why}: {reasons}");
    }
    if !barred.is_empty() {
        let steps: Vec<_> = barred.iter().map(ToString::to_string).collect();
        why = format!("{why} (without what just failed: {})", steps.join(", "));
    }
    why
}
