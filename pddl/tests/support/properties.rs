//! Properties of every text, with errors or without. Tests and fuzz targets call the same checks.
//!
//! No reading panics. The tree keeps every byte, and its nodes are nested. A diagnostic lies inside the text
//! and splits no character. Formatting keeps the words and is idempotent. A model prints to itself.

use pddl::model::{Domain, Problem};
use pddl::syntax::{self, Node, TokenKind};
use pddl::{
    Analysis, Diagnostic, Names, Parsed, Source, Span, analyze_domain, analyze_plan, analyze_problem,
    parse_domain, parse_plan, parse_problem, print_domain, print_plan, print_problem,
};

/// Properties of any text.
pub(crate) fn check_text(source: &Source) {
    let (tree, diagnostics) = syntax::parse(source);
    assert_eq!(tree.text(), source.text());
    check_places(source, &diagnostics);
    let whole = Span::new(0, u32::try_from(source.text().len()).expect("texts of tests are short"));
    check_nodes(tree.roots(), whole);
    check_formatted(source);
}

/// The nodes follow each other inside the span of what holds them.
fn check_nodes<'t>(nodes: impl Iterator<Item = Node<'t>>, within: Span) {
    let mut free = within.start;
    for node in nodes {
        let span = node.span();
        assert!(free <= span.start && span.start < span.end && span.end <= within.end, "{node:?}");
        free = span.end;
        check_nodes(node.children(), span);
    }
}

/// Reads the text as a domain.
pub(crate) fn check_domain(source: &Source, imports: &[&Domain]) -> Option<Domain> {
    let parsed = parse_domain(source, imports);
    let analysis = analyze_domain(source, imports, Names::Kept);
    check_analysis(source, &parsed, &analysis);
    print_domain(&analysis.draft);
    let domain = parsed.model?;
    super::check_domain_printed(&domain, imports);
    Some(domain)
}

/// Reads the text as a problem of `domain`.
pub(crate) fn check_problem(source: &Source, domain: &Domain) -> Option<Problem> {
    let parsed = parse_problem(source, domain);
    let analysis = analyze_problem(source, domain, Names::Kept);
    check_analysis(source, &parsed, &analysis);
    print_problem(&analysis.draft, domain);
    let problem = parsed.model?;
    super::check_problem_printed(&problem, domain);
    Some(problem)
}

/// Reads the text as a plan for `problem`.
pub(crate) fn check_plan(source: &Source, domain: &Domain, problem: &Problem) {
    let parsed = parse_plan(source, domain, problem);
    let analysis = analyze_plan(source, domain, problem, Names::Kept);
    check_analysis(source, &parsed, &analysis);
    print_plan(&analysis.draft, domain, problem);
    if let Some(plan) = &parsed.model {
        super::check_plan_printed(plan, domain, problem);
    }
}

/// Reads the text as a domain and as a problem of it, both of them drafts.
pub(crate) fn check_drafts(source: &Source) {
    let domain = analyze_domain(source, &[], Names::Skipped).draft;
    let problem = analyze_problem(source, &domain, Names::Skipped).draft;
    print_problem(&problem, &domain);
    print_plan(&analyze_plan(source, &domain, &problem, Names::Skipped).draft, &domain, &problem);
}

/// There is a model or an error; an editor gets the same diagnostics, and each name stands at its place.
/// Printing a draft follows each of its ids, so it shows that they are in range.
fn check_analysis<M>(source: &Source, parsed: &Parsed<M>, analysis: &Analysis<M>) {
    check_places(source, &parsed.diagnostics);
    assert_eq!(parsed.model.is_none(), parsed.errors().next().is_some());
    assert_eq!(parsed.model.is_some(), analysis.sound);
    assert_eq!(parsed.diagnostics, analysis.diagnostics);
    for occurrence in &analysis.occurrences {
        assert!(!source.slice(occurrence.span).is_empty(), "{occurrence:?}");
        if let Some(scope) = occurrence.symbol.scope {
            assert!(
                scope.start <= occurrence.span.start && occurrence.span.end <= scope.end,
                "{occurrence:?}"
            );
        }
    }
    assert!(analysis.occurrences.is_sorted_by_key(|occurrence| occurrence.span.start));
}

/// Diagnostics come in order, stand in the text between characters, and can be shown.
fn check_places(source: &Source, diagnostics: &[Diagnostic]) {
    for diagnostic in diagnostics {
        for span in std::iter::once(diagnostic.span).chain(diagnostic.labels.iter().map(|(span, _)| *span)) {
            assert!(source.text().get(span.range()).is_some(), "{span:?} of {diagnostic:?}");
        }
        assert!(!diagnostic.describe(source).is_empty());
    }
}

/// Everything but white space; of comments all but the blanks at their end.
fn words(source: &Source) -> Vec<(TokenKind, &str)> {
    let (tree, _) = syntax::parse(source);
    let tokens = tree.tokens().filter(|(kind, _)| *kind != TokenKind::Whitespace);
    tokens.map(|(kind, span)| (kind, source.slice(span).trim_end())).collect()
}

/// Whether the text could be formatted; panics if an invariant does not hold.
pub(crate) fn check_formatted(source: &Source) -> bool {
    let text = match pddl::format(source) {
        Ok(text) => text,
        Err(diagnostics) => {
            assert!(!diagnostics.is_empty());
            return false;
        }
    };
    let formatted = Source::new(source.name(), text);
    assert!(words(source) == words(&formatted), "{}: other tokens\n{}", source.name(), formatted.text());
    let again = pddl::format(&formatted).expect("it is as balanced as before");
    if formatted.text() != again {
        let (line, (a, b)) = (1..)
            .zip(formatted.text().lines().zip(again.lines()))
            .find(|(_, (a, b))| a != b)
            .expect("they differ in a line");
        panic!("{}: formatting twice differs in line {line}:\n{a}\n{b}", source.name());
    }
    assert!(again.is_empty() || again.ends_with('\n') && !again.ends_with("\n\n"));
    assert!(again.lines().all(|l| !l.ends_with([' ', '\t', '\r'])), "blanks at a line's end\n{again}");
    assert!(!again.contains("\n\n\n"));
    true
}
