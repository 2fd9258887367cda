//! What several test files share: texts with what they mean, and what is found in them.
#![allow(dead_code, reason = "each test file uses a part of it")]

use lints::{Edit, File, Finding, Level, Linter};
use pddl::model::{Domain, Problem};
use pddl::{FileKind, Source, parse_domain, parse_problem};

/// A domain, perhaps with a problem; both may stand in one file.
pub(crate) struct Case {
    sources: Vec<Source>,
    domain: (usize, Domain),
    problem: Option<(usize, Problem)>,
}

impl Case {
    /// The domain (the last one, if it imports those before it) and the problem in the sources.
    pub(crate) fn new(sources: &[Source]) -> Self {
        let (mut domains, mut problem): (Vec<(usize, Domain)>, _) = (Vec::new(), None);
        for (i, source) in sources.iter().enumerate() {
            if source.text().contains("(domain ") {
                let imports: Vec<&Domain> = domains.iter().map(|(_, d)| d).collect();
                let parsed = parse_domain(source, &imports);
                let said: String = parsed.errors().map(|d| d.describe(source)).collect();
                domains.push((i, parsed.model.unwrap_or_else(|| panic!("{said}"))));
            }
            if source.text().contains("(problem ") {
                let parsed = parse_problem(source, &domains.last().expect("the domain comes first").1);
                let said: String = parsed.errors().map(|d| d.describe(source)).collect();
                problem = Some((i, parsed.model.unwrap_or_else(|| panic!("{said}"))));
            }
        }
        let domain = domains.pop().expect("there is a domain");
        Self { sources: sources.to_vec(), domain, problem }
    }

    pub(crate) fn of_texts(texts: &[&str]) -> Self {
        Self::new(&texts.iter().map(|text| Source::new("example", *text)).collect::<Vec<_>>())
    }

    fn source(&self, file: FileKind) -> usize {
        match file {
            FileKind::Domain => self.domain.0,
            FileKind::Problem => self.problem.as_ref().expect("a problem was looked at").0,
        }
    }

    pub(crate) fn describe(&self, findings: &[Finding]) -> String {
        let problem = self.problem.as_ref().map(|(i, _)| &self.sources[*i]);
        findings.iter().map(|f| f.describe(&self.sources[self.domain.0], problem)).collect()
    }

    /// The same with other texts.
    pub(crate) fn edited(&self, edits: &[Edit]) -> Self {
        let mut edits = edits.to_vec();
        edits.sort_by_key(|e| std::cmp::Reverse(e.place.span));
        let mut texts: Vec<String> = self.sources.iter().map(|s| s.text().to_owned()).collect();
        for edit in edits {
            texts[self.source(edit.place.file)].replace_range(edit.place.span.range(), &edit.text);
        }
        Self::of_texts(&texts.iter().map(String::as_str).collect::<Vec<_>>())
    }
}

/// What is found in the problem, then in the domain.
pub(crate) fn findings_of(case: &Case, level: Level) -> Vec<Finding> {
    let source = &case.sources[case.domain.0];
    let mut linter = Linter::new(File { source, model: &case.domain.1 }, level);
    let mut found = Vec::new();
    if let Some((i, problem)) = &case.problem {
        found = linter.problem(File { source: &case.sources[*i], model: problem });
    }
    found.extend(linter.finish());
    found
}
