//! The goals of a mission for the executive.
//!
//! What makes a goal wanted, holds it and ends it are conditions over what is perceived. Each becomes one more axiom of the
//! perception, of a predicate without parameters whose name no text can have, so that it is evaluated and explained like
//! all others.

use executive::{GoalText, Importance};
use low_to_high::Fact;
use mission::{Mission, MissionGoal, Perceived, Worth};
use pddl::Span;
use pddl::model::{Axiom, Domain, Idx, Name, Predicate, PredicateId, Variables};
use std::collections::BTreeSet;

/// The perception of a mission with the conditions of its goals, and their places in `mission.toml`.
pub(crate) fn perception(mission: &Mission) -> (Domain, BTreeSet<Span>) {
    let mut domain = mission.layers.perception.model.clone();
    let mut places = BTreeSet::new();
    for goal in &mission.goals {
        for (fact, perceived) in conditions(goal) {
            let predicate = PredicateId::from_index(domain.predicates.len());
            // Like an imported predicate, it has no place in this source.
            let (variables, span) = (Variables::default(), Span::default());
            domain.predicates.push(Predicate { name: fact.predicate, variables, derived: true, span });
            let Perceived { condition, variables, span } = perceived.clone();
            domain.axioms.push(Axiom { predicate, variables, body: condition, span });
            places.insert(span);
        }
    }
    (domain, places)
}

/// The goals as the executive reads them.
pub(crate) fn texts(mission: &Mission) -> Vec<GoalText> {
    let text = |goal: &MissionGoal| GoalText {
        name: goal.name.clone(),
        condition: goal.condition.clone(),
        variables: goal.variables.clone(),
        importance: match goal.worth {
            Worth::Priority(priority) => Importance::Hard(i64::from(priority)),
            Worth::Penalty(penalty) => Importance::Soft(penalty),
        },
        when: goal.when.as_ref().map(|_| fact("wanted", goal)),
        hold: goal.hold.as_ref().map(|_| fact("held", goal)),
        drop: goal.drop.as_ref().map(|_| fact("dropped", goal)),
        deadline: goal.deadline,
        urgent: goal.urgent,
        maintained: goal.maintained,
    };
    mission.goals.iter().map(text).collect()
}

/// The conditions of a goal, and the fact that each derives.
fn conditions(goal: &MissionGoal) -> impl Iterator<Item = (Fact, &Perceived)> {
    let all = [("wanted", &goal.when), ("held", &goal.hold), ("dropped", &goal.drop)];
    all.into_iter().filter_map(|(what, condition)| Some((fact(what, goal), condition.as_ref()?)))
}

/// A blank cannot stand in a name of PDDL.
fn fact(what: &str, goal: &MissionGoal) -> Fact {
    Fact { predicate: Name::new(&format!("{what} {}", goal.name)), arguments: Vec::new() }
}
