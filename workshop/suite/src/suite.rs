//! The cases of a folder, in a stable order.
//!
//! Invariant: every domain and problem of the folder has a case, and every plan has one or is warned about. Order:
//! domains, problems, what is asked of the planner, plans, each by path.

use crate::expected::{
    CodeAt, Details, DiagnosticsEntry, Expected, PlanEntry, Solvable, Verdict, Warnings, Written,
};
use crate::folder::{last_folder, stem};
use crate::read::{Known, read};
use crate::{File, Folder};
use diagnostics::{Finding, Place, SourceId, Sources};
use pddl::{Severity, Source, Span};
use project::{FileKind, Project};
use std::time::Duration;

/// The most time for one question to the planner, if nothing else is written.
const TIMEOUT: Duration = Duration::from_secs(60);

/// A case's position in its suite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CaseId(u32);

/// Something to check.
#[derive(Clone, Debug)]
pub struct Case {
    /// `domains/tea/plans/valid/two-cups.plan::valid`
    pub name: String,
    pub(crate) file: SourceId,
    pub(crate) what: What,
}

#[derive(Clone, Debug)]
pub(crate) enum What {
    /// No errors; no warnings either, if they are denied.
    Clean(Warnings),
    /// These diagnostics and no others.
    Diagnostics { entry: Span, expected: Vec<Written<CodeAt>> },
    /// The planner's answer.
    Solvable { expected: Written<Solvable>, timeout: Duration },
    /// The validator's verdict.
    Plan(PlanCase),
}

#[derive(Clone, Debug)]
pub(crate) struct PlanCase {
    /// The entry's key; `None` if the folder's name states all.
    pub(crate) entry: Option<Span>,
    pub(crate) problem: SourceId,
    pub(crate) verdict: Verdict,
    pub(crate) details: Details,
}

/// A suite. Its files are parsed when a case first needs them.
#[derive(Clone, Debug)]
pub struct Suite {
    path: String,
    pub(crate) project: Project,
    sources: Sources,
    pub(crate) expected: SourceId,
    findings: Vec<Finding>,
    cases: Vec<Case>,
}

impl Suite {
    /// Reads what is expected of a folder. A suite with errors among its [`findings`](Suite::findings) has no cases.
    pub fn read(mut folder: Folder) -> Self {
        folder.files.sort_by(|a, b| a.path.cmp(&b.path));
        let mut project = Project::new();
        let mut known = Known::default();
        let texts = folder.files.iter().map(|file| file.source.clone());
        let elsewhere = folder.elsewhere.iter().cloned();
        let ids = project.set_all(texts.chain(elsewhere));
        for (&id, File { path, .. }) in ids.iter().zip(&folder.files) {
            match project.kind(id) {
                FileKind::Domain => known.domains.push((id, path.clone())),
                FileKind::Problem => known.problems.push((id, path.clone())),
                FileKind::Plan => known.plans.push((id, path.clone())),
            }
        }
        let mut sources = project.sources().clone();
        let id = sources.push(folder.expected);
        let (expected, findings) = read(id, &sources[id], &known);
        let suite = Self { path: folder.path, project, sources, expected: id, findings, cases: Vec::new() };
        suite.with_cases(&expected, &known)
    }

    fn with_cases(mut self, expected: &Expected, known: &Known) -> Self {
        if known.domains.is_empty() && known.problems.is_empty() {
            let place = Sources::start_of(self.expected);
            let finding = Finding::error("T0107", place, "there is no domain and no problem in this folder");
            self.findings.push(finding.help("put this file beside a domain"));
        }
        for (file, _) in known.domains.iter().chain(&known.problems) {
            let entry = expected.diagnostics.iter().find(|d| d.file == *file);
            let (what, word) = match entry {
                None => (What::Clean(expected.warnings), "check"),
                Some(DiagnosticsEntry { span, expected, .. }) => {
                    (What::Diagnostics { entry: *span, expected: expected.clone() }, "diagnostics")
                }
            };
            self.push(*file, word, what);
        }
        for (file, _) in &known.problems {
            let Some(entry) = expected.problems.iter().find(|p| p.file == *file) else { continue };
            let Some(solvable) = entry.solvable else {
                let place = Place { source: self.expected, span: entry.span };
                let finding = Finding::error("T0103", place, "this entry expects nothing");
                self.findings.push(finding.help("write `solvable = true`, or a bound on the plan's cost"));
                continue;
            };
            let word = if solvable.value == Solvable::No { "unsolvable" } else { "solvable" };
            let timeout = entry.timeout.or(expected.timeout).unwrap_or(TIMEOUT);
            self.push(*file, word, What::Solvable { expected: solvable, timeout });
        }
        for (file, path) in &known.plans {
            let entry = expected.plans.iter().find(|p| p.file == *file);
            if let Some(case) = self.plan_case(*file, path, entry, known) {
                self.push(*file, case.verdict.word(), What::Plan(case));
            }
        }
        self.findings.sort_by_key(|finding| (finding.place.source, finding.place.span));
        if self.has_errors() {
            self.cases.clear();
        }
        self
    }

