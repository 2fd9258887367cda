//! The analysis of a failure of a plan without times.

use super::track::Track;
use super::wants::{Want, Wants};
use crate::cause::Cause;
use crate::trace::Diff;
use crate::verdict::{Breach, Failure};

/// The analysis of a failing plan.
pub(super) struct Case {
    /// The step that fails; the plan's length if no step fails.
    pub(super) fails: usize,
    pub(super) wants: Wants,
    /// For each want, the position of the last step that undid it or changed it.
    pub(super) taken_by: Vec<(usize, Want)>,
}

impl Case {
    /// The first position from which a step that achieves the want is not undone before the failure. For a fluent it is
    /// the start of the plan, because each change of the fluent matters.
    fn window(&self, want: &Want) -> usize {
        if matches!(want, Want::Another(_)) {
            return 0;
        }
        self.taken_by.iter().find(|(_, other)| other == want).map_or(0, |(position, _)| position + 1)
    }

    pub(super) fn earliest(&self) -> usize {
        self.wants.list.iter().map(|want| self.window(want)).min().unwrap_or(self.fails)
    }

    /// The steps that undid a want, the last ones first.
    pub(super) fn culprits(&self) -> Vec<usize> {
        let mut culprits: Vec<usize> = self.taken_by.iter().map(|(position, _)| *position).collect();
        culprits.sort_unstable_by(|a, b| b.cmp(a));
        culprits.dedup();
        culprits
    }

    /// Analyses a failure. Afterwards the track is right before it.
    pub(super) fn new(track: &mut Track<'_, '_>, failure: &Failure) -> Self {
        let count = track.steps.len();
        let fails = match failure {
            Failure::Precondition { at: Cause::Step(step), .. }
            | Failure::Effect { at: Cause::Step(step), .. }
            | Failure::Step { step, .. } => step.0 as usize,
            // The step that leads into the state that breaks the constraint.
            Failure::Constraint { breach: Breach::Here(state) | Breach::Again(state), .. } => {
                state.saturating_sub(1).min(count)
            }
            _ => count,
        };
        track.go_to(fails);
        let wants = Wants::of(track.prepared, track.state(), failure);
        let taken_by =
            wants.list.iter().filter_map(|want| Some((last_taken(track.taken(), want)?, want.clone())));
        Self { fails, taken_by: taken_by.collect(), wants }
    }
}

/// Whether a step undid a want.
pub(super) fn takes(diff: &Diff, want: &Want) -> bool {
    match want {
        Want::Holds(atom) => diff.deleted.contains(atom),
        Want::HoldsNot(atom) => diff.added.contains(atom),
        Want::Another(fluent) => diff.fluents.iter().any(|change| change.fluent == *fluent),
    }
}

fn last_taken(taken: &[Diff], want: &Want) -> Option<usize> {
    taken.iter().rposition(|diff| takes(diff, want))
}
