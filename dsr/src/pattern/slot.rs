//! Slots: the places for the nodes of variables and constants while a compiled pattern is matched.

/// The place for the node of a variable or a constant while matching.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Slot(pub(super) u8);

/// The most variables and constants that one pattern may have.
pub(super) const SLOTS: usize = 64;

/// A set of slots.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Mask(u64);

impl Mask {
    pub(super) fn insert(&mut self, slot: Slot) {
        self.0 |= 1 << (slot.0 % 64);
    }

    pub(super) fn contains(self, slot: Slot) -> bool {
        slot.0 < 64 && self.0 >> slot.0 & 1 == 1
    }

    pub(super) fn includes(self, other: Self) -> bool {
        other.0 & !self.0 == 0
    }

    pub(super) fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    pub(super) fn minus(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }
}
