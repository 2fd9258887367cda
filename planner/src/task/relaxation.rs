//! The delete relaxation as flat arrays.
//!
//! Problem: heuristics walk the same bipartite graph of propositions and operators millions of
//! times. Idea: a proposition for each fact and for the negation of each fact that some condition
//! negates; a node for each operator, each of its conditional effects and each axiom rule; adjacency
//! in compressed rows. Deleting a fact achieves its negation. The negation of a derived fact counts
//! as true (optimistic, hence safe). A comparison of numbers is a fact like others; how often an
//! operator must be done for it is told by [`Ways`]. Invariant: a plan of the task is a plan of the
//! relaxation.
//!
//! Source: Hoffmann & Nebel, "The FF planning system", JAIR 2001, §3; negations as in Helmert 2006.

use super::cliques::cliques;
use super::{AxiomProgram, Fact, Goal, Literals, Numeric, Operator, Way, Ways, contains, for_each_set};
use crate::ids::{FactId, OperatorId, id32};
use pddl::model::{Idx, IndexVec};
use rustc_hash::FxHashMap;

/// Rows of `u32` behind each other.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rows {
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Rows {
    pub(crate) fn push(&mut self, row: impl IntoIterator<Item = u32>) {
        if self.starts.is_empty() {
            self.starts.push(0);
        }
        self.items.extend(row);
        self.starts.push(id32(self.items.len()));
    }

    pub(crate) fn row(&self, i: u32) -> &[u32] {
        &self.items[self.range(i)]
    }

    /// The positions of a row among all items.
    pub(crate) fn range(&self, i: u32) -> std::ops::Range<usize> {
        self.starts[i as usize] as usize..self.starts[i as usize + 1] as usize
    }

    pub(crate) fn item(&self, position: usize) -> u32 {
        self.items[position]
    }

    fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// For each of `n` items, the rows that hold it.
    pub(crate) fn transposed(&self, n: usize) -> Self {
        let mut starts = vec![0_u32; n + 1];
        for &item in &self.items {
            starts[item as usize + 1] += 1;
        }
        for i in 0..n {
            starts[i + 1] += starts[i];
        }
        let mut fill = starts.clone();
        let mut items = vec![0; self.items.len()];
        for row in 0..self.len() {
            for &item in self.row(id32(row)) {
                items[fill[item as usize] as usize] = id32(row);
                fill[item as usize] += 1;
            }
        }
        Self { starts, items }
    }
}

/// No operator: an axiom's node.
pub(crate) const AXIOM: u32 = u32::MAX;

/// The graph.
#[derive(Clone, Debug, Default)]
pub(crate) struct Relaxation {
    facts: usize,
    /// Facts with a proposition for their negation, in order of these propositions.
    negated: Vec<FactId>,
    /// The proposition for the negation of a fact, or 0 (no negation is proposition 0).
    negation: Vec<u32>,
    /// Negations of derived facts.
    optimistic: Vec<u32>,
    /// The operator of each node, or [`AXIOM`].
    pub(crate) operator: Vec<u32>,
    /// The cost of each node.
    pub(crate) cost: Vec<u32>,
    /// What each node needs.
    pub(crate) preconditions: Rows,
    /// What each node achieves.
    pub(crate) effects: Rows,
    /// How it achieves them.
    pub(crate) ways: Ways,
    /// The nodes that need a proposition.
    pub(crate) needed_by: Rows,
    /// Nodes from this one on are moves: they need one proposition and nothing else.
    pub(crate) first_move: u32,
    /// By proposition, where in its row of `needed_by` the moves begin.
    moves_at: Vec<u32>,
    /// By proposition, its clique.
    pub(crate) clique: Vec<u32>,
    pub(crate) cliques: usize,
    /// The nodes that need nothing.
    pub(crate) free: Vec<u32>,
}

impl Relaxation {
    pub(crate) fn new(
        facts: &IndexVec<FactId, Fact>,
        operators: &IndexVec<OperatorId, Operator>,
        axioms: &AxiomProgram,
        numeric: &Numeric,
        goal: &Goal,
    ) -> Self {
        let mut graph = Self { facts: facts.len(), negation: vec![0; facts.len()], ..Self::default() };
        let conditions = operators.iter().flat_map(|o| {
            let updates = o.numeric.iter().flat_map(|e| e.updates.iter());
            let conditional = o.conditional.iter().map(|e| &e.condition);
            std::iter::once(&o.precondition).chain(conditional).chain(updates.map(|u| &u.condition))
        });
        for literals in conditions.chain(axioms.rules().iter().map(|r| &r.body)).chain([&goal.literals]) {
            for &f in &literals.negative {
                if graph.negation[f.index()] == 0 {
                    let proposition = id32(graph.facts + graph.negated.len());
                    graph.negation[f.index()] = proposition;
                    graph.negated.push(f);
                    if facts[f].derived {
                        graph.optimistic.push(proposition);
                    }
                }
            }
        }
        let comparisons = numeric.comparisons.iter().zip(0..);
        let comparisons: FxHashMap<FactId, u32> =
            comparisons.map(|(c, position)| (c.fact, position)).collect();
        for (id, op) in operators.enumerate() {
            graph.ways.set_takings(id.0, numeric.takings(op, &comparisons));
            graph.node(id.0, op.cost, &[&op.precondition], &op.adds, &op.deletes);
            for influenced in op.numeric.iter().flat_map(|e| numeric.influences(e)) {
                let (facts, ways): (Vec<FactId>, Vec<Way>) = influenced.holds.into_iter().unzip();
                let before = graph.effects.items.len();
                graph.node(
                    id.0,
                    op.cost,
                    &[&op.precondition, influenced.condition],
                    &facts,
                    &influenced.fails,
                );
                for (i, (way, fact)) in ways.into_iter().zip(facts).enumerate() {
                    graph.ways.set(before + i, fact.0, way);
                }
            }
            for e in &op.conditional {
                graph.node(id.0, op.cost, &[&op.precondition, &e.condition], &e.adds, &e.deletes);
            }
        }
        for rule in axioms.rules() {
            graph.node(AXIOM, 0, &[&rule.body], &[rule.head], &[]);
        }
        graph.first_move = id32(graph.nodes());
        graph.index();
        graph
    }

