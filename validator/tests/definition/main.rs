//! The validator against an evaluator that follows the definition and nothing else, and laws that any evaluator keeps.
//!
//! Random tasks over all of the language ([`sample`]) with random plans, and plans of the planner with steps that were
//! dropped, swapped and changed, are judged by the validator and by [`naive`]; both must name the same step, or the same
//! value of the metric. Names, order, and what is irrelevant must not matter to the validator ([`laws`]).

#![allow(clippy::unwrap_used, reason = "a test may panic")]
#![allow(unreachable_pub, reason = "modules of a test")]

mod choices;
mod fraction;
mod laws;
mod naive;
mod planned;
mod sample;
mod sequential;
mod timed;
mod timed_naive;
mod types;

/// So many cases, unless `PROPTEST_CASES` asks for another number.
fn cases(count: u32) -> proptest::test_runner::Config {
    let mut config = proptest::test_runner::Config { failure_persistence: None, ..Default::default() };
    if std::env::var_os("PROPTEST_CASES").is_none() {
        config.cases = count;
    }
    config
}
