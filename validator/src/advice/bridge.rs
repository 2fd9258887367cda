//! A few missing steps, found together.
//!
//! A breadth-first search from the state before the failure, by this crate's own semantics. It ends when the failing
//! step is applicable or the goal holds, and skips states that it has seen. It is complete up to its depth, and
//! affordable only because the depth is small.

use super::edit::Edit;
use super::instances::Look;
use super::sequential_case::Case;
use super::track::Track;
use crate::trace::Diff;
use crate::value::{GroundAtom, Value};
use pddl::PlanStep;
use pddl::model::GroundApplication;
use std::collections::{BTreeMap, BTreeSet, HashSet, VecDeque};

/// The most steps that are inserted.
pub(super) const LONGEST: usize = 3;

/// The most states that are visited.
const STATES: usize = 20_000;

/// The most bridges that are tried.
const BRIDGES: usize = 2_000;

/// The difference to the state where the search began.
type Difference = (BTreeSet<GroundAtom>, BTreeMap<(u32, Vec<u32>), String>);

/// Short sequences of steps after which the failing step is applicable.
pub(super) fn bridge(track: &mut Track<'_, '_>, case: &Case) -> Vec<Edit> {
    let before = case.fails;
    track.go_to(before);
    if track.taken().len() != before {
        return Vec::new();
    }
    let mut edits = Vec::new();
    let mut seen: HashSet<Difference> = HashSet::from([Difference::default()]);
    let mut open: VecDeque<Vec<PlanStep>> = VecDeque::from([Vec::new()]);
    while let Some(path) = open.pop_front() {
        if !follow(track, before, &path) {
            continue;
        }
        let mut next = Vec::new();
        Look { prepared: track.prepared, state: track.state() }.all(&mut |step| next.push(step));
        for step in next {
            if track.left == 0 || seen.len() >= STATES || edits.len() >= BRIDGES {
                return edits;
            }
            track.back_to(before + path.len());
            if !track.take(&step) || !seen.insert(difference(&track.taken()[before..])) {
                continue;
            }
            let mut longer = path.clone();
            longer.push(step);
            let arrived = match track.steps.get(before) {
                Some(failing) => track.take(failing),
                None => track.at_goal(),
            };
            if arrived {
                edits.push(Edit::Insert { before, steps: longer.clone() });
            }
            if longer.len() < LONGEST {
                open.push_back(longer);
            }
        }
    }
    edits
}

/// Moves the track to the end of the path.
fn follow(track: &mut Track<'_, '_>, before: usize, path: &[PlanStep]) -> bool {
    track.back_to(before);
    path.iter().all(|step| track.take(step))
}

fn difference(taken: &[Diff]) -> Difference {
    let mut difference = Difference::default();
    for diff in taken {
        for atom in diff.added.iter().chain(&diff.deleted) {
            if !difference.0.remove(atom) {
                difference.0.insert(atom.clone());
            }
        }
        for change in &diff.fluents {
            let GroundApplication { function, arguments } = &change.fluent;
            let key = (function.0, arguments.iter().map(|object| object.0).collect());
            let value = match change.after {
                None => String::new(),
                Some(Value::Number(number)) => number.to_string(),
                Some(Value::Object(object)) => format!("{object:?}"),
            };
            difference.1.insert(key, value);
        }
    }
    difference
}
