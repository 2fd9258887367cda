//! Which suffixes of a plan reach the goal from a state that changes.
//!
//! Problem: simulating every suffix on each change costs the square of the plan's length. Idea:
//! regress the goal through the plan. Each suffix has a conjunction of conditions; a condition
//! usually belongs to many consecutive suffixes, and is stored once with the span of them. A change
//! of a condition adjusts the counters of its span.
//!
//! Regression is exact for conditional effects, comparisons of numbers, and axioms (recursive ones
//! too). What it refuses: a comparison that depends on more than four conditional changes of one
//! step, expressions whose coefficients do not fit or that grow beyond 64 parts, and conditions
//! beyond [`SIZE`]. Then the other conditions of these suffixes still decide where one of them
//! fails; where all hold, the suffix is simulated. Later suffixes are not affected.
//!
//! Invariant: `missing[i]` is the number of conditions of suffix `i` that do not hold in the state
//! last observed; from `exact` on, a suffix reaches the goal exactly if it misses nothing. Cost: a
//! change of a fact visits the conditions that mention it; the furthest suffix is found in one pass
//! over the counters.
//!
//! Source: Fikes, Hart & Nilsson, "Learning and executing generalized robot plans", AIJ 1972;
//! conditional effects: Rintanen, "Regression for classical and nondeterministic planning", ECAI 2008.

use super::super::{Goal, LiteralsRef, State, Task};
use super::circuit::{Circuit, Gate, NEVER, Node};
use super::step::{Step, conjuncts, is_never};
use super::values::Values;
use crate::ids::{FactId, OperatorId, id32};
use std::collections::BTreeMap;

/// The most gates with their inputs; beyond it, conditions that are no literals are simulated.
const SIZE: usize = 1 << 18;
/// The most gates that are visited while the goal is regressed.
const VISITS: usize = 1 << 22;

/// A plan and its suffixes: which of them reach the goal from the state last observed.
#[derive(Clone, Debug)]
pub struct Suffixes {
    plan: Vec<OperatorId>,
    goal: Goal,
    values: Values,
    spans: Vec<Span>,
    /// By gate: where its spans start in `spans`.
    starts: Vec<u32>,
    /// By suffix: the number of its conditions that do not hold.
    missing: Vec<u32>,
    exact: usize,
}

/// A condition of consecutive suffixes.
#[derive(Clone, Copy, Debug)]
struct Span {
    condition: Node,
    first: u32,
    last: u32,
}

impl Suffixes {
    /// Regresses `goal` through `plan`, and observes `state`.
    pub fn new(task: &Task, plan: Vec<OperatorId>, goal: Goal, state: &State) -> Self {
        let mut regressed = Regressed::new(task, &goal, plan.len());
        for (suffix, &step) in plan.iter().enumerate().rev() {
            regressed.before(step, suffix);
        }
        let Regressed { circuit, mut spans, conditions, exact, .. } = regressed;
        spans.extend(conditions.into_iter().map(|(condition, last)| Span { condition, first: 0, last }));
        spans.sort_unstable_by_key(|span| (span.condition, span.first));
        let mut starts = vec![0; circuit.gates().len() + 1];
        spans.iter().for_each(|span| starts[span.condition.0 as usize + 1] += 1);
        (1..starts.len()).for_each(|i| starts[i] += starts[i - 1]);
        let values = Values::new(task, circuit, state);
        let mut missing = vec![0; plan.len() + 1];
        for span in spans.iter().filter(|span| !values.holds(span.condition)) {
            missing[span.first as usize..=span.last as usize].iter_mut().for_each(|count| *count += 1);
        }
        Self { plan, goal, values, spans, starts, missing, exact }
    }

    /// The plan.
    pub fn plan(&self) -> &[OperatorId] {
        &self.plan
    }

    /// Takes in the state as it is now.
    pub fn observe(&mut self, task: &Task, state: &State) {
        let Self { values, spans, starts, missing, .. } = self;
        values.observe(task, state, |condition, holds| {
            let i = condition.0 as usize;
            for span in &spans[starts[i] as usize..starts[i + 1] as usize] {
                for count in &mut missing[span.first as usize..=span.last as usize] {
                    *count = if holds { *count - 1 } else { *count + 1 };
                }
            }
        });
    }

    /// The last suffix that reaches the goal, as the number of steps that it leaves out; the plan's
    /// length if the goal holds. `None`: no suffix does.
    pub fn furthest(&self, task: &Task) -> Option<usize> {
        (0..self.missing.len()).rev().find(|&suffix| self.reaches(task, suffix))
    }

    /// Whether a suffix reaches the goal.
    pub fn reaches(&self, task: &Task, suffix: usize) -> bool {
        self.missing[suffix] == 0 && (suffix >= self.exact || self.simulated(task, suffix))
    }

    /// The first suffix whose regression is exact; those before it are simulated where all of their
    /// conditions hold.
    pub fn exact_from(&self) -> usize {
        self.exact
    }

