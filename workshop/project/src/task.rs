//! A task: a problem with its domain, and with all domains that this one imports.
//!
//! Problem: planning, validating and testing all start from a task, and a caller that reads the files by itself easily
//! forgets the imports. Idea: a task is read here only. [`Project::task`] is for files that were found together: the
//! project's links say which domain the problem means. [`read_domain`] is for a caller that knows which file is the
//! domain, whatever its name and head say.
//! Invariant: a task has no errors, neither in its files nor in an import.

use crate::links::links;
use crate::{FileKind, Header, Project, Reading};
use diagnostics::{Finding, SourceId, Sources};
use pddl::model::{Domain, Problem};
use pddl::{Analysis, Names, analyze_domain};
use rustc_hash::{FxHashMap, FxHashSet};

/// A domain with a problem, both without errors.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    /// The domain's file.
    pub domain_file: SourceId,
    /// The domain, its imports included.
    pub domain: &'a Domain,
    /// The problem's file.
    pub problem_file: SourceId,
    /// The problem.
    pub problem: &'a Problem,
}

/// Why a file is no problem of a task.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoTask {
    /// No file defines its domain.
    NoDomain,
    /// A file has errors: itself, its domain, or an import. With the first error.
    Errors(SourceId, Option<Box<Finding>>),
    /// It is no problem.
    NoProblem,
}

impl Project {
    /// The problem in a file with its domain.
    ///
    /// # Errors
    /// What the file lacks.
    pub fn task(&self, problem: SourceId) -> Result<Task<'_>, NoTask> {
        let domain_file = self.domain_of(problem).ok_or(NoTask::NoDomain)?;
        for file in self.with_imports(domain_file).into_iter().chain([problem]) {
            if !self.reading(file).is_some_and(Reading::is_sound) {
                let first = self.language_findings(file).iter().find(|finding| finding.is_error());
                return Err(NoTask::Errors(file, first.cloned().map(Box::new)));
            }
        }
        match (self.domain(domain_file), self.problem(problem)) {
            (Some(domain), Some(model)) => {
                Ok(Task { domain_file, domain, problem_file: problem, problem: model })
            }
            _ => Err(NoTask::NoProblem),
        }
    }

    /// A domain and all that it imports, imports before those that import them.
    pub fn with_imports(&self, domain: SourceId) -> Vec<SourceId> {
        in_order(domain, |file| self.needs(file))
    }
}

/// Reads a domain with its imports, which are looked for by name among `imports`: files that may be in any order, and of
/// which some may not be needed. No model if the domain or one of its imports has errors.
pub fn read_domain(
    sources: &Sources,
    domain: SourceId,
    imports: &[SourceId],
) -> (Option<Domain>, Vec<Finding>) {
    let header = |id: SourceId| Header::of(sources[id].name(), sources[id].text());
    // The caller says that this one is a domain.
    let own = Header { kind: FileKind::Domain, ..header(domain) };
    let mut headers = vec![(domain, own)];
    headers.extend(imports.iter().filter(|&&id| id != domain).map(|&id| (id, header(id))));
    let entries: Vec<_> = headers.iter().map(|(id, header)| (*id, sources[*id].name(), header)).collect();
    let links = links(&entries);
    let needs = |id: SourceId| links.get(&id).map_or(&[][..], Vec::as_slice);
    let mut read: FxHashMap<SourceId, Analysis<Domain>> = FxHashMap::default();
    let mut findings = Vec::new();
    let mut sound = true;
    for id in in_order(domain, needs) {
        let known: Vec<&Domain> =
            needs(id).iter().flatten().filter_map(|import| Some(&read.get(import)?.draft)).collect();
        let analysis = analyze_domain(&sources[id], &known, Names::Skipped);
        findings.extend(analysis.diagnostics.iter().map(|diagnostic| diagnostic.finding(id)));
        sound &= analysis.sound;
        read.insert(id, analysis);
    }
    (read.remove(&domain).filter(|_| sound).map(|analysis| analysis.draft), findings)
}

/// A file and all that it needs, each once, after all that it needs itself. Iterative, since chains of imports may be
/// long; links have no cycle.
fn in_order<'a>(file: SourceId, needs: impl Fn(SourceId) -> &'a [Option<SourceId>]) -> Vec<SourceId> {
    let (mut done, mut order) = (FxHashSet::default(), Vec::new());
    let mut way = vec![file];
    while let Some(&next) = way.last() {
        match needs(next).iter().flatten().find(|need| !done.contains(*need)) {
            Some(&need) => way.push(need),
            None => {
                way.pop();
                if done.insert(next) {
                    order.push(next);
                }
            }
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::{NoTask, read_domain};
    use crate::Project;
    use diagnostics::{Source, Sources};

    const PLACES: &str = "(define (domain places) (:requirements :typing) (:types place))";
    const ROADS: &str = "(define (domain roads) (:import places)
        (:predicates (road ?a ?b - place) (at ?a - place)))";
    const TOUR: &str = "(define (domain tour) (:import roads) (:action go :parameters (?a ?b - place)
        :precondition (and (at ?a) (road ?a ?b)) :effect (and (at ?b) (not (at ?a)))))";

    #[test]
    fn imports_of_imports_are_read_in_whatever_order_they_come() {
        for texts in [[TOUR, ROADS, PLACES], [TOUR, PLACES, ROADS]] {
            let mut sources = Sources::new();
            let ids: Vec<_> = (0..)
                .zip(texts)
                .map(|(n, text)| sources.push(Source::new(format!("{n}.pddl"), text)))
                .collect();
            let (domain, findings) = read_domain(&sources, ids[0], &ids[1..]);
            assert_eq!(findings, []);
            assert_eq!(domain.expect("no file has errors").predicates.len(), 2);
        }
    }

    #[test]
    fn an_error_in_an_import_leaves_no_model() {
        let mut sources = Sources::new();
        let tour = sources.push(Source::new("tour.pddl", TOUR));
        let roads = sources.push(Source::new("roads.pddl", ROADS));
        let (domain, findings) = read_domain(&sources, tour, &[roads]);
        assert!(domain.is_none());
        assert!(findings.iter().any(|finding| finding.is_error() && finding.place.source == roads));
    }

    #[test]
    fn imports_that_go_round_are_reported() {
        let mut sources = Sources::new();
        let a = sources.push(Source::new("a.pddl", "(define (domain a) (:import b))"));
        let b = sources.push(Source::new("b.pddl", "(define (domain b) (:import a))"));
        let (domain, findings) = read_domain(&sources, a, &[b]);
        assert!(domain.is_none() && findings.iter().any(diagnostics::Finding::is_error));
    }

    #[test]
    fn a_problem_of_a_project_has_a_task_if_nothing_that_it_needs_has_errors() {
        let mut project = Project::new();
        let places = project.set("places.pddl", PLACES);
        project.set("roads.pddl", ROADS);
        let tour = project.set("tour.pddl", TOUR);
        let text = "(define (problem p) (:domain tour) (:objects a b - place)
            (:init (at a) (road a b)) (:goal (at b)))";
        let problem = project.set("p.pddl", text);
        let task = project.task(problem).expect("no file has errors");
        assert_eq!((task.domain_file, task.problem.objects.len()), (tour, 2));
        project.set("places.pddl", "(define (domain places) (:types))) (");
        assert!(matches!(project.task(problem), Err(NoTask::Errors(file, _)) if file == places));
        project.remove("tour.pddl");
        assert_eq!(project.task(problem).err(), Some(NoTask::NoDomain));
    }
}
