//! What must hold beside a change for it to concern a pattern: one thing per seed, so that a commit finds the few
//! patterns that it concerns among many by looking up what is there, not by asking each.
//!
//! Idea: an attribute that is held against a constant matters only when it comes to that constant or leaves it. An
//! edge matters only if its ends are of the types that the pattern wants, and if what the pattern says of them beside
//! the edge holds: an attribute with a certain value, or another edge with a certain label.
//!
//! Invariant: if a delta makes a match appear or disappear, at least one of its changes is passed by the clue of one of
//! its seeds. A part of the match that holds after the delta is found there. One that does not was changed by the same
//! delta: an attribute's own seed is passed by its old value, and labels that the delta touches count as there.

use std::hash::{Hash, Hasher};

use rustc_hash::FxHasher;

use super::slot::Slot;
use super::source::{Atom, Carrier, Conjunction, Right};
use super::term::Comparison;
use crate::id::{AttributeId, LabelId};
use crate::value::Value;

/// One of the ends of an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Tip {
    From,
    To,
}

/// Which way an edge beside the changed one goes, seen from the node that they share.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Way {
    Out,
    In,
}

/// A hash of a value: the same for equal ones. Two that share one only cost a look.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct ValueKey(u64);

impl ValueKey {
    pub(crate) fn of(value: &Value) -> Self {
        let mut hasher = FxHasher::default();
        match value {
            // Zero and minus zero are equal, and their sum is zero.
            Value::Number(number) => (0_u8, (number + 0.0).to_bits()).hash(&mut hasher),
            Value::Text(text) => (1_u8, text).hash(&mut hasher),
            Value::Bool(truth) => (2_u8, truth).hash(&mut hasher),
            Value::Node(node) => (3_u8, node).hash(&mut hasher),
        }
        Self(hasher.finish())
    }
}

/// A number in the order of numbers; patterns hold no infinite or undefined ones against anything.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Ordered(i64);

impl Ordered {
    pub(crate) const LEAST: Self = Self(i64::MIN);
    pub(crate) const MOST: Self = Self(i64::MAX);

    pub(crate) fn of(number: f64) -> Self {
        // The bits of negative numbers count downwards; see `f64::total_cmp`.
        let bits = (number + 0.0).to_bits().cast_signed();
        Self(bits ^ ((bits >> 63).cast_unsigned() >> 1).cast_signed())
    }
}

/// The clue of a seed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Clue {
    /// Any change of the token.
    Any,
    /// The attribute comes to this value or leaves it.
    Is(ValueKey),
    /// The attribute crosses this number; true above it.
    Above(Ordered),
    /// The attribute crosses this number; true below it.
    Below(Ordered),
    /// At this end of the edge, the attribute has this value.
    With(Tip, AttributeId, ValueKey),
    /// At this end of the edge, there is another one.
    Beside(Tip, LabelId, Way),
}

/// The clue of a guard's attribute.
pub(super) fn of_guard(comparison: Comparison, operand: &Right<Slot>) -> Clue {
    match (comparison, operand) {
        (Comparison::Equal, Right::Value(value)) => Clue::Is(ValueKey::of(value)),
        (Comparison::Greater | Comparison::GreaterOrEqual, Right::Value(Value::Number(number))) => {
            Clue::Above(Ordered::of(*number))
        }
        (Comparison::Less | Comparison::LessOrEqual, Right::Value(Value::Number(number))) => {
            Clue::Below(Ordered::of(*number))
        }
        _ => Clue::Any,
    }
}

/// The clue of the edge that is the atom `own` of the innermost of these conjunctions: the first value, else the first
/// edge, that any of them wants at one of its ends.
pub(super) fn of_edge(ends: (Slot, Slot), own: usize, around: &[&Conjunction<Slot>]) -> Clue {
    let tip = |slot: Slot| match slot {
        slot if slot == ends.0 => Some(Tip::From),
        slot if slot == ends.1 => Some(Tip::To),
        _ => None,
    };
    let innermost = around.len().saturating_sub(1);
    let others = || {
        around.iter().enumerate().flat_map(move |(depth, part)| {
            let is_own = move |at: usize| depth == innermost && at == own;
            part.atoms.iter().enumerate().filter(move |(at, _)| !is_own(*at)).map(|(_, atom)| atom)
        })
    };
    let with = |atom: &Atom<Slot>| match atom {
        Atom::Guard {
            holder: Carrier::Node(node),
            attribute,
            comparison: Comparison::Equal,
            operand: Right::Value(value),
        } => Some(Clue::With(tip(*node)?, *attribute, ValueKey::of(value))),
        _ => None,
    };
    let beside = |atom: &Atom<Slot>| match atom {
        Atom::Edge { from, label, to } => match (tip(*from), tip(*to)) {
            (Some(tip), None) => Some(Clue::Beside(tip, *label, Way::Out)),
            (None, Some(tip)) => Some(Clue::Beside(tip, *label, Way::In)),
            _ => None,
        },
        _ => None,
    };
    others().find_map(with).or_else(|| others().find_map(beside)).unwrap_or(Clue::Any)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_in_order() {
        let numbers = [f64::NEG_INFINITY, -2.0, -1.0, -f64::MIN_POSITIVE, 0.0, 1e-300, 1.0, 2.0, f64::MAX];
        assert!(numbers.is_sorted_by(|a, b| Ordered::of(*a) < Ordered::of(*b)));
        assert_eq!(Ordered::of(-0.0), Ordered::of(0.0));
        assert_eq!(ValueKey::of(&Value::Number(-0.0)), ValueKey::of(&Value::Number(0.0)));
    }
}
