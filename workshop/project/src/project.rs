//! The files of a project, read on demand and again after a change.
//!
//! Invariant: a cached reading is valid: neither its text, nor the files that it needs, nor their readings
//! have changed since. Cost of a change: linear in the number of files if a header changed (all links are
//! made again), else in the number of dependent files; reading is deferred until a query. A clone is cheap
//! and shares the readings, so a server can answer from a snapshot.

use std::sync::{Arc, OnceLock};

use pddl::model::{Domain, IndexVec};
use pddl::{Names, Source, analyze_domain, analyze_plan, analyze_problem};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::language;
use crate::links::links;
use crate::{FileKind, Header, Linted, Reading};
use diagnostics::{Finding, SourceId, Sources};

/// A file and its cached results.
#[derive(Debug)]
struct File {
    header: Header,
    /// The provider of each need; see [`links`].
    links: Vec<Option<SourceId>>,
    read: OnceLock<Read>,
    /// The lints' findings. Those of a domain depend on its problems too.
    lints: OnceLock<Vec<Linted>>,
}

impl File {
    fn new(header: Header, links: Vec<Option<SourceId>>) -> Arc<Self> {
        Arc::new(Self { header, links, read: OnceLock::new(), lints: OnceLock::new() })
    }

    fn unlinted(&self) -> Option<Arc<Self>> {
        self.lints.get()?;
        let (header, links, read) = (self.header.clone(), self.links.clone(), self.read.clone());
        Some(Arc::new(Self { header, links, read, lints: OnceLock::new() }))
    }
}

#[derive(Clone, Debug)]
struct Read {
    reading: Arc<Reading>,
    language: Vec<Finding>,
}

/// A set of files.
#[derive(Clone, Debug, Default)]
pub struct Project {
    sources: Sources,
    files: IndexVec<SourceId, Option<Arc<File>>>,
    by_path: FxHashMap<String, SourceId>,
    names: Names,
    level: LintLevel,
}

/// Which lints run.
#[derive(Clone, Copy, Debug)]
struct LintLevel(lints::Level);

impl Default for LintLevel {
    fn default() -> Self {
        Self(lints::Level::Default)
    }
}

impl Project {
    /// An empty project.
    pub fn new() -> Self {
        Self::default()
    }

    /// An empty project for callers that need findings only: readings have no occurrences.
    pub fn without_names() -> Self {
        Self { names: Names::Skipped, ..Self::default() }
    }

    /// Enables lints up to `level` for files that are set from now on.
    pub fn set_lint_level(&mut self, level: lints::Level) {
        self.level = LintLevel(level);
    }

    /// The highest level of lints that run.
    pub fn lint_level(&self) -> lints::Level {
        self.level.0
    }

    /// Adds the file at `path` or replaces its text. Paths have `/` between folders; a path keeps its id,
    /// even over [`Project::remove`].
    ///
    /// # Panics
    /// Like [`Source::new`].
    pub fn set(&mut self, path: &str, text: impl Into<String>) -> SourceId {
        self.set_all([Source::new(path, text)])[0]
    }

    /// Sets many files at once, by their paths: links between them are made only once.
    pub fn set_all(&mut self, sources: impl IntoIterator<Item = Source>) -> Vec<SourceId> {
        let mut changed = Vec::new();
        let mut relink = false;
        let mut before = Vec::new();
        for source in sources {
            let path = source.name().to_owned();
            let header = Header::of(&path, source.text());
            let id = match self.by_path.get(&path) {
                Some(&id) => {
                    self.sources.replace(id, source);
                    id
                }
                None => {
                    let id = self.sources.push(source);
                    self.files.push(None);
                    self.by_path.insert(path, id);
                    id
                }
            };
            let links = match &self.files[id] {
                Some(old) if old.header.same_names(&header) => old.links.clone(),
                old => {
                    relink = true;
                    before.extend(old.iter().flat_map(|file| file.links.iter().flatten().copied()));
                    Vec::new()
                }
            };
            self.files[id] = Some(File::new(header, links));
            changed.push(id);
        }
        self.settle(changed.iter().copied().collect(), relink, before);
        changed
    }

    /// Removes the file at `path`. No other file gets its id.
    pub fn remove(&mut self, path: &str) -> Option<SourceId> {
        let id = *self.by_path.get(path)?;
        let before = self.files[id].take()?.links.iter().flatten().copied().collect();
        self.sources.replace(id, Source::new(path, ""));
        self.settle(FxHashSet::from_iter([id]), true, before);
        Some(id)
    }

