//! The files of a project, read when asked for and again after a change.
//!
//! Invariant: a reading is kept only as long as neither its text, nor what provides its needs, nor the reading
//! of that has changed. Cost of a change: linear in the number of files if a head changed (links are made
//! anew), else in the number of those that depend on the file; reading is put off until somebody asks. A clone
//! is cheap and shares what was read, so that a server can answer from a snapshot.

use std::sync::{Arc, OnceLock};

use pddl::model::{Domain, IndexVec};
use pddl::{Names, Source, analyze_domain, analyze_plan, analyze_problem};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::judge;
use crate::links::links;
use crate::{FileKind, Header, Linted, Reading};
use diagnostics::{Finding, SourceId, Sources};

/// What is known of a file.
#[derive(Debug)]
struct File {
    header: Header,
    /// What provides each need; see [`links`].
    links: Vec<Option<SourceId>>,
    read: OnceLock<Read>,
    /// What lints say. Of a domain it depends on its problems too.
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

/// What lints may say.
#[derive(Clone, Copy, Debug)]
struct LintLevel(lints::Level);

impl Default for LintLevel {
    fn default() -> Self {
        Self(lints::Level::Default)
    }
}

impl Project {
    /// No files.
    pub fn new() -> Self {
        Self::default()
    }

    /// No files, and of those to come only what is wrong with them is wanted: readings have no occurrences.
    pub fn without_names() -> Self {
        Self { names: Names::Skipped, ..Self::default() }
    }

    /// Lets lints up to `level` speak, in files that are set from now on.
    pub fn set_lint_level(&mut self, level: lints::Level) {
        self.level = LintLevel(level);
    }

    /// Up to which level lints speak.
    pub fn lint_level(&self) -> lints::Level {
        self.level.0
    }

    /// Adds the file at `path` or gives it another text. Paths have `/` between folders; a path keeps its id,
    /// also over [`Project::remove`].
    ///
    /// # Panics
    /// Like [`Source::new`].
    pub fn set(&mut self, path: &str, text: impl Into<String>) -> SourceId {
        self.set_all([Source::new(path, text)])[0]
    }

    /// Many files at once, named by their paths: links between them are looked for only once.
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

    /// Takes the file at `path` out. Its id stays its own.
    pub fn remove(&mut self, path: &str) -> Option<SourceId> {
        let id = *self.by_path.get(path)?;
        let before = self.files[id].take()?.links.iter().flatten().copied().collect();
        self.sources.replace(id, Source::new(path, ""));
        self.settle(FxHashSet::from_iter([id]), true, before);
        Some(id)
    }

