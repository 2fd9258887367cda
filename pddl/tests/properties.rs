//! Whatever the bytes: no panic, a lossless tree, and every model prints to itself.

mod support;

use std::path::Path;
use std::sync::LazyLock;

use pddl::model::Domain;
use pddl::{Source, Span, parse_domain, parse_plan, parse_problem, syntax};
use proptest::prelude::*;
use support::properties::{check_domain, check_drafts, check_plan, check_problem, check_text};

/// The good and bad cases, as material to mutate.
static TEXTS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("test_data");
    let read = |p: std::path::PathBuf| Source::from_bytes("", std::fs::read(p).expect("readable"));
    support::files(&folder).into_iter().map(|p| read(p).text().to_owned()).collect()
});

static VOCABULARY: LazyLock<Domain> = LazyLock::new(|| {
    let text = include_str!("../test_data/ok/vocabulary.pddl");
    parse_domain(&Source::new("vocabulary.pddl", text), &[]).model.expect("a good case")
});

/// Reads the text as everything it could be.
fn read(text: &str) {
    let source = Source::new("text", text);
    check_text(&source);
    check_drafts(&source);
    let Some(domain) = check_domain(&source, &[&*VOCABULARY]) else { return };
    let Some(problem) = check_problem(&source, &domain) else { return };
    check_plan(&source, &domain, &problem);
}

#[derive(Clone, Debug)]
enum Edit {
    /// Takes a piece out.
    Cut(usize, usize),
    /// Puts a word in.
    Put(usize, &'static str),
    /// Moves a piece.
    Copy(usize, usize, usize),
}

const WORDS: &[&str] = &[
    "(",
    ")",
    "()",
    "(and",
    "?x",
    ":init",
    "(:action",
    "5",
    "-",
    "- object",
    "(either",
    ";",
    "\u{feff}",
    "é",
    "(at start",
    "(forall (?x)",
    "=",
    "(= ?x ?y)",
    "undefined",
    ":parameters",
    "#t",
    "not",
    "(not",
];

fn edits() -> impl Strategy<Value = Vec<Edit>> {
    let edit = prop_oneof![
        (any::<usize>(), 0..40usize).prop_map(|(at, n)| Edit::Cut(at, n)),
        (any::<usize>(), prop::sample::select(WORDS)).prop_map(|(at, w)| Edit::Put(at, w)),
        (any::<usize>(), 0..60usize, any::<usize>()).prop_map(|(at, n, to)| Edit::Copy(at, n, to)),
    ];
    prop::collection::vec(edit, 0..6)
}

fn apply(text: &str, edits: &[Edit]) -> String {
    let mut chars: Vec<char> = text.chars().collect();
    for edit in edits {
        let place = |at: usize| at % (chars.len() + 1);
        match *edit {
            Edit::Cut(at, n) => {
                let at = place(at);
                let end = (at + n).min(chars.len());
                chars.drain(at..end);
            }
            Edit::Put(at, word) => {
                let at = place(at);
                chars.splice(at..at, format!(" {word} ").chars());
            }
            Edit::Copy(at, n, to) => {
                let (at, to) = (place(at), place(to));
                let piece: Vec<char> = chars[at..(at + n).min(chars.len())].to_vec();
                chars.splice(to..to, piece);
            }
        }
    }
    chars.into_iter().collect()
}

proptest! {
    #[test]
    fn arbitrary_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        read(Source::from_bytes("", bytes).text());
    }

    #[test]
    fn arbitrary_words(words in prop::collection::vec(prop::sample::select(WORDS), 0..60)) {
        read(&words.join(" "));
        read(&format!("(define (domain d) {})", words.join(" ")));
    }

    #[test]
    fn mutated_cases(index in any::<prop::sample::Index>(), edits in edits()) {
        read(&apply(index.get::<String>(&TEXTS), &edits));
    }
}

/// As deep as lists may nest, in each recursive form; a test's stack is what a thread's usually is.
#[test]
fn deep_nesting_is_an_error_and_no_overflow() {
    for form in ["(not ", "(and (p) ", "(forall (?x) ", "(imply (p) ", "(when (p) ", "(> 1 (+ 1 ", "("] {
        for depth in [500, 990, 1_000, 5_000] {
            let body = form.repeat(depth) + "(p)" + &")".repeat(depth * form.matches("(").count());
            let effect = format!("(:action a :parameters () :precondition {body} :effect {body})");
            let timed = format!("(:durative-action d :condition (at start {body}) :effect (at end {body}))");
            let text = format!("(define (domain d) (:predicates (p)) {effect} {timed})");
            let source = Source::new("deep.pddl", text);
            let parsed = parse_domain(&source, &[]);
            if depth >= 1_000 {
                assert!(parsed.diagnostics.iter().any(|d| d.code() == "E0103"), "{form} {depth}");
            }
            if let Some(domain) = parsed.model {
                support::check_domain_printed(&domain, &[]);
            }
        }
    }
}

