//! Relaxed plans in which operators are repeated and replace the resources that they consume.
//!
//! Problem: a relaxation ignores decreases, so one log is enough for ten houses; after the first
//! house is built, the estimate rises by the logs for the second. Idea: extract the plan backwards,
//! from the most expensive propositions to the cheapest. If several comparisons need an operator,
//! it occurs as often as the most demanding one requires. Each occurrence takes from the sums that
//! the precondition bounds (a tank, a purse, a room). When the comparison of such a sum has its
//! turn, the sum must suffice for all takings but the last. A sum that the goal bounds must suffice
//! for the takings of every operator. If a sum satisfies its comparison already but does not
//! suffice, the first operator that was able to raise it supplies the rest. A taking from a sum
//! whose turn is over gives its comparison another turn; the number of turns is bounded, because
//! two operators may supply each other. The estimate is neither admissible nor consistent. It is
//! finite wherever the exploration is, hence safe. Cost: the plan's propositions in a queue.
//!
//! Source: repetitions as in Scala, Haslum, Thiébaux & Ramirez, JAIR 2020; takings as an extension of
//! relaxed plan extraction in Hoffmann, "The Metric-FF planning system", JAIR 2003, §4.3, ours.

use super::explorer::UNREACHED;
use super::{Costs, Estimate, Explorer};
use crate::ids::OperatorId;
use crate::task::{AXIOM, Task};
use rustc_hash::FxHashMap;
use std::collections::BinaryHeap;

/// How much the operators of a plan take from a sum.
#[derive(Clone, Copy, Default)]
struct Taken {
    all: f64,
    /// The part taken by operators whose preconditions bound the sum.
    needed: f64,
    /// The most that one application of such an operator takes.
    most: f64,
}

/// The most turns of a comparison that is a goal, and of any other.
const TURNS: [u32; 2] = [64, 8];

/// Scratch for relaxed plans of one task.
pub(crate) struct CountedPlan {
    /// Propositions to be achieved, the most expensive first.
    queue: BinaryHeap<(u32, u32)>,
    /// Generation in which a proposition or operator was last met.
    marked: Vec<u32>,
    used: Vec<u32>,
    count: Vec<u32>,
    generation: u32,
    /// The real cost of the last plan.
    real: u64,
    /// By sum.
    taken: FxHashMap<u32, Taken>,
    /// By sum: its comparisons that had a turn.
    met: FxHashMap<u32, Vec<u32>>,
    /// By comparison: the number of its turns.
    turns: FxHashMap<u32, u32>,
}

/// The input of a walk.
pub(crate) struct Walk<'w, 'a> {
    pub(crate) task: &'a Task,
    pub(crate) explorer: &'w Explorer<'a>,
    pub(crate) costs: Costs,
    pub(crate) words: &'w [u64],
}

impl CountedPlan {
    /// `None` for a task without repetitions.
    pub(crate) fn new(task: &Task) -> Option<Self> {
        (!task.relaxation.ways.is_empty()).then(|| Self {
            queue: BinaryHeap::new(),
            marked: vec![0; task.relaxation.propositions()],
            used: vec![0; task.operators.len()],
            count: vec![0; task.operators.len()],
            generation: 0,
            real: 0,
            taken: FxHashMap::default(),
            met: FxHashMap::default(),
            turns: FxHashMap::default(),
        })
    }

    /// Extracts a plan backwards from the goal, after an exploration. Appends the propositions that
    /// the plan achieves to `achieved`, and its applicable operators to `preferred`.
    pub(crate) fn walk(
        &mut self,
        walk: &Walk<'_, '_>,
        achieved: &mut Vec<u32>,
        mut preferred: Option<&mut Vec<OperatorId>>,
    ) -> Estimate {
        let Walk { task, explorer, costs, words } = *walk;
        let graph = explorer.graph();
        self.generation += 1;
        self.taken.clear();
        self.met.clear();
        self.turns.clear();
        self.real = 0;
        let generation = self.generation;
        let mut total = 0_u32;
        self.queue.extend(explorer.goal().iter().map(|&p| (explorer.cost(p), p)));
        while let Some((_, p)) = self.queue.pop() {
            if std::mem::replace(&mut self.marked[p as usize], generation) == generation {
                continue;
            }
            let mut node = explorer.supporter(p);
            let (more, first) = self.turn(walk, p);
            if node == UNREACHED {
                node = if more > 0.0 { explorer.supplier(p) } else { UNREACHED };
            } else if first {
                achieved.push(p);
            }
            if node == UNREACHED {
                continue;
            }
            let times = explorer.times(node, p, more, words);
            if times == 0 {
                continue;
            }
            self.queue.extend(graph.preconditions.row(node).iter().map(|&q| (explorer.cost(q), q)));
            let number = graph.operator[node as usize];
            if number == AXIOM {
                continue;
            }
            let again = std::mem::replace(&mut self.used[number as usize], generation) == generation;
            let count = &mut self.count[number as usize];
            let before = if again { *count } else { 0 };
            *count = before.max(times);
            let added = *count - before;
            let operator = task.operator(OperatorId(number));
            total = total.saturating_add(added.saturating_mul(costs.of(operator.cost)));
            self.real += u64::from(added) * u64::from(operator.cost);
            if added > 0 {
                self.take(walk, number, added);
            }
            if again {
                continue;
            }
            let Some(preferred) = preferred.as_deref_mut() else { continue };
            if explorer.is_ready(node) && operator.precondition.hold_in(words) {
                preferred.push(OperatorId(number));
            }
        }
        Estimate(total.min(u32::MAX - 1))
    }

    /// The real cost of the last plan.
    pub(crate) fn real(&self) -> u64 {
        self.real
    }

    /// How far a comparison's sum must exceed the comparison's bound, in the comparison's units,
    /// and whether this is the comparison's first turn.
    fn turn(&mut self, walk: &Walk<'_, '_>, proposition: u32) -> (f64, bool) {
        let Some(comparison) = walk.explorer.graph().ways.comparison(proposition) else { return (0.0, true) };
        let Some((sum, unit)) = walk.task.numeric.sum_of(comparison) else { return (0.0, true) };
        let turns = self.turns.entry(proposition).or_default();
        *turns += 1;
        let first = *turns == 1;
        if first {
            self.met.entry(sum).or_default().push(proposition);
        }
        let more = self.taken.get(&sum).map_or(0.0, |taken| match walk.explorer.is_goal(proposition) {
            true => taken.all,
            false => taken.needed - taken.most,
        });
        (more * unit, first)
    }

    /// Notes the takings of `times` more applications of an operator.
    fn take(&mut self, walk: &Walk<'_, '_>, operator: u32, times: u32) {
        let explorer = walk.explorer;
        for taking in explorer.graph().ways.takings(operator) {
            let taken = self.taken.entry(taking.sum).or_default();
            let amount = f64::from(times) * taking.amount;
            taken.all += amount;
            if taking.is_needed {
                taken.needed += amount;
                taken.most = taken.most.max(taking.amount);
            }
            for &p in self.met.get(&taking.sum).map_or(&[][..], Vec::as_slice) {
                let is_goal = explorer.is_goal(p);
                let turns = self.turns.get(&p).copied().unwrap_or(0);
                if (is_goal || taking.is_needed) && turns < TURNS[usize::from(!is_goal)] {
                    self.marked[p as usize] = 0;
                    self.queue.push((explorer.cost(p), p));
                }
            }
        }
    }
}
