//! The files of a project, read when asked for and again after a change.
//!
//! Invariant: a reading is kept only as long as neither its text, nor what provides its needs, nor the reading
//! of that has changed. Cost of a change: linear in the number of files if a head changed (links are made
//! anew), else in the number of those that depend on the file; reading is put off until somebody asks. A clone
//! is cheap and shares what was read, so that a server can answer from a snapshot.

use std::sync::{Arc, OnceLock};

use pddl::model::{Domain, IndexVec};
use pddl::{Source, Span, analyze_domain, analyze_plan, analyze_problem};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::links::links;
use crate::{FileKind, Finding, Header, Place, Reading, SourceId, Sources};

/// What is known of a file.
#[derive(Debug)]
struct File {
    header: Header,
    /// What provides each need; see [`links`].
    links: Vec<Option<SourceId>>,
    read: OnceLock<Read>,
}

#[derive(Debug)]
struct Read {
    reading: Reading,
    findings: Vec<Finding>,
}

/// A set of files.
#[derive(Clone, Debug, Default)]
pub struct Project {
    sources: Sources,
    files: IndexVec<SourceId, Option<Arc<File>>>,
    by_path: FxHashMap<String, SourceId>,
}

impl Project {
    /// No files.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds the file at `path` or gives it another text. Paths have `/` between folders; a path keeps its id,
    /// also over [`Project::remove`].
    ///
    /// # Panics
    /// Like [`Source::new`].
    pub fn set(&mut self, path: &str, text: impl Into<String>) -> SourceId {
        self.set_all([(path, text)])[0]
    }

    /// Many files at once: links between them are looked for only once.
    ///
    /// # Panics
    /// Like [`Source::new`].
    pub fn set_all<'a, T: Into<String>>(
        &mut self,
        files: impl IntoIterator<Item = (&'a str, T)>,
    ) -> Vec<SourceId> {
        let mut changed = Vec::new();
        let mut relink = false;
        for (path, text) in files {
            let source = Source::new(path, text);
            let header = Header::of(path, source.text());
            let id = match self.by_path.get(path) {
                Some(&id) => {
                    self.sources.replace(id, source);
                    id
                }
                None => {
                    let id = self.sources.push(source);
                    self.files.push(None);
                    self.by_path.insert(path.to_owned(), id);
                    id
                }
            };
            let links = match &self.files[id] {
                Some(old) if old.header.same_names(&header) => old.links.clone(),
                _ => {
                    relink = true;
                    Vec::new()
                }
            };
            self.files[id] = Some(Arc::new(File { header, links, read: OnceLock::new() }));
            changed.push(id);
        }
        self.settle(changed.iter().copied().collect(), relink);
        changed
    }

    /// Takes the file at `path` out. Its id stays its own.
    pub fn remove(&mut self, path: &str) -> Option<SourceId> {
        let id = *self.by_path.get(path)?;
        self.files[id].take()?;
        self.sources.replace(id, Source::new(path, ""));
        self.settle(FxHashSet::from_iter([id]), true);
        Some(id)
    }

    /// Makes links anew if `relink`, then forgets what was read of the changed files and of all that depend on
    /// them.
    fn settle(&mut self, mut changed: FxHashSet<SourceId>, relink: bool) {
        if relink {
            let entries: Vec<_> = self
                .ids()
                .filter_map(|id| Some((id, self.path(id), &self.files[id].as_ref()?.header)))
                .collect();
            for (id, links) in links(&entries) {
                if let Some(file) = &self.files[id]
                    && file.links != links
                {
                    let file = File { header: file.header.clone(), links, read: OnceLock::new() };
                    self.files[id] = Some(Arc::new(file));
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
                    let (header, links) = (file.header.clone(), file.links.clone());
                    self.files[id] = Some(Arc::new(File { header, links, read: OnceLock::new() }));
                }
                changed.insert(id);
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
        self.read(id).map(|read| &read.reading)
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

    /// Everything to say about a file, in order of place.
    pub fn findings(&self, id: SourceId) -> &[Finding] {
        self.read(id).map_or(&[], |read| &read.findings)
    }

    fn file(&self, id: SourceId) -> Option<&File> {
        self.files.get(id)?.as_deref()
    }

    fn read(&self, id: SourceId) -> Option<&Read> {
        let file = self.file(id)?;
        Some(file.read.get_or_init(|| self.read_anew(id, file)))
    }

    fn read_anew(&self, id: SourceId, file: &File) -> Read {
        let source = self.source(id);
        let reading = match file.header.kind {
            FileKind::Domain => {
                let imports: Vec<&Domain> =
                    file.links.iter().flatten().filter_map(|&import| self.domain(import)).collect();
                Reading::Domain(analyze_domain(source, &imports))
            }
            FileKind::Problem => {
                let nothing;
                let domain = match self.domain_of(id).and_then(|domain| self.domain(domain)) {
                    Some(domain) => domain,
                    None => {
                        nothing = analyze_domain(&Source::new("", ""), &[]).draft;
                        &nothing
                    }
                };
                Reading::Problem(analyze_problem(source, domain))
            }
            FileKind::Plan => {
                let domain = self.domain_of(id).and_then(|domain| self.domain(domain));
                let problem = self.problem_of(id).and_then(|problem| self.problem(problem));
                Reading::Plan(match (domain, problem) {
                    (Some(domain), Some(problem)) => analyze_plan(source, domain, problem),
                    _ => pddl::Analysis {
                        draft: pddl::Plan::default(),
                        sound: false,
                        diagnostics: Vec::new(),
                        occurrences: Vec::new(),
                    },
                })
            }
        };
        let findings = self.judge(id, file, &reading);
        Read { reading, findings }
    }

    fn judge(&self, id: SourceId, file: &File, reading: &Reading) -> Vec<Finding> {
        let diagnostics = reading.diagnostics().iter();
        let mut findings: Vec<Finding> = Vec::new();
        match (file.header.kind, file.links.first()) {
            (FileKind::Problem, Some(None)) => {
                // Without its domain every name in it would be unknown: what is said is what is missing, and
                // what the text alone shows.
                if let Some(need) = file.header.needs.first() {
                    let place = Place { source: id, span: need.span };
                    let message = format!("no file defines the domain `{}`", need.name);
                    findings.push(Finding::error("E0212", place, message));
                }
                findings.extend(diagnostics.filter(|d| d.code() < "E0200").map(|d| Finding::of_pddl(id, d)));
            }
            (FileKind::Plan, Some(None)) => {
                let place = Place { source: id, span: Span::default() };
                let message = "no problem in this folder belongs to this plan";
                findings.push(
                    Finding::warning("W0225", place, message)
                        .help("a plan has the name of its problem: `p01.plan` for `p01.pddl`"),
                );
            }
            _ => findings.extend(diagnostics.map(|d| Finding::of_pddl(id, d))),
        }
        findings.sort_by_key(|finding| finding.place.span);
        findings
    }
}
