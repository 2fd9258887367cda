//! Actions, methods, axioms and the like as one thing, for lints about variables and atoms.

use pddl::Span;
use pddl::model::{
    Action, AssignOperator, Axiom, Condition, ContinuousEffect, Direction, Domain, DurativeAction, Effect,
    EffectKind, Event, Given, Method, Process, SubtaskHead, TaskNetwork, Term, TimeSpecifier, Variables,
};

use analysis::walk::{self, Part, Polarity};

/// Something with variables and a body.
#[derive(Clone, Copy)]
pub(crate) enum Schema<'a> {
    Action(&'a Action),
    Durative(&'a DurativeAction),
    Axiom(&'a Axiom),
    Method(&'a Method),
    Event(&'a Event),
    Process(&'a Process),
}

impl<'a> Schema<'a> {
    /// Its name in messages: ``action `go` ``.
    pub(crate) fn title(&self, domain: &Domain) -> String {
        match self {
            Self::Action(action) => format!("action `{}`", action.name),
            Self::Durative(action) if action.rule.is_some() => format!("rule `{}`", action.name),
            Self::Durative(action) => format!("action `{}`", action.name),
            Self::Axiom(axiom) => format!("axiom of `{}`", domain.predicates[axiom.predicate].name),
            Self::Method(method) => format!("method `{}`", method.name),
            Self::Event(event) => format!("event `{}`", event.name),
            Self::Process(process) => format!("process `{}`", process.name),
        }
    }

    pub(crate) fn variables(&self) -> &'a Variables {
        match self {
            Self::Action(action) => &action.variables,
            Self::Durative(action) => &action.variables,
            Self::Axiom(axiom) => &axiom.variables,
            Self::Method(method) => &method.variables,
            Self::Event(event) => &event.variables,
            Self::Process(process) => &process.variables,
        }
    }

    #[allow(dead_code, reason = "the first lint that needs it comes next")]
    pub(crate) fn span(&self) -> Span {
        match self {
            Self::Action(action) => action.name_span,
            Self::Durative(action) => action.name_span,
            Self::Axiom(axiom) => axiom.span,
            Self::Method(method) => method.span,
            Self::Event(event) => event.name_span,
            Self::Process(process) => process.name_span,
        }
    }

    /// Its conditions; those in one group must hold together.
    pub(crate) fn conditions(&self) -> Vec<Vec<&'a Condition>> {
        let mut groups = match self {
            Self::Action(action) => vec![vec![&action.precondition]],
            Self::Durative(action) => {
                let mut groups: Vec<(&TimeSpecifier, Vec<&Condition>)> = Vec::new();
                for part in &action.conditions {
                    match groups.iter_mut().find(|(when, _)| **when == part.when) {
                        Some((_, group)) => group.push(&part.condition),
                        None => groups.push((&part.when, vec![&part.condition])),
                    }
                }
                groups.into_iter().map(|(_, group)| group).collect()
            }
            Self::Axiom(axiom) => vec![vec![&axiom.body]],
            Self::Method(method) => vec![vec![&method.precondition]],
            Self::Event(event) => vec![vec![&event.precondition]],
            Self::Process(process) => vec![vec![&process.precondition]],
        };
        for effect in self.effects().into_iter().flatten() {
            guards(effect, &mut groups);
        }
        groups
    }

    /// Its effects; those in one group happen together.
    pub(crate) fn effects(&self) -> Vec<Vec<&'a Effect>> {
        match self {
            Self::Action(action) => vec![vec![&action.effect]],
            Self::Durative(action) => {
                let mut groups: Vec<(&TimeSpecifier, Vec<&Effect>)> = Vec::new();
                // What hangs on another time may not happen with the rest.
                let (plain, others): (Vec<_>, Vec<_>) =
                    action.effects.iter().partition(|effect| effect.given.is_empty());
                for part in plain {
                    match groups.iter_mut().find(|(when, _)| **when == part.when) {
                        Some((_, group)) => group.push(&part.effect),
                        None => groups.push((&part.when, vec![&part.effect])),
                    }
                }
                let others = others.into_iter().map(|effect| vec![&effect.effect]);
                groups.into_iter().map(|(_, group)| group).chain(others).collect()
            }
            Self::Event(event) => vec![vec![&event.effect]],
            Self::Axiom(_) | Self::Method(_) | Self::Process(_) => Vec::new(),
        }
    }

    /// Its conditions and effects, part by part.
    pub(crate) fn parts(&self, f: &mut dyn FnMut(Part<'a>)) {
        match self {
            Self::Action(action) => {
                walk::condition(&action.precondition, Polarity::Positive, f);
                action.preferences.iter().for_each(|p| walk::preference(p, &p.body, f));
                walk::effect(&action.effect, f);
            }
            Self::Durative(action) => {
                for bound in &action.duration {
                    bound.functions.iter().for_each(|function| f(Part::Reads(&function.application)));
                    walk::expression(&bound.bound, f);
                }
                action.conditions.iter().for_each(|c| walk::condition(&c.condition, Polarity::Positive, f));
                action.preferences.iter().for_each(|p| walk::preference(p, &p.body.condition, f));
                for effect in &action.effects {
                    for given in &effect.given {
                        match given {
                            Given::Forall(bound) => f(Part::Binds(bound)),
                            Given::When(asked) => {
                                asked
                                    .iter()
                                    .for_each(|c| walk::condition(&c.condition, Polarity::Positive, f));
                            }
                        }
                    }
                    walk::effect(&effect.effect, f);
                }
                continuous(&action.continuous, f);
                if let Some(rule) = &action.rule {
                    let arguments = rule.skill.iter().flat_map(|skill| &skill.arguments);
                    arguments.chain(&rule.claims).for_each(|&term| f(Part::Term(term)));
                }
            }
            Self::Axiom(axiom) => {
                f(Part::Derives(axiom.predicate));
                // The head's arguments are the parameters.
                axiom.variables.parameter_ids().for_each(|v| f(Part::Term(Term::Variable(v))));
                walk::condition(&axiom.body, Polarity::Positive, f);
            }
            Self::Method(method) => {
                method.task_arguments.iter().for_each(|&term| f(Part::Term(term)));
                walk::condition(&method.precondition, Polarity::Positive, f);
                network(&method.network, f);
            }
            Self::Event(event) => {
                walk::condition(&event.precondition, Polarity::Positive, f);
                walk::effect(&event.effect, f);
            }
            Self::Process(process) => {
                walk::condition(&process.precondition, Polarity::Positive, f);
                continuous(&process.effects, f);
            }
        }
    }
}

/// What changes with time.
fn continuous<'a>(effects: &'a [ContinuousEffect], f: &mut dyn FnMut(Part<'a>)) {
    for effect in effects {
        if !effect.forall.is_empty() {
            f(Part::Binds(&effect.forall));
        }
        effect.functions.iter().for_each(|function| f(Part::Reads(&function.application)));
        let operator = match effect.direction {
            Direction::Increase => AssignOperator::Increase,
            Direction::Decrease => AssignOperator::Decrease,
        };
        f(Part::Writes(operator, &effect.fluent));
        walk::expression(&effect.rate, f);
    }
}

/// The conditions of `when`, each a group of its own.
fn guards<'a>(effect: &'a Effect, groups: &mut Vec<Vec<&'a Condition>>) {
    match &effect.kind {
        EffectKind::And(parts) => parts.iter().for_each(|part| guards(part, groups)),
        EffectKind::Forall(_, inner) => guards(inner, groups),
        EffectKind::When(condition, inner) => {
            groups.push(vec![condition]);
            guards(inner, groups);
        }
        _ => {}
    }
}

/// What a task network names.
pub(crate) fn network<'a>(network: &'a TaskNetwork, f: &mut dyn FnMut(Part<'a>)) {
    network.constraints.iter().for_each(|c| walk::condition(c, Polarity::Positive, f));
    for subtask in &network.subtasks {
        let head: SubtaskHead = subtask.head;
        f(Part::Subtask(head));
        subtask.arguments.iter().for_each(|&term| f(Part::Term(term)));
    }
}
