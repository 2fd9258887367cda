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
use super::sort::sort_by_count;
use super::{
    AxiomProgram, Fact, Goal, Literals, LiteralsRef, Numeric, Operators, Rows, Way, Ways, contains,
    for_each_set,
};
use crate::ids::{FactId, id32};
use budget::{Interrupted, Meter};
use pddl::model::{Idx, IndexVec};
use rustc_hash::FxHashMap;

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
        operators: &Operators,
        axioms: &AxiomProgram,
        numeric: &Numeric,
        goal: &Goal,
        meter: &Meter<'_>,
    ) -> Result<Self, Interrupted> {
        let mut graph = Self { facts: facts.len(), negation: vec![0; facts.len()], ..Self::default() };
        let conditions = operators.iter().flat_map(|o| {
            let updates = o.numeric.into_iter().flat_map(|e| e.updates.iter());
            let conditional = o.conditional.iter().map(|e| e.condition);
            std::iter::once(o.precondition).chain(conditional).chain(updates.map(|u| u.condition.as_ref()))
        });
        let bodies = axioms.rules().iter().map(|r| r.body.as_ref());
        for literals in conditions.chain(bodies).chain([goal.literals.as_ref()]) {
            meter.spend(8 + literals.negative.len())?;
            for &f in literals.negative {
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
            graph.ways.set_takings(id.0, numeric.takings(&op, &comparisons));
            meter.spend(32 + 8 * op.size())?;
            graph.node(id.0, op.cost, &[op.precondition], op.adds, op.deletes);
            for influenced in op.numeric.into_iter().flat_map(|e| numeric.influences(e)) {
                let (facts, ways): (Vec<FactId>, Vec<Way>) = influenced.holds.into_iter().unzip();
                let before = graph.effects.items();
                graph.node(
                    id.0,
                    op.cost,
                    &[op.precondition, influenced.condition.as_ref()],
                    &facts,
                    &influenced.fails,
                );
                for (i, (way, fact)) in ways.into_iter().zip(facts).enumerate() {
                    graph.ways.set(before + i, fact.0, way);
                }
            }
            for e in op.conditional.iter() {
                meter.spend(32 + 8 * (op.precondition.len() + e.condition.len() + e.adds.len()))?;
                graph.node(id.0, op.cost, &[op.precondition, e.condition], e.adds, e.deletes);
            }
        }
        for rule in axioms.rules() {
            meter.spend(32 + 8 * rule.body.len())?;
            graph.node(AXIOM, 0, &[rule.body.as_ref()], &[rule.head], &[]);
        }
        graph.first_move = id32(graph.nodes());
        graph.index(meter)?;
        Ok(graph)
    }

    /// Finds who needs what.
    fn index(&mut self, meter: &Meter<'_>) -> Result<(), Interrupted> {
        self.needed_by = self.preconditions.transposed(self.propositions(), meter)?;
        let starts = (0..id32(self.propositions())).map(|p| {
            let row = self.needed_by.row(p);
            meter.spend(32).map(|()| id32(row.partition_point(|&node| node < self.first_move)))
        });
        self.moves_at = starts.collect::<Result<_, _>>()?;
        (self.clique, self.cliques) = cliques(self, meter)?;
        Ok(())
    }

    /// The nodes that need a proposition: those that may need others as well, and the moves.
    pub(crate) fn waiting_and_moves(&self, proposition: u32) -> (&[u32], &[u32]) {
        self.needed_by.row(proposition).split_at(self.moves_at[proposition as usize] as usize)
    }

    fn node(&mut self, op: u32, cost: u32, needs: &[LiteralsRef<'_>], adds: &[FactId], deletes: &[FactId]) {
        let negation = &self.negation;
        let achieves = |f: &&FactId| negation[f.index()] != 0;
        if adds.is_empty() && !deletes.iter().any(|f| achieves(&f)) {
            return;
        }
        let negated = deletes.iter().filter(achieves).map(|f| negation[f.index()]);
        self.effects.push(adds.iter().map(|f| f.0).chain(negated));
        let positive = needs.iter().flat_map(|l| l.positive.iter().map(|f| f.0));
        // Each negated fact of a condition was given a proposition.
        let negative = needs.iter().flat_map(|l| l.negative.iter().map(|f| negation[f.index()]));
        self.preconditions.push_sorted(positive.chain(negative));
        let node = id32(self.operator.len());
        if self.preconditions.row(node).is_empty() {
            self.free.push(node);
        }
        self.operator.push(op);
        self.cost.push(cost);
    }

    /// What a node counts: first whether it is an operator at all, then its cost.
    pub(crate) fn price(&self, node: u32) -> (bool, u32) {
        (self.operator[node as usize] != AXIOM, self.cost[node as usize])
    }

    /// The same graph with these effects for each node; nodes without effects go, and moves come last,
    /// by what they need.
    pub(crate) fn with_effects(&self, effects: &Rows, meter: &Meter<'_>) -> Result<Self, Interrupted> {
        let mut graph = Self {
            facts: self.facts,
            negated: self.negated.clone(),
            negation: self.negation.clone(),
            optimistic: self.optimistic.clone(),
            ways: self.ways.without_effects(),
            ..Self::default()
        };
        let (mut moves, mut others) = (Vec::new(), Vec::new());
        for node in 0..id32(effects.len()) {
            meter.spend(4)?;
            let is_move = self.preconditions.row(node).len() == 1;
            if !effects.row(node).is_empty() {
                (if is_move { &mut moves } else { &mut others }).push(node);
            }
        }
        let needed = |node: u32| self.preconditions.row(node)[0] as usize;
        let moves = sort_by_count(&moves, self.propositions(), meter, needed)?;
        graph.first_move = id32(others.len());
        for node in others.into_iter().chain(moves) {
            let (needs, achieves) = (self.preconditions.row(node), effects.row(node));
            meter.spend(16 + 2 * (needs.len() + achieves.len()))?;
            if needs.is_empty() {
                graph.free.push(id32(graph.operator.len()));
            }
            graph.operator.push(self.operator[node as usize]);
            graph.cost.push(self.cost[node as usize]);
            graph.preconditions.push(needs.iter().copied());
            if !self.ways.is_empty() {
                let before = graph.effects.items();
                for (i, effect) in achieves.iter().enumerate() {
                    let mut known = self.effects.range(node);
                    if let Some(position) = known.find(|&position| self.effects.item(position) == *effect) {
                        graph.ways.set(before + i, *effect, self.ways.get(position).clone());
                    }
                }
            }
            graph.effects.push(achieves.iter().copied());
        }
        graph.index(meter)?;
        Ok(graph)
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

    /// Bytes that it holds, about.
    pub(crate) fn memory_bytes(&self) -> usize {
        let rows = [&self.preconditions, &self.effects, &self.needed_by];
        let lists = self.operator.capacity() + self.cost.capacity() + self.free.capacity() + self.facts;
        rows.into_iter().map(Rows::memory_bytes).sum::<usize>() + lists * size_of::<u32>()
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
