//! Atoms and equations with their sign, so that two places can be compared.

use pddl::Span;
use pddl::model::{Atom, Condition, ConditionKind, PredicateId, Term};
use rustc_hash::FxHashMap;

/// What is true or false.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Fact {
    Atom(PredicateId, Vec<Term>),
    /// The smaller term first.
    Same(Term, Term),
}

impl Fact {
    pub(super) fn of(atom: &Atom) -> Self {
        Self::Atom(atom.predicate, atom.arguments.clone())
    }
}

/// A fact or its negation, and where it stands.
#[derive(Clone, Debug)]
pub(super) struct Literal {
    pub(super) fact: Fact,
    pub(super) positive: bool,
    pub(super) span: Span,
}

impl Literal {
    /// The condition as a literal, if it is one.
    pub(super) fn of(condition: &Condition) -> Option<Self> {
        let span = condition.span;
        let (fact, positive) = match &condition.kind {
            ConditionKind::Atom(atom) => (Fact::of(atom), true),
            ConditionKind::Same(a, b) => (Fact::Same(*a.min(b), *a.max(b)), true),
            ConditionKind::Not(inner) => {
                let inner = Self::of(inner)?;
                (inner.fact, !inner.positive)
            }
            _ => return None,
        };
        Some(Self { fact, positive, span })
    }

    pub(super) fn contradicts(&self, other: &Self) -> bool {
        self.fact == other.fact && self.positive != other.positive
    }

    pub(super) fn repeats(&self, other: &Self) -> bool {
        self.fact == other.fact && self.positive == other.positive
    }
}

/// Literals that contradict an earlier one, with the first such.
pub(super) fn contradictions(literals: &[Literal]) -> impl Iterator<Item = (&Literal, &Literal)> {
    // A large goal is compared by hashing.
    let mut first: FxHashMap<(&Fact, bool), &Literal> = FxHashMap::default();
    literals.iter().filter_map(move |literal| {
        first.entry((&literal.fact, literal.positive)).or_insert(literal);
        first.get(&(&literal.fact, !literal.positive)).map(|&earlier| (literal, earlier))
    })
}

/// The parts of a conjunction, conjunctions in it flattened.
pub(super) fn conjuncts<'a>(condition: &'a Condition, into: &mut Vec<&'a Condition>) {
    match &condition.kind {
        ConditionKind::And(parts) => parts.iter().for_each(|part| conjuncts(part, into)),
        _ => into.push(condition),
    }
}

/// The literals that must hold for all of the conditions to hold.
pub(super) fn required<'a>(conditions: impl IntoIterator<Item = &'a Condition>) -> Vec<Literal> {
    let mut parts = Vec::new();
    conditions.into_iter().for_each(|condition| conjuncts(condition, &mut parts));
    parts.into_iter().filter_map(Literal::of).collect()
}

/// Conditions that are asked for together, or of which one is enough.
pub(super) enum Group<'a> {
    All(Vec<&'a Condition>),
    Any(Vec<&'a Condition>),
}

/// All groups in some conditions that must hold together: they themselves, and those inside of their parts.
pub(super) fn groups<'a>(conditions: impl IntoIterator<Item = &'a Condition>) -> Vec<Group<'a>> {
    let mut all = Vec::new();
    conditions.into_iter().for_each(|condition| conjuncts(condition, &mut all));
    let mut groups = Vec::new();
    all.iter().for_each(|condition| inside(condition, &mut groups));
    groups.push(Group::All(all));
    groups
}

fn inside<'a>(condition: &'a Condition, groups: &mut Vec<Group<'a>>) {
    match &condition.kind {
        ConditionKind::And(_) => groups.extend(self::groups([condition])),
        ConditionKind::Or(parts) => {
            parts.iter().for_each(|part| inside(part, groups));
            groups.push(Group::Any(parts.iter().collect()));
        }
        ConditionKind::Not(inner) | ConditionKind::Exists(_, inner) | ConditionKind::Forall(_, inner) => {
            groups.extend(self::groups([&**inner]));
        }
        ConditionKind::Imply(left, right) => {
            groups.extend(self::groups([&**left]));
            groups.extend(self::groups([&**right]));
        }
        _ => {}
    }
}
