//! Regression: the condition under which a sequence of steps reaches a goal.
//!
//! Two forms serve two callers. [`Kernel`] is a conjunction of literals, because it becomes the
//! goal of a search; it ignores what a conjunction cannot express, and its callers replay what they
//! find. [`Suffixes`] is exact, because it decides whether a robot acts; it regresses to a circuit
//! of conditions.

mod circuit;
mod kernel;
mod numbers;
mod step;
mod suffixes;
#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test")]
mod tests;
mod values;

pub(crate) use kernel::Kernel;
pub use suffixes::Suffixes;
