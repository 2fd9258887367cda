//! The delete relaxation without dominated effects.
//!
//! Problem: many operators differ only in conditions that do not matter for an effect (who else
//! rides along), and every estimate visits them all. Idea: if one node achieves a proposition with
//! a subset of another node's preconditions and at no higher cost, the other node loses that
//! effect; a node without effects is removed. A proposition that is achieved step by step keeps all
//! its achievers, because the number of steps depends on the state. Invariant: hmax and hadd of
//! every proposition do not change, and neither does reachability. (A relaxed plan may cost more if
//! one operator served two purposes, so h+ and landmark cuts need the whole graph.) Cost: each
//! effect is compared with the kept achievers whose rarest precondition is among its own. A limit
//! for each proposition stops the comparisons and keeps the rest.
//!
//! Source: Helmert, "The Fast Downward planning system", JAIR 2006, simplification of unary operators.

use super::Rows;
use super::relaxation::Relaxation;
use super::sort::sort_by_count;
use crate::ids::id32;
use budget::{Interrupted, Meter};
use rustc_hash::FxHashMap;

/// The kept achievers that are compared, per achiever of a proposition on average.
const LOOKS: usize = 64;

struct Work<'g> {
    graph: &'g Relaxation,
    meter: &'g Meter<'g>,
    /// The kept achievers of the current proposition, by their rarest precondition.
    by_need: Vec<Vec<u32>>,
    touched: Vec<u32>,
    /// The kept achievers without preconditions.
    free: Vec<u32>,
    /// By proposition: the last node that marked it as a precondition.
    mark: Vec<u32>,
}

/// The part of `graph` that is not dominated.
pub(crate) fn undominated(graph: &Relaxation, meter: &Meter<'_>) -> Result<Relaxation, Interrupted> {
    let order = by_needs_and_price(graph, meter)?;
    let achievers = graph.effects.transposed_in(order.into_iter(), graph.propositions(), meter)?;
    let mut kept = Rows::default();
    let mut work = Work {
        graph,
        meter,
        by_need: vec![Vec::new(); graph.propositions()],
        touched: Vec::new(),
        free: Vec::new(),
        mark: vec![u32::MAX; graph.propositions()],
    };
    let mut undominated = Vec::new();
    for proposition in 0..id32(graph.propositions()) {
        let candidates = achievers.row(proposition);
        if graph.ways.comparison(proposition).is_some() {
            kept.push(candidates.iter().copied());
            continue;
        }
        let mut looks = LOOKS * candidates.len();
        undominated.clear();
        for &node in candidates {
            if !work.is_dominated(node, proposition, &mut looks)? {
                undominated.push(node);
                work.keep(node);
            }
        }
        kept.push(undominated.iter().copied());
        work.clear();
    }
    graph.with_effects(&kept.transposed(graph.nodes(), meter)?, meter)
}

/// The nodes, sorted by the number of their preconditions, then by cost.
fn by_needs_and_price(graph: &Relaxation, meter: &Meter<'_>) -> Result<Vec<u32>, Interrupted> {
    let nodes: Vec<u32> = (0..id32(graph.nodes())).collect();
    let mut ranks: FxHashMap<(bool, u32), usize> = FxHashMap::default();
    let mut most = 0;
    for part in meter.chunks(&nodes, 8) {
        for &node in part? {
            ranks.entry(graph.price(node)).or_insert(0);
            most = most.max(graph.preconditions.row(node).len());
        }
    }
    let mut prices: Vec<(bool, u32)> = ranks.keys().copied().collect();
    prices.sort_unstable();
    prices.iter().enumerate().for_each(|(rank, price)| *ranks.entry(*price).or_default() = rank);
    let cheap = match prices.len() {
        0 | 1 => nodes,
        different => sort_by_count(&nodes, different, meter, |node| ranks[&graph.price(node)])?,
    };
    sort_by_count(&cheap, most + 1, meter, |node| graph.preconditions.row(node).len())
}

impl Work<'_> {
    fn is_dominated(&mut self, node: u32, proposition: u32, looks: &mut usize) -> Result<bool, Interrupted> {
        let graph = self.graph;
        let needs = graph.preconditions.row(node);
        self.meter.spend(16 + 4 * needs.len())?;
        for &p in needs {
            self.mark[p as usize] = node;
        }
        if needs.contains(&proposition) {
            return Ok(true);
        }
        let price = graph.price(node);
        // They are sorted by price, so the first is the cheapest.
        if self.free.first().is_some_and(|&other| graph.price(other) <= price) {
            return Ok(true);
        }
        for &p in needs {
            for &other in &self.by_need[p as usize] {
                if *looks == 0 {
                    return Ok(false);
                }
                *looks -= 1;
                let row = graph.preconditions.row(other);
                self.meter.spend(8 + row.len())?;
                if row.iter().all(|&q| self.mark[q as usize] == node) && graph.price(other) <= price {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }

    fn keep(&mut self, node: u32) {
        let graph = self.graph;
        let needs = graph.preconditions.row(node);
        match needs.iter().copied().min_by_key(|&p| graph.needed_by.row(p).len()) {
            Some(rarest) => {
                self.by_need[rarest as usize].push(node);
                self.touched.push(rarest);
            }
            None => self.free.push(node),
        }
    }

    fn clear(&mut self) {
        for p in self.touched.drain(..) {
            self.by_need[p as usize].clear();
        }
        self.free.clear();
    }
}
