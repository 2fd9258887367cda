//! Seeds: the atoms of a pattern, from which a join begins when something changes.
//!
//! Problem: matching a pattern from scratch after each commit costs as much as the graph is large, although the commit
//! changed one edge. Idea: a match can only appear or disappear if one of its atoms changed at the nodes of the match.
//! So each atom is a seed: a change fixes the variables of that atom, and only matches with these nodes are computed
//! again. An atom of a negated part fixes those of its variables that are declared outside of it.
//!
//! Invariant: matches outside the slices of a delta are the same before and after it. If a change fixes no variable (a
//! constant is added or removed, a negated part shares no variable with the atom), all matches are computed again. For
//! metrics see `rigid`. A variable that an edge or an attribute binds needs no seed for added and removed nodes,
//! because their edges and attributes are added and removed with them.
//!
//! Source: the semi-naive evaluation of Datalog (Bancilhon and Ramakrishnan, SIGMOD 1986), with single changes as the
//! deltas.

use super::clue::{self, Clue};
use super::slot::{Mask, Slot};
use super::source::{Atom, Carrier, Conjunction, Limit, Right};
use super::term::Comparison;
use crate::id::{AttributeId, LabelId};

/// An atom from which a join begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Seed {
    Edge {
        label: LabelId,
        from: Slot,
        to: Slot,
    },
    NodeAttribute {
        attribute: AttributeId,
        node: Slot,
    },
    EdgeAttribute {
        attribute: AttributeId,
        label: LabelId,
        from: Slot,
        to: Slot,
    },
    /// A variable that only its type binds.
    Loose(Slot),
}

/// A seed with its clue and its place in the pattern.
#[derive(Debug, Clone)]
pub(super) struct Seedling {
    pub(super) seed: Seed,
    pub(super) clue: Clue,
    /// The negated part that contains it, if any.
    pub(super) part: Option<usize>,
}

/// The seeds of a pattern.
pub(super) fn seedlings(body: &Conjunction<Slot>) -> Vec<Seedling> {
    let mut found = Vec::new();
    seeds(&[body], None, &mut found);
    found
}

/// Collects the seeds of the innermost of these nested conjunctions, and of the negated parts in it.
fn seeds(around: &[&Conjunction<Slot>], inside: Option<usize>, all: &mut Vec<Seedling>) {
    let mut found = Vec::new();
    let into = &mut found;
    let Some(part) = around.last() else { return };
    let mut bound = Mask::default();
    for (at, atom) in part.atoms.iter().enumerate() {
        match atom {
            Atom::Edge { from, label, to } => {
                let seed = Seed::Edge { label: *label, from: *from, to: *to };
                into.push((seed, clue::of_edge((*from, *to), at, around)));
                bound.insert(*from);
                bound.insert(*to);
            }
            Atom::Present { holder, attribute } => {
                carrier(holder, *attribute, Clue::Any, &mut bound, into);
            }
            Atom::Guard { holder, attribute, comparison, operand } => {
                let clue = clue::of_guard(*comparison, operand);
                carrier(holder, *attribute, clue, &mut bound, into);
                match operand {
                    Right::Attribute(holder, attribute) => {
                        carrier(holder, *attribute, Clue::Any, &mut bound, into);
                    }
                    Right::Term(slot) if *comparison == Comparison::Equal => bound.insert(*slot),
                    Right::Term(_) | Right::Value(_) => {}
                }
            }
            Atom::Metric { from, limit, .. } => {
                if let Limit::Attribute(attribute) = limit {
                    into.push((Seed::NodeAttribute { attribute: *attribute, node: *from }, Clue::Any));
                }
            }
            Atom::Without(inner) => seeds(&[around, &[inner]].concat(), inside.or(Some(at)), all),
            // The type of a node never changes; `Loose` is the seed for nodes that are added or removed.
            Atom::Distinct(..) | Atom::IsA(..) => {}
        }
    }
    let loose = part.variables.iter().filter(|slot| !bound.contains(**slot));
    into.extend(loose.map(|slot| (Seed::Loose(*slot), Clue::Any)));
    all.extend(found.into_iter().map(|(seed, clue)| Seedling { seed, clue, part: inside }));
}

fn carrier(
    holder: &Carrier<Slot>,
    attribute: AttributeId,
    clue: Clue,
    bound: &mut Mask,
    into: &mut Vec<(Seed, Clue)>,
) {
    match *holder {
        Carrier::Node(node) => {
            into.push((Seed::NodeAttribute { attribute, node }, clue));
            bound.insert(node);
        }
        Carrier::Edge { from, label, to } => {
            into.push((Seed::EdgeAttribute { attribute, label, from, to }, clue));
            bound.insert(from);
            bound.insert(to);
        }
    }
}
