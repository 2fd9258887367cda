//! What changes the state: actions, events, starts and ends of durative actions, outcomes of rules.
//!
//! Problem: every analysis asks the same of each of them: under which conditions it happens, and
//! which effects it has. Idea: one flat list; what changes continuously is not in it. Invariant: a
//! happening's conditions are at most those of any plan in which it happens, so that an analysis that
//! follows the list misses nothing.

use pddl::model::{Condition, Domain, Effect, TimeSpecifier, Variables};

use crate::reachability::{Part, Schema};

/// One of them.
pub(crate) struct Happening<'a> {
    /// What it belongs to.
    pub(crate) schema: Schema,
    /// Which part of it.
    pub(crate) part: Part,
    /// The schema's variables.
    pub(crate) variables: &'a Variables,
    /// What it needs, then or before.
    pub(crate) conditions: Vec<&'a Condition>,
    /// What surely holds just before, with no other happening between.
    pub(crate) just_before: Vec<&'a Condition>,
    /// What it does.
    pub(crate) effects: Vec<&'a Effect>,
}

impl<'a> From<Happening<'a>> for analysis::invariants::Happening<'a> {
    fn from(of: Happening<'a>) -> Self {
        Self { variables: of.variables, just_before: of.just_before, effects: of.effects }
    }
}

/// All that a domain has.
pub(crate) fn happenings(domain: &Domain) -> Vec<Happening<'_>> {
    let mut all = Vec::new();
    for (id, action) in domain.actions.enumerate() {
        all.push(Happening {
            schema: Schema::Action(id),
            part: Part::Whole,
            variables: &action.variables,
            conditions: vec![&action.precondition],
            just_before: vec![&action.precondition],
            effects: vec![&action.effect],
        });
    }
    for (id, event) in domain.events.enumerate() {
        all.push(Happening {
            schema: Schema::Event(id),
            part: Part::Whole,
            variables: &event.variables,
            conditions: vec![&event.precondition],
            just_before: vec![&event.precondition],
            effects: vec![&event.effect],
        });
    }
    for (id, action) in domain.durative_actions.enumerate() {
        let mut parts = vec![Part::Start, Part::End];
        for effect in &action.effects {
            if let TimeSpecifier::Outcome(name) = &effect.when {
                let part = Part::Outcome(name.clone());
                if !parts.contains(&part) {
                    parts.push(part);
                }
            }
        }
        for part in parts {
            let at = |when: &TimeSpecifier| match (when, &part) {
                (TimeSpecifier::Start, Part::Start) | (TimeSpecifier::End, Part::End) => true,
                (TimeSpecifier::Outcome(name), Part::Outcome(own)) => name == own,
                _ => false,
            };
            let now =
                |when: &TimeSpecifier| at(when) || (part == Part::End && *when == TimeSpecifier::OverAll);
            let needed = |when: &TimeSpecifier| part == Part::End || *when == TimeSpecifier::Start;
            all.push(Happening {
                schema: Schema::Durative(id),
                variables: &action.variables,
                conditions: action
                    .conditions
                    .iter()
                    .filter(|c| needed(&c.when))
                    .map(|c| &c.condition)
                    .collect(),
                just_before: action
                    .conditions
                    .iter()
                    .filter(|c| now(&c.when))
                    .map(|c| &c.condition)
                    .collect(),
                effects: action.effects.iter().filter(|e| at(&e.when)).map(|e| &e.effect).collect(),
                part,
            });
        }
    }
    all
}
