//! A domain and a problem, read from files.

use crate::console::Console;
use crate::exit::Exit;
use crate::files;
use crate::render::{Message, show_all};
use pddl::model::{Domain, Problem};
use pddl::{Source, parse_domain, parse_problem};
use std::path::Path;

/// What `plan` and `validate` work on.
pub(crate) struct TaskFiles {
    pub(crate) domain_source: Source,
    pub(crate) domain: Domain,
    pub(crate) problem_source: Source,
    pub(crate) problem: Problem,
}

impl TaskFiles {
    /// Reads both files and shows what is wrong with them.
    ///
    /// # Errors
    /// [`Exit::Unreadable`] if either cannot be read; that has been shown.
    pub(crate) fn read(domain: &Path, problem: &Path, console: &mut Console<'_>) -> Result<Self, Exit> {
        let domain_source = read_source(domain, console)?;
        let problem_source = read_source(problem, console)?;
        let parsed = parse_domain(&domain_source, &[]);
        show_all(&domain_source, &parsed.diagnostics, console);
        let domain = parsed.model.ok_or(Exit::Unreadable)?;
        let parsed = parse_problem(&problem_source, &domain);
        show_all(&problem_source, &parsed.diagnostics, console);
        let problem = parsed.model.ok_or(Exit::Unreadable)?;
        Ok(Self { domain_source, domain, problem_source, problem })
    }
}

/// Reads a file; what goes wrong is shown.
///
/// # Errors
/// [`Exit::Unreadable`].
pub(crate) fn read_source(path: &Path, console: &mut Console<'_>) -> Result<Source, Exit> {
    files::read(path).map_err(|error| {
        Message::error(error.to_string()).show(console);
        Exit::Unreadable
    })
}
