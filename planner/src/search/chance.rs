//! A seeded random number generator: the same seed gives the same sequence on every machine.
//!
//! Source: O'Neill, "PCG: A family of simple fast space-efficient statistically good algorithms for
//! random number generation", 2014. `rand_pcg` guarantees that the stream of a generator does not
//! change.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// A random number generator.
pub(crate) struct Chance(Pcg64Mcg);

impl Chance {
    pub(crate) fn new(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
    }

    /// Returns a number below `n`. The bias is negligible.
    #[expect(clippy::cast_possible_truncation, reason = "the product's upper half is below n")]
    pub(crate) fn below(&mut self, n: usize) -> usize {
        ((u128::from(self.0.next_u64()) * n as u128) >> 64) as usize
    }
}
