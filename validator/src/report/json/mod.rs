//! Verdicts as JSON. Keys and words are in snake case; names and conditions are in PDDL syntax.

mod advice;
mod cause;
mod decomposition;
mod failure;
mod network;
mod place;
mod trace;
mod unsatisfied;
mod verdict;

pub use verdict::{VerdictRecord, Word};
