//! Checking a plan for a task network that does not give its decomposition: a search finds one.

use super::decomposed;
use super::schema::Schema;
use super::search;
use crate::prepared::Prepared;
use crate::sequential;
use crate::state::State;
use crate::trace::Trace;
use crate::verdict::{Feature, NetworkFault, Stop, Unsupported, Valid};
use crate::work::Work;
use pddl::SequentialPlan;

/// Judges a plan without a decomposition: finds a decomposition and judges that.
pub(crate) fn run(
    prepared: &Prepared<'_>,
    plan: &SequentialPlan,
    state: &mut State,
    trace: Option<&mut Trace>,
) -> Result<Valid, Stop> {
    let unsupported = |feature, span| Err(Stop::Unsupported(Unsupported { feature, span }));
    let goal_span = prepared.problem.goal_span;
    let Some((variables, network)) = &prepared.problem.htn else {
        return Err(NetworkFault::NoNetwork.into());
    };
    if let Some(span) = Schema::of_problem(variables, network).durative() {
        return unsupported(Feature::DurativeSubtaskOfProblem, span);
    }
    sequential::run(prepared, plan.steps.iter(), state, trace, &mut |_, _| ())?;
    if state.work.is_exhausted() {
        return unsupported(Feature::TooMuch, goal_span);
    }
    let span = network.subtasks.first().map_or(goal_span, |subtask| subtask.span);
    match search::search(prepared, plan) {
        search::Outcome::Found(found) => {
            let mut state = prepared.initial.clone();
            state.work = Work::for_steps(plan.steps.len());
            match decomposed::run(prepared, &found, &mut state, None) {
                Ok(valid) if !state.work.is_exhausted() => {
                    Ok(Valid { decomposition: Some(Box::new(found)), ..valid })
                }
                other => {
                    let refused = matches!(other, Err(Stop::Failure(_)));
                    debug_assert!(!refused, "what was found is a decomposition: {other:?}");
                    unsupported(Feature::DecompositionLimit, span)
                }
            }
        }
        search::Outcome::None(shortfall) => {
            // The search ignores methods with durative actions.
            let mut methods = prepared.domain.methods.iter();
            match methods.find_map(|method| Schema::of_method(method).durative()) {
                Some(span) => unsupported(Feature::DurativeSubtaskOfDomain, span),
                None => Err(NetworkFault::NoDecomposition { shortfall }.into()),
            }
        }
        search::Outcome::Limit => unsupported(Feature::DecompositionLimit, span),
    }
}
