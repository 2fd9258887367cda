//! Warnings that catch modelling mistakes: a domain can be right PDDL and still not say what was meant.
//!
//! Each lint is a file: its code, its name, its explanation with a wrong and a right example, and the function that
//! looks for it. [`all`] is the registry. A [`Linter`] looks at a domain and, one after the other, at its problems;
//! what they say is data ([`Finding`]) with places, and with edits where a machine can mend it. A comment
//! `; allow(unused-parameter)` on the same line or on a line of its own before it silences a lint there.
//!
//! ```
//! use lints::{File, Level, Linter};
//! use pddl::{Source, parse_domain};
//!
//! let source = Source::new("hall.pddl", "(define (domain hall) (:predicates (lit ?x))
//!   (:action switch :parameters (?x ?y) :precondition (not (lit ?x)) :effect (lit ?x)))");
//! let domain = parse_domain(&source, &[]).model.expect("no errors");
//! let findings = Linter::new(File { source: &source, model: &domain }, Level::Default).finish();
//! assert!(findings.iter().any(|f| f.lint.name == "unused-parameter" && f.message.contains("`?y`")));
//! ```
//!
//! | module | holds |
//! |---|---|
//! | `lint` | what a lint is |
//! | `registry` | all of them |
//! | `linter` | which of them run, and what is left after the comments |
//! | `finding` | what they say |
//! | `allow` | the comments that silence them |
//! | `view` | what a lint sees of a domain and a problem |
//! | `text` | the sections and keys of a file, for lints about how something is written |
//! | `usage` | what names what |
//! | `schema`, `shape` | everything that has variables and a body, as one thing |
//! | `declarations` | W07: declarations, requirements, names |
//! | `logic` | W08: conditions, effects, initial states, goals |
//! | `semantics` | W0850 on: what never happens, and why |
//! | `hierarchy` | W09: tasks and methods |
//! | `analysis` | mutexes, intervals and reachability of the crate `analysis`, computed once for all lints |
//! | `features` | which features of the language the lints know |

mod allow;
mod analysis;
mod declarations;
mod features;
mod finding;
mod hierarchy;
mod lint;
mod linter;
mod logic;
mod registry;
mod schema;
mod semantics;
mod shape;
mod text;
mod usage;
mod view;

pub use finding::{Edit, Finding, Fix, Place};
pub use lint::{Level, Lint};
pub use linter::{File, Linter};
pub use registry::{all, find};
