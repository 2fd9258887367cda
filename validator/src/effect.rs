//! The effects of an action on a state.
//!
//! All conditions and values are read in the state before. Then deletes, adds and assignments
//! happen at once; an add wins over a delete of the same atom. For one fluent, increases and
//! decreases add up, scalings multiply, and equal assignments agree. Any other pair of changes
//! conflicts, and the action has no result. [`Changes`] is reused for all steps, so an ordinary
//! step allocates only for new atoms and fluents.
//!
//! Source: Fox & Long, "PDDL2.1", JAIR 2003, Definitions 6 to 9 and §8. Deviation: assigning the
//! same value twice (by two instances of a `forall`) is not a conflict.

use crate::condition::Strictness;
use crate::number::{NoResult, Number};
use crate::relation::Moment;
use crate::scene::{Binding, Scene};
use crate::state::State;
use crate::trace::{Diff, FluentChange};
use crate::value::{GroundAtom, Value};
use crate::verdict::{EffectFault, NumericFault};
use indexmap::IndexMap;
use indexmap::map::Entry;
use pddl::Span;
use pddl::model::{
    Application, AssignOperator, AssignedValue, Atom, Condition, Effect, EffectKind, GroundApplication,
    ObjectId, PredicateId, VariableId,
};
use rustc_hash::FxBuildHasher;
use std::ops::ControlFlow;

/// The kind of change of a fluent, as far as the order of changes matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Write {
    /// Increases and decreases, in any order.
    Additive,
    /// Any other change.
    Other,
}

#[derive(Clone, Copy, Debug)]
enum Update {
    Assign(Option<Value>),
    Shift(Number),
    Scale(Number),
}

#[derive(Clone, Debug, Default)]
struct Atoms {
    heads: Vec<(PredicateId, u32)>,
    arguments: Vec<ObjectId>,
}

impl Atoms {
    fn push(&mut self, atom: &Atom, binding: &Binding) {
        self.head(atom.predicate, atom.arguments.len());
        self.arguments.extend(atom.arguments.iter().map(|&t| binding.object(t)));
    }

    fn push_ground(&mut self, predicate: PredicateId, arguments: &[ObjectId]) {
        self.head(predicate, arguments.len());
        self.arguments.extend_from_slice(arguments);
    }

    fn head(&mut self, predicate: PredicateId, arity: usize) {
        let arity = u32::try_from(arity).expect("an atom of a file has less than 2^32 arguments");
        self.heads.push((predicate, arity));
    }

    fn clear(&mut self) {
        self.heads.clear();
        self.arguments.clear();
    }

    fn each(&self, mut visit: impl FnMut(PredicateId, &[ObjectId])) {
        let mut rest = self.arguments.as_slice();
        for &(predicate, arity) in &self.heads {
            let (arguments, tail) = rest.split_at(arity as usize);
            rest = tail;
            visit(predicate, arguments);
        }
    }
}

/// The changes of one step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Changes {
    adds: Atoms,
    deletes: Atoms,
    updates: IndexMap<GroundApplication, (Update, Span), FxBuildHasher>,
}

impl Changes {
    pub(crate) fn clear(&mut self) {
        self.adds.clear();
        self.deletes.clear();
        self.updates.clear();
    }

    pub(crate) fn add(&mut self, predicate: PredicateId, arguments: &[ObjectId]) {
        self.adds.push_ground(predicate, arguments);
    }

    pub(crate) fn delete(&mut self, predicate: PredicateId, arguments: &[ObjectId]) {
        self.deletes.push_ground(predicate, arguments);
    }

    /// Sets the value of a fluent; `None` makes it undefined.
    pub(crate) fn set(&mut self, fluent: GroundApplication, value: Option<Value>, span: Span) {
        self.updates.insert(fluent, (Update::Assign(value), span));
    }

    pub(crate) fn each_add(&self, mut visit: impl FnMut(GroundAtom)) {
        self.adds.each(|predicate, arguments| visit(GroundAtom { predicate, arguments: arguments.into() }));
    }

    pub(crate) fn each_delete(&self, mut visit: impl FnMut(GroundAtom)) {
        self.deletes.each(|predicate, arguments| {
            visit(GroundAtom { predicate, arguments: arguments.into() });
        });
    }

    pub(crate) fn each_write(&self, mut visit: impl FnMut(&GroundApplication, Write)) {
        for (fluent, (update, _)) in &self.updates {
            let additive = matches!(update, Update::Shift(_));
            visit(fluent, if additive { Write::Additive } else { Write::Other });
        }
    }

    /// Collects the changes of `effect` in the state of `scene`.
    pub(crate) fn collect(
        &mut self,
        scene: Scene<'_>,
        effect: &Effect,
        binding: &mut Binding,
    ) -> Result<(), EffectFault> {
        match &effect.kind {
            EffectKind::And(parts) => parts.iter().try_for_each(|part| self.collect(scene, part, binding)),
            EffectKind::Add(atom) => {
                self.adds.push(atom, binding);
                Ok(())
            }
            EffectKind::Delete(atom) => {
                self.deletes.push(atom, binding);
                Ok(())
            }
            EffectKind::Assign(operator, application, value) => {
                self.assign(scene, *operator, application, value, effect.span, binding)
            }
            EffectKind::Forall(variables, body) => self.collect_all(scene, variables, body, binding),
            EffectKind::When(condition, body) => {
                if scene.holds(condition, binding) {
                    self.collect(scene, body, binding)
                } else {
                    Ok(())
                }
            }
        }
    }

