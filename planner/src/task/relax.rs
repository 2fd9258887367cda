//! Builds the delete relaxation: from a task, or from another relaxation with fewer effects.

use super::axioms::AxiomProgram;
use super::cliques::cliques;
use super::fact::Fact;
use super::goal::Goal;
use super::literals::LiteralsRef;
use super::numeric::Numeric;
use super::operators::Operators;
use super::relaxation::{AXIOM, Relaxation};
use super::repetition::Way;
use super::rows::Rows;
use super::sort::sort_by_count;
use crate::ids::{FactId, id32};
use budget::{Interrupted, Meter};
use pddl::model::{Idx, IndexVec};
use rustc_hash::FxHashMap;

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

    /// Computes the nodes that need each proposition, and the moves.
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

    fn node(&mut self, op: u32, cost: u32, needs: &[LiteralsRef<'_>], adds: &[FactId], deletes: &[FactId]) {
        let negation = &self.negation;
        let achieves = |f: &&FactId| negation[f.index()] != 0;
        if adds.is_empty() && !deletes.iter().any(|f| achieves(&f)) {
            return;
        }
        let negated = deletes.iter().filter(achieves).map(|f| negation[f.index()]);
        self.effects.push(adds.iter().map(|f| f.0).chain(negated));
        let positive = needs.iter().flat_map(|l| l.positive.iter().map(|f| f.0));
        // Every negated fact of a condition has a proposition.
        let negative = needs.iter().flat_map(|l| l.negative.iter().map(|f| negation[f.index()]));
        self.preconditions.push_sorted(positive.chain(negative));
        let node = id32(self.operator.len());
        if self.preconditions.row(node).is_empty() {
            self.free.push(node);
        }
        self.operator.push(op);
        self.cost.push(cost);
    }

    /// The same graph with these effects for each node. Nodes without effects are removed, and
    /// moves come last, sorted by their precondition.
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
}
