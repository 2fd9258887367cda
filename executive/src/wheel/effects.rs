//! The effects of one turn: how they are collected, and how all writes become one transaction.

use super::event::Effect;
use crate::narration::Narration;
use dsr::Edit;
use high_to_low::RefinementEvent;

pub(super) fn is_write(effect: &Effect) -> bool {
    matches!(effect, Effect::Write(_))
}

/// All writes of a turn as one, where the first stood.
pub(super) fn in_one_transaction(effects: Vec<Effect>) -> Vec<Effect> {
    let mut merged: Vec<Effect> = Vec::with_capacity(effects.len());
    for effect in effects {
        match (effect, merged.iter_mut().find(|e| is_write(e))) {
            (Effect::Write(more), Some(Effect::Write(edits))) => edits.extend(more),
            (effect, _) => merged.push(effect),
        }
    }
    merged
}

pub(super) fn write(edits: Vec<Edit>, effects: &mut Vec<Effect>) {
    if !edits.is_empty() {
        effects.push(Effect::Write(edits));
    }
}

pub(super) fn tell(events: Vec<RefinementEvent>, effects: &mut Vec<Effect>) {
    effects.extend(events.into_iter().map(|what| Effect::Tell(Narration::Refined { what })));
}
