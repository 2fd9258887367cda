//! Groups of facts of which at most one holds, and finite-domain variables made of them.
//!
//! Problem: facts are not independent: an object in one room is in no other room. Idea: the groups
//! come from the domain's invariants. Greedily, the group with the most facts without a variable
//! becomes a variable. A fact in no group is a variable of its own. Invariant: in every state that
//! operators reach from the initial one, at most one fact of a group holds, and exactly one if the
//! group is exact. A state that a caller makes up may violate this; [`Mutexes::hold_in`] checks it.
//!
//! Source: Helmert, "Concise finite-domain representations for PDDL planning tasks", AIJ 2009, §5–6.

use super::{Operator, Operators, Rows, State, contains};
use crate::ids::{FactId, id32};
use budget::{Interrupted, Meter};
use pddl::model::Idx;

/// The mutex groups.
#[derive(Clone, Debug, Default)]
pub struct Mutexes {
    /// The facts of each group, sorted.
    groups: Rows,
    /// The groups of each fact, sorted.
    of: Rows,
    /// By group: whether exactly one of its facts always holds.
    exact: Vec<bool>,
}

impl Mutexes {
    /// Creates groups from sets of facts; operators and the initial state decide which groups are
    /// exact.
    pub(crate) fn new(
        facts: usize,
        groups: &[Vec<u32>],
        operators: &Operators,
        initial: &State,
        meter: &Meter<'_>,
    ) -> Result<Self, Interrupted> {
        let mut rows = Rows::default();
        for group in groups {
            meter.spend(8 + 4 * group.len())?;
            rows.push(group.iter().copied());
        }
        let of = rows.transposed(facts, meter)?;
        let one = |group: &Vec<u32>| group.iter().filter(|&&f| initial.contains(FactId(f))).count() == 1;
        let mut mutexes = Self { groups: rows, of, exact: groups.iter().map(one).collect() };
        if !groups.is_empty() {
            for operator in operators.iter() {
                let (deletes, adds) = (operator.deletes.len(), operator.adds.len());
                meter.spend(16 + 8 * deletes * (1 + adds) + 16 * operator.conditional.len())?;
                mutexes.leave(&operator);
            }
        }
        Ok(mutexes)
    }

    /// Marks the groups of which no fact may hold after the operator as not exact.
    fn leave(&mut self, operator: &Operator<'_>) {
        let Self { of, exact, .. } = self;
        let covered = |g: u32| operator.adds.iter().any(|a| of.row(a.0).contains(&g));
        for f in operator.deletes {
            for &g in of.row(f.0) {
                exact[g as usize] = exact[g as usize] && covered(g);
            }
        }
        for f in operator.conditional.iter().flat_map(|e| e.deletes) {
            of.row(f.0).iter().for_each(|&g| exact[g as usize] = false);
        }
    }

    /// The number of groups.
    pub fn len(&self) -> usize {
        self.exact.len()
    }

    /// Whether no groups are known.
    pub fn is_empty(&self) -> bool {
        self.exact.is_empty()
    }

    /// The facts of a group, in order.
    pub fn group(&self, group: usize) -> impl ExactSizeIterator<Item = FactId> + '_ {
        self.groups.row(id32(group)).iter().map(|&f| FactId(f))
    }

    /// Whether exactly one fact of the group holds in every reachable state.
    pub fn is_exact(&self, group: usize) -> bool {
        self.exact[group]
    }

    /// The groups that contain a fact, in order.
    pub fn groups_of(&self, fact: FactId) -> impl ExactSizeIterator<Item = usize> + '_ {
        self.of(fact).iter().map(|&g| g as usize)
    }

    fn of(&self, fact: FactId) -> &[u32] {
        if self.is_empty() { &[] } else { self.of.row(fact.0) }
    }

    /// Whether two different facts never hold together. Cost: the facts' groups, mostly one or two.
    pub fn are_mutex(&self, a: FactId, b: FactId) -> bool {
        if a == b {
            return false;
        }
        let (mut left, mut right) = (self.of(a), self.of(b));
        while let ([x, after_x @ ..], [y, after_y @ ..]) = (left, right) {
            match x.cmp(y) {
                std::cmp::Ordering::Equal => return true,
                std::cmp::Ordering::Less => left = after_x,
                std::cmp::Ordering::Greater => right = after_y,
            }
        }
        false
    }

    /// Whether at most one fact of each group holds.
    pub(crate) fn keep(&self, words: &[u64]) -> bool {
        let held = |g: usize| self.group(g).filter(|&f| contains(words, f)).count();
        (0..self.len()).all(|g| held(g) <= 1)
    }

    /// Whether a state satisfies all groups: at most one fact holds, and exactly one if the group
    /// is exact.
    pub fn hold_in(&self, state: &State) -> bool {
        (0..self.len()).all(|g| {
            let held = self.group(g).filter(|&f| state.contains(f)).count();
            held == 1 || (held == 0 && !self.exact[g])
        })
    }
}

/// A finite-domain variable: its values are its facts, and "none of them" unless it is complete.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variable {
    /// Its facts, in order.
    pub facts: Box<[FactId]>,
    /// Whether one of them holds in every reachable state.
    pub complete: bool,
}

impl Variable {
    /// The number of values.
    pub fn size(&self) -> usize {
        self.facts.len() + usize::from(!self.complete)
    }
}

/// Assigns each basic fact to one variable, largest groups first. Derived facts have no variable.
pub(crate) fn variables(mutexes: &Mutexes, derived: &[bool]) -> Vec<Variable> {
    let mut taken = derived.to_vec();
    let mut left: Vec<usize> = (0..mutexes.len()).map(|g| mutexes.group(g).len()).collect();
    let most = left.iter().copied().max().unwrap_or(0);
    let mut by_size: Vec<Vec<usize>> = vec![Vec::new(); most + 1];
    (0..mutexes.len()).rev().for_each(|g| by_size[left[g]].push(g));
    let mut found = Vec::new();
    for size in (2..=most).rev() {
        while let Some(group) = by_size[size].pop() {
            if left[group] < size {
                by_size[left[group]].push(group);
                continue;
            }
            let facts: Vec<FactId> = mutexes.group(group).filter(|f| !taken[f.index()]).collect();
            for &f in &facts {
                taken[f.index()] = true;
                mutexes.of(f).iter().for_each(|&g| left[g as usize] -= 1);
            }
            // In a part of an exact group, possibly no fact holds.
            let complete = mutexes.is_exact(group) && facts.len() == mutexes.group(group).len();
            found.push(Variable { facts: facts.into(), complete });
        }
    }
    let single = (0..taken.len()).filter(|&f| !taken[f]).map(FactId::from_index);
    found.extend(single.map(|f| Variable { facts: Box::new([f]), complete: false }));
    found
}
