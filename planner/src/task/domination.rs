//! The relaxation without what it does not need.
//!
//! Problem: many operators differ only in things that do not matter to an effect (who else rides
//! along), and every estimate walks them all. Idea: where one node achieves a proposition from a subset
//! of another's needs at no more cost, the other loses that effect; a node without effects goes.
//! What is achieved step by step keeps all its achievers: how many steps depends on the state.
//! Invariant: hmax and hadd of every proposition stay what they were, and so does what can be reached.
//! (A relaxed plan may cost more where one operator served two ends, so h+ and landmark cuts need
//! the whole graph.) Cost: for each effect, a look at the kept achievers whose rarest need is one of
//! ours; a cap per proposition leaves the rest as it is.
//!
//! Source: Helmert, "The Fast Downward planning system", JAIR 2006, simplification of unary operators.

use super::relaxation::Relaxation;
use crate::ids::id32;

/// Kept achievers looked at, for each achiever of a proposition on average.
const LOOKS: usize = 64;

struct Work<'g> {
    graph: &'g Relaxation,
    /// Kept achievers of the current proposition, by their rarest need.
    by_need: Vec<Vec<u32>>,
    touched: Vec<u32>,
    /// Kept achievers that need nothing.
    free: Vec<u32>,
    /// The node whose needs were marked last.
    mark: Vec<u32>,
}

/// The undominated part of `graph`.
pub(crate) fn undominated(graph: &Relaxation) -> Relaxation {
    let achievers = graph.effects.transposed(graph.propositions());
    let mut kept: Vec<Vec<u32>> = vec![Vec::new(); graph.nodes()];
    let mut work = Work {
        graph,
        by_need: vec![Vec::new(); graph.propositions()],
        touched: Vec::new(),
        free: Vec::new(),
        mark: vec![u32::MAX; graph.propositions()],
    };
    for proposition in 0..id32(graph.propositions()) {
        if graph.ways.comparison(proposition).is_some() {
            achievers.row(proposition).iter().for_each(|&node| kept[node as usize].push(proposition));
            continue;
        }
        let mut candidates = achievers.row(proposition).to_vec();
        candidates.sort_by_key(|&n| (graph.preconditions.row(n).len(), graph.price(n), n));
        let mut looks = LOOKS * candidates.len();
        for node in candidates {
            if !work.is_dominated(node, proposition, &mut looks) {
                kept[node as usize].push(proposition);
                work.keep(node);
            }
        }
        work.clear();
    }
    graph.with_effects(&kept)
}

impl Work<'_> {
    fn is_dominated(&mut self, node: u32, proposition: u32, looks: &mut usize) -> bool {
        let graph = self.graph;
        let needs = graph.preconditions.row(node);
        for &p in needs {
            self.mark[p as usize] = node;
        }
        if needs.contains(&proposition) {
            return true;
        }
        let price = graph.price(node);
        if self.free.iter().any(|&other| graph.price(other) <= price) {
            return true;
        }
        for &p in needs {
            for &other in &self.by_need[p as usize] {
                if *looks == 0 {
                    return false;
                }
                *looks -= 1;
                let all = graph.preconditions.row(other).iter().all(|&q| self.mark[q as usize] == node);
                if all && graph.price(other) <= price {
                    return true;
                }
            }
        }
        false
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
