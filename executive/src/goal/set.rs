//! The goals of a mission, and any of them together as one goal of the planner.

use super::compile::{Compiled, compile};
use super::text::{GoalId, GoalText, Importance};
use pddl::model::{Condition, ConditionKind, Domain, PredicateId, Problem};
use planner::{AtomStatus, FactId, Goal, GroundAtom, Impossible, Literals, Task};

/// The goals of a mission, by their numbers.
#[derive(Clone, Debug)]
pub(crate) struct Goals {
    texts: Vec<GoalText>,
    /// The same for the planner; empty if the problem's own goal is the only one.
    compiled: Vec<Compiled>,
}

impl Goals {
    /// The goals; without any, it is the problem's own. Adds what stands for them to domain and problem, and returns the
    /// predicates that grounding must keep.
    pub(crate) fn new(
        texts: Vec<GoalText>,
        domain: &mut Domain,
        problem: &mut Problem,
        perceived: &[PredicateId],
    ) -> (Self, Vec<PredicateId>) {
        if texts.is_empty() {
            return (Self { texts: vec![GoalText::of_problem(problem)], compiled: Vec::new() }, Vec::new());
        }
        let (compiled, kept) = compile(domain, problem, &texts, perceived);
        (Self { texts, compiled }, kept)
    }

    /// The goals as the mission gives them.
    pub(crate) fn texts(&self) -> &[GoalText] {
        &self.texts
    }

    /// Whether the mission names its goals; otherwise the problem's own is the only one.
    pub(crate) fn are_named(&self) -> bool {
        !self.compiled.is_empty()
    }

    /// The hard ones among these goals, in levels of the same priority, the highest first.
    pub(crate) fn levels(&self, goals: &[GoalId]) -> Vec<Vec<GoalId>> {
        let mut levels: Vec<(i64, Vec<GoalId>)> = Vec::new();
        for &id in goals {
            let Importance::Hard(priority) = self.texts[id.index()].importance else { continue };
            match levels.iter_mut().find(|(other, _)| *other == priority) {
                Some((_, level)) => level.push(id),
                None => levels.push((priority, vec![id])),
            }
        }
        levels.sort_by_key(|(priority, _)| std::cmp::Reverse(*priority));
        levels.into_iter().map(|(_, level)| level).collect()
    }

    /// All of these goals as one goal of a task that was grounded with them.
    pub(crate) fn together(&self, task: &Task, goals: &[GoalId]) -> Goal {
        if self.compiled.is_empty() {
            return task.goal().clone();
        }
        let (mut positive, mut negative, mut never, mut always) = (vec![], vec![], vec![], vec![]);
        for (predicate, arguments, holds) in goals.iter().flat_map(|id| &self.compiled[id.index()].literals) {
            let atom = || GroundAtom { predicate: *predicate, arguments: arguments.clone().into() };
            match (task.status(*predicate, arguments), *holds) {
                (AtomStatus::Fact(fact), true) => positive.push(fact),
                (AtomStatus::Fact(fact), false) => negative.push(fact),
                (AtomStatus::NeverTrue, true) => never.push(atom()),
                (AtomStatus::AlwaysTrue, false) => always.push(atom()),
                _ => {}
            }
        }
        let (positive, negative) = (sorted(positive), sorted(negative));
        let impossible = match () {
            () if !never.is_empty() => Some(Impossible::Atoms(never)),
            () if !always.is_empty() => Some(Impossible::NegatedAtoms(always)),
            () if positive.iter().any(|fact| negative.contains(fact)) => Some(Impossible::Formula),
            () => None,
        };
        Goal { literals: Literals { positive, negative }, impossible }
    }

    /// A soft goal as conditions without variables, with its penalty; `None` for a hard one.
    pub(crate) fn soft(&self, goal: GoalId) -> Option<(Vec<Condition>, f64)> {
        let Importance::Soft(penalty) = self.texts[goal.index()].importance else { return None };
        Some((self.compiled.get(goal.index())?.conditions().collect(), penalty))
    }

    /// The problem with these goals as its goal.
    pub(crate) fn problem(&self, problem: &Problem, goals: &[GoalId]) -> Problem {
        let mut problem = problem.clone();
        if self.are_named() {
            let parts = goals.iter().flat_map(|id| self.compiled[id.index()].conditions()).collect();
            problem.goal = Condition { kind: ConditionKind::And(parts), span: problem.goal_span };
        }
        problem
    }
}

fn sorted(mut facts: Vec<FactId>) -> Box<[FactId]> {
    facts.sort_unstable();
    facts.dedup();
    facts.into_boxed_slice()
}
