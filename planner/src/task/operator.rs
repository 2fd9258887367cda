//! Ground operators, conjunctions of literals, goals.

use super::{ConditionalEffects, GroundAtom, NumericEffects, contains, set, unset};
use crate::ids::FactId;
use pddl::model::{ActionId, ObjectId};

/// A conjunction of ground literals.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Literals {
    /// Facts that must hold, sorted.
    pub positive: Box<[FactId]>,
    /// Facts that must not hold, sorted.
    pub negative: Box<[FactId]>,
}

impl Literals {
    pub(crate) fn hold_in(&self, words: &[u64]) -> bool {
        self.as_ref().hold_in(words)
    }

    /// How many literals.
    pub fn len(&self) -> usize {
        self.as_ref().len()
    }

    /// Whether it holds everywhere.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The same, borrowed as operators give theirs.
    pub fn as_ref(&self) -> LiteralsRef<'_> {
        LiteralsRef { positive: &self.positive, negative: &self.negative }
    }
}

/// A conjunction that someone else holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LiteralsRef<'a> {
    /// Facts that must hold, sorted.
    pub positive: &'a [FactId],
    /// Facts that must not hold, sorted.
    pub negative: &'a [FactId],
}

impl LiteralsRef<'_> {
    pub(crate) fn hold_in(self, words: &[u64]) -> bool {
        self.positive.iter().all(|&f| contains(words, f))
            && self.negative.iter().all(|&f| !contains(words, f))
    }

    /// How many literals.
    pub fn len(self) -> usize {
        self.positive.len() + self.negative.len()
    }

    /// Whether it holds everywhere.
    pub fn is_empty(self) -> bool {
        self.len() == 0
    }
}

/// Effects under a condition on the state before.
#[derive(Clone, Copy, Debug)]
pub struct ConditionalEffect<'a> {
    /// When.
    pub condition: LiteralsRef<'a>,
    /// Facts that become true.
    pub adds: &'a [FactId],
    /// Facts that become false unless something adds them.
    pub deletes: &'a [FactId],
}

/// A ground operator. Several may stand for one ground action: copies of a disjunctive or
/// existential precondition.
#[derive(Clone, Copy, Debug)]
pub struct Operator<'a> {
    /// The schema.
    pub action: ActionId,
    /// The schema's parameters.
    pub arguments: &'a [ObjectId],
    /// When it may be applied.
    pub precondition: LiteralsRef<'a>,
    /// Facts that become true.
    pub adds: &'a [FactId],
    /// Facts that become false (disjoint from `adds`).
    pub deletes: &'a [FactId],
    /// What else happens.
    pub conditional: ConditionalEffects<'a>,
    /// What it does to numbers.
    pub(crate) numeric: Option<&'a NumericEffects>,
    /// Its cost in units of `1 / Task::cost_scale`.
    pub cost: u32,
}

impl Operator<'_> {
    /// Whether it changes numbers that something reads.
    pub fn changes_numbers(&self) -> bool {
        self.numeric.is_some_and(|effects| !effects.updates.is_empty())
    }

    /// How many literals and changes, those under conditions left out.
    pub(crate) fn size(&self) -> usize {
        self.precondition.len() + self.adds.len() + self.deletes.len()
    }

    pub(crate) fn apply(&self, state: &[u64], next: &mut [u64]) {
        for &f in self.deletes {
            unset(next, f);
        }
        for effect in self.conditional.iter().filter(|e| e.condition.hold_in(state)) {
            for &f in effect.deletes {
                unset(next, f);
            }
        }
        for &f in self.adds {
            set(next, f);
        }
        for effect in self.conditional.iter().filter(|e| e.condition.hold_in(state)) {
            for &f in effect.adds {
                set(next, f);
            }
        }
    }
}

/// What a search looks for.
#[derive(Clone, Debug, Default)]
pub struct Goal {
    /// The literals that must hold.
    pub literals: Literals,
    /// Set where grounding has shown that no reachable state satisfies the goal.
    pub impossible: Option<Impossible>,
}

/// Why a goal is impossible.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Impossible {
    /// These conjuncts are true in no reachable state.
    Atoms(Vec<GroundAtom>),
    /// These conjuncts forbid what holds in every reachable state.
    NegatedAtoms(Vec<GroundAtom>),
    /// These conjuncts exclude each other.
    Exclusive(Vec<GroundAtom>),
    /// A disjunction or quantified part cannot be satisfied.
    Formula,
}

impl Goal {
    /// A goal of literals.
    pub fn new(literals: Literals) -> Self {
        Self { literals, impossible: None }
    }

    pub(crate) fn holds_in(&self, words: &[u64]) -> bool {
        self.impossible.is_none() && self.literals.hold_in(words)
    }
}
