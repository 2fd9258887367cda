//! Conditions put together, with what always or never holds folded.

use pddl::Span;
use pddl::model::{Condition, ConditionKind, VariableId};

pub(super) fn is_always(condition: &Condition) -> bool {
    condition.is_always()
}

pub(super) fn is_never(condition: &Condition) -> bool {
    matches!(&condition.kind, ConditionKind::Or(parts) if parts.is_empty())
}

pub(super) fn conjunction(parts: Vec<Condition>, span: Span) -> Condition {
    if let Some(never) = parts.iter().find(|part| is_never(part)) {
        return never.clone();
    }
    let mut parts: Vec<Condition> = parts.into_iter().filter(|part| !is_always(part)).collect();
    if parts.len() == 1 { parts.remove(0) } else { Condition { kind: ConditionKind::And(parts), span } }
}

pub(super) fn disjunction(parts: Vec<Condition>, span: Span) -> Condition {
    if let Some(always) = parts.iter().find(|part| is_always(part)) {
        return always.clone();
    }
    let mut parts: Vec<Condition> = parts.into_iter().filter(|part| !is_never(part)).collect();
    if parts.len() == 1 { parts.remove(0) } else { Condition { kind: ConditionKind::Or(parts), span } }
}

pub(super) fn negation(part: Condition, span: Span) -> Condition {
    let kind = match part.kind {
        ConditionKind::And(parts) if parts.is_empty() => ConditionKind::Or(parts),
        ConditionKind::Or(parts) if parts.is_empty() => ConditionKind::And(parts),
        kind => ConditionKind::Not(Box::new(Condition { kind, span: part.span })),
    };
    Condition { kind, span }
}

pub(super) fn quantified(
    make: fn(Vec<VariableId>, Box<Condition>) -> ConditionKind,
    slots: &[VariableId],
    part: Condition,
    span: Span,
) -> Condition {
    Condition { kind: make(slots.to_vec(), Box::new(part)), span }
}
