//! What can ever become true and which actions can ever apply, if nothing is ever deleted.
//!
//! Problem: an action that can never apply, a goal out of reach and an axiom that never fires are mistakes that reading a
//! domain does not show. Idea: drop the deletes, take every negated atom that could be deleted and every comparison that
//! could become true as true, and compute all reachable atoms as a Datalog fixpoint, semi-naively: each new row is joined
//! with those before it. Invariant: what a real plan reaches is reached here. "Unreachable" is proven; "reachable" is
//! not. Cost: bounded by a budget of join steps; past it there is no answer.
//!
//! The planner does not use it: its grounding needs instances and exclusions of objects that this leaves out, and its
//! explanations start from any state, without some operators. It asks its own relaxation, and shares the intervals and
//! the literals with this module.
//!
//! Source: Hoffmann & Nebel, "The FF planning system", JAIR 2001 (delete relaxation); Helmert,
//! "Concise finite-domain representations", AIJ 2009, §6 (as Datalog); Ullman, "Principles of
//! database and knowledge-base systems", 1989, ch. 3 (semi-naive evaluation).
//!
//! | module | holds, from the ground up |
//! |---|---|
//! | `world` | the objects that variables range over |
//! | `database`, `rule` | rows with indices, rules |
//! | `relax`, `evaluate` | conditions as rule bodies, and under a binding |
//! | `compile` | a domain as rules |
//! | `join`, `fixpoint` | their evaluation |
//! | `why` | why a rule never fires |
//! | `wording` | reasons as text |
//! | `summary` | everything that never happens, by root causes |

mod compile;
mod database;
mod evaluate;
mod fixpoint;
mod join;
mod relax;
mod rule;
mod summary;
mod why;
mod wording;
mod world;

pub use rule::Origin;
pub use summary::{Dead, Impossible, Summary, UnreachableGoal};
pub use why::RootCause;
pub use wording::Wording;
