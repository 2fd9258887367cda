//! The negated parts of a pattern that can be judged by what has moved in them; `negated` does so.

use super::measure::End;
use super::plan::{Step, free, plan};
use super::slot::{Mask, Slot};
use super::source::{Atom, Conjunction, Limit};
use crate::id::TypeId;
use crate::vocabulary::Vocabulary;

/// A negated part of a pattern, not of another part, that measures something of its own.
#[derive(Debug, Clone)]
pub(super) struct Part {
    /// Which part of the pattern it is.
    pub(super) at: usize,
    /// The pattern's variables in it.
    pub(super) outer: Vec<usize>,
    /// The ends of its metrics that are given from outside.
    pub(super) anchors: Vec<Slot>,
    /// Those that are variables of its own, and the join order where one is given besides what comes from outside.
    pub(super) own: Vec<(End, Vec<Step>)>,
    /// Its own variables, and the order of its atoms where all of them are given.
    pub(super) locals: Vec<Slot>,
    pub(super) judgement: Vec<Step>,
}

/// The parts of a pattern with so many variables; the slots of its constants are those in the mask.
pub(super) fn parts(
    body: &Conjunction<Slot>,
    constants: Mask,
    type_of: &impl Fn(Slot) -> Option<TypeId>,
    vocabulary: &Vocabulary,
) -> Vec<Part> {
    let part = |(at, atom): (usize, &Atom<Slot>)| {
        let Atom::Without(inner) = atom else { return None };
        let (mut anchors, mut own) = (Vec::new(), Vec::<(End, Vec<Step>)>::new());
        let (outside, mut remembers) = (free(atom), false);
        for atom in &inner.atoms {
            match atom {
                Atom::Metric { from, to, limit, .. } => {
                    if let Limit::Threshold(threshold) = limit {
                        remembers |= threshold.appears != threshold.disappears;
                    }
                    for &slot in [from, to].into_iter().filter(|_| from != to) {
                        if !inner.variables.contains(&slot) {
                            anchors.push(slot);
                        } else if !own.iter().any(|(end, _)| end.slot == slot) {
                            let mut bound = constants.union(outside);
                            bound.insert(slot);
                            own.push((End::new(slot, type_of(slot), vocabulary), plan(inner, bound)));
                        }
                    }
                }
                Atom::Without(deeper) if measures(deeper) => return None,
                _ => {}
            }
        }
        let is_outer = |slot: &&Slot| outside.contains(**slot);
        let outer: Vec<_> = body.variables.iter().filter(is_outer).map(|slot| usize::from(slot.0)).collect();
        let known = !remembers || outer.len() == body.variables.len();
        let mut bound = constants.union(outside);
        inner.variables.iter().for_each(|slot| bound.insert(*slot));
        let (locals, judgement) = (inner.variables.clone(), plan(inner, bound));
        (known && !own.is_empty()).then_some(Part { at, outer, anchors, own, locals, judgement })
    };
    body.atoms.iter().enumerate().filter_map(part).collect()
}

fn measures(part: &Conjunction<Slot>) -> bool {
    part.atoms.iter().any(|atom| match atom {
        Atom::Metric { .. } => true,
        Atom::Without(deeper) => measures(deeper),
        _ => false,
    })
}
