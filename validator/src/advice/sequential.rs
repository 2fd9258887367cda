//! Changes of a plan without times.

use super::{Repair, Trials, each_part, parts};
use crate::cause::Cause;
use crate::condition::Strictness;
use crate::run::Validator;
use crate::scene::{Binding, Clock};
use crate::sequential::before_each;
use crate::state::{GroundAtom, State};
use crate::verdict::{Failure, StepIndex, Unsatisfied};
use pddl::model::{Action, ActionId, Atom, Effect, EffectKind, ObjectId, Term};
use pddl::{PlanStep, SequentialPlan, Span};
use std::ops::ControlFlow;

/// How far before the failure a step is inserted.
const NEAR: usize = 8;

/// How many instances of an action are looked at for each atom and place.
const INSTANCES: usize = 64;

pub(super) fn repair(
    trials: &mut Trials<'_, '_>,
    plan: &SequentialPlan,
    failure: &Failure,
) -> Option<Repair> {
    let count = plan.steps.len();
    let fails = match failure {
        Failure::Precondition { at: Cause::Step(step), .. }
        | Failure::Effect { at: Cause::Step(step), .. }
        | Failure::Step { step, .. } => step.0 as usize,
        _ => count,
    };
    let lacks = Lacks::of(failure);
    for index in nearest(fails, count) {
        if trials.is_spent() {
            return None;
        }
        let mut steps = plan.steps.clone();
        steps.remove(index);
        if trials.passes((&SequentialPlan::new(steps)).into()) {
            return Some(Repair::Drop(step_index(index)));
        }
    }
    let (insertions, replacements) = instances(trials.validator, plan, fails, &lacks);
    for (before, step) in insertions {
        let mut steps = plan.steps.clone();
        steps.insert(before, step.clone());
        if trials.passes((&SequentialPlan::new(steps)).into()) {
            let PlanStep { action, arguments, .. } = step;
            return Some(Repair::Insert { before: step_index(before), action, arguments });
        }
    }
    for (step, before) in moves(fails, count, &lacks) {
        if trials.is_spent() {
            return None;
        }
        let mut steps = plan.steps.clone();
        let moved = steps.remove(step);
        steps.insert(if before > step { before - 1 } else { before }, moved);
        if trials.passes((&SequentialPlan::new(steps)).into()) {
            return Some(Repair::Move { step: step_index(step), before: step_index(before) });
        }
    }
    for (index, arguments) in replacements {
        let mut steps = plan.steps.clone();
        steps[index].arguments.clone_from(&arguments);
        if trials.passes((&SequentialPlan::new(steps)).into()) {
            return Some(Repair::Replace { step: step_index(index), arguments });
        }
    }
    None
}

fn step_index(index: usize) -> StepIndex {
    StepIndex(u32::try_from(index).unwrap_or(u32::MAX))
}

/// All positions, those next to `middle` first.
fn nearest(middle: usize, count: usize) -> Vec<usize> {
    let mut all: Vec<usize> = (0..count).collect();
    all.sort_by_key(|&index| index.abs_diff(middle));
    all
}

/// What a failure asks for.
struct Lacks {
    missing: Vec<GroundAtom>,
    present: Vec<GroundAtom>,
    culprits: Vec<usize>,
}

impl Lacks {
    fn of(failure: &Failure) -> Self {
        let mut lacks = Self { missing: Vec::new(), present: Vec::new(), culprits: Vec::new() };
        each_part(parts(failure), &mut |part| {
            let (atom, by, into) = match part {
                Unsatisfied::Missing { atom, deleted_by, .. } => (atom, deleted_by, &mut lacks.missing),
                Unsatisfied::Present { atom, added_by, .. } => (atom, added_by, &mut lacks.present),
                _ => return,
            };
            into.push(atom.clone());
            lacks.culprits.extend(by.and_then(Cause::step).map(|step| step.0 as usize));
        });
        lacks
    }
}

/// The failing step and those that are to blame, each to everywhere, near places first; then later steps to before
/// the failing one.
fn moves(fails: usize, count: usize, lacks: &Lacks) -> Vec<(usize, usize)> {
    let mut moves = Vec::new();
    let movable = std::iter::once(fails).chain(lacks.culprits.iter().copied()).filter(|&step| step < count);
    for step in movable {
        let places = nearest(step, count + 1).into_iter().filter(|&b| b != step && b != step + 1);
        moves.extend(places.map(|before| (step, before)));
    }
    moves.extend((fails + 1..count).map(|step| (step, fails)));
    moves
}

type Insertions = Vec<(usize, PlanStep)>;
type Replacements = Vec<(usize, Vec<ObjectId>)>;

