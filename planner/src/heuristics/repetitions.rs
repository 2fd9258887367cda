//! Repetitions of operators while costs are propagated.
//!
//! Idea: if costs are added up, an achiever counts as often as it must be applied in the state to
//! satisfy the comparison; one achiever has to do it alone. If costs are maximised, that would not
//! be admissible, because two achievers may share the work. There a comparison costs what it lacks
//! times the lowest price of a unit, which is admissible for any achiever. Both are finite whenever
//! the comparison can be satisfied. Cost: one evaluation of a comparison per state.
//!
//! Source: Scala, Haslum, Thiébaux & Ramirez, "Subgoaling techniques for satisficing and optimal
//! numeric planning", JAIR 2020, §4.2 and §4.3. Our bound for hmax is below theirs: they add the
//! achiever's preconditions and count twice what achieves both.

use crate::task::{Numeric, Relaxation, Way};
use rustc_hash::FxHashMap;

/// The largest number of repetitions that is counted exactly.
const MOST: f64 = 1e6;

/// Counts repetitions for explorations of one graph.
pub(crate) struct Repetitions<'a> {
    graph: &'a Relaxation,
    numeric: &'a Numeric,
    /// By comparison: the lowest cost of a unit upwards and downwards; empty if prices are not
    /// needed.
    prices: Vec<[f64; 2]>,
}

impl<'a> Repetitions<'a> {
    /// `None` if no operator needs repetition.
    pub(crate) fn new(graph: &'a Relaxation, numeric: &'a Numeric) -> Option<Self> {
        (!graph.ways.is_empty()).then(|| Self { graph, numeric, prices: Vec::new() })
    }

    /// Adds prices, from the cost of each node.
    pub(crate) fn with_prices(mut self, cost: impl Fn(u32) -> u32) -> Self {
        self.prices = vec![[f64::INFINITY; 2]; self.numeric.comparisons.len()];
        let positions = self.numeric.comparisons.iter().zip(0..);
        let of: FxHashMap<u32, u32> = positions.map(|(comparison, i)| (comparison.fact.0, i)).collect();
        for node in 0..crate::ids::id32(self.graph.nodes()) {
            for effect in self.graph.effects.range(node) {
                match self.graph.ways.get(effect) {
                    Way::Steps { comparison, step } => {
                        let price = &mut self.prices[*comparison as usize][usize::from(*step < 0.0)];
                        *price = price.min(f64::from(cost(node)) / step.abs());
                    }
                    Way::Rate { comparison, .. } => self.prices[*comparison as usize] = [0.0; 2],
                    Way::Once => {
                        if let Some(&comparison) = of.get(&self.graph.effects.item(effect)) {
                            self.prices[comparison as usize] = [0.0; 2];
                        }
                    }
                }
            }
        }
        self
    }

    /// How often a node must be applied for this effect, if the comparison needs `more` units than
    /// its bound; `None` if the node never achieves it.
    pub(crate) fn count(&self, effect: usize, more: f64, words: &[u64]) -> Option<u32> {
        let times = self.numeric.repetitions(self.graph.ways.get(effect), more, words)?;
        Some(whole(times))
    }

    /// A lower bound on the cost of the comparison of this effect, for any achiever.
    pub(crate) fn bound(&self, effect: usize, words: &[u64]) -> u32 {
        let Way::Steps { comparison, .. } = self.graph.ways.get(effect) else { return 0 };
        let Some(lack) = self.numeric.lack(*comparison, words) else { return 0 };
        let price = self.prices[*comparison as usize][usize::from(lack < 0.0)];
        let least = lack.abs() * price;
        // Slightly less, to stay below the exact value despite rounding.
        if least.is_finite() { whole((least * (1.0 - 1e-9) - 1e-9).ceil()) } else { 0 }
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and a million")]
fn whole(number: f64) -> u32 {
    number.clamp(0.0, MOST) as u32
}
