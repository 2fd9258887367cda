//! Decision Support: a plan from the perceived state, checked before anybody acts on it.
//!
//! Idea: the wheel hands out a [`Request`] and goes on turning; whoever holds it calls [`decide`], in a
//! thread of its own or not, and hands the [`Decision`] back as an event. A plan is first put through the
//! validator, which shares no code with the planner: a plan that does not validate is a bug of ours, and
//! must not reach a patient.

use crate::{Model, Step};
use planner::{
    Budget, Impossible, OperatorId, Outcome, Query, SearchConfiguration, State, UnsolvableReason, solve,
};

/// A request for a plan.
#[derive(Clone, Debug)]
pub struct Request {
    /// Its number; a decision that answers an older one is thrown away.
    pub id: RequestId,
    /// From where.
    pub state: State,
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
    },
    /// There is none, and why.
    NoPlan(String),
    /// None was found within this many expansions.
    LimitReached(u64),
    /// The planner's plan does not validate: a bug of ours, with the validator's words.
    Rejected(String),
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
    let budget = Budget { expansions: Some(request.expansions), ..Budget::default() };
    let report = solve(task, &query, &SearchConfiguration::default(), &budget);
    match report.outcome {
        Outcome::Solved(plan) => match objection(model, &request.state, &plan.operators) {
            None => Decision::Plan { operators: plan.operators, expanded: report.statistics.expanded },
            Some(why) => Decision::Rejected(why),
        },
        Outcome::Unsolvable(reason) => Decision::NoPlan(unsolvable(model, &reason, &request.barred)),
        Outcome::Unsupported(feature) => {
            Decision::Rejected(format!("the planner does not support {feature}"))
        }
        Outcome::LimitReached(_) => Decision::LimitReached(request.expansions),
    }
}

/// What the validator, which shares nothing with the planner, says against the plan.
fn objection(model: &Model, state: &State, plan: &[OperatorId]) -> Option<String> {
    let steps = plan
        .iter()
        .map(|&operator| {
            let operator = &model.task().operators()[operator];
            let arguments = operator.arguments.to_vec();
            pddl::PlanStep { action: operator.action, arguments, span: pddl::Span::default() }
        })
        .collect();
    let (problem, plan) = (model.problem_in(state), pddl::SequentialPlan::new(steps));
    let verdict = validator::validate(model.domain(), &problem, &plan);
    validator::explain(model.domain(), &problem, &plan, &verdict).map(|finding| finding.sentence)
}

/// Says why there is no plan: what can never hold, or that all was tried, and what had to be left out.
fn unsolvable(model: &Model, reason: &UnsolvableReason, barred: &[Step]) -> String {
    let mut why = match reason {
        UnsolvableReason::Impossible(_) => "the goal cannot be reached from here".to_owned(),
        UnsolvableReason::SpaceExhausted => "no sequence of steps reaches the goal from here".to_owned(),
    };
    if let UnsolvableReason::Impossible(Impossible::Atoms(atoms)) = reason {
        let atoms: Vec<_> = atoms.iter().map(|atom| model.atom(atom).to_string()).collect();
        why = format!("nothing can bring about {}", atoms.join(", "));
    }
    if !barred.is_empty() {
        let steps: Vec<_> = barred.iter().map(ToString::to_string).collect();
        why = format!("{why} without what just failed: {}", steps.join(", "));
    }
    why
}
