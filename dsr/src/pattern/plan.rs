//! The join order: which part to look at next, decided once per pattern and set of fixed variables.
//!
//! Idea: greedy, from bound to unbound. A part whose variables are all bound filters at once. Otherwise a part with one
//! bound end walks along an edge or a reference. Otherwise the variable that occurs in most remaining parts takes each
//! node of its type. Invariant: when a step runs, every slot that it reads is bound.

use super::slot::{Mask, Slot};
use super::source::{Atom, Carrier, Conjunction, Right};
use super::term::Comparison;
use crate::id::{AttributeId, LabelId};

/// One step of a join.
#[derive(Debug, Clone)]
pub(super) enum Step {
    /// Filter: a part whose slots are all bound. Never a negated one.
    Check(Atom<Slot>),
    /// Bind `to` to the ends of the edges that leave `from`.
    Forward { from: Slot, label: LabelId, to: Slot },
    /// Bind `from` to the starts of the edges that reach `to`.
    Backward { from: Slot, label: LabelId, to: Slot },
    /// Bind `to` to the node that the attribute names.
    Follow { holder: Carrier<Slot>, attribute: AttributeId, to: Slot },
    /// Bind the variable to every node of its type.
    Scan(Slot),
    /// Filter: the steps of the negated part, which is atom `at`, must have no match.
    Without { at: usize, steps: Vec<Step> },
}

/// A join order for `part`, when the slots in `bound` are bound.
pub(super) fn plan(part: &Conjunction<Slot>, mut bound: Mask) -> Vec<Step> {
    let mut waiting: Vec<(usize, &Atom<Slot>)> = part.atoms.iter().enumerate().collect();
    let mut steps = Vec::new();
    loop {
        let mut at = 0;
        while at < waiting.len() {
            if bound.includes(free(waiting[at].1)) {
                steps.push(match waiting.remove(at) {
                    (at, Atom::Without(part)) => Step::Without { at, steps: plan(part, bound) },
                    (_, atom) => Step::Check(atom.clone()),
                });
            } else {
                at += 1;
            }
        }
        if let Some((at, step, slot)) =
            waiting.iter().enumerate().find_map(|(at, (_, atom))| walk(atom, bound).map(|(s, t)| (at, s, t)))
        {
            waiting.remove(at);
            steps.push(step);
            bound.insert(slot);
            continue;
        }
        let unbound = part.variables.iter().copied().filter(|&slot| !bound.contains(slot));
        let wanted = |slot: &Slot| waiting.iter().filter(|(_, atom)| free(atom).contains(*slot)).count();
        // Ties are broken by the order of declaration.
        let Some(slot) = unbound.rev().max_by_key(wanted) else { break };
        steps.push(Step::Scan(slot));
        bound.insert(slot);
    }
    debug_assert!(waiting.is_empty(), "every slot that a part reads is a variable from here or from outside");
    steps
}

/// The step by which a part binds its one unbound slot, and that slot, if it can.
fn walk(atom: &Atom<Slot>, bound: Mask) -> Option<(Step, Slot)> {
    match *atom {
        Atom::Edge { from, label, to } => match (bound.contains(from), bound.contains(to)) {
            (true, false) => Some((Step::Forward { from, label, to }, to)),
            (false, true) => Some((Step::Backward { from, label, to }, from)),
            _ => None,
        },
        Atom::Guard { ref holder, attribute, comparison: Comparison::Equal, operand: Right::Term(to) }
            if !bound.contains(to) && bound.includes(carried(holder)) =>
        {
            Some((Step::Follow { holder: holder.clone(), attribute, to }, to))
        }
        _ => None,
    }
}

/// The slots that a part reads, except the local variables of negated parts.
pub(super) fn free(atom: &Atom<Slot>) -> Mask {
    let pair = |a: Slot, b: Slot| {
        let mut mask = Mask::default();
        mask.insert(a);
        mask.insert(b);
        mask
    };
    match atom {
        Atom::Edge { from, to, .. } | Atom::Distinct(from, to) | Atom::Metric { from, to, .. } => {
            pair(*from, *to)
        }
        Atom::IsA(node, _) => pair(*node, *node),
        Atom::Present { holder, .. } => carried(holder),
        Atom::Guard { holder, operand, .. } => carried(holder).union(match operand {
            Right::Value(_) => Mask::default(),
            Right::Term(slot) => pair(*slot, *slot),
            Right::Attribute(holder, _) => carried(holder),
        }),
        Atom::Without(part) => {
            let all = part.atoms.iter().map(free).fold(Mask::default(), Mask::union);
            let mut own = Mask::default();
            part.variables.iter().for_each(|&slot| own.insert(slot));
            all.minus(own)
        }
    }
}

fn carried(holder: &Carrier<Slot>) -> Mask {
    let mut mask = Mask::default();
    match *holder {
        Carrier::Node(node) => mask.insert(node),
        Carrier::Edge { from, to, .. } => {
            mask.insert(from);
            mask.insert(to);
        }
    }
    mask
}

/// The join orders that a subscriber has needed so far, by the variables that were fixed.
#[derive(Debug, Default)]
pub(crate) struct Plans(pub(super) Vec<(Mask, Vec<Step>)>);