    /// Makes links anew if `relink`, then forgets what was read of the changed files and of all that depend on
    /// them, and what lints said of these and of what the changed files needed `before`.
    fn settle(&mut self, mut changed: FxHashSet<SourceId>, relink: bool, before: Vec<SourceId>) {
        let mut linted_with = before;
        if relink {
            let entries: Vec<_> = self
                .ids()
                .filter_map(|id| Some((id, self.path(id), &self.files[id].as_ref()?.header)))
                .collect();
            for (id, links) in links(&entries) {
                if let Some(file) = &self.files[id]
                    // What is missing is told with names that are near: those may be others now.
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

    /// Domains are linted with their problems: what was said of the domains of changed ones is forgotten.
    fn forget_lints(&mut self, domains: impl IntoIterator<Item = SourceId>) {
        for domain in domains {
            if let Some(file) = &self.files[domain]
                && let Some(file) = file.unlinted()
            {
                self.files[domain] = Some(file);
            }
        }
    }

    /// The files, in the order in which they came.
    pub fn ids(&self) -> impl Iterator<Item = SourceId> + '_ {
        self.files.enumerate().filter(|(_, file)| file.is_some()).map(|(id, _)| id)
    }

    /// The file at `path`.
    pub fn id(&self, path: &str) -> Option<SourceId> {
        self.by_path.get(path).copied().filter(|&id| self.files[id].is_some())
    }

    /// Whether the file is (still) one of the project's.
    pub fn contains(&self, id: SourceId) -> bool {
        self.files.get(id).is_some_and(Option::is_some)
    }

    /// The texts; of a file that was taken out, the empty one.
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

    /// What a file is; a domain, if it is none of the project's.
    pub fn kind(&self, id: SourceId) -> FileKind {
        self.file(id).map_or(FileKind::Domain, |file| file.header.kind)
    }

    /// The names in a file's head.
    pub fn header(&self, id: SourceId) -> Option<&Header> {
        self.file(id).map(|file| &file.header)
    }

    /// What a file needs directly, for each need in its head what provides it. A problem has one, its domain;
    /// a plan one, its problem.
    pub fn needs(&self, id: SourceId) -> &[Option<SourceId>] {
        self.file(id).map_or(&[], |file| &file.links)
    }

    /// The files that need this one directly.
    pub fn dependents(&self, id: SourceId) -> impl Iterator<Item = SourceId> + '_ {
        self.ids().filter(move |&other| self.needs(other).contains(&Some(id)))
    }

    /// The domain file that a file's names come from: its own for a domain, else by way of the problem.
    pub fn domain_of(&self, id: SourceId) -> Option<SourceId> {
        let need = || self.needs(id).first().copied().flatten();
        match self.kind(id) {
            FileKind::Domain => self.contains(id).then_some(id),
            FileKind::Problem => need(),
            FileKind::Plan => self.domain_of(need()?),
        }
    }

    /// The problem file that a file's objects come from: its own for a problem, a plan's for a plan.
    pub fn problem_of(&self, id: SourceId) -> Option<SourceId> {
        match self.kind(id) {
            FileKind::Domain => None,
            FileKind::Problem => Some(id),
            FileKind::Plan => self.needs(id).first().copied().flatten(),
        }
    }

    /// A file as it was read; `None` if it is none of the project's.
    pub fn reading(&self, id: SourceId) -> Option<&Reading> {
        self.read(id).map(|read| &*read.reading)
    }

    /// The model of the domain in a file, whatever is wrong with it; `None` if the file is no domain.
    pub fn domain(&self, id: SourceId) -> Option<&Domain> {
        match self.reading(id)? {
            Reading::Domain(analysis) => Some(&analysis.draft),
            Reading::Problem(_) | Reading::Plan(_) => None,
        }
    }

    /// The model of the problem in a file, whatever is wrong with it; `None` if the file is no problem.
    pub fn problem(&self, id: SourceId) -> Option<&pddl::model::Problem> {
        match self.reading(id)? {
            Reading::Problem(analysis) => Some(&analysis.draft),
            Reading::Domain(_) | Reading::Plan(_) => None,
        }
    }

    /// What the language says about a file, in order of place.
    pub fn language_findings(&self, id: SourceId) -> &[Finding] {
        self.read(id).map_or(&[], |read| &read.language)
    }

    /// What lints say about a file, in order of place; nothing while it or its domain has errors.
    pub fn lint_findings(&self, id: SourceId) -> &[Linted] {
        self.file(id).map_or(&[], |file| file.lints.get_or_init(|| judge::lints(self, id)))
    }

    /// What lints say about a file if they have looked at it since it changed; nothing if they have not. For whoever
    /// must not wait: lints may take longer than reading.
    pub fn cached_lint_findings(&self, id: SourceId) -> &[Linted] {
        self.file(id).and_then(|file| file.lints.get()).map_or(&[], Vec::as_slice)
    }

    /// Everything to say about a file, in order of place.
    pub fn findings(&self, id: SourceId) -> Vec<Finding> {
        let lints = self.lint_findings(id).iter().map(|linted| &linted.finding);
        let mut all: Vec<Finding> = self.language_findings(id).iter().chain(lints).cloned().collect();
        all.sort_by_key(|finding| finding.place.span);
        all
    }

    fn file(&self, id: SourceId) -> Option<&File> {
        self.files.get(id)?.as_deref()
    }

    /// Reads a file after all that it needs, which may be a long way: the way is on a stack of our own.
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
        let language = judge::language(self, id, &reading);
        Read { reading: Arc::new(reading), language }
    }
}
