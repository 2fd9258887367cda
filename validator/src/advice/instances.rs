//! Instances of actions that achieve a want, or that are applicable in a state.
//!
//! An effect that matches the want fixes the parameters that occur in it. Joining the condition with the state finds
//! the others.

use super::wants::{Want, Wants};
use crate::condition::Strictness;
use crate::prepared::Prepared;
use crate::scene::{Binding, Clock};
use crate::state::State;
use pddl::model::{ActionId, Condition, Effect, EffectKind, ObjectId, Term, TimeSpecifier, Variables};
use pddl::{PlanStep, Span};
use std::ops::ControlFlow;

/// The most instances of an action that are tried for one effect in one state.
const INSTANCES: usize = 64;

/// The parameters that are already fixed.
pub(super) type Fixed = Vec<Option<ObjectId>>;

/// The parameters with which an effect achieves a want.
pub(super) fn each_match(
    prepared: &Prepared<'_>,
    variables: &Variables,
    effect: &Effect,
    want: &Want,
    visit: &mut dyn FnMut(Fixed),
) {
    let mut unify = |terms: &[Term], objects: &[ObjectId]| {
        visit_unified(prepared, variables, terms, objects, visit);
    };
    match (&effect.kind, want) {
        (EffectKind::And(parts), _) => {
            parts.iter().for_each(|part| each_match(prepared, variables, part, want, visit));
        }
        (EffectKind::Forall(_, body) | EffectKind::When(_, body), _) => {
            each_match(prepared, variables, body, want, visit);
        }
        (EffectKind::Add(atom), Want::Holds(wanted)) | (EffectKind::Delete(atom), Want::HoldsNot(wanted))
            if atom.predicate == wanted.predicate =>
        {
            unify(&atom.arguments, &wanted.arguments);
        }
        (EffectKind::Assign(_, application, _), Want::Another(wanted))
            if application.function == wanted.function =>
        {
            unify(&application.arguments, &wanted.arguments);
        }
        _ => {}
    }
}

/// Quantified variables may be anything.
fn visit_unified(
    prepared: &Prepared<'_>,
    variables: &Variables,
    terms: &[Term],
    objects: &[ObjectId],
    visit: &mut dyn FnMut(Fixed),
) {
    let mut fixed = vec![None; variables.parameters];
    for (&term, &object) in terms.iter().zip(objects) {
        match term {
            Term::Object(same) if same == object => {}
            Term::Object(_) => return,
            Term::Variable(variable) => {
                let Some(place) = variables.parameter_ids().position(|parameter| parameter == variable)
                else {
                    continue;
                };
                let fits = prepared.universe.extent(&variables[variable].types);
                if !fits.contains(object) || fixed[place].is_some_and(|other| other != object) {
                    return;
                }
                fixed[place] = Some(object);
            }
        }
    }
    visit(fixed);
}

/// An action with its fixed parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Template {
    pub(super) action: ActionId,
    pub(super) fixed: Fixed,
}

/// The actions that could achieve a want.
pub(super) fn templates(prepared: &Prepared<'_>, wants: &Wants) -> Vec<Template> {
    let mut templates = Vec::new();
    for (action, schema) in prepared.domain.actions.enumerate() {
        for want in &wants.list {
            each_match(prepared, &schema.variables, &schema.effect, want, &mut |fixed| {
                let template = Template { action, fixed };
                if !templates.contains(&template) {
                    templates.push(template);
                }
            });
        }
    }
    templates
}

/// Whether a step may achieve a want.
pub(super) fn may_help(prepared: &Prepared<'_>, wants: &[Want], step: &PlanStep) -> bool {
    let Some(schema) = prepared.domain.actions.get(step.action) else { return false };
    let mut helps = false;
    for want in wants {
        each_match(prepared, &schema.variables, &schema.effect, want, &mut |fixed| {
            helps |= fixed.iter().zip(&step.arguments).all(|(f, a)| f.is_none_or(|object| object == *a));
        });
    }
    helps
}

