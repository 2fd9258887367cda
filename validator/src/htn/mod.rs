//! Plans for task networks.
//!
//! A plan with its decomposition (`decomposed`) is checked in four passes. The numbers form a tree (`tree`). The
//! subtasks of each task are those of its method, under some values of the method's variables and in an order that
//! the method allows (`schema`, `matching`). The steps are applicable one after the other, as in any plan. Each
//! method's precondition holds in a state that the task's place in the order allows (`placing`). For a plan without a
//! decomposition, a search finds one (`undecomposed`, `search`), and the same passes check it.
//!
//! Verdicts are exact. A search that reaches its limit ends with a refusal, never with a guess.
//!
//! Source: Höller et al., "HDDL: an extension to PDDL for expressing hierarchical planning problems", AAAI 2020;
//! Behnke, Höller & Biundo, "On the complexity of HTN plan verification", ICAPS 2015.

mod decomposed;
mod matching;
mod placing;
mod schema;
mod search;
mod tree;
mod undecomposed;

pub(crate) use decomposed::run;
pub(crate) use undecomposed::run as run_undecomposed;
