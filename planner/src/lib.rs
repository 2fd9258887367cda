//! Grounding, heuristics and forward search.
//!
//! [`ground`] turns a typed domain and problem into a [`Task`] once. [`solve`] answers any number
//! of [`Query`]s on it (initial state, goal, excluded operators) within a [`Budget`]. The crate
//! does not parse, print, read files or read clocks.
//!
//! ```
//! use planner::{Budget, GroundOptions, Outcome, Query, SearchConfiguration, ground, solve};
//!
//! let domain = pddl::Source::new("d", "(define (domain hall) (:predicates (lit))
//!     (:action switch :parameters () :precondition (not (lit)) :effect (lit)))");
//! let problem = pddl::Source::new("p", "(define (problem dark) (:domain hall) (:init) (:goal (lit)))");
//! let domain = pddl::parse_domain(&domain, &[]).model.expect("a correct domain");
//! let problem = pddl::parse_problem(&problem, &domain).model.expect("a correct problem");
//!
//! let task = ground(&domain, &problem, &GroundOptions::default())?;
//! let report = solve(&task, &Query::of(&task), &SearchConfiguration::default(), &Budget::default());
//! let Outcome::Solved(plan) = report.outcome else { panic!("one step is enough") };
//! assert_eq!(task.operator_name(plan.operators[0]), "(switch)");
//! # Ok::<(), planner::GroundError>(())
//! ```
//!
//! | module, from the ground up | holds |
//! |---|---|
//! | `ids`, `number` | numbered things; exact numbers, expressions over fluents |
//! | `task` | the grounded task, states, successors, axioms, the delete relaxation, regression |
//! | `ground` | from schemas to facts and operators, in five stages |
//! | `query` | a question on a task, and the meter of its searches |
//! | `heuristics` | estimators, one file each |
//! | `search` | search algorithms, configurations, repair |
//! | `unsolvability` | why there is no plan |

mod ground;
mod heuristics;
mod ids;
#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test")]
mod lifted_tests;
mod number;
mod query;
#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test")]
mod random_numbers;
#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test")]
mod random_tests;
mod search;
mod task;
#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test")]
mod test_support;
mod unsolvability;

pub use budget::Budget;
pub use ground::{Feature, GroundError, GroundOptions, Origin, ground};
pub use ids::{FactId, FluentId, OperatorId};
pub use number::Number;
pub use search::{
    Attempt, Distance, Improved, Limit, Outcome, Plan, Preference, Quality, Query, Repair, Repaired, Report,
    SearchConfiguration, Statistics, UnsolvableReason, Way, improve, repair, solve, still_needed,
};
pub use task::{
    AtomStatus, AxiomRule, ConditionalEffect, ConditionalEffects, Fact, Goal, GroundAtom, Impossible,
    Literals, LiteralsRef, Mutexes, ObjectValue, Operator, Operators, State, Suffixes, Task, Variable,
};
pub use unsolvability::{
    Achiever, Exclusive, Explanation, Extent, Literal, Nearest, Need, Never, NeverCompares, Obstruction,
    Part, Pattern, Reason, ReasonId, Space, Why, Wording, explain,
};
