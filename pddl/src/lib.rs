//! PDDL 3.1 and HDDL: lossless syntax, a typed model, diagnostics, and a printer.
//!
//! Text becomes a `syntax::Tree` that keeps every byte, the tree becomes a typed
//! [`model::Domain`] or [`model::Problem`] with resolved names, and whatever is wrong on the way
//! becomes a [`Diagnostic`] with a place. Nothing here reads files or prints.
//!
//! ```
//! use pddl::{Source, parse_domain};
//!
//! let source = Source::new("hall.pddl", "(define (domain hall) (:predicates (lit)))");
//! let parsed = parse_domain(&source, &[]);
//! assert!(parsed.diagnostics.is_empty());
//! assert_eq!(parsed.model.expect("no errors").predicates.len(), 1);
//! ```

mod diagnostic;
mod lower;
pub mod model;
mod parse;
mod plan;
mod print;
mod source;
pub mod syntax;

pub use diagnostic::{Diagnostic, DiagnosticKind, FileKind, Label, Severity, SymbolKind, UnsupportedFeature};
pub use parse::{Parsed, parse_domain, parse_plan, parse_problem};
pub use plan::{Plan, PlanStep};
pub use print::{print_domain, print_plan, print_problem};
pub use source::{LineColumn, Source, Span};
