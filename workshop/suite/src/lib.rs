//! Tests for domains as text: `expected.toml`, compared with the results of parser, planner and validator.
//!
//! Problem: a change of a domain can silently make a problem unsolvable, make an invalid plan valid, or move an error to
//! another place. Idea: a folder is a suite. The names of `plans/valid` and `plans/invalid` state what is expected of the
//! plans in them, `expected.toml` states the rest, and every file without an entry must be free of errors.
//! [`Suite::read`] turns a [`Folder`] into [`Case`]s; [`Suite::run`] compares one of them with the results of parser,
//! planner and validator, and returns the differences as findings at their places.
//! Invariant: nothing here reads a disk or a clock; cases may run in any order and on any thread.
//!
//! ```
//! use pddl::Source;
//! use planner::Budget;
//! use std::time::Duration;
//! use suite::{File, Folder, Suite};
//!
//! let file = |path: &str, text: &str| File { path: path.to_owned(), source: Source::new(path, text) };
//! let folder = Folder {
//!     path: String::new(),
//!     expected: Source::new("expected.toml", "[problem.dark]\ncost-at-most = 0"),
//!     files: vec![
//!         file("hall.pddl", "(define (domain hall) (:predicates (lit)) (:action switch :effect (lit)))"),
//!         file("dark.pddl", "(define (problem dark) (:domain hall) (:init) (:goal (lit)))"),
//!         file("plans/valid/once.plan", "(switch)"),
//!     ],
//!     elsewhere: Vec::new(),
//! };
//! let suite = Suite::read(folder);
//! assert!(suite.findings().is_empty());
//! let failed: Vec<_> = suite
//!     .cases()
//!     .filter(|(id, _)| !suite.run(*id, &|| Duration::ZERO, &Budget::default()).is_empty())
//!     .map(|(_, case)| case.name.clone())
//!     .collect();
//! assert_eq!(failed, ["dark.pddl::solvable"]);
//! ```
//!
//! Map, from the ground up: `folder` (the files of a suite), `fault` (kinds of fault of a plan, by stable words),
//! `expected` (the model of `expected.toml`), `read` (its text), `suite` (cases), `found` (the verdict on a plan), `plan`,
//! `solve` and `language` (the comparison for plans, problems and diagnostics), `judge` (runs a case), `touched` (which
//! suites a change affects), `draft` (a first `expected.toml` from the present results).
//!
//! Codes: T01 an inconsistent suite, T02 a file without an expectation, T03 a failed case; `explain` has a page for each.

mod draft;
mod expected;
mod explain;
mod fault;
mod folder;
mod found;
mod judge;
mod language;
mod plan;
mod read;
mod solve;
mod suite;
mod touched;

pub use draft::draft;
pub use explain::explanations;
pub use fault::Fault;
pub use folder::{File, Folder};
pub use solve::Clock;
pub use suite::{Case, CaseId, Suite};
pub use touched::{Extent, touched};
