//! Effects one by one, each with what it hangs on.

use pddl::model::{Condition, Effect, EffectKind};

/// An effect that is neither `and` nor `forall` nor `when`.
#[derive(Clone, Copy)]
pub(super) struct Change<'a> {
    pub(super) effect: &'a Effect,
    /// The number of the `forall` or `when` that it stands in; 0 for none. Changes of one number happen together.
    pub(super) context: usize,
}

/// A conditional effect.
pub(super) struct When<'a> {
    pub(super) condition: &'a Condition,
    pub(super) effect: &'a Effect,
    /// The whole.
    pub(super) whole: &'a Effect,
}

/// What effects that happen together consist of.
#[derive(Default)]
pub(super) struct Changes<'a> {
    pub(super) changes: Vec<Change<'a>>,
    pub(super) whens: Vec<When<'a>>,
    contexts: usize,
}

impl<'a> Changes<'a> {
    pub(super) fn of(effects: impl IntoIterator<Item = &'a Effect>) -> Self {
        let mut changes = Self::default();
        effects.into_iter().for_each(|effect| changes.add(effect, 0));
        changes
    }

    fn add(&mut self, effect: &'a Effect, context: usize) {
        match &effect.kind {
            EffectKind::And(parts) => parts.iter().for_each(|part| self.add(part, context)),
            EffectKind::Forall(_, inner) => {
                self.contexts += 1;
                self.add(inner, self.contexts);
            }
            EffectKind::When(condition, inner) => {
                self.whens.push(When { condition, effect: inner, whole: effect });
                self.contexts += 1;
                self.add(inner, self.contexts);
            }
            _ => self.changes.push(Change { effect, context }),
        }
    }

    /// The changes that nothing stands around.
    pub(super) fn certain(&self) -> impl Iterator<Item = &'a Effect> + '_ {
        self.changes.iter().filter(|change| change.context == 0).map(|change| change.effect)
    }
}