/// The steps that could be taken near to the failure and change what it asks for, and other arguments with which the
/// steps there could be taken.
fn instances(
    validator: &Validator<'_>,
    plan: &SequentialPlan,
    fails: usize,
    lacks: &Lacks,
) -> (Insertions, Replacements) {
    let mut insertions = Vec::new();
    let mut replacements = Vec::new();
    before_each(validator, plan, fails, &mut |position, state| {
        if position + NEAR <= fails {
            return;
        }
        let look = Look { validator, state, position };
        for (action, schema) in validator.domain.actions.enumerate() {
            let wanted = lacks.missing.iter().map(|atom| (atom, true));
            for (atom, adds) in wanted.chain(lacks.present.iter().map(|atom| (atom, false))) {
                each_change(&schema.effect, adds, &mut |effect| {
                    let Some(fixed) = look.unify(schema, effect, atom) else { return };
                    look.applicable(schema, &fixed, &mut |arguments| {
                        let step = PlanStep { action, arguments, span: Span::default() };
                        let same = |(other, old): &(usize, PlanStep)| {
                            *other == position && old.action == action && old.arguments == step.arguments
                        };
                        if !insertions.iter().any(same) {
                            insertions.push((position, step));
                        }
                    });
                });
            }
        }
        if let Some(step) = plan.steps.get(position) {
            look.others(step.action, &step.arguments, &mut |arguments| {
                replacements.push((position, arguments));
            });
        }
    });
    insertions.sort_by_key(|(position, _)| fails - position);
    replacements.sort_by_key(|(position, _)| fails - position);
    (insertions, replacements)
}

/// The atoms that an effect adds or deletes, whatever the condition.
fn each_change(effect: &Effect, adds: bool, visit: &mut dyn FnMut(&Atom)) {
    match &effect.kind {
        EffectKind::And(parts) => parts.iter().for_each(|part| each_change(part, adds, visit)),
        EffectKind::Forall(_, body) | EffectKind::When(_, body) => each_change(body, adds, visit),
        EffectKind::Add(atom) if adds => visit(atom),
        EffectKind::Delete(atom) if !adds => visit(atom),
        EffectKind::Add(_) | EffectKind::Delete(_) | EffectKind::Assign(..) => {}
    }
}

/// A place in the plan, and the state there.
struct Look<'l, 'a> {
    validator: &'l Validator<'a>,
    state: &'l State,
    position: usize,
}

impl Look<'_, '_> {
    /// The parameters under which an effect's atom is the one wanted; quantified variables may be anything.
    fn unify(&self, schema: &Action, effect: &Atom, atom: &GroundAtom) -> Option<Vec<Option<ObjectId>>> {
        if effect.predicate != atom.predicate {
            return None;
        }
        let mut fixed = vec![None; schema.variables.parameters];
        for (&term, &object) in effect.arguments.iter().zip(&atom.arguments) {
            match term {
                Term::Object(same) if same == object => {}
                Term::Object(_) => return None,
                Term::Variable(variable) => {
                    let Some(place) =
                        schema.variables.parameter_ids().position(|parameter| parameter == variable)
                    else {
                        continue;
                    };
                    let fits = self.validator.universe.extent(&schema.variables[variable].types);
                    if !fits.contains(object) || fixed[place].is_some_and(|other| other != object) {
                        return None;
                    }
                    fixed[place] = Some(object);
                }
            }
        }
        Some(fixed)
    }

    /// The arguments with which the action can be taken here.
    fn applicable(&self, schema: &Action, fixed: &[Option<ObjectId>], visit: &mut dyn FnMut(Vec<ObjectId>)) {
        let mut binding = Binding::new(&schema.variables, &[]);
        let mut open = Vec::new();
        for (parameter, object) in schema.variables.parameter_ids().zip(fixed) {
            match object {
                Some(object) => binding.set(parameter, Some(*object)),
                None => open.push(parameter),
            }
        }
        let clock = Clock::steps(step_index(self.position).0);
        let scene = self.validator.scene(self.state, &schema.variables, clock);
        if open.is_empty() {
            if scene.holds(&schema.precondition, &mut binding) {
                visit(fixed.iter().copied().flatten().collect());
            }
            return;
        }
        let mut left = INSTANCES;
        let guards = [(&schema.precondition, true)];
        let flow = scene.each_binding(&open, &guards, Strictness::Certain, &mut binding, &mut |binding| {
            visit(schema.variables.parameter_ids().filter_map(|p| binding.get(p)).collect());
            left -= 1;
            if left == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        debug_assert_eq!(flow.is_break(), left == 0);
    }

    /// The arguments that differ in one place and with which the action can be taken here.
    fn others(&self, action: ActionId, arguments: &[ObjectId], visit: &mut dyn FnMut(Vec<ObjectId>)) {
        let Some(schema) = self.validator.domain.actions.get(action) else { return };
        for free in 0..arguments.len() {
            let mut fixed: Vec<_> = arguments.iter().copied().map(Some).collect();
            fixed[free] = None;
            self.applicable(schema, &fixed, &mut |other| {
                if other != arguments {
                    visit(other);
                }
            });
        }
    }
}
