//! The distance between two plans.
//!
//! Idea: the distance is the number of steps that occur in only one of the two plans, as multisets.
//! That ignores their order, so the common steps outside a longest common subsequence are counted
//! as moved. Invariant: `removed + added + 2 moved` insertions and deletions turn one plan into the
//! other. Cost: the product of the lengths of both plans, without their common prefix and suffix.
//!
//! Source: Fox, Gerevini, Long & Serina, "Plan stability: replanning versus plan repair", ICAPS
//! 2006, §2 (which treats plans as sets of steps).

use crate::ids::OperatorId;
use crate::task::Task;
use rustc_hash::FxHashMap;

/// The difference between two plans.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Distance {
    /// Steps of the old plan that the new one lacks.
    pub removed: usize,
    /// Steps of the new plan that the old one lacks.
    pub added: usize,
    /// Common steps whose order among the common steps has changed.
    pub moved: usize,
}

impl Distance {
    /// The distance between two plans of a task. Operators of the same action with the same
    /// arguments count as the same step.
    pub fn between(task: &Task, old: &[OperatorId], new: &[OperatorId]) -> Self {
        let mut numbers = FxHashMap::default();
        let mut number = |&operator: &OperatorId| {
            let operator = task.operator(operator);
            let next = numbers.len();
            *numbers.entry((operator.action, operator.arguments)).or_insert(next)
        };
        let old: Vec<usize> = old.iter().map(&mut number).collect();
        let new: Vec<usize> = new.iter().map(&mut number).collect();
        Self::of(&old, &new)
    }

    /// The number of removed and added steps: the distance of Fox et al.
    pub fn steps(self) -> usize {
        self.removed + self.added
    }

    fn of(old: &[usize], new: &[usize]) -> Self {
        let prefix = old.iter().zip(new).take_while(|(a, b)| a == b).count();
        let (old, new) = (&old[prefix..], &new[prefix..]);
        let suffix = old.iter().rev().zip(new.iter().rev()).take_while(|(a, b)| a == b).count();
        let (old, new) = (&old[..old.len() - suffix], &new[..new.len() - suffix]);
        let mut count: FxHashMap<usize, usize> = FxHashMap::default();
        old.iter().for_each(|&a| *count.entry(a).or_default() += 1);
        let mut common = 0;
        for b in new {
            if let Some(left) = count.get_mut(b).filter(|left| **left > 0) {
                *left -= 1;
                common += 1;
            }
        }
        let moved = common - in_order(old, new);
        Self { removed: old.len() - common, added: new.len() - common, moved }
    }
}

/// Returns the length of a longest common subsequence.
fn in_order(old: &[usize], new: &[usize]) -> usize {
    let mut before = vec![0_usize; new.len() + 1];
    for a in old {
        let mut diagonal = 0;
        for (i, b) in new.iter().enumerate() {
            let above = before[i + 1];
            before[i + 1] = if a == b { diagonal + 1 } else { above.max(before[i]) };
            diagonal = above;
        }
    }
    before[new.len()]
}

#[cfg(test)]
mod tests {
    use super::Distance;

    #[test]
    fn steps_are_removed_added_and_moved() {
        let of = |old: &[usize], new: &[usize]| {
            let Distance { removed, added, moved } = Distance::of(old, new);
            [removed, added, moved]
        };
        assert_eq!(of(&[1, 2, 3], &[1, 2, 3]), [0, 0, 0]);
        assert_eq!(of(&[1, 2, 3], &[2, 3]), [1, 0, 0]);
        assert_eq!(of(&[1, 2, 3, 4], &[1, 5, 3, 4]), [1, 1, 0]);
        assert_eq!(of(&[], &[7, 8]), [0, 2, 0]);
        assert_eq!(of(&[1, 2, 3, 4, 5], &[5, 1, 3, 2, 4]), [0, 0, 2]);
        assert_eq!(of(&[1, 1, 2], &[1, 2, 2]), [1, 1, 0], "each as often as it occurs");
    }
}
