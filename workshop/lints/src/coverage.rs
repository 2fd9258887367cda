//! Which features of the language the lints know.

use pddl::model::{Domain, Feature, Problem};

/// Whether lints see all that the domain says: what the language will have one day is unknown to them until it is
/// named here.
pub(crate) fn all_is_seen(domain: &Domain) -> bool {
    domain.unsupported.is_empty() && domain.features().iter().all(|(feature, _)| is_seen(*feature))
}

/// The same of a problem.
pub(crate) fn all_of_problem_is_seen(problem: &Problem) -> bool {
    problem.unsupported.is_empty() && problem.features().iter().all(|(feature, _)| is_seen(*feature))
}

fn is_seen(feature: Feature) -> bool {
    matches!(
        feature,
        Feature::Preferences
            | Feature::TrajectoryConstraints
            | Feature::TimedInitials
            | Feature::NetworkConstraints
            | Feature::TypePredicates
            | Feature::Processes
            | Feature::Events
            | Feature::ContinuousEffects
            | Feature::ConditionsAcrossTimes
            | Feature::DurationAtEnd
    )
}
