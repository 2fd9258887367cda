//! Maps the atoms and operators of the raw task to facts.

use crate::ground::instantiate::{RawOperator, RawOperators};
use crate::ground::literal::Lit;
use crate::ground::prune::Pruned;
use crate::ids::FactId;
use crate::task::{Literals, Operators};
use pddl::model::ObjectId;

/// The number of an atom that is not a fact.
pub(super) const NONE: u32 = u32::MAX;

/// The results of pruning, and the fact of each atom.
pub(super) struct View<'a> {
    pub(super) pruned: &'a Pruned,
    pub(super) numbers: &'a [u32],
}

impl View<'_> {
    /// The facts of a conjunction; `None` if it never holds.
    pub(super) fn literals(&self, literals: &[Lit]) -> Option<Literals> {
        let (mut positive, mut negative) = (0, 0);
        for &l in literals {
            match self.pruned.constant(l) {
                Some(true) => {}
                Some(false) => return None,
                None if l & 1 == 0 => positive += 1,
                None => negative += 1,
            }
        }
        // Literals are sorted, and facts are numbered in the order of their atoms.
        let facts = |negated: u32, count: usize| {
            let mut facts = Vec::with_capacity(count);
            let open = literals.iter().filter(|&&l| l & 1 == negated && self.pruned.constant(l).is_none());
            facts.extend(open.map(|&l| FactId(self.numbers[(l >> 1) as usize])));
            debug_assert!(facts.is_sorted());
            facts.into_boxed_slice()
        };
        Some(Literals { positive: facts(0, positive), negative: facts(1, negative) })
    }

    /// Replaces `facts` by the facts among sorted atoms.
    fn facts(&self, atoms: &[u32], facts: &mut Vec<FactId>) {
        facts.clear();
        facts.extend(atoms.iter().map(|&a| self.numbers[a as usize]).filter(|&n| n != NONE).map(FactId));
        debug_assert!(facts.is_sorted());
    }

    /// Writes the facts of a conjunction; `false` if it never holds.
    fn condition(&self, literals: &[Lit], positive: &mut Vec<FactId>, negative: &mut Vec<FactId>) -> bool {
        positive.clear();
        negative.clear();
        for &l in literals {
            match self.pruned.constant(l) {
                Some(true) => {}
                Some(false) => return false,
                None => {
                    let fact = FactId(self.numbers[(l >> 1) as usize]);
                    (if l & 1 == 0 { &mut *positive } else { &mut *negative }).push(fact);
                }
            }
        }
        true
    }

    /// Fills in the operator's parts and adds its conditional effects to `operators`. Returns
    /// `false` for a useless operator: it changes no needed fact, and `counts` says that its
    /// effects on numbers do not count.
    pub(super) fn operator(
        &self,
        all: &RawOperators,
        raw: &RawOperator<'_>,
        counts: bool,
        parts: &mut Parts,
        operators: &mut Operators,
    ) -> bool {
        // The condition of a useless operator may read atoms that were not kept, so it is mapped
        // last.
        let Parts { arguments, positive, negative, adds, deletes, conditional } = parts;
        self.facts(raw.adds, adds);
        self.facts(raw.deletes, deletes);
        let mut effects = 0;
        for (condition, adds, deletes) in all.conditional(raw) {
            let [p, n, a, d] = conditional;
            self.facts(adds, a);
            self.facts(deletes, d);
            if (!a.is_empty() || !d.is_empty()) && self.condition(condition, p, n) {
                operators.push_conditional([p, n, a, d]);
                effects += 1;
            }
        }
        if adds.is_empty() && deletes.is_empty() && effects == 0 && !counts {
            return false;
        }
        self.condition(raw.precondition, positive, negative);
        arguments.clear();
        arguments.extend(raw.arguments.iter().map(|&o| ObjectId(o)));
        true
    }
}

/// Buffers for the parts of one operator.
#[derive(Default)]
pub(super) struct Parts {
    pub(super) arguments: Vec<ObjectId>,
    positive: Vec<FactId>,
    negative: Vec<FactId>,
    adds: Vec<FactId>,
    deletes: Vec<FactId>,
    conditional: [Vec<FactId>; 4],
}

impl Parts {
    pub(super) fn facts(&self) -> [&[FactId]; 4] {
        [&self.positive, &self.negative, &self.adds, &self.deletes]
    }
}
