//! A set of PDDL files as one project: which file needs which, and the findings in each.
//!
//! Problem: a problem has no meaning without its domain, a domain without its imports, a plan without its
//! problem, and an author edits all of them at once. Idea: callers hand in texts by path ([`Project::set`]),
//! and the names in their headers link them. A file is read at the first query, and again only after it or a
//! file that it depends on has changed. Nothing here reads a disk.
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
//! Map, from the ground up: `header` (the names in a file's header), `pairs` (the domain of a problem, the problem of a
//! plan), `links` (which file needs which), `file` (a file's reading), `language` (the parser's findings in it), `project`, `task` (a problem with its domain and imports), `lint` (lints over a domain with all its
//! problems), `judge` (all findings in a file).

mod file;
mod header;
mod judge;
mod language;
mod links;
mod lint;
mod pairs;
mod project;
mod task;

pub use file::{FileKind, Reading};
pub use header::{Header, Need};
pub use lints::{Fix, Linted};
pub use pairs::{Candidate, domain_for, problem_for};
pub use project::Project;
pub use task::{NoTask, Task, read_domain};
