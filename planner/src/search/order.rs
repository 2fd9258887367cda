//! The sort keys of best-first search.

use crate::heuristics::Estimate;

/// The sort key of a best-first search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Order {
    /// The estimate alone. States keep the first path that was found.
    Greedy,
    /// The cost so far plus the weighted estimate.
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
