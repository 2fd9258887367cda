//! What changes the state: actions, events, starts and ends of durative actions, outcomes of agents' rules.
//!
//! Problem: every analysis asks the same of each of them: under which conditions it happens, and which effects it has.
//! Idea: one flat list, without continuous changes. Invariant: the conditions of a happening hold in every plan in which
//! it happens, so that an analysis that follows the list misses nothing.

use pddl::Span;
use pddl::model::{
    Action, ActionId, Condition, Domain, DurativeActionId, Effect, EventId, MethodId, Name, TimeSpecifier,
    Variables,
};

/// A part of a model that has conditions.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Schema {
    /// An instantaneous action.
    Action(ActionId),
    /// A durative action.
    Durative(DurativeActionId),
    /// An axiom, by position.
    Axiom(usize),
    /// An event of PDDL+.
    Event(EventId),
    /// A method.
    Method(MethodId),
    /// A conjunct of the goal, by position.
    Goal(usize),
    /// A subtask of the problem's network, by position.
    Initial(usize),
}

impl Schema {
    /// Its variables; `None` for what belongs to the problem.
    pub fn variables<'d>(&self, domain: &'d Domain) -> Option<&'d Variables> {
        Some(match self {
            Self::Action(id) => &domain.actions[*id].variables,
            Self::Durative(id) => &domain.durative_actions[*id].variables,
            Self::Axiom(i) => &domain.axioms[*i].variables,
            Self::Method(id) => &domain.methods[*id].variables,
            Self::Event(id) => &domain.events[*id].variables,
            Self::Goal(_) | Self::Initial(_) => return None,
        })
    }

    /// The place of its name in the domain; the default span for what belongs to the problem.
    pub fn span(&self, domain: &Domain) -> Span {
        match self {
            Self::Action(id) => domain.actions[*id].name_span,
            Self::Durative(id) => domain.durative_actions[*id].name_span,
            Self::Axiom(i) => domain.axioms[*i].span,
            Self::Method(id) => domain.methods[*id].span,
            Self::Event(id) => domain.events[*id].name_span,
            Self::Goal(_) | Self::Initial(_) => Span::default(),
        }
    }
}

/// Which phase of a schema.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Phase {
    /// All of it: an action, an axiom, a method.
    Whole,
    /// The start of a durative action.
    Start,
    /// Its end.
    End,
    /// Another outcome of an agent's rule.
    Outcome(Name),
}

/// One change of the state at one moment.
#[derive(Clone, Debug)]
pub struct Happening<'a> {
    /// The schema that it belongs to.
    pub schema: Schema,
    /// Which phase of it.
    pub phase: Phase,
    /// The schema's variables.
    pub variables: &'a Variables,
    /// The conditions that hold then or held before.
    pub conditions: Vec<&'a Condition>,
    /// The conditions that hold just before, with no other happening between.
    pub just_before: Vec<&'a Condition>,
    /// Its effects.
    pub effects: Vec<&'a Effect>,
}

impl<'a> Happening<'a> {
    /// An action that takes no time.
    pub fn of_action(id: ActionId, action: &'a Action) -> Self {
        Self {
            schema: Schema::Action(id),
            phase: Phase::Whole,
            variables: &action.variables,
            conditions: vec![&action.precondition],
            just_before: vec![&action.precondition],
            effects: vec![&action.effect],
        }
    }
}

/// All happenings of a domain.
pub fn happenings(domain: &Domain) -> Vec<Happening<'_>> {
    let mut all: Vec<Happening<'_>> =
        domain.actions.enumerate().map(|(id, action)| Happening::of_action(id, action)).collect();
    for (id, event) in domain.events.enumerate() {
        all.push(Happening {
            schema: Schema::Event(id),
            phase: Phase::Whole,
            variables: &event.variables,
            conditions: vec![&event.precondition],
            just_before: vec![&event.precondition],
            effects: vec![&event.effect],
        });
    }
    for (id, action) in domain.durative_actions.enumerate() {
        let mut phases = vec![Phase::Start, Phase::End];
        for effect in &action.effects {
            if let TimeSpecifier::Outcome(name) = &effect.when {
                let phase = Phase::Outcome(name.clone());
                if !phases.contains(&phase) {
                    phases.push(phase);
                }
            }
        }
        for phase in phases {
            let at = |when: &TimeSpecifier| match (when, &phase) {
                (TimeSpecifier::Start, Phase::Start) | (TimeSpecifier::End, Phase::End) => true,
                (TimeSpecifier::Outcome(name), Phase::Outcome(own)) => name == own,
                _ => false,
            };
            let now =
                |when: &TimeSpecifier| at(when) || (phase == Phase::End && *when == TimeSpecifier::OverAll);
            let needed = |when: &TimeSpecifier| phase == Phase::End || *when == TimeSpecifier::Start;
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
                phase,
            });
        }
    }
    all
}
