//! Matching the subtasks of the plan with those of the network.
//!
//! Problem: the plan lists its subtasks in any order, and a network may have equal subtasks that only its ordering
//! distinguishes. Idea: a search over the assignments, subtask by subtask, that binds the variables of the network on
//! the way; interchangeable subtasks are tried in one order only. Invariant: an [`Assignment`] binds each variable
//! that a task determines. Cost: linear where names and arguments distinguish the subtasks; bounded by a budget.

use super::schema::{Schema, unify};
use super::tree::Range;
use crate::scene::{Binding, Clock, Scene};
use crate::state::State;
use crate::universe::Universe;
use crate::verdict::{NetworkFault, Parent};
use pddl::PlanReference;
use pddl::model::{ObjectId, SubtaskHead, VariableId};
use rustc_hash::FxHashMap;

/// The most candidates that are tried in a whole plan.
pub(super) const TRIES: u64 = 20_000_000;
/// The most assignments of one task that are considered.
const ASSIGNMENTS: usize = 256;

/// A subtask of the plan.
#[derive(Clone, Copy)]
pub(super) struct Child<'p> {
    pub(super) head: SubtaskHead,
    pub(super) arguments: &'p [ObjectId],
    pub(super) range: Range,
    pub(super) reference: PlanReference,
}

/// Per subtask of the network, the position of the plan's subtask; and the variables' values.
#[derive(Clone, Debug)]
pub(super) struct Assignment {
    pub(super) children: Vec<u32>,
    pub(super) binding: Binding,
}

/// The result of a match.
#[derive(Debug)]
pub(super) enum Match {
    /// At least one assignment.
    Found {
        assignments: Vec<Assignment>,
        /// Whether there may be further ones.
        more: bool,
    },
    /// No assignment, for this reason.
    Fault(NetworkFault),
    /// No assignment, because the constraints fail, for instance under this binding.
    Constraints(Binding),
}

/// The search reached its limit.
#[derive(Debug)]
pub(super) struct Limit;

/// The conditions of an assignment besides names and arguments.
#[derive(Clone, Copy, PartialEq)]
enum Strictness {
    All,
    NotTheOrder,
    NamesOnly,
}

pub(super) struct Matching<'m, 'a> {
    pub(super) universe: &'m Universe,
    pub(super) state: &'m State,
    pub(super) schema: &'m Schema<'a>,
    pub(super) of: Parent,
    pub(super) children: &'m [Child<'m>],
    /// The variables that the task's arguments bind.
    pub(super) binding: Binding,
}

impl Matching<'_, '_> {
    /// All assignments, or the reason why the subtasks do not match the network.
    pub(super) fn all(&self, tries: &mut u64) -> Result<Match, Limit> {
        let assignments = self.search(Strictness::All, ASSIGNMENTS, tries)?;
        if !assignments.is_empty() {
            let more = assignments.len() == ASSIGNMENTS;
            return Ok(Match::Found { assignments, more });
        }
        if let Some(found) = self.search(Strictness::NotTheOrder, 1, tries)?.pop()
            && let Some((before, after)) = self.too_early(&found.children)
        {
            let (before, after) = (self.reference(before), self.reference(after));
            return Ok(Match::Fault(NetworkFault::Ordering { of: self.of, before, after }));
        }
        if let Some(found) = self.search(Strictness::NamesOnly, 1, tries)?.pop() {
            return Ok(Match::Constraints(found.binding));
        }
        Ok(Match::Fault(self.nearest()))
    }

    fn reference(&self, child: u32) -> PlanReference {
        self.children[child as usize].reference
    }

    fn search(&self, strictness: Strictness, most: usize, tries: &mut u64) -> Result<Vec<Assignment>, Limit> {
        let subtasks = &self.schema.network.subtasks;
        let mut found = Vec::new();
        if subtasks.len() != self.children.len() {
            return Ok(found);
        }
        let mut candidates = FxHashMap::<SubtaskHead, Vec<u32>>::default();
        for (place, child) in (0u32..).zip(self.children) {
            candidates.entry(child.head).or_default().push(place);
        }
        let mut binding = self.binding.clone();
        let mut bound: Vec<VariableId> = Vec::new();
        let mut chosen: Vec<Option<u32>> = vec![None; subtasks.len()];
        let mut used = vec![false; subtasks.len()];
        // For each chosen subtask: the number of candidates tried, and the number of variables
        // bound before.
        let mut way: Vec<(usize, usize)> = Vec::new();
        let mut next = 0;
        loop {
            let depth = way.len();
            let marks = bound.len();
            let mut step = None;
            if depth == subtasks.len() {
                if self.accepts(strictness, &chosen, &mut binding) {
                    let children = chosen.iter().filter_map(|child| *child).collect();
                    found.push(Assignment { children, binding: binding.clone() });
                    if found.len() == most {
                        return Ok(found);
                    }
                }
            } else {
                let list = candidates.get(&subtasks[depth].head).map_or(&[] as &[u32], Vec::as_slice);
                while let Some(&child) = list.get(next) {
                    next += 1;
                    *tries = tries.checked_sub(1).ok_or(Limit)?;
                    if used[child as usize] || !self.may_be(strictness, depth, child, &chosen) {
                        continue;
                    }
                    let objects = self.children[child as usize].arguments;
                    let (terms, variables) = (&subtasks[depth].arguments, self.schema.variables);
                    if unify(self.universe, variables, terms, objects, &mut binding, &mut bound).is_ok() {
                        step = Some(child);
                        break;
                    }
                    unbind(&mut binding, &mut bound, marks);
                }
            }
            if let Some(child) = step {
                chosen[depth] = Some(child);
                used[child as usize] = true;
                way.push((next, marks));
                next = 0;
            } else {
                let Some((tried, marks)) = way.pop() else { return Ok(found) };
                next = tried;
                unbind(&mut binding, &mut bound, marks);
                if let Some(child) = chosen[way.len()].take() {
                    used[child as usize] = false;
                }
            }
        }
    }

