//! Clues: what must hold beside a change for it to concern a pattern.
//!
//! Problem: a commit should find the few patterns that it concerns among many by look-ups, not by asking each pattern.
//! Idea: each seed has a clue. An attribute that is compared with a constant matters only when its value reaches that
//! constant or leaves it. An edge matters only if its ends have the types of the pattern, and if another requirement of
//! the pattern at one of its ends holds: an attribute with a certain value, or another edge with a certain label.
//!
//! Invariant: if a delta makes a match appear or disappear, at least one of its changes passes the clue of one of its
//! seeds. A requirement that holds after the delta is found in the state. One that does not hold any more was changed
//! by the same delta: an attribute passes its own clue by its old value, and edges that the delta removes count as
//! present.

use std::hash::{Hash, Hasher};

use rustc_hash::FxHasher;

use super::slot::Slot;
use super::source::{Atom, Carrier, Conjunction, Right};
use super::term::Comparison;
use crate::id::{AttributeId, LabelId};
use crate::value::Value;

/// One end of an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Tip {
    From,
    To,
}

/// The direction of an edge beside the changed one, seen from the node that they share.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Way {
    Out,
    In,
}

/// A hash of a value: equal values have equal hashes. A collision costs one needless match.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct ValueKey(u64);

impl ValueKey {
    pub(crate) fn of(value: &Value) -> Self {
        let mut hasher = FxHasher::default();
        match value {
            // Zero and minus zero are equal; adding zero makes their bits equal.
            Value::Number(number) => (0_u8, (number + 0.0).to_bits()).hash(&mut hasher),
            Value::Text(text) => (1_u8, text).hash(&mut hasher),
            Value::Bool(truth) => (2_u8, truth).hash(&mut hasher),
            Value::Node(node) => (3_u8, node).hash(&mut hasher),
        }
        Self(hasher.finish())
    }
}

/// A finite number as an integer with the same order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Ordered(i64);

impl Ordered {
    pub(crate) const LEAST: Self = Self(i64::MIN);
    pub(crate) const MOST: Self = Self(i64::MAX);

    pub(crate) fn of(number: f64) -> Self {
        // The bits of negative numbers are in reverse order; see `f64::total_cmp`.
        let bits = (number + 0.0).to_bits().cast_signed();
        Self(bits ^ ((bits >> 63).cast_unsigned() >> 1).cast_signed())
    }
}

/// The clue of a seed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Clue {
    /// Any change of the token.
    Any,
    /// The attribute reaches this value or leaves it.
    Is(ValueKey),
    /// The attribute crosses this number; the guard holds above it.
    Above(Ordered),
    /// The attribute crosses this number; the guard holds below it.
    Below(Ordered),
    /// At this end of the edge, the attribute has this value.
    With(Tip, AttributeId, ValueKey),
    /// At this end of the edge, another edge exists.
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

/// The clue of the edge that is atom `own` of the innermost of these conjunctions: the first attribute value that one
/// of them requires at an end of the edge, or else the first other edge.
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
