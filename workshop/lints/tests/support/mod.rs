//! Shared by several test files: texts with their models, and the findings in them.
#![allow(dead_code, reason = "each test file uses a part of it")]

use diagnostics::{Place, SourceId};
use lints::{File, Level, Linted, Linter};
use pddl::model::{Domain, Problem};
use pddl::{Source, parse_domain, parse_problem};
use std::fmt::Write as _;

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

    pub(crate) fn describe(&self, findings: &[Linted]) -> String {
        findings.iter().map(|linted| describe(linted, &|id| &self.sources[id.0 as usize])).collect()
    }

    /// The same with other texts.
    pub(crate) fn edited(&self, edits: &[(Place, String)]) -> Self {
        let mut edits = edits.to_vec();
        edits.sort_by_key(|(place, _)| std::cmp::Reverse(place.span));
        let mut texts: Vec<String> = self.sources.iter().map(|s| s.text().to_owned()).collect();
        for (place, text) in edits {
            texts[place.source.0 as usize].replace_range(place.span.range(), &text);
        }
        Self::of_texts(&texts.iter().map(String::as_str).collect::<Vec<_>>())
    }
}

/// The findings in the problem, then those in the domain.
pub(crate) fn findings_of(case: &Case, level: Level) -> Vec<Linted> {
    let id = |at: usize| SourceId(u32::try_from(at).expect("there are few files"));
    let file = |at: usize| (id(at), &case.sources[at]);
    let (domain, source) = file(case.domain.0);
    let mut linter = Linter::new(File { id: domain, source, model: &case.domain.1 }, level);
    let mut found = Vec::new();
    if let Some((at, model)) = &case.problem {
        let (id, source) = file(*at);
        found = linter.problem(File { id, source, model });
    }
    found.extend(linter.finish());
    found
}

/// A finding with excerpts of its places.
pub(crate) fn describe<'s>(linted: &Linted, source: &dyn Fn(SourceId) -> &'s Source) -> String {
    let Linted { finding, lint, fix } = linted;
    let at = source(finding.place.source);
    let position = at.line_column(finding.place.span.start);
    let (line, column) = (position.line, position.column);
    let mut text = format!(
        "{}:{line}:{column}: warning[{}]: {} ({lint})\n",
        at.name(),
        finding.code.unwrap_or_default(),
        finding.message
    );
    text += &at.excerpt(finding.place.span, "");
    for (place, note) in &finding.related {
        text += &source(place.source).excerpt(place.span, note);
    }
    let title = fix.as_ref().map(|fix| &fix.title);
    if let Some(help) = finding.help.as_ref().filter(|&help| Some(help) != title) {
        let _ = writeln!(text, "  = {help}");
    }
    if let Some(title) = title {
        let _ = writeln!(text, "  = fix: {title}");
    }
    text
}