    fn push(&mut self, file: SourceId, word: &str, what: What) {
        let name = format!("{}::{word}", self.sources[file].name());
        self.cases.push(Case { name, file, what });
    }

    fn plan_case(
        &mut self,
        file: SourceId,
        path: &str,
        entry: Option<&PlanEntry>,
        known: &Known,
    ) -> Option<PlanCase> {
        let by_folder = last_folder(path).and_then(Verdict::of_word);
        let Some(verdict) = entry.and_then(|e| e.verdict).map(|v| v.value).or(by_folder) else {
            let (place, help) = match entry {
                None => (Sources::start_of(file), "move it to `plans/valid` or `plans/invalid`"),
                Some(entry) => {
                    (Place { source: self.expected, span: entry.span }, "write `verdict = \"valid\"`")
                }
            };
            let finding = match entry {
                None => Finding::warning("T0201", place, "nothing is expected of this plan"),
                Some(_) => {
                    Finding::error("T0103", place, "this entry does not say whether the plan is valid")
                }
            };
            self.findings.push(finding.help(help));
            return None;
        };
        let details = entry.map(|e| e.details.clone()).unwrap_or_default();
        self.contradictions(verdict, &details);
        let problem = entry.and_then(|e| e.problem).or_else(|| problem_of(path, &known.problems));
        let Some(problem) = problem else {
            let place = match entry {
                Some(entry) => Place { source: self.expected, span: entry.span },
                None => Sources::start_of(file),
            };
            let message = "no problem of this suite has a name with which this plan's name begins";
            let help = format!("name it like its problem, or write `[plan.{}] problem = \"…\"`", stem(path));
            self.findings.push(Finding::error("T0106", place, message).help(help));
            return None;
        };
        Some(PlanCase { entry: entry.map(|e| e.span), problem, verdict, details })
    }

    /// Reports expectations that contradict the verdict.
    fn contradictions(&mut self, verdict: Verdict, details: &Details) {
        let mut wrong = Vec::new();
        if verdict != Verdict::Valid {
            wrong.extend(details.cost.map(|c| ("cost", c.span)));
        }
        if verdict != Verdict::Invalid {
            wrong.extend(details.why.as_ref().map(|w| ("why", w.span)));
            wrong.extend(details.step.map(|s| ("step", s.span)));
            wrong.extend(details.line.map(|l| ("line", l.span)));
            wrong.extend(details.missing.first().map(|m| ("missing", m.span)));
            wrong.extend(details.says.first().map(|s| ("says", s.span)));
        }
        for (key, span) in wrong {
            let message = format!("a plan that is {} has no `{key}`", verdict.word());
            self.findings.push(Finding::error("T0103", Place { source: self.expected, span }, message));
        }
    }

    /// The path of its folder.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The texts in which findings have their places.
    pub fn sources(&self) -> &Sources {
        &self.sources
    }

    pub(crate) fn source(&self, id: SourceId) -> &Source {
        &self.sources[id]
    }

    /// Errors and warnings about the suite itself.
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// Whether the suite itself has errors.
    pub fn has_errors(&self) -> bool {
        self.findings.iter().any(|finding| finding.severity == Severity::Error)
    }

    /// All cases, in order.
    pub fn cases(&self) -> impl Iterator<Item = (CaseId, &Case)> {
        (0..).map(CaseId).zip(&self.cases)
    }

    pub(crate) fn case(&self, id: CaseId) -> Option<&Case> {
        self.cases.get(id.0 as usize)
    }
}

/// The problem with the longest stem that the plan's begins with, or the only one, or `problem.pddl`.
pub(crate) fn problem_of(plan: &str, problems: &[(SourceId, String)]) -> Option<SourceId> {
    let begins = |problem: &str| {
        let rest = stem(plan).strip_prefix(stem(problem));
        rest.is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
    };
    let named = problems.iter().filter(|(_, path)| begins(path)).max_by_key(|(_, path)| stem(path).len());
    let default = || problems.iter().find(|(_, path)| problems.len() == 1 || stem(path) == "problem");
    named.or_else(default).map(|(id, _)| *id)
}
