//! Random numbers from a seed: the same seed gives the same sequence on each machine.
//!
//! Source: O'Neill, "PCG: A family of simple fast space-efficient statistically good algorithms for random number
//! generation", 2014. `rand_pcg` keeps the stream of a generator stable.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// A generator of numbers.
pub(crate) struct Chance(Pcg64Mcg);

impl Chance {
    pub(crate) fn new(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
    }

    /// A number below `n`. The bias is far too small to matter.
    #[expect(clippy::cast_possible_truncation, reason = "the product's upper half is below n")]
    pub(crate) fn below(&mut self, n: usize) -> usize {
        ((u128::from(self.0.next_u64()) * n as u128) >> 64) as usize
    }
}
