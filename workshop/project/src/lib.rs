//! A set of PDDL files as one project: which file needs which, and what is wrong where.
//!
//! Problem: a problem means nothing without its domain, a domain nothing without its imports, a plan nothing
//! without its problem, and an author edits all of them at once. Idea: texts are handed in by path
//! ([`Project::set`]); names in their heads say what belongs together; each file is read when somebody first
//! asks, and again only after something that it depends on has changed. Nothing here reads a disk.
//!
//! ```
//! use project::Project;
//!
//! let mut project = Project::new();
//! project.set("hall/domain.pddl", "(define (domain hall) (:predicates (lit)))");
//! let problem = project.set(
//!     "hall/problem.pddl",
//!     "(define (problem dark) (:domain hall) (:goal (lti)))",
//! );
//! let findings = project.findings(problem);
//! assert_eq!(findings[0].message, "unknown predicate `lti`");
//! assert!(project.sources().describe(&findings[0]).starts_with("hall/problem.pddl:1:47: error[E0202]"));
//!
//! project.set("hall/domain.pddl", "(define (domain hall) (:predicates (lti)))");
//! assert!(project.language_findings(problem).is_empty());
//! ```
//!
//! Map, from the ground up: `header` (the names
//! in a file's head), `pairs` (which
//! domain a problem means, which problem a plan), `links` (which file needs which), `file` (a file as it was read), `lint` (a domain with all
//! its problems, looked at by lints), `judge` (what there is to say about a file), `project`,
//! `task` (a problem with its domain and its imports).

mod file;
mod header;
mod judge;
mod links;
mod lint;
mod pairs;
mod project;
mod task;

pub use file::{FileKind, Reading};
pub use header::{Header, Need};
pub use lint::{Fix, Linted};
pub use pairs::{Candidate, domain_for, problem_for};
pub use project::Project;
pub use task::{NoTask, Task, read_domain};
