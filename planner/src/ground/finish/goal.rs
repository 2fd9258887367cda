//! The goal over facts, and the reason if it is impossible.

use super::view::View;
use crate::ground::instantiate::RawTask;
use crate::ground::normalise::Formula;
use crate::task::{AtomTable, Goal, GroundAtom, Impossible, Names};
use pddl::model::Term;

pub(super) fn goal(raw: &RawTask, view: &View<'_>, table: &AtomTable, names: &Names) -> Goal {
    let mut atoms = Vec::new();
    let mut negated = Vec::new();
    let mut formula = false;
    let is_value = |atom: &GroundAtom| names.values().function(atom.predicate).is_some();
    let mut blame = |atom: Option<GroundAtom>, positive: bool| match atom.filter(|a| !is_value(a)) {
        Some(atom) if positive => atoms.push(atom),
        Some(atom) => negated.push(atom),
        None => formula = true,
    };
    for conjunct in &raw.refuted {
        match conjunct {
            Formula::Literal(l) => {
                let objects = l.arguments.iter().map(|t| match t {
                    Term::Object(o) => Some(*o),
                    Term::Variable(_) => None,
                });
                let atom = objects.collect::<Option<_>>();
                blame(atom.map(|arguments| GroundAtom { predicate: l.predicate, arguments }), l.positive);
            }
            _ => blame(None, true),
        }
    }
    for &l in raw.goal.iter().filter(|&&l| view.pruned.constant(l) == Some(false)) {
        let a = l >> 1;
        let atom = ((a as usize) < table.len())
            .then(|| GroundAtom { predicate: table.predicate(a), arguments: table.objects(a) });
        blame(atom, l & 1 == 0);
    }
    let exclusive = raw.exclusive.map(|(a, b)| [a, b].map(|a| (table.predicate(a), table.objects(a))));
    let impossible = if let Some(pair) = exclusive {
        let named = pair.map(|(predicate, arguments)| GroundAtom { predicate, arguments });
        match named.iter().any(is_value) {
            true => Some(Impossible::Formula),
            false => Some(Impossible::Exclusive(named.into())),
        }
    } else if !atoms.is_empty() {
        Some(Impossible::Atoms(atoms))
    } else if !negated.is_empty() {
        Some(Impossible::NegatedAtoms(negated))
    } else {
        formula.then_some(Impossible::Formula)
    };
    let literals = view.literals(&raw.goal).unwrap_or_default();
    Goal { literals, impossible }
}
