//! The reading of a file.

use pddl::model::{Domain, Problem};
use pddl::{Analysis, Diagnostic, Occurrence, Plan};
use serde::Serialize;

/// The kind of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum FileKind {
    /// `(define (domain …`, or any text that is neither a problem nor a plan.
    Domain,
    /// `(define (problem …`
    Problem,
    /// A plan, recognised by the file's name.
    Plan,
}

impl FileKind {
    /// Whether the path is that of a plan: `*.plan`, `*.soln`, `plan`, and `sas_plan` with or without a
    /// number behind it.
    pub fn is_plan(path: &str) -> bool {
        let name = path.rsplit('/').next().unwrap_or(path).to_ascii_lowercase();
        let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
        matches!(extension, "plan" | "soln")
            || matches!(name.as_str(), "plan" | "sas_plan")
            || name.starts_with("sas_plan.")
    }

    /// Whether a file with that path belongs to a project: a plan, `*.pddl` or `*.hddl`.
    pub fn is_source(path: &str) -> bool {
        Self::is_definition(path) || Self::is_plan(path)
    }

    /// Whether the path is that of a domain or a problem: `*.pddl` or `*.hddl`.
    pub fn is_definition(path: &str) -> bool {
        let extension = path.rsplit_once('.').map_or("", |(_, extension)| extension);
        extension.eq_ignore_ascii_case("pddl") || extension.eq_ignore_ascii_case("hddl")
    }
}

/// The draft of a file's model, with diagnostics and occurrences of names.
#[derive(Clone, Debug)]
pub enum Reading {
    /// A domain, vocabulary, rules, perception or methods.
    Domain(Analysis<Domain>),
    /// A problem.
    Problem(Analysis<Problem>),
    /// A plan.
    Plan(Analysis<Plan>),
}

impl Reading {
    /// Where names stand, in order of place.
    pub fn occurrences(&self) -> &[Occurrence] {
        match self {
            Self::Domain(a) => &a.occurrences,
            Self::Problem(a) => &a.occurrences,
            Self::Plan(a) => &a.occurrences,
        }
    }

    /// The parser's diagnostics of the file.
    pub fn diagnostics(&self) -> &[Diagnostic] {
        match self {
            Self::Domain(a) => &a.diagnostics,
            Self::Problem(a) => &a.diagnostics,
            Self::Plan(a) => &a.diagnostics,
        }
    }

    /// Whether the draft is the whole meaning of the file.
    pub fn is_sound(&self) -> bool {
        match self {
            Self::Domain(a) => a.sound,
            Self::Problem(a) => a.sound,
            Self::Plan(a) => a.sound,
        }
    }
}