#[test]
fn a_hundred_thousand_open_lists_are_one_error_for_their_depth_and_a_few_for_their_ends() {
    let source = Source::new("deep.pddl", "(".repeat(100_000));
    let codes: Vec<_> = parse_domain(&source, &[]).diagnostics.iter().map(pddl::Diagnostic::code).collect();
    assert_eq!(codes.iter().filter(|c| **c == "E0103").count(), 1);
    assert!(codes.len() < 30, "{codes:?}");
}

#[test]
fn a_hundred_thousand_lists_in_any_kind_of_file_are_an_error_and_no_overflow() {
    let deep = |form: &str| form.repeat(100_000) + "(p)" + &")".repeat(100_000);
    let domain = "(define (domain d) (:predicates (p)) (:action p :effect (p)))";
    let domain = parse_domain(&Source::new("d.pddl", domain), &[]).model.expect("a domain");
    let problem = "(define (problem p) (:domain d) (:init) (:goal (p)))";
    let problem = parse_problem(&Source::new("p.pddl", problem), &domain).model.expect("a problem");
    for form in ["(", "(and ", "(not\n", "(forall (?x) "] {
        let texts = [
            format!(
                "(define (domain d) (:predicates (p)) (:action a :precondition {} :effect (p)))",
                deep(form)
            ),
            format!("(define (problem p) (:domain d) (:init (p) {0}) (:goal {0}))", deep(form)),
            format!("(p) {} (p)", deep(form)),
            format!("0.0: {} [1]", deep(form)),
            format!("==>\n0 {0}\nroot {0}\n<==", deep(form)),
            form.repeat(100_000),
        ];
        for text in texts {
            let source = Source::new("deep", text);
            let said = [
                parse_domain(&source, &[]).diagnostics,
                parse_problem(&source, &domain).diagnostics,
                parse_plan(&source, &domain, &problem).diagnostics,
                pddl::format(&source).expect_err("it is too deep"),
            ];
            for diagnostics in said {
                assert!(diagnostics.iter().any(|d| d.code() == "E0103"), "{form} {diagnostics:?}");
                assert!(diagnostics.len() < 60, "{form} {}", diagnostics.len());
            }
        }
    }
}

/// A file without one of its parentheses reports the mistake in the section of that parenthesis. Without one
/// at the very end the report may be at the definition, and then names the last section as well. The
/// parenthesis that opens the definition is kept: without it no definition would contain a report.
#[test]
fn a_lost_parenthesis_is_reported_where_it_was() {
    let good = Path::new(env!("CARGO_MANIFEST_DIR")).join("test_data/ok");
    for path in support::files(&good) {
        let source = Source::from_bytes("text", std::fs::read(&path).expect("the case can be read"));
        let text = pddl::format(&source).expect("the case is good");
        let source = Source::new("text", text);
        let (tree, _) = syntax::parse(&source);
        for (at, _) in source.text().match_indices(['(', ')']) {
            let at = u32::try_from(at).expect("cases are short");
            let is_token = |(_, span): (_, Span)| span == Span::new(at, at + 1);
            let Some(define) = tree.roots().find(|n| n.span().start < at && at < n.span().end) else {
                continue;
            };
            if !define.is_headed("define") || !tree.tokens().any(is_token) {
                continue;
            }
            let section = define.children().find(|n| n.span().start < at && at + 1 < n.span().end);
            let place = section.filter(|n| n.is_list()).unwrap_or(define).span();
            let is_last = define.children().last().is_some_and(|last| last.span() == place);
            check_lost(&source, at, if is_last { Span::new(place.start, define.span().end) } else { place });
        }
    }
}

fn check_lost(source: &Source, at: u32, place: Span) {
    let mut text = source.text().to_owned();
    text.remove(at as usize);
    let broken = Source::new("broken", text);
    let (_, diagnostics) = syntax::parse(&broken);
    assert!(!diagnostics.is_empty(), "{}", broken.text());
    let lines = broken.line_column(place.start).line..=broken.line_column(place.end - 2).line;
    let spans = diagnostics
        .iter()
        .flat_map(|d| std::iter::once(d.span).chain(d.labels.iter().map(|(span, _)| *span)));
    let mut places = spans.map(|span| broken.line_column(span.start).line);
    let said: String = diagnostics.iter().map(|d| d.describe(&broken)).collect();
    assert!(places.any(|line| lines.contains(&line)), "{lines:?}\n{said}{}", broken.text());
}
