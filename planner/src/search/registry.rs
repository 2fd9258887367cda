//! Stores every state that a search has met, once.
//!
//! Problem: millions of states must be stored, looked up and traced back. Idea: the words of the
//! states are in segments that never move. An open-addressing hash table holds state ids and
//! compares the words themselves. If it saves much memory, states are packed into finite-domain
//! variables. The table is split into parts before it is large, so that an insertion never rehashes
//! more than a small part. Invariant: the id of a state is its position of insertion and never
//! changes. Cost: the bits of the state plus about 16 bytes.

use crate::ids::{OperatorId, StateId, id32};
use crate::query::UNLIMITED;
use crate::task::{Packing, Task};

/// Keeps ids well below 2^32.
const MOST_STATES: usize = u32::MAX as usize / 2;
const NONE: u32 = u32::MAX;
/// The number of slots at which the table is split.
const SPLIT: usize = 1 << 16;
/// The number of parts; the highest bits of the hash select the part.
const PARTS: usize = 256;

/// A part of the hash table; its length is a power of two.
struct Part {
    slots: Vec<u32>,
    used: usize,
}

impl Part {
    fn of_size(slots: usize) -> Self {
        Self { slots: vec![NONE; slots], used: 0 }
    }

    fn add(&mut self, hash: u64, id: u32) {
        let mask = self.slots.len() - 1;
        let mut slot = low(hash) & mask;
        while self.slots[slot] != NONE {
            slot = (slot + 1) & mask;
        }
        self.slots[slot] = id;
        self.used += 1;
    }

    fn is_crowded(&self) -> bool {
        self.used * 3 > self.slots.len() * 2
    }
}

/// The registry of states.
pub(crate) struct StateRegistry<'t> {
    /// `None` if states are not packed.
    packing: Option<&'t Packing>,
    /// A buffer for one packed state.
    packed: Vec<u64>,
    width: usize,
    per_segment: usize,
    segments: Vec<Vec<u64>>,
    parents: Vec<u32>,
    operators: Vec<u32>,
    /// One part, or [`PARTS`] of them.
    parts: Vec<Part>,
    slots: usize,
}

impl<'t> StateRegistry<'t> {
    /// A registry for the states that are reachable from `first`.
    pub(crate) fn new(task: &'t Task, first: &[u64]) -> Self {
        // A state made by a caller may hold two facts of a mutex group; no variable can hold both.
        let packing = task.packing.as_ref().filter(|_| task.mutexes.keep(first));
        let width = packing.map_or(first.len(), |p| p.width(first.len()));
        let per_segment = (1_usize << 14).div_ceil(width.max(1)).max(16).next_power_of_two();
        Self {
            packing,
            packed: vec![0; if packing.is_some() { width } else { 0 }],
            width,
            per_segment,
            segments: Vec::new(),
            parents: Vec::new(),
            operators: Vec::new(),
            parts: vec![Part::of_size(1024)],
            slots: 1024,
        }
    }

    /// Copies the words of a state.
    pub(crate) fn read(&self, id: StateId, words: &mut [u64]) {
        match self.packing {
            Some(packing) => packing.unpack(self.stored(id), words),
            None => words.copy_from_slice(self.stored(id)),
        }
    }

    fn stored(&self, id: StateId) -> &[u64] {
        let i = id.0 as usize;
        let start = i % self.per_segment * self.width;
        &self.segments[i / self.per_segment][start..start + self.width]
    }

    /// Stores a state. Returns its id, and whether it is new.
    pub(crate) fn insert(&mut self, words: &[u64], from: Option<(StateId, OperatorId)>) -> (StateId, bool) {
        let Some(packing) = self.packing else { return self.store(words, from) };
        let mut packed = std::mem::take(&mut self.packed);
        packing.pack(words, &mut packed);
        let stored = self.store(&packed, from);
        self.packed = packed;
        stored
    }

