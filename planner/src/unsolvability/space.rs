//! A visit of all states: which goals hold where.
//!
//! Problem: where the search has seen every state, none of the goal's parts need be impossible by itself. Idea:
//! visit the states once more, breadth first, and note which goals held in any state, which together, how far
//! numbers got, and which state had most. Invariant: what is said of all states is said only if all were visited. Cost:
//! at most [`STATES`] states and the caller's budget.

use super::breadth::{self, Visited};
use crate::ids::{FactId, FluentId, OperatorId, StateId, id32};
use crate::number::Number;
use crate::search::Query;
use crate::task::{Task, contains};
use budget::Budget;
use pddl::model::{GroundApplication, Idx};
use std::ops::ControlFlow;

/// States that are visited.
pub(super) const STATES: u32 = 200_000;
/// Goals of which pairs are counted: bits of a word.
const PAIRED: usize = 64;

/// A goal: a fact and whether it must hold.
type Literal = (FactId, bool);

/// What a visit of the states showed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Space {
    /// States visited.
    pub states: u32,
    /// Whether these were all.
    pub complete: bool,
    /// Goals that held in none of them.
    pub never: Vec<Literal>,
    /// Pairs of other goals that held, and never together; of the first 64 goals.
    pub apart: Vec<[Literal; 2]>,
    /// Numeric fluents that the goal reads: the least and the largest value.
    pub numbers: Vec<(GroundApplication, Number, Number)>,
    /// The state that satisfies most.
    pub nearest: Nearest,
}

/// A state that satisfies as much of the goal as any.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Nearest {
    /// A shortest way there.
    pub steps: Vec<OperatorId>,
    /// The goals that it lacks.
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

/// The numeric fluents that comparisons among the goals read.
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