    fn collect_all(
        &mut self,
        scene: Scene<'_>,
        variables: &[VariableId],
        body: &Effect,
        binding: &mut Binding,
    ) -> Result<(), EffectFault> {
        match &body.kind {
            EffectKind::And(parts) => {
                parts.iter().try_for_each(|part| self.collect_all(scene, variables, part, binding))
            }
            EffectKind::Forall(more, body) => {
                self.collect_all(scene, &[variables, more].concat(), body, binding)
            }
            EffectKind::When(condition, body) => {
                self.collect_each(scene, variables, &[(condition, true)], body, binding)
            }
            _ => self.collect_each(scene, variables, &[], body, binding),
        }
    }

    fn collect_each(
        &mut self,
        scene: Scene<'_>,
        variables: &[VariableId],
        guards: &[(&Condition, bool)],
        body: &Effect,
        binding: &mut Binding,
    ) -> Result<(), EffectFault> {
        let mut result = Ok(());
        let flow = scene.each_binding(variables, guards, Strictness::Certain, binding, &mut |binding| {
            result = self.collect(scene, body, binding);
            if result.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        debug_assert_eq!(flow.is_break(), result.is_err());
        result
    }

    fn assign(
        &mut self,
        scene: Scene<'_>,
        operator: AssignOperator,
        application: &Application,
        value: &AssignedValue,
        span: Span,
        binding: &Binding,
    ) -> Result<(), EffectFault> {
        let update = match value {
            AssignedValue::Undefined => Update::Assign(None),
            AssignedValue::Object(term) => Update::Assign(Some(Value::Object(binding.object(*term)))),
            AssignedValue::Number(expression) => {
                let number = scene.number(expression, binding).map_err(EffectFault::Numeric)?;
                match operator {
                    AssignOperator::Assign => Update::Assign(Some(Value::Number(number))),
                    AssignOperator::Increase => Update::Shift(number),
                    AssignOperator::Decrease => Update::Shift(number.negated()),
                    AssignOperator::ScaleUp => Update::Scale(number),
                    AssignOperator::ScaleDown => {
                        Update::Scale(Number::integer(1).over(number).map_err(|f| numeric(f, span))?)
                    }
                }
            }
        };
        match self.updates.entry(scene.ground(application, binding)) {
            Entry::Vacant(entry) => {
                entry.insert((update, span));
            }
            Entry::Occupied(mut entry) => {
                let (before, first) = *entry.get();
                let both = match (before, update) {
                    (Update::Shift(a), Update::Shift(b)) => {
                        Update::Shift(a.plus(b).map_err(|f| numeric(f, span))?)
                    }
                    (Update::Scale(a), Update::Scale(b)) => {
                        Update::Scale(a.times(b).map_err(|f| numeric(f, span))?)
                    }
                    (Update::Assign(a), Update::Assign(b)) if a == b => update,
                    _ => {
                        return Err(EffectFault::Conflict {
                            fluent: entry.key().clone(),
                            first,
                            second: span,
                        });
                    }
                };
                entry.insert((both, first));
            }
        }
        Ok(())
    }

    /// Applies the changes; if one of them has no result, changes nothing.
    pub(crate) fn apply(
        &self,
        state: &mut State,
        now: Moment,
        mut diff: Option<&mut Diff>,
    ) -> Result<(), EffectFault> {
        let mut values = Vec::with_capacity(self.updates.len());
        for (fluent, &(update, span)) in &self.updates {
            let before = state.fluent(fluent);
            let after = match (update, before) {
                (Update::Assign(value), _) => value,
                (Update::Shift(by), Some(Value::Number(number))) => {
                    Some(Value::Number(number.plus(by).map_err(|f| numeric(f, span))?))
                }
                (Update::Scale(by), Some(Value::Number(number))) => {
                    Some(Value::Number(number.times(by).map_err(|f| numeric(f, span))?))
                }
                (Update::Shift(_) | Update::Scale(_), _) => {
                    let fluent = fluent.clone();
                    return Err(EffectFault::Numeric(NumericFault::Undefined { fluent, span }));
                }
            };
            values.push((before, after));
        }
        for (fluent, (before, after)) in self.updates.keys().zip(values) {
            if before != after {
                state.set_fluent(fluent.clone(), after);
                if let Some(diff) = &mut diff {
                    diff.fluents.push(FluentChange { fluent: fluent.clone(), before, after });
                }
            }
        }
        self.adds.each(|predicate, arguments| {
            if state.facts[predicate].add(arguments, now)
                && let Some(diff) = &mut diff
            {
                diff.added.push(GroundAtom { predicate, arguments: arguments.into() });
            }
        });
        self.deletes.each(|predicate, arguments| {
            if state.facts[predicate].delete(arguments, now)
                && let Some(diff) = &mut diff
            {
                diff.deleted.push(GroundAtom { predicate, arguments: arguments.into() });
            }
        });
        Ok(())
    }
}

fn numeric(fault: NoResult, span: Span) -> EffectFault {
    EffectFault::Numeric(NumericFault::of(fault, span))
}