    /// Finds who needs what.
    fn index(&mut self) {
        self.needed_by = self.preconditions.transposed(self.propositions());
        let starts = (0..id32(self.propositions())).map(|p| {
            let row = self.needed_by.row(p);
            id32(row.partition_point(|&node| node < self.first_move))
        });
        self.moves_at = starts.collect();
        (self.clique, self.cliques) = cliques(self);
    }

    /// The nodes that need a proposition: those that may need others as well, and the moves.
    pub(crate) fn waiting_and_moves(&self, proposition: u32) -> (&[u32], &[u32]) {
        self.needed_by.row(proposition).split_at(self.moves_at[proposition as usize] as usize)
    }

    fn node(&mut self, op: u32, cost: u32, needs: &[&Literals], adds: &[FactId], deletes: &[FactId]) {
        let mut pre: Vec<u32> = needs.iter().flat_map(|l| self.literals(l)).collect();
        pre.sort_unstable();
        pre.dedup();
        let negation = &self.negation;
        let negated = deletes.iter().map(|f| negation[f.index()]).filter(|&p| p != 0);
        let effects: Vec<u32> = adds.iter().map(|f| f.0).chain(negated).collect();
        if effects.is_empty() {
            return;
        }
        if pre.is_empty() {
            self.free.push(id32(self.operator.len()));
        }
        self.operator.push(op);
        self.cost.push(cost);
        self.preconditions.push(pre);
        self.effects.push(effects);
    }

    /// What a node counts: first whether it is an operator at all, then its cost.
    pub(crate) fn price(&self, node: u32) -> (bool, u32) {
        (self.operator[node as usize] != AXIOM, self.cost[node as usize])
    }

    /// The same graph with these effects for each node; nodes without effects go, and moves come last,
    /// by what they need.
    pub(crate) fn with_effects(&self, effects: &[Vec<u32>]) -> Self {
        let mut graph = Self {
            facts: self.facts,
            negated: self.negated.clone(),
            negation: self.negation.clone(),
            optimistic: self.optimistic.clone(),
            ways: self.ways.without_effects(),
            ..Self::default()
        };
        let kept = (0..id32(self.nodes())).filter(|&n| !effects[n as usize].is_empty());
        let is_move = |n: &u32| self.preconditions.row(*n).len() == 1;
        let (mut moves, others): (Vec<u32>, Vec<u32>) = kept.partition(is_move);
        moves.sort_by_key(|&n| self.preconditions.row(n)[0]);
        graph.first_move = id32(others.len());
        for node in others.into_iter().chain(moves).map(|n| n as usize) {
            let effects = &effects[node];
            let needs = self.preconditions.row(id32(node));
            if needs.is_empty() {
                graph.free.push(id32(graph.operator.len()));
            }
            graph.operator.push(self.operator[node]);
            graph.cost.push(self.cost[node]);
            graph.preconditions.push(needs.iter().copied());
            if !self.ways.is_empty() {
                let before = graph.effects.items.len();
                for (i, effect) in effects.iter().enumerate() {
                    let mut known = self.effects.range(id32(node));
                    if let Some(position) = known.find(|&position| self.effects.item(position) == *effect) {
                        graph.ways.set(before + i, *effect, self.ways.get(position).clone());
                    }
                }
            }
            graph.effects.push(effects.iter().copied());
        }
        graph.index();
        graph
    }

    /// The propositions of a conjunction. A negated fact without a proposition (a goal that came
    /// after grounding) is left out: optimistic.
    pub(crate) fn literals(&self, literals: &Literals) -> Vec<u32> {
        let negative = literals.negative.iter().map(|f| self.negation[f.index()]).filter(|&p| p != 0);
        literals.positive.iter().map(|f| f.0).chain(negative).collect()
    }

    /// How many propositions.
    pub(crate) fn propositions(&self) -> usize {
        self.facts + self.negated.len()
    }

    /// How many nodes.
    pub(crate) fn nodes(&self) -> usize {
        self.operator.len()
    }

    /// The fact of a proposition and whether it must hold.
    pub(crate) fn literal(&self, proposition: u32) -> (FactId, bool) {
        match (proposition as usize).checked_sub(self.facts) {
            None => (FactId(proposition), true),
            Some(i) => (self.negated[i], false),
        }
    }

    /// Calls `f` with every proposition that is true in the state.
    pub(crate) fn for_each_true(&self, words: &[u64], mut f: impl FnMut(u32)) {
        for_each_set(&words[..self.facts.div_ceil(64)], &mut f);
        for (i, &fact) in self.negated.iter().enumerate() {
            if !contains(words, fact) {
                f(id32(self.facts + i));
            }
        }
        for &proposition in &self.optimistic {
            f(proposition);
        }
    }
}
