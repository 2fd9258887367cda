//! Whether a candidate's number can grow.
//!
//! Invariant: a candidate is said to hold only if every add of every happening is already true or
//! goes with a delete of an atom of the same instance that was true, and no two adds of one happening
//! can meet in one instance.

use pddl::model::{Atom, Condition, ConditionKind, Domain, Term, TypeSet, VariableId, Variables};

use crate::happening::{Change, Happening, changes};

use super::{Invariant, Member};

/// What a happening does, as far as it matters here.
pub(super) struct Moves<'a> {
    variables: &'a Variables,
    pub(super) adds: Vec<Move<'a>>,
    deletes: Vec<Move<'a>>,
}

/// An add or a delete.
pub(super) struct Move<'a> {
    pub(super) atom: &'a Atom,
    /// Atoms that hold whenever it happens.
    held: Vec<&'a Atom>,
    /// Terms that differ whenever it happens.
    differ: Vec<(Term, Term)>,
    /// The conditions of its `when`s.
    when: Vec<&'a Condition>,
    /// Whether it happens for several objects at once.
    several: bool,
}

/// The adds and deletes of a happening.
pub(super) fn moves<'a>(happening: &Happening<'a>) -> Moves<'a> {
    let mut moves = Moves { variables: happening.variables, adds: Vec::new(), deletes: Vec::new() };
    let (mut held, mut differ) = (Vec::new(), Vec::new());
    happening.just_before.iter().for_each(|c| literals(c, &mut held, &mut differ));
    for effect in &happening.effects {
        changes(effect, &mut |context, change| {
            let (atom, list) = match change {
                Change::Add(atom) => (*atom, &mut moves.adds),
                Change::Delete(atom) => (*atom, &mut moves.deletes),
                Change::Assign(..) => return,
            };
            let (mut held, mut differ) = (held.clone(), differ.clone());
            context.when.iter().for_each(|c| literals(c, &mut held, &mut differ));
            let several = !context.forall.is_empty();
            list.push(Move { atom, held, differ, when: context.when.clone(), several });
        });
    }
    moves
}

/// The atoms and inequalities among a condition's conjuncts.
pub(crate) fn literals<'a>(of: &'a Condition, held: &mut Vec<&'a Atom>, differ: &mut Vec<(Term, Term)>) {
    match &of.kind {
        ConditionKind::And(parts) => parts.iter().for_each(|p| literals(p, held, differ)),
        ConditionKind::Atom(atom) => held.push(atom),
        ConditionKind::Not(inner) => {
            if let ConditionKind::Same(a, b) = inner.kind {
                differ.push((a, b));
            }
        }
        _ => {}
    }
}

/// What becomes of a candidate.
pub(super) enum Verdict {
    /// Its number never grows.
    Holds,
    /// It may, beyond repair.
    Broken,
    /// Some add lacks a delete; each of these members would give it one.
    Unbalanced(Vec<Member>),
}

/// Holds a candidate against all happenings.
pub(super) fn judge(domain: &Domain, candidate: &Invariant, moves: &[Moves<'_>]) -> Verdict {
    for happening in moves {
        let member = |m: &Move<'_>| candidate.member(m.atom.predicate);
        let adds: Vec<_> = happening.adds.iter().filter_map(|a| Some((a, member(a)?))).collect();
        for (i, (add, member)) in adds.iter().enumerate() {
            let instance = member.instance(&add.atom.arguments);
            let meets = |(other, other_member): &(&Move<'_>, &Member)| {
                let other_instance = other_member.instance(&other.atom.arguments);
                let apart = |(&a, &b): (&Term, &Term)| {
                    let differ = |known: &[(Term, Term)]| differ(domain, happening.variables, a, b, known);
                    differ(&add.differ) || differ(&other.differ)
                };
                !same(add.atom, other.atom) && !instance.iter().zip(&other_instance).any(apart)
            };
            if add.several || adds[..i].iter().any(meets) {
                return Verdict::Broken;
            }
            let held = |atom: &Atom| add.held.iter().any(|h| same(h, atom));
            let goes = |d: &&Move<'_>| {
                let with = d.when.iter().all(|w| add.when.iter().any(|a| std::ptr::eq(*a, *w)));
                !d.several && with && held(d.atom)
            };
            let balances = |d: &Move<'_>| {
                candidate.member(d.atom.predicate).is_some_and(|m| m.instance(&d.atom.arguments) == instance)
            };
            if held(add.atom) || happening.deletes.iter().filter(goes).any(balances) {
                continue;
            }
            let others = happening.deletes.iter().filter(goes);
            let others = others.filter(|d| candidate.member(d.atom.predicate).is_none());
            return Verdict::Unbalanced(others.filter_map(|d| remedy(d.atom, &instance)).collect());
        }
    }
    Verdict::Holds
}

fn same(a: &Atom, b: &Atom) -> bool {
    a.predicate == b.predicate && a.arguments == b.arguments
}

/// The way in which an atom belongs to the instance.
fn remedy(atom: &Atom, instance: &[Term]) -> Option<Member> {
    let mut free: Vec<usize> = (0..atom.arguments.len()).collect();
    let mut parameters = Vec::new();
    for &term in instance {
        let at = free.iter().position(|&p| atom.arguments[p] == term)?;
        parameters.push(free.remove(at));
    }
    (free.len() <= 1).then(|| Member {
        predicate: atom.predicate,
        parameters,
        counted: free.first().copied(),
    })
}

/// Whether two terms are surely different objects.
pub(crate) fn differ(
    domain: &Domain,
    variables: &Variables,
    a: Term,
    b: Term,
    known: &[(Term, Term)],
) -> bool {
    if known.iter().any(|&(x, y)| (x, y) == (a, b) || (y, x) == (a, b)) {
        return true;
    }
    match (a, b) {
        (Term::Object(a), Term::Object(b)) => a != b,
        (Term::Variable(a), Term::Variable(b)) => {
            let types = |v: VariableId| variables.slots.get(v).map(|v| &v.types);
            a != b && apart(domain, types(a), types(b))
        }
        _ => false,
    }
}

/// Whether no object can have types of both: no declared type is below both.
fn apart(domain: &Domain, a: Option<&TypeSet>, b: Option<&TypeSet>) -> bool {
    let (Some(a), Some(b)) = (a, b) else { return false };
    let table = &domain.types;
    let known = !a.is_unknown() && !b.is_unknown();
    known && table.enumerate().all(|(t, _)| !(table.is_in(t, a) && table.is_in(t, b)))
}
