//! What best-first searches sort states by.

use crate::heuristics::Estimate;

/// What a best-first search sorts states by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Order {
    /// The estimate alone. States keep the first way that was found.
    Greedy,
    /// The cost so far plus so many times the estimate.
    Weighted(u32),
}

impl Order {
    pub(crate) fn key(self, cost: u64, estimate: Estimate) -> u64 {
        match self {
            Self::Greedy => u64::from(estimate.0),
            Self::Weighted(weight) => cost.saturating_add(u64::from(weight) * u64::from(estimate.0)),
        }
    }
}
