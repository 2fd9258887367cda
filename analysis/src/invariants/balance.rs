//! Whether a candidate's number can grow.
//!
//! Invariant: a candidate is said to hold only if every add of every happening is already true or
//! goes with a delete of an atom of the same instance that was true, and no two adds of one happening
//! can meet in one instance in which at most one atom held before (or, where that is asked for, they meet
//! only where some terms are equal, and the candidate says so). So it is a bound of one that is kept;
//! of larger numbers nothing is said.

use super::invariant::{Invariant, Member, Proviso};
use crate::changes::{Change, changes};
use crate::happening::Happening;
use pddl::model::{Atom, Condition, ConditionKind, Domain, Term, TypeSet, VariableId, Variables};

/// What surely holds: atoms, and terms that differ.
#[derive(Default)]
struct Known<'a> {
    held: Vec<&'a Atom>,
    differ: Vec<(Term, Term)>,
}

/// What a happening does, as far as it matters here.
pub(super) struct Moves<'a> {
    variables: &'a Variables,
    /// Just before.
    before: Known<'a>,
    pub(super) adds: Vec<Move<'a>>,
    deletes: Vec<Move<'a>>,
}

/// An add or a delete.
pub(super) struct Move<'a> {
    pub(super) atom: &'a Atom,
    /// What its `when`s say.
    inside: Known<'a>,
    /// The conditions of its `when`s.
    when: Vec<&'a Condition>,
    /// Whether it happens for several objects at once.
    several: bool,
}

impl<'a> Moves<'a> {
    pub(super) fn of(happening: &Happening<'a>) -> Self {
        let mut before = Known::default();
        happening.just_before.iter().for_each(|c| literals(c, &mut before.held, &mut before.differ));
        let mut moves =
            Self { variables: happening.variables, before, adds: Vec::new(), deletes: Vec::new() };
        for effect in &happening.effects {
            changes(effect, &mut |context, change| {
                let (atom, list) = match change {
                    Change::Add(atom) => (*atom, &mut moves.adds),
                    Change::Delete(atom) => (*atom, &mut moves.deletes),
                    Change::Assign(..) => return,
                };
                let mut inside = Known::default();
                context.when.iter().for_each(|c| literals(c, &mut inside.held, &mut inside.differ));
                let several = !context.forall.is_empty();
                list.push(Move { atom, inside, when: context.when.clone(), several });
            });
        }
        moves
    }

    fn holds_before(&self, change: &Move<'_>, atom: &Atom) -> bool {
        change.inside.held.iter().chain(&self.before.held).any(|h| same(h, atom))
    }
}

impl Moves<'_> {
    /// Whether two adds can be in one instance. They cannot if its parameters surely differ, nor if two
    /// atoms of that instance would have to hold before: then its number was more than one already.
    fn meet(&self, domain: &Domain, candidate: &Invariant, a: Side<'_>, b: Side<'_>) -> bool {
        let known = [&self.before, &a.0.inside, &b.0.inside];
        let apart = |x: Term, y: Term| known.iter().any(|k| differ(domain, self.variables, x, y, &k.differ));
        if a.1.iter().zip(b.1).any(|(&x, &y)| apart(x, y)) {
            return false;
        }
        let mut equal = Equal::default();
        a.1.iter().zip(b.1).for_each(|(&x, &y)| equal.join(x, y));
        // Where the parameters are equal, the two may be one and the same atom.
        let arguments = |atom: &Atom| atom.arguments.iter().map(|&t| equal.of(t)).collect::<Vec<_>>();
        if a.0.atom.predicate == b.0.atom.predicate && arguments(a.0.atom) == arguments(b.0.atom) {
            return false;
        }
        let instance: Vec<Term> = a.1.iter().map(|&t| equal.of(t)).collect();
        let mut inside: Vec<&Atom> = Vec::new();
        for &atom in known.iter().flat_map(|k| &k.held) {
            let Some(member) = candidate.member(atom.predicate) else { continue };
            if !member.instance(&atom.arguments).iter().map(|&t| equal.of(t)).eq(instance.iter().copied()) {
                continue;
            }
            let different = |other: &&Atom| {
                other.predicate != atom.predicate
                    || other.arguments.iter().zip(&atom.arguments).any(|(&x, &y)| apart(x, y))
            };
            if inside.iter().any(different) {
                return false;
            }
            inside.push(atom);
        }
        true
    }
}

