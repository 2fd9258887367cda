//! What happened a moment ago, and who of it is in the way of what happens now.
//!
//! Problem: ten thousand actions that start at one time are fifty million pairs. Idea: what each needs and changes is
//! listed by atom and fluent, and who comes next looks its own up. Invariant: the lists hold those that are remembered,
//! in the order in which they happened, and perhaps some that were forgotten, at their beginning.
//!
//! Cost: the size of a footprint, whatever else happens.

use super::footprint::Footprint;
use crate::cause::Cause;
use crate::number::Number;
use crate::state::GroundAtom;
use crate::verdict::Shared;
use pddl::model::{GroundApplication, PredicateId};
use rustc_hash::FxHashMap;
use std::collections::VecDeque;

/// What two happenings may have in common, and what one of them does with it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Touch {
    /// It is needed.
    Needs(GroundAtom),
    /// It is added.
    Adds(GroundAtom),
    /// It is deleted.
    Deletes(GroundAtom),
    /// A derived predicate that is needed depends on it.
    Below(PredicateId),
    /// An atom of it is added or deleted.
    Changes(PredicateId),
    /// Its value is read.
    Reads(GroundApplication),
    /// It is increased or decreased.
    Shifts(GroundApplication),
    /// It is changed in another way.
    Sets(GroundApplication),
}

impl Touch {
    /// What must not happen at the same time.
    pub(super) fn each_rival(&self, visit: &mut dyn FnMut(Self)) {
        match self {
            Self::Needs(atom) => {
                visit(Self::Adds(atom.clone()));
                visit(Self::Deletes(atom.clone()));
            }
            Self::Adds(atom) => {
                visit(Self::Needs(atom.clone()));
                visit(Self::Deletes(atom.clone()));
            }
            Self::Deletes(atom) => {
                visit(Self::Needs(atom.clone()));
                visit(Self::Adds(atom.clone()));
            }
            Self::Below(predicate) => visit(Self::Changes(*predicate)),
            Self::Changes(predicate) => visit(Self::Below(*predicate)),
            Self::Reads(fluent) => {
                visit(Self::Shifts(fluent.clone()));
                visit(Self::Sets(fluent.clone()));
            }
            Self::Shifts(fluent) => {
                visit(Self::Reads(fluent.clone()));
                visit(Self::Sets(fluent.clone()));
            }
            Self::Sets(fluent) => {
                visit(Self::Reads(fluent.clone()));
                visit(Self::Shifts(fluent.clone()));
                visit(Self::Sets(fluent.clone()));
            }
        }
    }
}

#[derive(Debug)]
struct Recent {
    time: Number,
    what: Cause,
    footprint: Footprint,
}

/// What happened a moment ago, oldest first.
#[derive(Debug, Default)]
pub(super) struct Crowd {
    recent: VecDeque<Recent>,
    /// How many were forgotten.
    forgotten: usize,
    /// By what they touch, the numbers of those who do.
    by_touch: FxHashMap<Touch, VecDeque<usize>>,
}

impl Crowd {
    /// Forgets what happened so long before `now`.
    pub(super) fn forget(&mut self, now: Number, separation: Number) {
        while let Some(oldest) = self.recent.front() {
            if now.minus(oldest.time).is_ok_and(|age| age < separation) {
                return;
            }
            self.recent.pop_front();
            self.forgotten += 1;
        }
        if self.recent.is_empty() {
            self.by_touch.clear();
        }
    }

    /// The first that is in the way, and of what.
    pub(super) fn in_the_way(&mut self, footprint: &Footprint) -> Option<(Cause, Shared)> {
        let (forgotten, by_touch) = (self.forgotten, &mut self.by_touch);
        let mut first: Option<usize> = None;
        footprint.each_touch(&mut |touch| {
            touch.each_rival(&mut |rival| {
                let Some(numbers) = by_touch.get_mut(&rival) else { return };
                while numbers.front().is_some_and(|&number| number < forgotten) {
                    numbers.pop_front();
                }
                if let Some(&number) = numbers.front() {
                    first = Some(first.map_or(number, |first| first.min(number)));
                }
            });
        });
        let recent = self.recent.get(first? - forgotten)?;
        Some((recent.what, recent.footprint.interference(footprint)?))
    }

    /// Remembers what happens now.
    pub(super) fn push(&mut self, time: Number, what: Cause, footprint: Footprint) {
        let number = self.forgotten + self.recent.len();
        footprint.each_touch(&mut |touch| {
            let numbers = self.by_touch.entry(touch).or_default();
            if numbers.back() != Some(&number) {
                numbers.push_back(number);
            }
        });
        self.recent.push_back(Recent { time, what, footprint });
    }
}
