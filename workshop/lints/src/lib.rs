//! Warnings that catch modelling mistakes: a domain can be correct PDDL and still not say what its author meant.
//!
//! Each lint has two files: `NAME.rs` with its check, and beside it `CODE.md` with its explanation and a wrong and a right
//! example. [`all`] is the registry. A [`Linter`] reads a domain and then its problems, one after the other. Its findings
//! are data with places and, where the change is certain, with edits ([`Linted`]). A comment
//! `; allow(unused-parameter)` on the same line, or on a line of its own before it, silences a lint there.
//!
//! ```
//! use diagnostics::Sources;
//! use lints::{File, Level, Linter};
//! use pddl::{Source, parse_domain};
//!
//! let mut sources = Sources::new();
//! let id = sources.push(Source::new("hall.pddl", "(define (domain hall) (:predicates (lit ?x))
//!   (:action switch :parameters (?x ?y) :precondition (not (lit ?x)) :effect (lit ?x)))"));
//! let domain = parse_domain(&sources[id], &[]).model.expect("no errors");
//! let domain = File { id, source: &sources[id], model: &domain };
//! let findings = Linter::new(domain, Level::Default).finish();
//! assert!(findings.iter().any(|f| f.lint == "unused-parameter" && f.finding.message.contains("`?y`")));
//! ```
//!
//! From the ground up:
//!
//! | module | holds |
//! |---|---|
//! | `place`, `finding` | places in the two files, findings with edits |
//! | `text` | the sections and keys of a file, for lints about how something is written |
//! | `schema`, `shape` | actions, methods, axioms and the like as one thing |
//! | `usage` | which names are used |
//! | `coverage` | which features of the language the lints know |
//! | `analysis` | mutexes, intervals and reachability of the crate `analysis`, computed once for all lints |
//! | `allow` | the comments that silence lints |
//! | `view` | the domain and the problem as lints see them |
//! | `lint` | the type of a lint |
//! | `declarations` | W07: declarations, requirements, names |
//! | `logic` | W08: conditions, effects, initial states, goals |
//! | `semantics` | W0850 on: what never happens, and why |
//! | `hierarchy` | W09: tasks and methods |
//! | `registry` | all lints |
//! | `linter` | runs them |

mod allow;
mod analysis;
mod coverage;
mod declarations;
mod finding;
mod hierarchy;
mod lint;
mod linter;
mod logic;
mod place;
mod registry;
mod schema;
mod semantics;
mod shape;
mod text;
mod usage;
mod view;

pub use finding::{Fix, Linted};
pub use lint::{Level, Lint};
pub use linter::{File, Linter};
pub use registry::{all, find};
