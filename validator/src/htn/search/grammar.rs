//! Ground tasks and their decompositions, restricted to the steps of one plan.
//!
//! A [`Rule`] is a method (or the problem's network) with objects for all variables that its subtasks need. Its
//! precondition is one more node before all others: a guard, which yields no step and needs a moment at which the
//! precondition holds. So the search sees nodes and orders only, and can read the plan from either end:
//! [`Grammar::reversed`] is the grammar of the reversed plan.
//!
//! Source: Höller et al., "HDDL", AAAI 2020, §3 (preconditions of methods as actions); Barták, Maillard & Cardoso,
//! "Validation of hierarchical plans via parsing of attribute grammars", ICAPS 2018 (decomposition as a grammar).

use pddl::model::{Idx, IndexVec, MethodId, ObjectId, TaskId};

/// A moment: the number of steps before it.
pub(super) type Slot = u32;

/// A task with its objects, an action of the plan, or a guard.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct SymbolId(pub(super) u32);

/// A way to carry out a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct RuleId(pub(super) u32);

impl Idx for SymbolId {
    fn from_index(index: usize) -> Self {
        Self(u32::try_from(index).expect("the work that makes symbols is bounded below 2^32"))
    }
    fn index(self) -> usize {
        self.0 as usize
    }
}

impl Idx for RuleId {
    fn from_index(index: usize) -> Self {
        Self(u32::try_from(index).expect("the work that makes rules is bounded below 2^32"))
    }
    fn index(self) -> usize {
        self.0 as usize
    }
}

#[derive(Clone, Debug)]
pub(super) enum Symbol {
    /// The symbol that must yield the whole plan.
    Root,
    Task {
        task: TaskId,
        arguments: Box<[ObjectId]>,
    },
    /// An action with its objects, by its number among the actions of the plan.
    Action(u32),
    /// For each moment, whether the guard holds.
    Guard(Box<[bool]>),
}

#[derive(Clone, Debug)]
pub(super) struct Rule {
    /// The method; `None` for the problem's network.
    pub(super) method: Option<MethodId>,
    pub(super) head: SymbolId,
    /// In a topological order: each node after its predecessors.
    pub(super) nodes: Vec<SymbolId>,
    /// By node: its direct predecessors.
    pub(super) before: Vec<Vec<u32>>,
    /// By node: the subtask of the network; `None` for the guard.
    pub(super) subtask: Vec<Option<u32>>,
}

#[derive(Clone, Debug)]
pub(super) struct Grammar {
    pub(super) symbols: IndexVec<SymbolId, Symbol>,
    pub(super) rules: IndexVec<RuleId, Rule>,
    /// By symbol: its rules.
    pub(super) ways: IndexVec<SymbolId, Vec<RuleId>>,
    pub(super) root: SymbolId,
    /// By step of the plan: its action.
    pub(super) steps: Vec<SymbolId>,
    /// The number of different actions.
    pub(super) actions: usize,
}

impl Grammar {
    /// The number of the last moment.
    pub(super) fn end(&self) -> Slot {
        Slot::try_from(self.steps.len()).unwrap_or(Slot::MAX - 1)
    }

    /// The grammar of the reversed plan.
    pub(super) fn reversed(&self) -> Self {
        let mut other = self.clone();
        other.steps.reverse();
        for symbol in 0..other.symbols.len() {
            if let Symbol::Guard(holds) = &mut other.symbols[SymbolId::from_index(symbol)] {
                holds.reverse();
            }
        }
        for rule in 0..other.rules.len() {
            let rule = &mut other.rules[RuleId::from_index(rule)];
            let last = rule.nodes.len().wrapping_sub(1);
            let mut before = vec![Vec::new(); rule.nodes.len()];
            for (after, nodes) in (0u32..).zip(&rule.before) {
                for &node in nodes {
                    // Predecessors become successors, and both are counted from the other end.
                    let place = u32::try_from(last).unwrap_or(u32::MAX) - after;
                    before[last - node as usize].push(place);
                }
            }
            before.iter_mut().for_each(|nodes| nodes.sort_unstable());
            rule.before = before;
            rule.nodes.reverse();
            rule.subtask.reverse();
        }
        other
    }
}
