//! All states that a search has met, each once.
//!
//! Problem: millions of states must be stored, found again and traced back. Idea: words in segments
//! that never move, and an open-addressing table of ids whose keys are the words themselves.
//! Where that makes them much smaller, states are packed into finite-domain variables.
//! Invariant: an id is the position of insertion and never changes. Cost: the
//! state's bits plus about 16 bytes.

use super::meter::UNLIMITED;
use crate::ids::{OperatorId, StateId, id32};
use crate::task::{Packing, Task};

/// Ids stay well below 2^32.
const MOST_STATES: usize = u32::MAX as usize / 2;
const NONE: u32 = u32::MAX;

/// The states.
pub(crate) struct StateRegistry<'t> {
    /// `None` where states are kept as they are.
    packing: Option<&'t Packing>,
    /// A packed state.
    packed: Vec<u64>,
    width: usize,
    per_segment: usize,
    segments: Vec<Vec<u64>>,
    parents: Vec<u32>,
    operators: Vec<u32>,
    slots: Vec<u32>,
}

impl<'t> StateRegistry<'t> {
    /// For the states that operators reach from `first`.
    pub(crate) fn new(task: &'t Task, first: &[u64]) -> Self {
        // A made-up state may hold two facts of a group, and then there is no variable of them.
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
            slots: vec![NONE; 1024],
        }
    }

    /// A state's words.
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

    /// The state's id, and whether it is new.
    pub(crate) fn insert(&mut self, words: &[u64], from: Option<(StateId, OperatorId)>) -> (StateId, bool) {
        let Some(packing) = self.packing else { return self.store(words, from) };
        let mut packed = std::mem::take(&mut self.packed);
        packing.pack(words, &mut packed);
        let stored = self.store(&packed, from);
        self.packed = packed;
        stored
    }

    fn store(&mut self, words: &[u64], from: Option<(StateId, OperatorId)>) -> (StateId, bool) {
        let mask = self.slots.len() - 1;
        let mut slot = spread(words) & mask;
        loop {
            match self.slots[slot] {
                NONE => break,
                id if self.stored(StateId(id)) == words => return (StateId(id), false),
                _ => slot = (slot + 1) & mask,
            }
        }
        let id = id32(self.parents.len());
        self.slots[slot] = id;
        if (id as usize).is_multiple_of(self.per_segment) {
            self.segments.push(Vec::with_capacity(self.per_segment * self.width));
        }
        self.segments[id as usize / self.per_segment].extend_from_slice(words);
        self.parents.push(from.map_or(NONE, |(s, _)| s.0));
        self.operators.push(from.map_or(NONE, |(_, o)| o.0));
        if self.parents.len() * 3 > self.slots.len() * 2 {
            self.grow();
        }
        (StateId(id), true)
    }

    /// Records a better way to a state.
    pub(crate) fn reparent(&mut self, id: StateId, from: StateId, operator: OperatorId) {
        self.parents[id.0 as usize] = from.0;
        self.operators[id.0 as usize] = operator.0;
    }

    fn grow(&mut self) {
        let mut slots = vec![NONE; self.slots.len() * 2];
        let mask = slots.len() - 1;
        for id in 0..id32(self.parents.len()) {
            let mut slot = spread(self.stored(StateId(id))) & mask;
            while slots[slot] != NONE {
                slot = (slot + 1) & mask;
            }
            slots[slot] = id;
        }
        self.slots = slots;
    }

    /// The operators from the first state to this one.
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

    /// Bytes held; more than anybody allows where ids run out.
    pub(crate) fn memory(&self) -> usize {
        if self.parents.len() >= MOST_STATES {
            return UNLIMITED;
        }
        self.segments.len() * self.per_segment * self.width * 8
            + self.parents.capacity() * 8
            + self.slots.len() * 4
    }
}

/// A hash whose low bits are good.
#[expect(clippy::cast_possible_truncation, reason = "the table is smaller than any usize")]
fn spread(words: &[u64]) -> usize {
    let mut hash = 0x9e37_79b9_7f4a_7c15_u64;
    for &word in words {
        hash = (hash ^ word).wrapping_mul(0xff51_afd7_ed55_8ccd);
        hash ^= hash >> 32;
    }
    hash as usize
}