/// The steps that differ from a step in one argument and may achieve a want.
pub(super) fn nearly(prepared: &Prepared<'_>, wants: &[Want], step: &PlanStep) -> Vec<PlanStep> {
    let Some(schema) = prepared.domain.actions.get(step.action) else { return Vec::new() };
    let mut found: Vec<PlanStep> = Vec::new();
    for want in wants {
        each_match(prepared, &schema.variables, &schema.effect, want, &mut |fixed| {
            let changed = fixed.iter().zip(&step.arguments).filter(|(f, a)| f.is_some_and(|o| o != **a));
            if changed.count() == 1 {
                let arguments: Vec<ObjectId> =
                    fixed.iter().zip(&step.arguments).map(|(f, &a)| f.unwrap_or(a)).collect();
                if !found.iter().any(|other| other.arguments == arguments) {
                    found.push(PlanStep { action: step.action, arguments, span: step.span });
                }
            }
        });
    }
    found
}

/// A state whose applicable steps are searched.
pub(super) struct Look<'l, 'a> {
    pub(super) prepared: &'l Prepared<'a>,
    pub(super) state: &'l State,
}

impl Look<'_, '_> {
    /// The arguments with which `conditions` hold here.
    pub(super) fn applicable(
        &self,
        variables: &Variables,
        conditions: &[&Condition],
        fixed: &[Option<ObjectId>],
        visit: &mut dyn FnMut(Vec<ObjectId>),
    ) {
        let mut binding = Binding::new(variables, &[]);
        let mut open = Vec::new();
        for (parameter, object) in variables.parameter_ids().zip(fixed) {
            match object {
                Some(object) => binding.set(parameter, Some(*object)),
                None => open.push(parameter),
            }
        }
        let scene = self.prepared.scene(self.state, variables, Clock::steps(0));
        if open.is_empty() {
            if conditions.iter().all(|condition| scene.holds(condition, &mut binding)) {
                visit(fixed.iter().copied().flatten().collect());
            }
            return;
        }
        let mut left = INSTANCES;
        let guards: Vec<_> = conditions.iter().map(|&condition| (condition, true)).collect();
        let flow = scene.each_binding(&open, &guards, Strictness::Certain, &mut binding, &mut |binding| {
            visit(variables.parameter_ids().filter_map(|p| binding.get(p)).collect());
            left -= 1;
            if left == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        debug_assert_eq!(flow.is_break(), left == 0);
    }

    /// The instances of an action that are applicable here.
    pub(super) fn steps(&self, template: &Template, visit: &mut dyn FnMut(PlanStep)) {
        let Some(schema) = self.prepared.domain.actions.get(template.action) else { return };
        self.applicable(&schema.variables, &[&schema.precondition], &template.fixed, &mut |arguments| {
            visit(PlanStep { action: template.action, arguments, span: Span::default() });
        });
    }

    /// The steps that differ from a step in one argument and are applicable here.
    pub(super) fn others(&self, step: &PlanStep, visit: &mut dyn FnMut(PlanStep)) {
        for free in 0..step.arguments.len() {
            let mut fixed: Fixed = step.arguments.iter().copied().map(Some).collect();
            fixed[free] = None;
            let template = Template { action: step.action, fixed };
            self.steps(&template, &mut |other| {
                if other.arguments != step.arguments {
                    visit(PlanStep { span: step.span, ..other });
                }
            });
        }
    }

    /// All steps that are applicable here.
    pub(super) fn all(&self, visit: &mut dyn FnMut(PlanStep)) {
        for (action, schema) in self.prepared.domain.actions.enumerate() {
            let fixed = vec![None; schema.variables.parameters];
            self.steps(&Template { action, fixed }, visit);
        }
    }
}

/// A durative action's conditions at a time.
pub(super) fn conditions_at<'d>(
    action: &'d pddl::model::DurativeAction,
    when: &TimeSpecifier,
) -> Vec<&'d Condition> {
    action.conditions.iter().filter(|timed| timed.when == *when).map(|timed| &timed.condition).collect()
}