    /// The literals that a suffix needs and that do not hold, and whether they are all that it
    /// misses.
    pub fn broken(&self, suffix: usize) -> (Vec<(FactId, bool)>, bool) {
        let here = |span: &&Span| (span.first as usize..=span.last as usize).contains(&suffix);
        let failing = self.spans.iter().filter(here).filter(|span| !self.values.holds(span.condition));
        let mut broken = Vec::new();
        let mut all = suffix >= self.exact;
        for span in failing {
            match *self.values.gate(span.condition) {
                Gate::Literal(fact, wanted) => broken.push((fact, wanted)),
                _ => all = false,
            }
        }
        broken.sort_unstable();
        (broken, all)
    }

    fn simulated(&self, task: &Task, suffix: usize) -> bool {
        let mut steps = self.plan[suffix..].iter();
        let start = self.values.state().clone();
        let end =
            steps.try_fold(start, |state, &step| task.ways(step).find_map(|way| task.successor(&state, way)));
        end.is_some_and(|end| task.satisfies(&end, &self.goal))
    }
}

/// The conditions of the suffixes so far, from the last to the first.
struct Regressed<'a> {
    task: &'a Task,
    circuit: Circuit,
    /// The conditions of the first suffix so far, each with the last suffix that has it.
    conditions: BTreeMap<Node, u32>,
    /// The spans that have ended.
    spans: Vec<Span>,
    exact: usize,
    visits: usize,
}

impl<'a> Regressed<'a> {
    fn new(task: &'a Task, goal: &Goal, last: usize) -> Self {
        let (circuit, conditions) = (Circuit::new(), BTreeMap::new());
        let mut regressed = Self { task, circuit, conditions, spans: Vec::new(), exact: 0, visits: 0 };
        if goal.impossible.is_some() {
            regressed.conditions.insert(NEVER, id32(last));
        }
        regressed.require(goal.literals.as_ref(), last);
        regressed
    }

    /// Regresses through the first step of `suffix`.
    fn before(&mut self, step: OperatorId, suffix: usize) {
        if self.conditions.contains_key(&NEVER) {
            return;
        }
        let task = self.task;
        let ways: Vec<OperatorId> = task.ways(step).collect();
        let grows = self.circuit.size() < SIZE && self.visits < VISITS;
        let after: Vec<Node> = self.conditions.keys().copied().collect();
        let mut before: Vec<Step<'a>> = ways.iter().map(|&way| Step::new(task, way, grows)).collect();
        for way in &mut before {
            self.visits += way.regress(&mut self.circuit, &after);
        }
        // What each way needs beyond the conditions that they have in common.
        let mut own: Vec<Vec<Node>> = vec![Vec::new(); ways.len()];
        let mut common: Vec<Node> = Vec::new();
        for condition in after {
            let circuit = &mut self.circuit;
            let nodes: Option<Vec<Node>> =
                before.iter_mut().map(|way| way.before(circuit, condition)).collect();
            match nodes {
                Some(nodes) if nodes[0] == condition && nodes.iter().all(|&n| n == condition) => continue,
                Some(nodes) if nodes.iter().all(|&n| n == nodes[0]) => {
                    common.extend(conjuncts(&self.circuit, nodes[0]));
                }
                Some(nodes) => own.iter_mut().zip(nodes).for_each(|(own, node)| own.push(node)),
                None => self.exact = self.exact.max(suffix + 1),
            }
            self.end(condition, suffix + 1);
        }
        let preconditions = ways.iter().map(|&way| task.operator(way).precondition);
        let preconditions: Vec<LiteralsRef<'_>> = preconditions.collect();
        let everywhere = |literal: &(FactId, bool)| preconditions.iter().all(|p| holds_in(*p, *literal));
        for (fact, wanted) in preconditions[0].iter().filter(everywhere) {
            common.push(self.circuit.literal(fact, wanted));
        }
        let alternatives = own.into_iter().zip(&preconditions).map(|(mut own, precondition)| {
            let rest = precondition.iter().filter(|literal| !everywhere(literal));
            own.extend(rest.map(|(fact, wanted)| self.circuit.literal(fact, wanted)));
            self.circuit.all(own)
        });
        let alternatives: Vec<Node> = alternatives.collect();
        let either = self.circuit.any(alternatives);
        common.extend(conjuncts(&self.circuit, either));
        if is_never(&common) {
            common = vec![NEVER];
        }
        for condition in common {
            self.conditions.entry(condition).or_insert(id32(suffix));
        }
    }

    fn require(&mut self, literals: LiteralsRef<'_>, suffix: usize) {
        for (fact, wanted) in literals.iter() {
            let literal = self.circuit.literal(fact, wanted);
            self.conditions.insert(literal, id32(suffix));
        }
    }

    /// The condition is none of the suffixes before `first`.
    fn end(&mut self, condition: Node, first: usize) {
        if let Some(last) = self.conditions.remove(&condition) {
            self.spans.push(Span { condition, first: id32(first), last });
        }
    }
}

fn holds_in(literals: LiteralsRef<'_>, (fact, wanted): (FactId, bool)) -> bool {
    let among = if wanted { literals.positive } else { literals.negative };
    among.binary_search(&fact).is_ok()
}
