//! What each example reads.

use pddl::model::{Domain, Problem};
use pddl::{Source, parse_domain, parse_problem};
use std::error::Error;

/// A domain and a problem from their files, or what stands in the way.
pub(crate) fn read(domain: &str, problem: &str) -> Result<(Domain, Problem), Box<dyn Error>> {
    let source = |path: &str| std::fs::read_to_string(path).map(|text| Source::new(path.to_owned(), text));
    let domain = parse_domain(&source(domain)?, &[]);
    let domain = domain.model.ok_or_else(|| format!("{:?}", domain.diagnostics))?;
    let problem = parse_problem(&source(problem)?, &domain);
    let problem = problem.model.ok_or_else(|| format!("{:?}", problem.diagnostics))?;
    Ok((domain, problem))
}
