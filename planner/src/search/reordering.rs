//! Reorders the steps of a plan.
//!
//! Problem: if a plan interleaves several activities, steps that belong together are far apart, and
//! no short window contains them. Idea: two steps may be swapped unless one adds or deletes a fact
//! that the other needs, adds or deletes. A chain of dependent steps is followed as far as possible
//! before the next chain begins: from the front, from the back, or in random order. Invariant:
//! steps that depend on each other through facts keep their order. Dependencies through axioms and
//! numbers are ignored, so a caller that needs a valid plan must replay it. Cost: linear in the
//! facts that the steps mention, plus the pairs of a step that writes a fact and one that reads it.
//!
//! Source: partial orders: Bäckström, "Computational aspects of reordering plans", JAIR 1998 (here
//! with interference only); windows of them: Siddiqui & Haslum, "Continuing plan quality
//! optimisation", JAIR 2015, §4.

use super::chance::Chance;
use crate::ids::{FactId, OperatorId};
use crate::task::Task;
use rustc_hash::FxHashMap;

/// The order of the steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Arrangement {
    /// The order of the plan.
    Found,
    /// Chains, followed from the front.
    Forward,
    /// Chains, followed from the back.
    Backward,
    /// Chains from the front that are left at random; the same seed gives the same order.
    Jumping(u64),
}

/// Returns the steps in this order.
pub(crate) fn arranged(task: &Task, steps: &[OperatorId], arrangement: Arrangement) -> Vec<OperatorId> {
    let places = match arrangement {
        Arrangement::Found => return steps.to_vec(),
        Arrangement::Forward => chains(&dependents(task, steps), None),
        Arrangement::Jumping(seed) => chains(&dependents(task, steps), Some(seed)),
        Arrangement::Backward => {
            let after = dependents(task, steps);
            let mirrored = |i| steps.len() - 1 - i;
            // From the back, each step depends on the steps that follow from it.
            let mut before = vec![Vec::new(); steps.len()];
            for (i, later) in after.iter().enumerate() {
                for &j in later {
                    before[mirrored(j)].push(mirrored(i));
                }
            }
            chains(&before, None).into_iter().rev().map(mirrored).collect()
        }
    };
    places.into_iter().map(|i| steps[i]).collect()
}

/// For each step, the later steps that must stay behind it. A step may be listed more than once.
fn dependents(task: &Task, steps: &[OperatorId]) -> Vec<Vec<usize>> {
    let mut after = vec![Vec::new(); steps.len()];
    // By fact: the last step that wrote it, and the steps that have read it since.
    let mut writer: FxHashMap<FactId, usize> = FxHashMap::default();
    let mut readers: FxHashMap<FactId, Vec<usize>> = FxHashMap::default();
    for (i, &step) in steps.iter().enumerate() {
        let operator = task.operator(step);
        let conditions = operator.conditional.iter().map(|e| e.condition);
        let reads = std::iter::once(operator.precondition)
            .chain(conditions)
            .flat_map(|l| l.positive.iter().chain(l.negative));
        for fact in reads {
            if let Some(&by) = writer.get(fact) {
                after[by].push(i);
            }
            readers.entry(*fact).or_default().push(i);
        }
        let conditional = operator.conditional.iter().flat_map(|e| e.adds.iter().chain(e.deletes));
        for fact in operator.adds.iter().chain(operator.deletes).chain(conditional) {
            for by in readers.remove(fact).unwrap_or_default().into_iter().chain(writer.insert(*fact, i)) {
                if by != i {
                    after[by].push(i);
                }
            }
        }
    }
    after
}

/// Returns an order in which each step comes after those that it depends on, as close behind the
/// last of them as possible.
fn chains(after: &[Vec<usize>], seed: Option<u64>) -> Vec<usize> {
    let mut open = vec![0_usize; after.len()];
    after.iter().flatten().for_each(|&j| open[j] += 1);
    let mut ready: Vec<usize> = (0..after.len()).rev().filter(|&i| open[i] == 0).collect();
    let mut places = Vec::with_capacity(after.len());
    let mut chance = seed.map(Chance::new);
    while let Some(top) = ready.len().checked_sub(1) {
        let mut chosen = top;
        if let Some(chance) = &mut chance
            && chance.below(4) == 0
        {
            chosen = chance.below(ready.len());
        }
        let step = ready.remove(chosen);
        places.push(step);
        for &j in after[step].iter().rev() {
            open[j] -= 1;
            if open[j] == 0 {
                ready.push(j);
            }
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::chains;

    #[test]
    fn a_chain_is_followed_before_the_next_begins() {
        // Two interleaved chains: 0 2 4 and 1 3. Step 5 depends on both.
        let after = [vec![2], vec![3], vec![4], vec![5, 5], vec![5], vec![]];
        assert_eq!(chains(&after, None), [0, 2, 4, 1, 3, 5]);
        for seed in 0..20 {
            let places = chains(&after, Some(seed));
            let at = |step| places.iter().position(|&p| p == step).unwrap();
            assert_eq!(places.len(), 6);
            for (i, later) in after.iter().enumerate() {
                assert!(later.iter().all(|&j| at(i) < at(j)), "{places:?}");
            }
        }
    }
}