    /// Makes links again if `relink`. Then drops the readings of the changed files and of all files that
    /// depend on them, and the lints' findings of these and of the files that the changed ones needed
    /// `before`.
    fn settle(&mut self, mut changed: FxHashSet<SourceId>, relink: bool, before: Vec<SourceId>) {
        let mut linted_with = before;
        if relink {
            let entries: Vec<_> = self
                .ids()
                .filter_map(|id| Some((id, self.path(id), &self.files[id].as_ref()?.header)))
                .collect();
            for (id, links) in links(&entries) {
                if let Some(file) = &self.files[id]
                    // A diagnostic about a missing name suggests similar names, and those may differ now.
                    && (file.links != links || links.contains(&None))
                {
                    linted_with.extend(file.links.iter().flatten().copied());
                    self.files[id] = Some(File::new(file.header.clone(), links));
                    changed.insert(id);
                }
            }
        }
        loop {
            let depends = |id: &SourceId| {
                !changed.contains(id) && self.needs(*id).iter().flatten().any(|need| changed.contains(need))
            };
            let next: Vec<SourceId> = self.ids().filter(depends).collect();
            if next.is_empty() {
                break;
            }
            for id in next {
                if let Some(file) = &self.files[id] {
                    self.files[id] = Some(File::new(file.header.clone(), file.links.clone()));
                }
                changed.insert(id);
            }
        }
        linted_with.extend(self.linted_with(&changed));
        self.forget_lints(linted_with);
    }

    fn linted_with(&self, files: &FxHashSet<SourceId>) -> Vec<SourceId> {
        files
            .iter()
            .filter(|&&id| self.kind(id) == FileKind::Problem)
            .filter_map(|&id| self.domain_of(id))
            .collect()
    }

    /// Domains are linted with their problems: drops the lints' findings of the domains of changed problems.
    fn forget_lints(&mut self, domains: impl IntoIterator<Item = SourceId>) {
        for domain in domains {
            if let Some(file) = &self.files[domain]
                && let Some(file) = file.unlinted()
            {
                self.files[domain] = Some(file);
            }
        }
    }

