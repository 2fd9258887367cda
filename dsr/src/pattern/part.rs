//! The negated parts of a pattern that can be judged by the frames that have moved; `negated` judges them.

use super::measure::End;
use super::plan::{Step, free, plan};
use super::slot::{Mask, Slot};
use super::source::{Atom, Conjunction, Limit};
use crate::id::TypeId;
use crate::vocabulary::Vocabulary;

/// A negated part at the top level of a pattern that measures one of its own variables.
#[derive(Debug, Clone)]
pub(super) struct Part {
    /// Its position among the atoms of the pattern.
    pub(super) at: usize,
    /// The variables of the pattern that it uses.
    pub(super) outer: Vec<usize>,
    /// The ends of its metrics that are bound from outside.
    pub(super) anchors: Vec<Slot>,
    /// The ends of its metrics that are its own variables, each with the join order that begins with it bound.
    pub(super) own: Vec<(End, Vec<Step>)>,
    /// Its own variables, and below the order of its atoms when all variables are bound.
    pub(super) locals: Vec<Slot>,
    pub(super) judgement: Vec<Step>,
}

/// The parts of a pattern; `constants` are the slots of its constants.
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
