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

use crate::arrivals::Arrival;
use crate::goal::GoalId;
use crate::goals::{Aim, Choice, Stage, choose};
use crate::outcome::{NoPlan, Unsolvable};
use crate::soft_plans::soft_plan;
use crate::{Model, Step};
use budget::Cancellation;
use low_to_high::{Fact, Fluent};
use planner::{
    Attempt, Budget, Distance, Goal, Impossible, OperatorId, Outcome, Plan, Preference, Query, Repaired,
    Report, SearchConfiguration, State, UnsolvableReason, Way, explain, improve, repair, solve, still_needed,
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
    /// The goals that are wanted, the most important first.
    pub goals: Vec<GoalId>,
    /// The rest of the plan that no longer fits, from the current step on; empty without a plan.
    pub broken: Vec<OperatorId>,
    /// The goals that it was made for.
    pub served: Vec<GoalId>,
    /// The steps that are being carried out, which go on where the new plan can start with them.
    pub running: Vec<OperatorId>,
    /// Steps that just failed in this very state.
    pub barred: Vec<Step>,
    /// How many states may be expanded.
    pub expansions: u64,
    /// What is perceived, if there are other objects than those of the model.
    pub arrived: Option<Arrived>,
}

/// What is perceived of a world with other objects than those of the model.
#[derive(Clone, Debug)]
pub struct Arrived {
    /// The objects that the problem does not have.
    pub objects: Vec<Arrival>,
    /// The facts.
    pub facts: Vec<Fact>,
    /// The numbers.
    pub numbers: Vec<(Fluent, f64)>,
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
        /// Its parts, and the goals that each serves.
        stages: Vec<Stage>,
        /// The goals that it does not serve, and why.
        postponed: Vec<(GoalId, NoPlan)>,
        /// The soft goals that cost more than they are worth, or for which the effort was not enough.
        forgone: Vec<GoalId>,
        /// The model that its operators are of, if it was made with other objects.
        model: Option<Arc<Model>>,
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
    let Some(arrived) = &request.arrived else { return decide_on(model, request, cancellation) };
    let grown = match model.with_arrivals(&arrived.objects) {
        Ok(grown) => Arc::new(grown),
        Err(error) => return Decision::NoPlan(NoPlan::TooLarge(error.to_string())),
    };
    let state = grown.state(&arrived.facts);
    let state =
        grown.with_numbers(state, arrived.numbers.iter().map(|(fluent, value)| (fluent, Some(*value))));
    let broken = grown.counterparts(model, &request.broken).into_iter().flatten().collect();
    let running: Vec<_> = grown.counterparts(model, &request.running).into_iter().flatten().collect();
    let mut state = state;
    grown.task().change(&mut state, grown.under_way(&running).into_iter().map(|fact| (fact, true)));
    let request = Request { state, broken, running, arrived: None, ..request.clone() };
    match decide_on(&grown, &request, cancellation) {
        Decision::Plan { operators, expanded, repair, stages, postponed, forgone, .. } => {
            Decision::Plan { operators, expanded, repair, stages, postponed, forgone, model: Some(grown) }
        }
        other => other,
    }
}

fn decide_on(model: &Arc<Model>, request: &Request, cancellation: &Cancellation) -> Decision {
    let task = model.task();
    let excluded: Vec<OperatorId> = if request.barred.is_empty() {
        Vec::new()
    } else {
        task.operators().ids().filter(|&o| request.barred.contains(&model.step(o))).collect()
    };
    let interrupted = || cancellation.is_cancelled();
    let budget = Budget { work: Some(request.expansions), interrupted: &interrupted, ..Budget::default() };
    let (mut expanded, mut repaired) = (0, None);
    let (mut levels, fresh) = levels(model, request);
    let mut reach = |aim: Aim<'_>| {
        let search = Search { model, request, excluded: &excluded, budget };
        let found = search.reach(&aim)?;
        expanded += found.expanded;
        repaired = found.repair.or(repaired);
        Ok(found.operators)
    };
    let mut choice = choose(&levels, &mut reach);
    let is_soft = |(goal, _): &(GoalId, NoPlan)| model.soft(*goal).is_some();
    let lost: Vec<_> = choice.postponed.iter().filter(|postponed| is_soft(postponed)).cloned().collect();
    if !lost.is_empty() {
        // A soft goal must not keep the hard ones of its level from being planned for together.
        levels.iter_mut().for_each(|level| level.retain(|goal| lost.iter().all(|(other, _)| other != goal)));
        levels.retain(|level| !level.is_empty());
        choice = choose(&levels, reach);
        choice.postponed.extend(lost);
    }
    let forgone = go_for(model, request, &fresh, &mut choice, &budget);
    if choice.stages.is_empty() {
        return without_plan(model, request, &excluded, choice, budget);
    }
    let served = choice.served();
    let goal = model.goal(&served);
    let query = Query { state: &request.state, goal: &goal, excluded: &excluded };
    let Choice { operators, stages, postponed } = choice;
    let first = stages.first().map_or(0, |stage| stage.end);
    let going_on = |plan, &running: &OperatorId| going_on(model, &query, plan, first, running);
    let operators = request.running.iter().rev().fold(operators, going_on);
    let distance = || Distance::between(task, &request.broken, &operators);
    let repair = repaired.map(|repair: Repair| repair.reordered(distance()));
    match objection(model, &request.state, &served, &operators) {
        None => Decision::Plan { operators, expanded, repair, stages, postponed, forgone, model: None },
        Some(finding) => Decision::NoPlan(NoPlan::Invalid(finding)),
    }
}