    /// The files, in the order in which they were added.
    pub fn ids(&self) -> impl Iterator<Item = SourceId> + '_ {
        self.files.enumerate().filter(|(_, file)| file.is_some()).map(|(id, _)| id)
    }

    /// The file at `path`.
    pub fn id(&self, path: &str) -> Option<SourceId> {
        self.by_path.get(path).copied().filter(|&id| self.files[id].is_some())
    }

    /// Whether the file is (still) in the project.
    pub fn contains(&self, id: SourceId) -> bool {
        self.files.get(id).is_some_and(Option::is_some)
    }

    /// The texts; empty for a removed file.
    pub fn sources(&self) -> &Sources {
        &self.sources
    }

    /// The text of a file.
    pub fn source(&self, id: SourceId) -> &Source {
        &self.sources[id]
    }

    /// The path of a file.
    pub fn path(&self, id: SourceId) -> &str {
        self.sources[id].name()
    }

    /// The kind of a file; a domain, if it is not in the project.
    pub fn kind(&self, id: SourceId) -> FileKind {
        self.file(id).map_or(FileKind::Domain, |file| file.header.kind)
    }

    /// The names in a file's header.
    pub fn header(&self, id: SourceId) -> Option<&Header> {
        self.file(id).map(|file| &file.header)
    }

    /// The files that a file needs directly, the provider of each need in its header. A problem has one, its
    /// domain; a plan has one, its problem.
    pub fn needs(&self, id: SourceId) -> &[Option<SourceId>] {
        self.file(id).map_or(&[], |file| &file.links)
    }

    /// The files that need this one directly.
    pub fn dependents(&self, id: SourceId) -> impl Iterator<Item = SourceId> + '_ {
        self.ids().filter(move |&other| self.needs(other).contains(&Some(id)))
    }

    /// The domain file that provides a file's names: itself for a domain, else through its problem.
    pub fn domain_of(&self, id: SourceId) -> Option<SourceId> {
        let need = || self.needs(id).first().copied().flatten();
        match self.kind(id) {
            FileKind::Domain => self.contains(id).then_some(id),
            FileKind::Problem => need(),
            FileKind::Plan => self.domain_of(need()?),
        }
    }

    /// The problem file that provides a file's objects: itself for a problem, a plan's problem for a plan.
    pub fn problem_of(&self, id: SourceId) -> Option<SourceId> {
        match self.kind(id) {
            FileKind::Domain => None,
            FileKind::Problem => Some(id),
            FileKind::Plan => self.needs(id).first().copied().flatten(),
        }
    }

    /// The reading of a file; `None` if it is not in the project.
    pub fn reading(&self, id: SourceId) -> Option<&Reading> {
        self.read(id).map(|read| &*read.reading)
    }

    /// The draft of the domain in a file, even with errors; `None` if the file is not a domain.
    pub fn domain(&self, id: SourceId) -> Option<&Domain> {
        match self.reading(id)? {
            Reading::Domain(analysis) => Some(&analysis.draft),
            Reading::Problem(_) | Reading::Plan(_) => None,
        }
    }

    /// The draft of the problem in a file, even with errors; `None` if the file is not a problem.
    pub fn problem(&self, id: SourceId) -> Option<&pddl::model::Problem> {
        match self.reading(id)? {
            Reading::Problem(analysis) => Some(&analysis.draft),
            Reading::Domain(_) | Reading::Plan(_) => None,
        }
    }

    /// The parser's findings in a file, in order of place.
    pub fn language_findings(&self, id: SourceId) -> &[Finding] {
        self.read(id).map_or(&[], |read| &read.language)
    }

    /// The lints' findings in a file, if lints have run since it changed; otherwise empty. For callers that
    /// must not wait: lints may take longer than reading.
    pub fn cached_lint_findings(&self, id: SourceId) -> &[Linted] {
        self.file(id).and_then(|file| file.lints.get()).map_or(&[], Vec::as_slice)
    }

    /// The cache of the lints' findings in a file.
    pub(crate) fn lint_cache(&self, id: SourceId) -> Option<&OnceLock<Vec<Linted>>> {
        self.file(id).map(|file| &file.lints)
    }

    fn file(&self, id: SourceId) -> Option<&File> {
        self.files.get(id)?.as_deref()
    }

    /// Reads a file after all files that it needs. The chain can be long, so it is on an explicit stack.
    fn read(&self, id: SourceId) -> Option<&Read> {
        let mut way = vec![id];
        while let Some(&next) = way.last() {
            let file = self.file(next)?;
            let unread = |id: &&SourceId| self.file(**id).is_some_and(|f| f.read.get().is_none());
            match file.links.iter().flatten().find(unread) {
                Some(&need) if file.read.get().is_none() => way.push(need),
                _ => {
                    file.read.get_or_init(|| self.read_anew(next, file));
                    way.pop();
                }
            }
        }
        self.file(id)?.read.get()
    }

    fn read_anew(&self, id: SourceId, file: &File) -> Read {
        let source = self.source(id);
        let reading = match file.header.kind {
            FileKind::Domain => {
                let imports: Vec<&Domain> =
                    file.links.iter().flatten().filter_map(|&import| self.domain(import)).collect();
                Reading::Domain(analyze_domain(source, &imports, self.names))
            }
            FileKind::Problem => {
                let nothing;
                let domain = match self.domain_of(id).and_then(|domain| self.domain(domain)) {
                    Some(domain) => domain,
                    None => {
                        nothing = analyze_domain(&Source::new("", ""), &[], self.names).draft;
                        &nothing
                    }
                };
                Reading::Problem(analyze_problem(source, domain, self.names))
            }
            FileKind::Plan => {
                let domain = self.domain_of(id).and_then(|domain| self.domain(domain));
                let problem = self.problem_of(id).and_then(|problem| self.problem(problem));
                Reading::Plan(match (domain, problem) {
                    (Some(domain), Some(problem)) => analyze_plan(source, domain, problem, self.names),
                    _ => pddl::Analysis {
                        draft: pddl::Plan::default(),
                        sound: false,
                        diagnostics: Vec::new(),
                        occurrences: Vec::new(),
                    },
                })
            }
        };
        let language = self.language(id, file, &reading);
        Read { reading: Arc::new(reading), language }
    }

    fn language(&self, id: SourceId, file: &File, reading: &Reading) -> Vec<Finding> {
        if file.header.kind != FileKind::Problem {
            return language::of(id, reading);
        }
        let found = self.domain_of(id).and_then(|domain| self.header(domain));
        let domains = self.ids().filter(|&other| self.kind(other) == FileKind::Domain);
        let known = domains.filter_map(|other| Some(self.header(other)?.name.as_str()));
        language::of_problem(id, reading, &file.header, found, known)
    }
}
