//! Visits all states and records which goals hold where.
//!
//! Problem: if the search exhausted the states, each part of the goal may be possible by itself. Idea: visit the states
//! once more, breadth first. Note which goals held in a state, which held together, the extent of the numbers, and the
//! state that satisfied most goals. Invariant: a claim about all states is made only if all were visited. Cost: at most
//! [`STATES`] states and the caller's budget.

use super::breadth::{self, Visited};
use crate::ids::{FactId, FluentId, OperatorId, StateId, id32};
use crate::number::Number;
use crate::search::Query;
use crate::task::{Task, contains};
use budget::Budget;
use pddl::model::{GroundApplication, Idx};
use std::ops::ControlFlow;

/// The most states that are visited.
pub(super) const STATES: u32 = 200_000;
/// The number of goals whose pairs are checked: the bits of a word.
const PAIRED: usize = 64;

/// A goal: a fact and whether it must hold.
type Literal = (FactId, bool);

/// The result of visiting the states.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Space {
    /// The number of states visited.
    pub states: u32,
    /// Whether these were all.
    pub complete: bool,
    /// Goals that held in no visited state.
    pub never: Vec<Literal>,
    /// Pairs of goals, among the first 64, that each held in some state but never together.
    pub apart: Vec<[Literal; 2]>,
    /// The numeric fluents that the goal reads, each with its least and its largest value.
    pub numbers: Vec<(GroundApplication, Number, Number)>,
    /// A state that satisfies most goals.
    pub nearest: Nearest,
}

/// A state that satisfies at least as many goals as any other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Nearest {
    /// A shortest sequence of operators that leads there.
    pub steps: Vec<OperatorId>,
    /// The goals that do not hold there.
    pub missing: Vec<Literal>,
}

pub(super) fn visit(task: &Task, query: &Query<'_>, budget: &Budget<'_>) -> Space {
    let literals = &query.goal.literals;
    let positive = literals.positive.iter().map(|&f| (f, true));
    let goals: Vec<Literal> = positive.chain(literals.negative.iter().map(|&f| (f, false))).collect();
    let fluents = fluents(task, &goals);
    let mut extent: Vec<Option<(Number, Number)>> = vec![None; fluents.len()];
    let mut held = vec![false; goals.len()];
    let mut together = [0_u64; PAIRED];
    let mut nearest: Option<(usize, StateId, Vec<Literal>)> = None;

    let Visited { registry, states, complete } =
        breadth::visit(task, query, budget, STATES, |id, here, _| {
            let holds = |&(fact, wanted): &Literal| contains(here, fact) == wanted;
            let mut mask = 0_u64;
            for (i, _) in goals.iter().enumerate().filter(|(_, goal)| holds(goal)) {
                held[i] = true;
                mask |= if i < PAIRED { 1 << i } else { 0 };
            }
            together
                .iter_mut()
                .enumerate()
                .filter(|(i, _)| mask >> i & 1 == 1)
                .for_each(|(_, with)| *with |= mask);
            for (fluent, extent) in fluents.iter().zip(&mut extent) {
                if let Some(value) = task.numeric.value(here, *fluent) {
                    let (low, high) = extent.unwrap_or((value, value));
                    let (low, high) = (
                        if value.is_below(low) { value } else { low },
                        if high.is_below(value) { value } else { high },
                    );
                    *extent = Some((low, high));
                }
            }
            let missing: Vec<Literal> = goals.iter().filter(|goal| !holds(goal)).copied().collect();
            if nearest.as_ref().is_none_or(|(least, ..)| missing.len() < *least) {
                nearest = Some((missing.len(), id, missing));
            }
            ControlFlow::Continue(())
        });
    let (steps, missing) =
        nearest.map_or_else(Default::default, |(_, id, missing)| (registry.path(id), missing));
    let all = id32(goals.len().min(PAIRED));
    let mut apart = Vec::new();
    for i in 0..all {
        let others = (i + 1..all).filter(|&j| held[i as usize] && held[j as usize]);
        apart.extend(others.filter(|j| together[i as usize] >> j & 1 == 0).map(|j| [i, j]));
    }
    let named = |(fluent, extent): (&FluentId, &Option<(Number, Number)>)| {
        let (low, high) = (*extent)?;
        Some((task.numeric.fluents[fluent.index()].application.clone(), low, high))
    };
    Space {
        states,
        complete,
        never: goals.iter().zip(&held).filter(|(_, held)| complete && !**held).map(|(g, _)| *g).collect(),
        apart: if complete {
            apart.into_iter().map(|pair| pair.map(|i| goals[i as usize])).collect()
        } else {
            Vec::new()
        },
        numbers: if complete { fluents.iter().zip(&extent).filter_map(named).collect() } else { Vec::new() },
        nearest: Nearest { steps, missing },
    }
}

/// The numeric fluents that the comparisons among the goals read.
fn fluents(task: &Task, goals: &[Literal]) -> Vec<FluentId> {
    let mut found = Vec::new();
    for comparison in &task.numeric.comparisons {
        if goals.iter().any(|(fact, _)| *fact == comparison.fact) {
            comparison.expression.each_fluent(&mut |&fluent| found.push(fluent));
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}