/// The goals in levels of priority, and the soft ones that no plan has served yet. Those that the plan before collected
/// belong to the last level.
fn levels(model: &Model, request: &Request) -> (Vec<Vec<GoalId>>, Vec<GoalId>) {
    let mut levels = model.levels(&request.goals);
    let soft = request.goals.iter().copied().filter(|&goal| model.soft(goal).is_some());
    let (kept, fresh): (Vec<_>, Vec<_>) = soft.partition(|goal| request.served.contains(goal));
    match levels.last_mut() {
        Some(last) => last.extend(kept),
        None if kept.is_empty() => {}
        None => levels.push(kept),
    }
    (levels, fresh)
}

/// Lets the last part of a plan go for soft goals as far as they are worth it. Returns those that are not; one that no plan
/// reaches is postponed, with the reason.
fn go_for(
    model: &Arc<Model>,
    request: &Request,
    soft: &[GoalId],
    choice: &mut Choice,
    budget: &Budget<'_>,
) -> Vec<GoalId> {
    if soft.is_empty() || (choice.stages.is_empty() && !choice.postponed.is_empty()) {
        return Vec::new();
    }
    let task = model.task();
    let start = choice.stages.iter().rev().nth(1).map_or(0, |stage| stage.end);
    let Some(state) = task.after(&request.state, &choice.operators[..start]) else { return soft.to_vec() };
    let found = soft_plan(model, &state, &choice.served(), soft, &request.barred, budget);
    let collected = found.as_ref().map_or(&[][..], |found| &found.collected).to_vec();
    if let Some(found) = found.filter(|found| !found.collected.is_empty()) {
        choice.operators.truncate(start);
        choice.operators.extend(found.operators);
        let end = choice.operators.len();
        match choice.stages.last_mut() {
            Some(last) => {
                last.goals.extend(&collected);
                last.end = end;
            }
            None => choice.stages.push(Stage { goals: collected.clone(), end }),
        }
    }
    let mut forgone = Vec::new();
    for &goal in soft.iter().filter(|goal| !collected.contains(goal)) {
        let search = Search { model, request, excluded: &[], budget: *budget };
        match search.reach(&Aim { after: &[], all: &[goal], fresh: &[goal] }) {
            Ok(_) => forgone.push(goal),
            Err(why) => choice.postponed.push((goal, *why)),
        }
    }
    forgone
}

/// No goal has a plan: the reason of the most important one, and whether it is only what has just failed.
fn without_plan(
    model: &Arc<Model>,
    request: &Request,
    excluded: &[OperatorId],
    choice: Choice,
    budget: Budget<'_>,
) -> Decision {
    let solvable = |goal: GoalId| {
        let goal = model.goal(&[goal]);
        let free = Query { state: &request.state, goal: &goal, excluded: &[] };
        let report = solve(model.task(), &free, &SearchConfiguration::default(), &budget);
        matches!(report.outcome, Outcome::Solved(_))
    };
    let barred = |(goal, why): &(GoalId, NoPlan)| {
        let proven = matches!(why, NoPlan::Unsolvable(_) | NoPlan::Concurrency(_));
        !excluded.is_empty() && proven && solvable(*goal)
    };
    match choice.postponed.iter().find(|postponed| barred(postponed)) {
        Some((_, why)) => Decision::Barred(why.clone()),
        None => {
            let first = choice.postponed.into_iter().next().map(|(_, why)| why);
            Decision::NoPlan(first.unwrap_or(NoPlan::Stopped))
        }
    }
}

/// A search for some of the goals.
struct Search<'a> {
    model: &'a Arc<Model>,
    request: &'a Request,
    excluded: &'a [OperatorId],
    budget: Budget<'a>,
}

/// What an old plan was made for, beside what a new one is made for.
enum Relation {
    /// Other goals.
    None,
    /// Some of the same: what they need of it is kept, if it still reaches them.
    Part,
    /// The same: it is repaired.
    Same,
}

/// A plan for some of the goals.
struct Found {
    operators: Vec<OperatorId>,
    expanded: u64,
    repair: Option<Repair>,
}

