//! From a change to the matches that it may concern: where a join begins at the changed edge.
//!
//! Problem: matching a pattern again for each commit costs what the graph is large; the commit changed an edge. Idea:
//! a match can only come or go if one of its atoms, at the nodes of the match, changed. So each atom is a seed: the
//! change gives nodes to the variables of that atom, and only matches that have them there are looked at again. An
//! atom of a negated part gives nodes to those of its variables that the pattern has outside.
//!
//! Invariant: matches outside the slices of a delta are the same before and after it. Where a change gives no variable
//! a node (a constant comes or goes, a negated part shares no variable with the atom), all matches are looked at again.
//! Which frames a metric begins at is a matter of its own (`rigid`). A variable that an edge or an attribute binds
//! needs no seed of its own for nodes that come and go, because their edges and attributes come and go with them.
//!
//! Source: the semi-naive evaluation of Datalog (Bancilhon and Ramakrishnan, SIGMOD 1986), with single changes as
//! the deltas.

use super::clue::{self, Clue};
use super::slot::{Mask, Slot};
use super::source::{Atom, Carrier, Conjunction, Limit, Right};
use super::term::Comparison;
use crate::id::{AttributeId, LabelId};

/// An atom as the beginning of a join.
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
    /// A variable that nothing but its type binds.
    Loose(Slot),
}

/// An atom as a seed, and where in the pattern it is.
#[derive(Debug, Clone)]
pub(super) struct Seedling {
    pub(super) seed: Seed,
    pub(super) clue: Clue,
    /// The negated part of the pattern in which it is, if it is in one.
    pub(super) part: Option<usize>,
}

/// The seeds of a pattern.
pub(super) fn seedlings(body: &Conjunction<Slot>) -> Vec<Seedling> {
    let mut found = Vec::new();
    seeds(&[body], None, &mut found);
    found
}

/// The seeds of the last of these conjunctions, which stand within each other, and of the negated parts in it.
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
            // A node is of its type from when it comes to when it goes, which is what `Loose` is for.
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