/// An add and its instance.
type Side<'m> = (&'m Move<'m>, &'m [Term]);

/// Terms that are taken to be equal.
#[derive(Default)]
struct Equal(Vec<(Term, Term)>);

impl Equal {
    /// The term that stands for this one.
    fn of(&self, mut term: Term) -> Term {
        while let Some(&(_, next)) = self.0.iter().find(|(t, _)| *t == term) {
            term = next;
        }
        term
    }

    fn join(&mut self, a: Term, b: Term) {
        let (a, b) = (self.of(a), self.of(b));
        if a != b {
            // An object stands for the variables that are equal to it.
            let (from, to) = if matches!(a, Term::Object(_)) { (b, a) } else { (a, b) };
            self.0.push((from, to));
        }
    }
}

/// The atoms and inequalities among a condition's conjuncts.
pub fn literals<'a>(of: &'a Condition, held: &mut Vec<&'a Atom>, differ: &mut Vec<(Term, Term)>) {
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
    /// The work is used up, or the caller wants no more.
    GivenUp,
}

/// Holds a candidate against all happenings that add one of its predicates. Where `provisos` are taken,
/// two adds that meet only where terms are equal add one, instead of breaking the candidate.
pub(super) fn judge<'m, 'a: 'm>(
    domain: &Domain,
    candidate: &Invariant,
    moves: impl Iterator<Item = (usize, &'m Moves<'a>)>,
    mut provisos: Option<&mut Vec<Proviso>>,
    work: &mut usize,
    go_on: &mut dyn FnMut(usize) -> bool,
) -> Verdict {
    for (number, happening) in moves {
        let cost = happening.adds.len() * (1 + happening.deletes.len());
        let Some(left) = work.checked_sub(cost).filter(|_| go_on(1 + cost)) else { return Verdict::GivenUp };
        *work = left;
        let member = |m: &Move<'_>| candidate.member(m.atom.predicate);
        let adds: Vec<_> = happening.adds.iter().filter_map(|a| Some((a, member(a)?))).collect();
        for (i, (add, member)) in adds.iter().enumerate() {
            let instance = member.instance(&add.atom.arguments);
            let meets = |(other, other_member): &(&Move<'_>, &Member)| {
                !same(add.atom, other.atom)
                    && happening.meet(
                        domain,
                        candidate,
                        (add, &instance),
                        (other, &other_member.instance(&other.atom.arguments)),
                    )
            };
            if add.several {
                return Verdict::Broken;
            }
            for (other, other_member) in adds[..i].iter().filter(|o| meets(o)) {
                let other = other_member.instance(&other.atom.arguments);
                let pairs = instance.iter().copied().zip(other);
                let equal: Vec<(Term, Term)> = pairs.filter(|(a, b)| a != b).collect();
                let Some(provisos) = provisos.as_deref_mut().filter(|_| !equal.is_empty()) else {
                    return Verdict::Broken;
                };
                let proviso = Proviso { happening: number, equal };
                if !provisos.contains(&proviso) {
                    provisos.push(proviso);
                }
            }
            let goes = |d: &&Move<'_>| {
                let with = d.when.iter().all(|w| add.when.iter().any(|a| std::ptr::eq(*a, *w)));
                !d.several && with && happening.holds_before(add, d.atom)
            };
            let balances = |d: &Move<'_>| {
                candidate.member(d.atom.predicate).is_some_and(|m| m.instance(&d.atom.arguments) == instance)
            };
            if happening.holds_before(add, add.atom) || happening.deletes.iter().filter(goes).any(balances) {
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

/// Whether two terms are surely different objects, with pairs that are known to differ.
pub fn differ(domain: &Domain, variables: &Variables, a: Term, b: Term, known: &[(Term, Term)]) -> bool {
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
    a.zip(b).is_some_and(|(a, b)| !domain.types.overlap(a, b))
}
