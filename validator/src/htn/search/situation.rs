//! A situation: the partial order of tasks that remain after some steps of a plan, and its successors.
//!
//! The nodes of a [`Situation`] are in a topological order. Each node stores its direct predecessors, and the moment
//! at which all completed predecessors were over.

use super::grammar::{Rule, Slot, SymbolId};

/// What was decided of a node that could take no step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Duty {
    /// Nothing yet.
    Open,
    /// It takes a step.
    Something,
    /// It takes none.
    Nothing,
}

/// A node of the decomposition that is being made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct NodeId(pub(super) u32);

#[derive(Clone, Debug)]
pub(super) struct Pending {
    pub(super) symbol: SymbolId,
    pub(super) duty: Duty,
    /// It begins at this moment or later.
    pub(super) start: Slot,
    /// Places of what must be over first.
    pub(super) before: Vec<u32>,
    pub(super) node: NodeId,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Situation {
    pub(super) step: u32,
    /// The node that the next step comes out of, once that is decided.
    pub(super) focus: Option<u32>,
    /// What the focus came out of, without anything that takes a step beside it.
    pub(super) trail: Vec<SymbolId>,
    pub(super) pending: Vec<Pending>,
    /// The next node's number.
    pub(super) next: u32,
}

/// Where a node of a rule goes: over already, or left to do.
#[derive(Clone, Copy, Debug)]
pub(super) enum Part {
    Gone(Slot),
    Left(Duty),
}

impl Situation {
    /// Takes out the nodes that `end` gives a moment at which they are over.
    pub(super) fn without(&mut self, end: &[Option<Slot>]) {
        let mut places = Vec::with_capacity(self.pending.len());
        let mut kept = 0u32;
        for gone in end {
            places.push(kept);
            kept += u32::from(gone.is_none());
        }
        let mut place = 0;
        self.pending.retain(|_| {
            place += 1;
            end[place - 1].is_none()
        });
        for pending in &mut self.pending {
            let start = &mut pending.start;
            pending.before.retain_mut(|before| {
                let old = *before as usize;
                *before = places[old];
                if let Some(end) = end[old] {
                    *start = (*start).max(end);
                }
                end[old].is_none()
            });
        }
        self.focus = self.focus.map(|focus| places[focus as usize]);
    }

    /// Puts a rule's nodes in the place of the focus; the focus is then the node of the rule at `next`.
    pub(super) fn expand(&mut self, focus: u32, rule: &Rule, parts: &[Part], starts: &[Slot], next: usize) {
        let first = self.next;
        self.next += u32::try_from(rule.nodes.len()).unwrap_or(u32::MAX);
        let mut places = Vec::with_capacity(parts.len());
        let mut count = 0u32;
        for part in parts {
            places.push(focus + count);
            count += u32::from(matches!(part, Part::Left(_)));
        }
        let mut last = vec![true; parts.len()];
        let mut inserted = Vec::with_capacity(count as usize);
        for (index, part) in parts.iter().enumerate() {
            let Part::Left(duty) = *part else { continue };
            let mut start = starts[index];
            let mut before = Vec::with_capacity(rule.before[index].len());
            for &earlier in &rule.before[index] {
                match parts[earlier as usize] {
                    Part::Gone(end) => start = start.max(end),
                    Part::Left(_) => {
                        last[earlier as usize] = false;
                        before.push(places[earlier as usize]);
                    }
                }
            }
            let node = NodeId(first + u32::try_from(index).unwrap_or(u32::MAX));
            inserted.push(Pending { symbol: rule.nodes[index], duty, start, before, node });
        }
        let ends: Vec<u32> = (places.iter().zip(parts).zip(&last))
            .filter(|((_, part), last)| **last && matches!(part, Part::Left(_)))
            .map(|((&place, _), _)| place)
            .collect();
        let shift = count - 1;
        for pending in &mut self.pending[focus as usize + 1..] {
            let waits = pending.before.contains(&focus);
            pending.before.retain(|&before| before != focus);
            for before in &mut pending.before {
                *before += if *before > focus { shift } else { 0 };
            }
            if waits {
                pending.before.extend(&ends);
                pending.before.sort_unstable();
            }
        }
        self.pending.splice(focus as usize..=focus as usize, inserted);
        self.focus = Some(places[next]);
    }
}
