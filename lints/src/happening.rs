//! What changes the state: actions, events, starts and ends of durative actions, outcomes of rules.
//!
//! Problem: every analysis asks the same of each of them: under which conditions it happens, and
//! which effects it has. Idea: one flat list; what changes continuously is not in it. Invariant: a
//! happening's conditions are at most those of any plan in which it happens, so that an analysis that
//! follows the list misses nothing.

use pddl::model::{
    Application, AssignOperator, AssignedValue, Atom, Condition, Domain, Effect, EffectKind, TimeSpecifier,
    VariableId, Variables,
};

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

/// An effect without its connectives.
pub(crate) enum Change<'a> {
    /// An atom becomes true.
    Add(&'a Atom),
    /// An atom becomes false.
    Delete(&'a Atom),
    /// A fluent changes.
    Assign(AssignOperator, &'a Application, &'a AssignedValue),
}

/// Where a change stands: under which conditions, for all values of which slots.
#[derive(Clone, Default)]
pub(crate) struct Context<'a> {
    /// The conditions of the `when`s around it.
    pub(crate) when: Vec<&'a Condition>,
    /// The slots of the `forall`s around it.
    pub(crate) forall: Vec<VariableId>,
}

/// Visits every change of an effect.
pub(crate) fn changes<'a>(effect: &'a Effect, visit: &mut dyn FnMut(&Context<'a>, &Change<'a>)) {
    walk(effect, &mut Context::default(), visit);
}

fn walk<'a>(effect: &'a Effect, context: &mut Context<'a>, visit: &mut dyn FnMut(&Context<'a>, &Change<'a>)) {
    match &effect.kind {
        EffectKind::And(parts) => parts.iter().for_each(|p| walk(p, context, visit)),
        EffectKind::Add(atom) => visit(context, &Change::Add(atom)),
        EffectKind::Delete(atom) => visit(context, &Change::Delete(atom)),
        EffectKind::Assign(operator, application, value) => {
            visit(context, &Change::Assign(*operator, application, value));
        }
        EffectKind::Forall(variables, inner) => {
            context.forall.extend(variables);
            walk(inner, context, visit);
            context.forall.truncate(context.forall.len() - variables.len());
        }
        EffectKind::When(condition, inner) => {
            context.when.push(condition);
            walk(inner, context, visit);
            context.when.pop();
        }
    }
}
