//! PDDL 3.1 and HDDL: lossless syntax, a typed model, diagnostics, and a printer.
//!
//! Text becomes a [`syntax::Tree`] that keeps every byte. The tree becomes a typed [`model::Domain`] or
//! [`model::Problem`] with resolved names. Each mistake becomes a [`Diagnostic`] with a place. Nothing here
//! reads files or prints to a terminal.
//!
//! ```
//! use pddl::{Source, parse_domain, print_domain};
//!
//! let source = Source::new("hall.pddl", "(define (domain hall) (:predicates (lit)))");
//! let parsed = parse_domain(&source, &[]);
//! assert!(parsed.diagnostics.is_empty());
//! let domain = parsed.model.expect("no errors");
//! assert_eq!(domain.predicates.len(), 1);
//! assert!(print_domain(&domain).contains("(:predicates"));
//!
//! let source = Source::new("hall.pddl", "(define (domain hall) (:predicates (lit))
//!   (:action switch :effect (lti)))");
//! let parsed = parse_domain(&source, &[]);
//! assert!(parsed.model.is_none());
//! let said = parsed.diagnostics[0].describe(&source);
//! assert!(said.starts_with("hall.pddl:2:28: error[E0202]: unknown predicate `lti`"));
//! assert!(said.ends_with("did you mean `lit`?\n"));
//! ```
//!
//! | module | holds |
//! |---|---|
//! | [`syntax`] | tokens that tile the text, the tree over them, recovery at parentheses |
//! | `lower` | tree to model: names, arities, types; a file for each part of the language |
//! | [`model`] | what a file means |
//! | `occurrence`, `analysis` | for editors: where each name occurs, a draft of the model of a file with errors |
//! | `diagnostic` | what can be wrong, with stable codes, and a page of explanation for each |
//! | `plan` | what a plan file means: sequential, temporal, hierarchical |
//! | `print` | model to text |
//! | `format` | text to text: the same tokens and comments, laid out anew |

mod analysis;
mod decimal;
mod diagnostic;
mod format;
mod lower;
pub mod model;
mod occurrence;
mod parse;
mod plan;
mod print;
pub mod syntax;

pub use analysis::{Analysis, Names, analyze_domain, analyze_plan, analyze_problem};
pub use decimal::{Decimal, NotADecimal};
pub use diagnostic::{
    Diagnostic, DiagnosticKind, FileKind, Label, SymbolKind, UnsupportedFeature, explain, explanations,
};
/// Texts and places in them, for callers that read nothing but PDDL.
pub use diagnostics::{Severity, Source, Span};
pub use format::format;
pub use occurrence::{NameKind, Occurrence, Role, Symbol};
pub use parse::{Parsed, parse_domain, parse_plan, parse_problem};
pub use plan::{
    ClaimedCost, Decomposition, DecompositionId, HierarchicalPlan, LabelledStep, LabelledStepId, Plan,
    PlanKind, PlanLabel, PlanNode, PlanReference, PlanStep, SequentialPlan, StepHead, TemporalPlan,
    TemporalStep,
};
pub use print::{print_domain, print_plan, print_problem};
