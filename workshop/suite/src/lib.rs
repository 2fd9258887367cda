//! Tests for domains as text: what `expected.toml` says, held against what is so.
//!
//! Problem: a domain changes, and nobody notices that a problem became unsolvable, that a plan which must never work
//! now does, or that an error lost its place. Idea: a folder is a suite. `plans/valid` and `plans/invalid` say by their
//! names what is expected of the plans in them, `expected.toml` says the rest, and whatever is in the folder without
//! being mentioned is at least free of errors. [`Suite::read`] turns a [`Folder`] into [`Case`]s; [`Suite::run`] holds
//! one of them against the parser, the planner and the validator, and answers with findings at their places.
//! Nothing here reads a disk or a clock, and cases may run in any order and on any thread.
//!
//! ```
//! use pddl::Source;
//! use suite::{File, Folder, Limits, Suite};
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
//!     .filter(|(id, _)| !suite.run(*id, &Limits::default()).is_empty())
//!     .map(|(_, case)| case.name.clone())
//!     .collect();
//! assert_eq!(failed, ["dark.pddl::solvable"]);
//! ```
//!
//! Map, from the ground up: `folder` (what a suite is made of), `fault` (why a plan is not valid, by a stable word),
//! `expected` (the model of `expected.toml`), `read` (its text), `suite` (cases), `judge` with `plan`, `solve` and
//! `diagnostics` (a case, held against what is so), `touched` (which suites a change concerns), `draft` (a first
//! `expected.toml` from what is found).
//!
//! Codes: T01 a suite that makes no sense, T02 something in the folder that nobody asks for, T03 a case that failed.

mod diagnostics;
mod draft;
mod expected;
mod fault;
mod folder;
mod judge;
mod plan;
mod read;
mod solve;
mod suite;
mod touched;

pub use draft::draft;
pub use fault::Fault;
pub use folder::{File, Folder};
pub use judge::Limits;
pub use suite::{Case, CaseId, Suite};
pub use touched::{Extent, touched};
