//! Whatever has variables and a body, as one thing: lints about variables and atoms need not know which it is.

use pddl::Span;
use pddl::model::{Action, Axiom, Domain, DurativeAction, Method, SubtaskHead, TaskNetwork, Term, Variables};

use crate::walk::{self, Part, Polarity};

/// Something with variables and a body.
#[derive(Clone, Copy)]
pub(crate) enum Schema<'a> {
    Action(&'a Action),
    Durative(&'a DurativeAction),
    Axiom(&'a Axiom),
    Method(&'a Method),
}

impl<'a> Schema<'a> {
    /// What to call it: ``action `go` ``.
    pub(crate) fn title(&self, domain: &Domain) -> String {
        match self {
            Self::Action(action) => format!("action `{}`", action.name),
            Self::Durative(action) if action.rule.is_some() => format!("rule `{}`", action.name),
            Self::Durative(action) => format!("action `{}`", action.name),
            Self::Axiom(axiom) => format!("axiom of `{}`", domain.predicates[axiom.predicate].name),
            Self::Method(method) => format!("method `{}`", method.name),
        }
    }

    pub(crate) fn variables(&self) -> &'a Variables {
        match self {
            Self::Action(action) => &action.variables,
            Self::Durative(action) => &action.variables,
            Self::Axiom(axiom) => &axiom.variables,
            Self::Method(method) => &method.variables,
        }
    }

    #[allow(dead_code, reason = "the first lint that needs it comes next")]
    pub(crate) fn span(&self) -> Span {
        match self {
            Self::Action(action) => action.name_span,
            Self::Durative(action) => action.name_span,
            Self::Axiom(axiom) => axiom.span,
            Self::Method(method) => method.span,
        }
    }

    /// Everything that it says, part by part.
    pub(crate) fn parts(&self, f: &mut dyn FnMut(Part<'a>)) {
        match self {
            Self::Action(action) => {
                walk::condition(&action.precondition, Polarity::Positive, f);
                action.preferences.iter().for_each(|p| walk::preference(p, &p.body, f));
                walk::effect(&action.effect, f);
            }
            Self::Durative(action) => {
                action.duration.iter().for_each(|d| walk::expression(&d.bound, f));
                action.conditions.iter().for_each(|c| walk::condition(&c.condition, Polarity::Positive, f));
                action.preferences.iter().for_each(|p| walk::preference(p, &p.body.condition, f));
                action.effects.iter().for_each(|e| walk::effect(&e.effect, f));
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
        }
    }
}

/// What a task network names.
pub(crate) fn network<'a>(network: &'a TaskNetwork, f: &mut dyn FnMut(Part<'a>)) {
    for subtask in &network.subtasks {
        let head: SubtaskHead = subtask.head;
        f(Part::Subtask(head));
        subtask.arguments.iter().for_each(|&term| f(Part::Term(term)));
    }
}
