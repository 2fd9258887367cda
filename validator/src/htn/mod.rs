//! Plans of task networks.
//!
//! A plan without its decomposition is given one ([`search`]). A plan with its decomposition is checked in four passes: the numbers make a tree ([`tree`]); the subtasks of each
//! task are those of its method, under some values of the method's variables and in an order that the method allows
//! ([`schema`], [`matching`]); the steps can be taken one after the other, as in any plan; and each method's
//! precondition holds at a moment that its task's place in the order allows ([`placing`]). What is found is exact
//! but for the limits of the searches, which end with a refusal and never with a guess.
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
