//! One change of a plan without times, without applying it.
//!
//! Plans may have ten thousand steps, and hundreds of changes are tried. So a trial reads the changed plan instead of
//! making it: [`Edit::step`] returns its step at a position in constant time.

use super::change::Repair;
use crate::plan::StepIndex;
use pddl::PlanStep;

/// A change.
#[derive(Clone, Debug)]
pub(super) enum Edit {
    Drop(usize),
    Insert { before: usize, steps: Vec<PlanStep> },
    Move { step: usize, before: usize },
    Swap { first: usize, second: usize },
    Replace { index: usize, step: PlanStep },
}

impl Edit {
    /// The first position at which the plan may become another one.
    pub(super) fn first(&self) -> usize {
        match *self {
            Self::Drop(index) | Self::Replace { index, .. } => index,
            Self::Insert { before, .. } => before,
            Self::Move { step, before } => step.min(before),
            Self::Swap { first, second } => first.min(second),
        }
    }

    /// The step of the changed plan at a position; `None` behind its end.
    pub(super) fn step<'s>(&'s self, steps: &'s [PlanStep], position: usize) -> Option<&'s PlanStep> {
        match self {
            Self::Drop(index) => steps.get(if position < *index { position } else { position + 1 }),
            Self::Insert { before, steps: new } => match position.checked_sub(*before) {
                None => steps.get(position),
                Some(behind) => new.get(behind).or_else(|| steps.get(position - new.len())),
            },
            Self::Move { step, before } => {
                // The position of the step after its removal from the old one.
                let to = if before > step { before - 1 } else { *before };
                steps.get(match position {
                    _ if position == to => *step,
                    _ if to < position && position <= *step => position - 1,
                    _ if *step <= position && position < to => position + 1,
                    _ => position,
                })
            }
            Self::Swap { first, second } => steps.get(match position {
                _ if position == *first => *second,
                _ if position == *second => *first,
                _ => position,
            }),
            Self::Replace { index, step } if *index == position => Some(step),
            Self::Replace { .. } => steps.get(position),
        }
    }

    /// All steps of the changed plan.
    pub(super) fn applied(&self, steps: &[PlanStep]) -> Vec<PlanStep> {
        (0..).map_while(|position| self.step(steps, position)).cloned().collect()
    }

    /// How much it changes.
    pub(super) fn size(&self) -> usize {
        match self {
            Self::Drop(_) | Self::Move { .. } | Self::Replace { .. } => 1,
            Self::Insert { steps, .. } => steps.len(),
            Self::Swap { .. } => 2,
        }
    }

    pub(super) fn repair(self) -> Repair {
        match self {
            Self::Drop(index) => Repair::Drop(StepIndex::at(index)),
            Self::Insert { before, steps } => Repair::Insert { before: StepIndex::at(before), steps },
            Self::Move { step, before } => {
                Repair::Move { step: StepIndex::at(step), before: StepIndex::at(before) }
            }
            Self::Swap { first, second } => Repair::Swap {
                first: StepIndex::at(first.min(second)),
                second: StepIndex::at(first.max(second)),
            },
            Self::Replace { index, step } => {
                Repair::Replace { step: StepIndex::at(index), arguments: step.arguments }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Edit;
    use pddl::model::{ActionId, ObjectId};
    use pddl::{PlanStep, Span};
    use proptest::prelude::*;

    fn step(number: u32) -> PlanStep {
        PlanStep { action: ActionId(0), arguments: vec![ObjectId(number)], span: Span::default() }
    }

    fn numbers(steps: &[PlanStep]) -> Vec<u32> {
        steps.iter().map(|step| step.arguments[0].0).collect()
    }

    proptest! {
        #[test]
        fn reading_is_making(count in 1_usize..8, one in 0_usize..8, other in 0_usize..9, kind in 0..5) {
            let (one, other) = (one % count, other % (count + 1));
            let steps: Vec<PlanStep> = (0..).map(step).take(count).collect();
            let mut made = numbers(&steps);
            let edit = match kind {
                0 => {
                    made.remove(one);
                    Edit::Drop(one)
                }
                1 => {
                    made.splice(other..other, [90, 91]);
                    Edit::Insert { before: other, steps: vec![step(90), step(91)] }
                }
                2 => {
                    let moved = made.remove(one);
                    made.insert(if other > one { other - 1 } else { other }, moved);
                    Edit::Move { step: one, before: other }
                }
                3 => {
                    made.swap(one, other % count);
                    Edit::Swap { first: one, second: other % count }
                }
                _ => {
                    made[one] = 90;
                    Edit::Replace { index: one, step: step(90) }
                }
            };
            prop_assert_eq!(numbers(&edit.applied(&steps)), &made[..]);
            let first = edit.first();
            prop_assert_eq!(&made[..first], &numbers(&steps)[..first]);
        }
    }
}
