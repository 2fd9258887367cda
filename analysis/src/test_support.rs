//! Models out of texts, for the tests of the analyses.

use pddl::model::{Domain, Problem};
use pddl::{Source, parse_domain, parse_problem};

/// A domain and a problem that have no errors.
pub(crate) fn both(domain: &str, problem: &str) -> (Domain, Problem) {
    let source = Source::new("domain", domain);
    let parsed = parse_domain(&source, &[]);
    let said: String = parsed.diagnostics.iter().map(|d| d.describe(&source)).collect();
    let domain = parsed.model.unwrap_or_else(|| panic!("{said}"));
    let source = Source::new("problem", problem);
    let parsed = parse_problem(&source, &domain);
    let said: String = parsed.diagnostics.iter().map(|d| d.describe(&source)).collect();
    (domain, parsed.model.unwrap_or_else(|| panic!("{said}")))
}