    fn store(&mut self, words: &[u64], from: Option<(StateId, OperatorId)>) -> (StateId, bool) {
        let hash = spread(words);
        let part = self.part(hash);
        let slots = &self.parts[part].slots;
        let mask = slots.len() - 1;
        let mut slot = low(hash) & mask;
        loop {
            match slots[slot] {
                NONE => break,
                id if self.stored(StateId(id)) == words => return (StateId(id), false),
                _ => slot = (slot + 1) & mask,
            }
        }
        let id = id32(self.parents.len());
        self.parts[part].slots[slot] = id;
        self.parts[part].used += 1;
        if (id as usize).is_multiple_of(self.per_segment) {
            self.segments.push(Vec::with_capacity(self.per_segment * self.width));
        }
        self.segments[id as usize / self.per_segment].extend_from_slice(words);
        self.parents.push(from.map_or(NONE, |(s, _)| s.0));
        self.operators.push(from.map_or(NONE, |(_, o)| o.0));
        if self.parts[part].is_crowded() {
            self.grow(part);
        }
        (StateId(id), true)
    }

    /// Records a better path to a state.
    pub(crate) fn reparent(&mut self, id: StateId, from: StateId, operator: OperatorId) {
        self.parents[id.0 as usize] = from.0;
        self.operators[id.0 as usize] = operator.0;
    }

    fn part(&self, hash: u64) -> usize {
        if self.parts.len() == 1 { 0 } else { (hash >> 56) as usize }
    }

    /// Moves the ids of one part to a part of twice the size, or splits the only part into many.
    fn grow(&mut self, part: usize) {
        let old = std::mem::replace(&mut self.parts[part], Part::of_size(0));
        let double = old.slots.len() * 2;
        if self.parts.len() == 1 && old.slots.len() >= SPLIT {
            self.parts = (0..PARTS).map(|_| Part::of_size(double / PARTS)).collect();
        } else {
            self.parts[part] = Part::of_size(double);
        }
        self.slots += old.slots.len();
        for id in old.slots.into_iter().filter(|&id| id != NONE) {
            let hash = spread(self.stored(StateId(id)));
            let part = self.part(hash);
            self.parts[part].add(hash, id);
        }
    }

    /// Returns the operators from the first state to this one.
    pub(crate) fn path(&self, to: StateId) -> Vec<OperatorId> {
        let mut steps = Vec::new();
        let mut at = to.0;
        while self.parents[at as usize] != NONE {
            steps.push(OperatorId(self.operators[at as usize]));
            at = self.parents[at as usize];
        }
        steps.reverse();
        steps
    }

    /// The bytes held; more than any budget allows once ids run out.
    pub(crate) fn memory(&self) -> usize {
        if self.parents.len() >= MOST_STATES {
            return UNLIMITED;
        }
        self.segments.len() * self.per_segment * self.width * 8 + self.parents.capacity() * 8 + self.slots * 4
    }
}

/// A hash whose lowest and highest bits are well distributed.
fn spread(words: &[u64]) -> u64 {
    let mut hash = 0x9e37_79b9_7f4a_7c15_u64;
    for &word in words {
        hash = (hash ^ word).wrapping_mul(0xff51_afd7_ed55_8ccd);
        hash ^= hash >> 32;
    }
    hash
}

#[expect(clippy::cast_possible_truncation, reason = "the table is smaller than any usize")]
fn low(hash: u64) -> usize {
    hash as usize
}

#[cfg(test)]
mod tests {
    use super::{PARTS, SPLIT, StateRegistry};
    use crate::ids::{StateId, id32};

    #[test]
    fn states_are_found_again_before_and_after_the_table_is_split() {
        let mut registry = StateRegistry {
            packing: None,
            packed: Vec::new(),
            width: 1,
            per_segment: 1024,
            segments: Vec::new(),
            parents: Vec::new(),
            operators: Vec::new(),
            parts: vec![super::Part::of_size(1024)],
            slots: 1024,
        };
        // The last states are inserted long after the split, when single parts have grown.
        let states = 5 * SPLIT;
        for state in 0..id32(states) {
            let (id, new) = registry.insert(&[u64::from(state)], None);
            assert!(new && id == StateId(state));
        }
        assert_eq!(registry.parts.len(), PARTS);
        assert_eq!(registry.parts.iter().map(|p| p.used).sum::<usize>(), states);
        assert_eq!(registry.parts.iter().map(|p| p.slots.len()).sum::<usize>(), registry.slots);
        for state in (0..states).step_by(97) {
            assert_eq!(registry.insert(&[state as u64], None), (StateId(id32(state)), false));
        }
        let largest = registry.parts.iter().map(|p| p.used).max();
        assert!(largest < Some(4 * states / PARTS), "the highest bits tell states apart");
    }
}
