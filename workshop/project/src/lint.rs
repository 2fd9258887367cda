//! Runs the lints over a domain and its problems.
//!
//! Problem: many mistakes in a domain show only with its problems, and a single problem proves little. Idea:
//! lint a domain together with all problems of the project that are for it; see [`lints::Linter`].
//! Invariant: files with errors are not linted. Nothing is cached here; [`Project::lint_findings`] caches
//! what it returns.

use lints::{File, Level, Linted, Linter};

use crate::{Project, Reading};
use diagnostics::SourceId;

impl Project {
    /// The findings of lints up to `level` in a domain and in all its problems, in order of files and
    /// places. Empty if the file is not a domain or has errors.
    pub fn lint_family(&self, domain: SourceId, level: Level) -> Vec<Linted> {
        let Some(mut linter) = self.linter(domain, level) else { return Vec::new() };
        let mut said: Vec<Linted> = Vec::new();
        for problem in self.dependents(domain) {
            if let Some(file) = self.sound_problem(problem) {
                said.extend(linter.problem(file));
            }
        }
        said.extend(linter.finish());
        said.sort_by_key(|l| (l.finding.place.source, l.finding.place.span));
        said
    }

    /// The findings of lints up to `level` in a domain without its problems.
    pub fn lint_domain(&self, domain: SourceId, level: Level) -> Vec<Linted> {
        self.linter(domain, level).map_or_else(Vec::new, Linter::finish)
    }

    /// The findings of lints up to `level` in a problem alone.
    pub fn lint_problem(&self, problem: SourceId, level: Level) -> Vec<Linted> {
        let linter = self.domain_of(problem).and_then(|domain| self.linter(domain, level));
        match (linter, self.sound_problem(problem)) {
            (Some(mut linter), Some(file)) => linter.problem(file),
            _ => Vec::new(),
        }
    }

    fn linter(&self, domain: SourceId, level: Level) -> Option<Linter<'_>> {
        match self.reading(domain)? {
            Reading::Domain(analysis) if analysis.sound => Some(Linter::new(
                File { id: domain, source: self.source(domain), model: &analysis.draft },
                level,
            )),
            _ => None,
        }
    }

    fn sound_problem(&self, problem: SourceId) -> Option<File<'_, pddl::model::Problem>> {
        match self.reading(problem)? {
            Reading::Problem(analysis) if analysis.sound => {
                Some(File { id: problem, source: self.source(problem), model: &analysis.draft })
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Level;
    use crate::Project;

    const DOMAIN: &str = "(define (domain hall) (:predicates (lit) (ready))
      (:action switch :parameters () :precondition (ready) :effect (lit)))";

    #[test]
    fn a_domain_is_judged_by_all_its_problems() {
        let problem = |init: &str| {
            format!("(define (problem p) (:domain hall) (:init {init}) (:goal (and (lit) (not (ready)))))")
        };
        let mut project = Project::new();
        let domain = project.set("hall/domain.pddl", DOMAIN);
        let first = project.set("hall/p01.pddl", problem(""));
        // Of all that is said, what is about the condition that nothing fulfils, and the goal's `not`.
        let codes = |project: &Project| {
            let said = project.lint_family(domain, Level::Default);
            let all = said.iter().filter_map(|l| Some((l.finding.code?, l.finding.place.source)));
            all.filter(|(code, _)| ["W0701", "W0705"].contains(code)).collect::<Vec<_>>()
        };
        assert_eq!(codes(&project), [("W0705", domain), ("W0701", first)]);
        let second = project.set("hall/p02.pddl", problem("(ready)"));
        assert_eq!(codes(&project), [("W0701", first), ("W0701", second)]);
        let alone = project.lint_problem(second, Level::Default);
        let fix = alone.iter().find_map(|l| l.fix.as_ref()).expect("a requirement can be declared");
        assert_eq!(
            (fix.edits[0].0.source, fix.title.as_str()),
            (second, "declare `:negative-preconditions`")
        );
        project.set("hall/p02.pddl", "(define (problem p) (:domain hall) (:goal (dark)))");
        assert_eq!(codes(&project), [("W0705", domain), ("W0701", first)]);
    }
}
