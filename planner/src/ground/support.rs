//! Rejects models with features that forward search does not support.

use super::error::{Feature, GroundError, Origin};
use pddl::Diagnostic;
use pddl::model::{Domain, Feature as Language, Problem};

/// Rejects the first unsupported feature, with its name and span.
pub(crate) fn refuse(domain: &Domain, problem: &Problem) -> Result<(), GroundError> {
    let refuse = |feature, origin, span| Err(GroundError::Unsupported { feature, origin, span });
    let first = |list: &[Diagnostic]| list.first().map(|d| d.span);
    if let Some(span) = first(&domain.unsupported) {
        return refuse(Feature::OutsideTheModel, Origin::Domain, span);
    }
    if let Some(span) = first(&problem.unsupported) {
        return refuse(Feature::OutsideTheModel, Origin::Problem, span);
    }
    // Grounding evaluates type predicates, and the planner does not read methods.
    let is_read = |feature| !matches!(feature, Language::TypePredicates | Language::NetworkConstraints);
    if let Some((feature, span)) = domain.features().into_iter().find(|(f, _)| is_read(*f)) {
        return refuse(Feature::Language(feature), Origin::Domain, span);
    }
    if let Some((feature, span)) = problem.features().into_iter().find(|(f, _)| is_read(*f)) {
        return refuse(Feature::Language(feature), Origin::Problem, span);
    }
    if let Some(action) = domain.durative_actions.iter().next() {
        return refuse(Feature::DurativeActions, Origin::Domain, action.span);
    }
    if problem.htn.is_some() {
        return refuse(Feature::TaskNetwork, Origin::Problem, problem.goal_span);
    }
    Ok(())
}