impl Search<'_> {
    /// Steps that reach all goals of an aim behind those that come first.
    fn reach(&self, aim: &Aim<'_>) -> Result<Found, Box<NoPlan>> {
        let Self { model, request, excluded, budget } = *self;
        let task = model.task();
        let state = task.after(&request.state, aim.after).ok_or(NoPlan::Stopped).map_err(Box::new)?;
        let mut goal = model.goal(aim.all);
        goal.impossible = goal.impossible.take().or_else(|| rivals(model, &state, &goal));
        let query = Query { state: &state, goal: &goal, excluded };
        let configuration = SearchConfiguration::default();
        let (Report { outcome, statistics }, repair) = match self.relation(aim) {
            Relation::None => (cheap(model, &query, &configuration, &budget), None),
            Relation::Part => {
                let fresh = cheap(model, &query, &configuration, &budget);
                let kept = still_needed(task, &query, &request.broken, budget.interrupted);
                (as_good(kept, fresh), None)
            }
            Relation::Same => {
                let broken = &request.broken;
                let repaired = repair(task, &query, broken, &configuration, Preference::Stability, &budget);
                (repaired.report(), Repair::of(&repaired))
            }
        };
        let expanded = statistics.expanded;
        Err(Box::new(match outcome {
            Outcome::Solved(plan) => return Ok(Found { operators: plan.operators, expanded, repair }),
            Outcome::Unsolvable(_) if !model.meanwhile().is_empty() => {
                NoPlan::Concurrency(model.meanwhile().to_vec())
            }
            Outcome::Unsolvable(reason) => self.unsolvable(aim, &query, &reason, expanded),
            Outcome::Unsupported(feature) => NoPlan::Unsupported(feature),
            Outcome::LimitReached(_) if (budget.interrupted)() => NoPlan::Stopped,
            Outcome::LimitReached(_) => NoPlan::LimitReached(request.expansions),
        }))
    }

    /// What the old plan has to do with an aim.
    fn relation(&self, aim: &Aim<'_>) -> Relation {
        let Request { broken, served, .. } = self.request;
        let same = aim.after.is_empty()
            && served.len() == aim.all.len()
            && served.iter().all(|goal| aim.all.contains(goal));
        match () {
            () if broken.is_empty() || !aim.fresh.iter().any(|goal| served.contains(goal)) => Relation::None,
            () if same => Relation::Same,
            () => Relation::Part,
        }
    }

    fn unsolvable(
        &self,
        aim: &Aim<'_>,
        query: &Query<'_>,
        reason: &UnsolvableReason,
        expanded: u64,
    ) -> NoPlan {
        let Self { model, request, budget, .. } = *self;
        let work = Some(request.expansions.saturating_sub(expanded).min(VISITED));
        let rest = Budget { work, ..budget };
        let problem = model.problem_for(aim.all);
        let explanation = explain(model.domain(), &problem, model.task(), query, reason, &rest);
        NoPlan::Unsolvable(Unsolvable {
            model: Arc::clone(model),
            explanation,
            barred: request.barred.clone(),
        })
    }
}

/// What is kept of an old plan, unless a new one is cheaper: nothing is done for a goal that has ended.
fn as_good(kept: Option<Plan>, fresh: Report) -> Report {
    let cheaper = |kept: &Plan| !matches!(&fresh.outcome, Outcome::Solved(plan) if plan.cost < kept.cost);
    match kept.filter(cheaper) {
        Some(plan) => Report { outcome: Outcome::Solved(plan), ..fresh },
        None => fresh,
    }
}

/// Two facts of goals that exclude each other in every state that can follow from this one: no search is needed.
fn rivals(model: &Model, state: &State, goal: &Goal) -> Option<Impossible> {
    let task = model.task();
    let facts = &goal.literals.positive;
    let mut pairs =
        facts.iter().enumerate().flat_map(|(at, &a)| facts[at + 1..].iter().map(move |&b| (a, b)));
    let (a, b) = pairs.find(|&(a, b)| task.mutexes().are_mutex(a, b))?;
    if !task.mutexes().hold_in(state) {
        return None;
    }
    let atoms = [a, b].map(|fact| task.facts()[fact].atom.clone());
    let atoms: Option<Vec<_>> = atoms.into_iter().collect();
    Some(atoms.map_or(Impossible::Formula, Impossible::Exclusive))
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

/// The plan with a running step first, if it is in its first part and the goal is still reached.
fn going_on(
    model: &Model,
    query: &Query<'_>,
    plan: Vec<OperatorId>,
    part: usize,
    running: OperatorId,
) -> Vec<OperatorId> {
    let Some(at) = plan[..part].iter().position(|&o| o == running) else { return plan };
    let mut other = plan.clone();
    other[..=at].rotate_right(1);
    let task = model.task();
    let reaches = task.after(query.state, &other).is_some_and(|end| task.satisfies(&end, query.goal));
    if reaches { other } else { plan }
}

/// What the validator, which shares nothing with the planner, finds against the plan.
fn objection(
    model: &Model,
    state: &State,
    goals: &[GoalId],
    plan: &[OperatorId],
) -> Option<validator::Finding> {
    let steps = plan
        .iter()
        .map(|&operator| {
            let operator = model.task().operator(operator);
            let arguments = operator.arguments.to_vec();
            pddl::PlanStep { action: operator.action, arguments, span: pddl::Span::default() }
        })
        .collect();
    let (problem, plan) = (model.problem_in(state, goals), pddl::SequentialPlan::new(steps));
    let verdict = validator::validate(model.domain(), &problem, &plan);
    validator::explain(model.domain(), &problem, &plan, &verdict)
}
