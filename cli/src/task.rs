//! A domain, its imports, and a problem, read from files.

use crate::console::Console;
use crate::exit::Exit;
use crate::files;
use crate::nearby;
use crate::render::{error, show_all};
use diagnostics::{SourceId, Sources};
use pddl::model::{Domain, Problem};
use pddl::{Source, parse_problem};
use project::{Header, Need, read_domain};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The task of `plan` and `validate`.
pub(crate) struct TaskFiles {
    pub(crate) sources: Sources,
    pub(crate) domain_file: SourceId,
    pub(crate) domain: Domain,
    pub(crate) problem_file: SourceId,
    pub(crate) problem: Problem,
}

impl TaskFiles {
    /// Reads both files and shows their findings. Searches the domains that the domain imports
    /// among `imports`, then near the file that needs them.
    ///
    /// # Errors
    /// [`Exit::Unreadable`] if one cannot be read; that has been shown.
    pub(crate) fn read(
        domain: &Path,
        imports: &[PathBuf],
        problem: &Path,
        console: &mut Console<'_>,
    ) -> Result<Self, Exit> {
        let (mut sources, domain_file) = Sources::of(read_source(domain, console)?);
        let problem_file = sources.push(read_source(problem, console)?);
        let found = found_imports(domain, &sources[domain_file], imports, console)?;
        let imports: Vec<SourceId> = found.into_iter().map(|source| sources.push(source)).collect();
        let (domain, findings) = read_domain(&sources, domain_file, &imports);
        show_all(&sources, &findings, console);
        let domain = domain.ok_or(Exit::Unreadable)?;
        let parsed = parse_problem(&sources[problem_file], &domain);
        let findings: Vec<_> = parsed.diagnostics.iter().map(|d| d.finding(problem_file)).collect();
        show_all(&sources, &findings, console);
        let problem = parsed.model.ok_or(Exit::Unreadable)?;
        Ok(Self { sources, domain_file, domain, problem_file, problem })
    }

    pub(crate) fn domain_source(&self) -> &Source {
        &self.sources[self.domain_file]
    }

    pub(crate) fn problem_source(&self) -> &Source {
        &self.sources[self.problem_file]
    }
}

/// The files that a domain imports, directly or indirectly. A missing import is not in the result;
/// the parser reports it at its place.
fn found_imports(
    domain: &Path,
    source: &Source,
    given: &[PathBuf],
    console: &mut Console<'_>,
) -> Result<Vec<Source>, Exit> {
    let header = |source: &Source| Header::of(source.name(), source.text());
    let own = header(source);
    let mut found = Vec::new();
    let mut defined = BTreeSet::from([own.name]);
    let needs = |path: &Path, needs: Vec<Need>| -> Vec<(PathBuf, String)> {
        needs.into_iter().map(|need| (path.to_owned(), need.name)).collect()
    };
    let mut sought = needs(domain, own.needs);
    for path in given {
        let source = read_source(path, console)?;
        let header = header(&source);
        defined.insert(header.name);
        sought.extend(needs(path, header.needs));
        found.push(source);
    }
    while let Some((path, name)) = sought.pop() {
        if defined.insert(name.clone())
            && let Some((path, source)) = nearby::provider(&path, &name)
        {
            sought.extend(needs(&path, header(&source).needs));
            found.push(source);
        }
    }
    Ok(found)
}

/// Reads a file, and shows the error if it cannot be read.
///
/// # Errors
/// [`Exit::Unreadable`].
pub(crate) fn read_source(path: &Path, console: &mut Console<'_>) -> Result<Source, Exit> {
    files::read(path).map_err(|why| {
        error(why.to_string(), console);
        Exit::Unreadable
    })
}
