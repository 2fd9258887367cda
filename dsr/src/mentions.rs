//! The tokens that a pattern depends on or a delta changes, as sets that intersect quickly.
//!
//! Invariant: if the mentions of a delta and of a pattern do not intersect, the delta does not change the pattern's
//! matches. If they do intersect, it may.

use smallvec::SmallVec;

use crate::id::{AttributeId, LabelId, TypeId};

/// A set of small numbers.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
struct Bits(SmallVec<[u64; 2]>);

impl Bits {
    fn insert(&mut self, index: usize) {
        if self.0.len() <= index / 64 {
            self.0.resize(index / 64 + 1, 0);
        }
        self.0[index / 64] |= 1 << (index % 64);
    }

    fn contains(&self, index: usize) -> bool {
        self.0.get(index / 64).is_some_and(|word| word >> (index % 64) & 1 == 1)
    }

    fn is_empty(&self) -> bool {
        self.0.iter().all(|word| *word == 0)
    }

    fn intersects(&self, other: &Self) -> bool {
        self.0.iter().zip(other.0.iter()).any(|(a, b)| a & b != 0)
    }

    fn iter(&self) -> impl Iterator<Item = usize> {
        (0..self.0.len() * 64).filter(|&index| self.contains(index))
    }
}

/// Labels, attributes, types of added and removed nodes, and whether transforms are included.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Mentions {
    labels: Bits,
    attributes: Bits,
    types: Bits,
    transforms: bool,
}

impl Mentions {
    /// Whether the two have a token in common.
    pub fn intersects(&self, other: &Self) -> bool {
        self.labels.intersects(&other.labels)
            || self.attributes.intersects(&other.attributes)
            || self.types.intersects(&other.types)
            || (self.transforms && other.transforms)
    }

    /// The labels.
    pub fn labels(&self) -> impl Iterator<Item = LabelId> + '_ {
        self.labels.iter().map(LabelId::at)
    }

    /// The attributes.
    pub fn attributes(&self) -> impl Iterator<Item = AttributeId> + '_ {
        self.attributes.iter().map(AttributeId::at)
    }

    /// The types of nodes that are added or removed; for a pattern, with all subtypes.
    pub fn types(&self) -> impl Iterator<Item = TypeId> + '_ {
        self.types.iter().map(TypeId::at)
    }

    /// Whether transforms are included.
    pub fn transforms(&self) -> bool {
        self.transforms
    }

    /// Whether it mentions nothing.
    pub fn is_empty(&self) -> bool {
        !self.transforms && [&self.labels, &self.attributes, &self.types].iter().all(|bits| bits.is_empty())
    }

    /// Adds everything that `other` mentions.
    pub fn extend(&mut self, other: &Self) {
        for (mine, theirs) in [
            (&mut self.labels, &other.labels),
            (&mut self.attributes, &other.attributes),
            (&mut self.types, &other.types),
        ] {
            theirs.iter().for_each(|index| mine.insert(index));
        }
        self.transforms |= other.transforms;
    }

    pub(crate) fn has_label(&self, label: LabelId) -> bool {
        self.labels.contains(label.index())
    }

    /// Whether leases or waits are included.
    pub(crate) fn leases(&self) -> bool {
        self.has_label(LabelId::HOLDS) || self.has_label(LabelId::AWAITS)
    }

    pub(crate) fn clear(&mut self) {
        *self = Self::default();
    }

    /// Adds a label.
    pub fn add_label(&mut self, label: LabelId) {
        self.labels.insert(label.index());
    }

    /// Adds an attribute.
    pub fn add_attribute(&mut self, attribute: AttributeId) {
        self.attributes.insert(attribute.index());
    }

    /// Adds nodes of exactly this type, which come and go.
    pub fn add_type(&mut self, node_type: TypeId) {
        self.types.insert(node_type.index());
    }

    /// Adds the transforms.
    pub fn add_transforms(&mut self) {
        self.transforms = true;
    }
}
