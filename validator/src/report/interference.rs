//! How each of two interfering happenings accesses the shared atom or fluent.
//!
//! A verdict names two happenings and an atom or fluent. This module finds the effect or condition in the domain that
//! accesses it. It reads the model alone, so a conditional effect is named whether its condition held or not.

use crate::cause::Cause;
use crate::plan::PlanRef;
use crate::value::GroundAtom;
use crate::verdict::Shared;
use pddl::model::{
    Application, Condition, ConditionKind, Domain, Effect, EffectKind, Expression, ExpressionKind,
    GroundApplication, ObjectId, PredicateId, Term, TimeSpecifier, Variables,
};
use pddl::{Span, StepHead};

/// The kind of access.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Access {
    /// It adds the atom.
    Adds,
    /// It deletes the atom.
    Deletes,
    /// It changes the fluent.
    Changes,
    /// It needs the atom, the derived predicate or the fluent's value.
    Needs,
}

/// The access of a happening, and its place in the domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Interference {
    /// The kind of access.
    pub(super) access: Access,
    /// The effect or condition.
    pub(super) span: Span,
}

/// How a happening accesses the shared atom or fluent; `None` for timed changes, events, and
/// accesses outside conditions and effects.
pub(super) fn interference_of<'p>(
    domain: &Domain,
    plan: impl Into<PlanRef<'p>>,
    cause: Cause,
    over: &Shared,
) -> Option<Interference> {
    let index = cause.step()?.0 as usize;
    let (head, arguments) = match plan.into() {
        PlanRef::Sequential(plan) => {
            plan.steps.get(index).map(|s| (StepHead::Action(s.action), s.arguments.as_slice()))
        }
        PlanRef::Temporal(plan) => plan.steps.get(index).map(|s| (s.head, s.arguments.as_slice())),
        PlanRef::Hierarchical(_) => None,
    }?;
    match head {
        StepHead::Action(id) => {
            let action = domain.actions.get(id)?;
            let search = Search { variables: &action.variables, arguments, over };
            search.effect(&action.effect).or_else(|| search.condition(&action.precondition))
        }
        StepHead::DurativeAction(id) => {
            let action = domain.durative_actions.get(id)?;
            let search = Search { variables: &action.variables, arguments, over };
            let when = if matches!(cause, Cause::End(_)) { TimeSpecifier::End } else { TimeSpecifier::Start };
            let mut effects = action.effects.iter().filter(|timed| timed.when == when);
            let mut conditions = action.conditions.iter().filter(|timed| timed.when == when);
            let mut bounds = action.duration.iter().filter(|bound| bound.when == when);
            effects
                .find_map(|timed| search.effect(&timed.effect))
                .or_else(|| conditions.find_map(|timed| search.condition(&timed.condition)))
                .or_else(|| bounds.find_map(|bound| search.expression(&bound.bound)))
        }
    }
}

struct Search<'s> {
    variables: &'s Variables,
    arguments: &'s [ObjectId],
    over: &'s Shared,
}

impl Search<'_> {
    /// Whether the terms may denote the objects; quantified variables may denote anything.
    fn fits(&self, terms: &[Term], objects: &[ObjectId]) -> bool {
        let fits = |(&term, &object): (&Term, &ObjectId)| match term {
            Term::Object(same) => same == object,
            Term::Variable(variable) => {
                let place = self.variables.parameter_ids().position(|parameter| parameter == variable);
                place.and_then(|place| self.arguments.get(place)).is_none_or(|&given| given == object)
            }
        };
        terms.iter().zip(objects).all(fits)
    }

    fn atom(&self) -> Option<&GroundAtom> {
        match self.over {
            Shared::Atom(atom) | Shared::Derived { atom, .. } => Some(atom),
            Shared::Fluent(_) => None,
        }
    }

    fn is_atom(&self, predicate: PredicateId, terms: &[Term]) -> bool {
        self.atom().is_some_and(|atom| atom.predicate == predicate && self.fits(terms, &atom.arguments))
    }

    fn is_fluent(&self, application: &Application) -> bool {
        let Shared::Fluent(GroundApplication { function, arguments }) = self.over else { return false };
        application.function == *function && self.fits(&application.arguments, arguments)
    }

    fn effect(&self, effect: &Effect) -> Option<Interference> {
        let found = |access| Some(Interference { access, span: effect.span });
        match &effect.kind {
            EffectKind::And(parts) => parts.iter().find_map(|part| self.effect(part)),
            EffectKind::Forall(_, body) => self.effect(body),
            EffectKind::When(condition, body) => self.effect(body).or_else(|| self.condition(condition)),
            EffectKind::Add(atom) if self.is_atom(atom.predicate, &atom.arguments) => found(Access::Adds),
            EffectKind::Delete(atom) if self.is_atom(atom.predicate, &atom.arguments) => {
                found(Access::Deletes)
            }
            EffectKind::Assign(_, application, _) if self.is_fluent(application) => found(Access::Changes),
            EffectKind::Add(_) | EffectKind::Delete(_) | EffectKind::Assign(..) => None,
        }
    }

    fn condition(&self, condition: &Condition) -> Option<Interference> {
        let found = |so: bool| so.then_some(Interference { access: Access::Needs, span: condition.span });
        match &condition.kind {
            ConditionKind::Atom(atom) => {
                let derived =
                    matches!(self.over, Shared::Derived { predicate, .. } if *predicate == atom.predicate);
                found(derived || self.is_atom(atom.predicate, &atom.arguments))
            }
            ConditionKind::Compare(_, left, right) => {
                self.expression(left).or_else(|| self.expression(right))
            }
            ConditionKind::FluentIs(application, _) => found(self.is_fluent(application)),
            _ => condition.parts().find_map(|part| self.condition(part)),
        }
    }

    fn expression(&self, expression: &Expression) -> Option<Interference> {
        match &expression.kind {
            ExpressionKind::Fluent(application) => self
                .is_fluent(application)
                .then_some(Interference { access: Access::Needs, span: expression.span }),
            ExpressionKind::Arithmetic(_, operands) => operands.iter().find_map(|part| self.expression(part)),
            ExpressionKind::Number(_)
            | ExpressionKind::Duration
            | ExpressionKind::TotalTime
            | ExpressionKind::IsViolated(_) => None,
        }
    }
}
