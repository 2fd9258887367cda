//! A situation: the partial order of tasks that remain after some steps of a plan, and its successors.
//!
//! The nodes of a [`Situation`] are in a topological order. Each node stores its direct predecessors, and the moment
//! at which all completed predecessors were over.

use super::grammar::{Rule, Slot, SymbolId};

/// The decision whether a node yields a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Duty {
    /// Not decided.
    Open,
    /// It yields at least one step.
    Something,
    /// It yields no step.
    Nothing,
}

/// A node of the decomposition under construction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct NodeId(pub(super) u32);

#[derive(Clone, Debug)]
pub(super) struct Pending {
    pub(super) symbol: SymbolId,
    pub(super) duty: Duty,
    /// The earliest moment at which it may begin.
    pub(super) start: Slot,
    /// The positions of its direct predecessors.
    pub(super) before: Vec<u32>,
    pub(super) node: NodeId,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Situation {
    pub(super) step: u32,
    /// The node that yields the next step, once chosen.
    pub(super) focus: Option<u32>,
    /// The ancestors of the focus since the last one with a sibling that yields a step.
    pub(super) trail: Vec<SymbolId>,
    pub(super) pending: Vec<Pending>,
    /// The number of the next node.
    pub(super) next: u32,
}

/// The status of a rule's node: completed, or left to do.
#[derive(Clone, Copy, Debug)]
pub(super) enum Part {
    Gone(Slot),
    Left(Duty),
}

impl Situation {
    /// Removes the nodes for which `end` has the moment of their end.
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

    /// Replaces the focus by the nodes of a rule. The new focus is the rule's node at `next`.
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
