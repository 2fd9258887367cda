//! Adds a raw operator, without the parts of its effects that its precondition decides.

use super::effects::GroundEffect;
use super::fold::Instantiator;
use super::raw::{RawChange, RawEffects, RawOperators};
use crate::ground::literal::Lit;
use crate::ids::id32;
use pddl::model::ActionId;
use std::collections::BTreeMap;

impl RawOperators {
    /// Adds an operator and returns its size.
    pub(super) fn add(
        &mut self,
        work: &mut Instantiator<'_>,
        action: ActionId,
        arguments: &[u32],
        mut precondition: Vec<Lit>,
        (effects, changes): (&[GroundEffect], &[RawChange]),
        cost: f64,
    ) -> usize {
        let mut always = RawEffects::default();
        let mut by_condition: BTreeMap<Vec<Lit>, RawEffects> = BTreeMap::new();
        // This also marks the groups of the precondition.
        work.without_implied(&mut precondition);
        let marks = &work.marks;
        // An atom that the precondition excludes does not hold, so it need not be deleted.
        let is_absent = |atom: u32| {
            precondition.binary_search(&(atom << 1)).is_err() && marks.exclude(work.exclusions, atom)
        };
        let contradicts = |condition: &[Lit]| {
            let absent = condition.iter().any(|&l| l & 1 == 0 && is_absent(l >> 1));
            absent || condition.iter().any(|l| precondition.binary_search(&(l ^ 1)).is_ok())
        };
        let given = |l: Lit| precondition.binary_search(&l).is_ok() || (l & 1 == 1 && is_absent(l >> 1));
        for (condition, positive, atom) in effects {
            if (!positive && is_absent(*atom)) || contradicts(condition) {
                continue;
            }
            let open: Vec<Lit> = condition.iter().copied().filter(|&l| !given(l)).collect();
            let into = if open.is_empty() { &mut always } else { by_condition.entry(open).or_default() };
            (if *positive { &mut into.adds } else { &mut into.deletes }).push(*atom);
        }
        for change in changes.iter().filter(|change| !contradicts(&change.condition)) {
            let mut change = change.clone();
            change.condition.retain(|&l| !given(l));
            self.numbers.push(change);
        }
        let always = tidy(always);
        self.actions.push(action);
        self.arguments.push(arguments.iter().copied());
        self.preconditions.push(precondition);
        self.adds.push(always.adds);
        self.deletes.push(always.deletes);
        for (condition, effects) in by_condition {
            let effects = tidy(effects);
            self.conditions.push(condition);
            self.conditional_adds.push(effects.adds);
            self.conditional_deletes.push(effects.deletes);
        }
        self.conditional_ends.push(id32(self.conditions.len()));
        self.costs.push(cost);
        self.number_ends.push(id32(self.numbers.len()));
        self.size(&self.get(id32(self.len() - 1)))
    }
}

/// Sorts the effects without duplicates; an add wins over a delete of the same atom.
fn tidy(mut effects: RawEffects) -> RawEffects {
    effects.adds.sort_unstable();
    effects.adds.dedup();
    effects.deletes.sort_unstable();
    effects.deletes.dedup();
    effects.deletes.retain(|d| effects.adds.binary_search(d).is_err());
    effects
}
