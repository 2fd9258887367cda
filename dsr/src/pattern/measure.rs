//! The ends of the metrics of a pattern: which frames may be there.

use super::slot::Slot;
use super::source::{Atom, Conjunction};
use crate::id::TypeId;
use crate::vocabulary::{Nature, Vocabulary};

/// One of the two ends of a metric.
#[derive(Debug, Clone)]
pub(super) struct End {
    pub(super) slot: Slot,
    /// The exact types of the frames that a variable may be; empty for a constant.
    pub(super) types: Box<[TypeId]>,
}

impl End {
    pub(super) fn new(slot: Slot, wanted: Option<TypeId>, vocabulary: &Vocabulary) -> Self {
        let fits = |sub: &TypeId| {
            wanted.is_some_and(|wanted| vocabulary.is_a(*sub, wanted))
                && vocabulary.nature(*sub) == Some(Nature::Geometric)
        };
        Self { slot, types: vocabulary.types().filter(fits).collect() }
    }
}

/// Collects the ends of each metric in a conjunction and in its negated parts. A metric from a frame to itself never
/// changes.
pub(super) fn measured(
    part: &Conjunction<Slot>,
    type_of: &impl Fn(Slot) -> Option<TypeId>,
    vocabulary: &Vocabulary,
    into: &mut Vec<[End; 2]>,
) {
    for atom in &part.atoms {
        match atom {
            Atom::Metric { from, to, .. } if from != to => {
                into.push([*from, *to].map(|slot| End::new(slot, type_of(slot), vocabulary)));
            }
            Atom::Without(part) => measured(part, type_of, vocabulary, into),
            _ => {}
        }
    }
}