    /// Whether a child can be that subtask, given the choices so far.
    fn may_be(&self, strictness: Strictness, subtask: usize, child: u32, chosen: &[Option<u32>]) -> bool {
        let chosen = |subtask: u32| chosen[subtask as usize];
        if self.schema.twin[subtask].and_then(chosen).is_some_and(|twin| twin > child) {
            return false;
        }
        let range = |child: u32| self.children[child as usize].range;
        let follows =
            |before: Range, after: Range| before.is_empty() || after.is_empty() || before.end <= after.first;
        let mut before = self.schema.before[subtask].iter().filter_map(|&b| chosen(b));
        let mut after = self.schema.after[subtask].iter().filter_map(|&a| chosen(a));
        strictness != Strictness::All
            || (before.all(|b| follows(range(b), range(child)))
                && after.all(|a| follows(range(child), range(a))))
    }

    fn accepts(&self, strictness: Strictness, chosen: &[Option<u32>], binding: &mut Binding) -> bool {
        if strictness == Strictness::NamesOnly {
            return true;
        }
        let (universe, variables) = (self.universe, self.schema.variables);
        let scene = Scene { universe, state: self.state, variables, clock: Clock::steps(0) };
        if !scene.holds(&self.schema.constraints, binding) {
            return false;
        }
        let children: Vec<u32> = chosen.iter().filter_map(|child| *child).collect();
        strictness != Strictness::All || self.too_early(&children).is_none()
    }

    /// Two of the plan's subtasks in the wrong order: the second begins before the first ends.
    fn too_early(&self, children: &[u32]) -> Option<(u32, u32)> {
        // For each subtask: the end of its last step or of a predecessor's, and the subtask of that
        // step.
        let mut ends: Vec<Option<(u32, u32)>> = vec![None; children.len()];
        for &subtask in &self.schema.order {
            let child = children[subtask as usize];
            let range = self.children[child as usize].range;
            let before = self.schema.before[subtask as usize].iter();
            let latest = before.filter_map(|&b| ends[b as usize]).max();
            if let Some((end, before)) = latest
                && !range.is_empty()
                && range.first < end
            {
                return Some((before, child));
            }
            let own = (!range.is_empty()).then_some((range.end, child));
            ends[subtask as usize] = own.max(latest);
        }
        None
    }

    /// The subtasks that a greedy match leaves over on both sides.
    fn nearest(&self) -> NetworkFault {
        let mut binding = self.binding.clone();
        let mut bound = Vec::new();
        let mut used = vec![false; self.children.len()];
        let mut missing = Vec::new();
        for subtask in &self.schema.network.subtasks {
            let fits = (0..self.children.len()).find(|&place| {
                let child = &self.children[place];
                if used[place] || child.head != subtask.head {
                    return false;
                }
                let marks = bound.len();
                let (terms, variables) = (&subtask.arguments, self.schema.variables);
                let objects = child.arguments;
                let fits = unify(self.universe, variables, terms, objects, &mut binding, &mut bound).is_ok();
                if !fits {
                    unbind(&mut binding, &mut bound, marks);
                }
                fits
            });
            match fits {
                Some(place) => used[place] = true,
                None => missing.push(subtask.span),
            }
        }
        let left = self.children.iter().zip(used).filter(|(_, used)| !used);
        let surplus = left.map(|(child, _)| child.reference).collect();
        NetworkFault::Subtasks { of: self.of, missing, surplus }
    }
}

fn unbind(binding: &mut Binding, bound: &mut Vec<VariableId>, marks: usize) {
    for variable in bound.drain(marks..) {
        binding.set(variable, None);
    }
}
