//! Formatting: the same tokens, comments and model; once is enough; `test_data/format/NAME.pddl` comes out as
//! `NAME.expected` beside it (`UPDATE_EXPECT=1` writes it anew).

mod support;

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use pddl::{Source, parse_domain, parse_problem};
use proptest::prelude::*;
use support::properties::check_formatted as check;

fn read(path: &Path) -> Source {
    let bytes = std::fs::read(path).expect("the file can be read");
    Source::from_bytes(path.display().to_string(), bytes)
}

/// Comparing models by their text is for files of a size that people write.
fn check_model(source: &Source) {
    let formatted = Source::new(source.name(), pddl::format(source).expect("checked before"));
    let (before, after) = (parse_domain(source, &[]), parse_domain(&formatted, &[]));
    assert_eq!(support::without_spans(&before.model), support::without_spans(&after.model));
    let codes = |d: &[pddl::Diagnostic]| d.iter().map(pddl::Diagnostic::message).collect::<Vec<_>>();
    assert_eq!(codes(&before.diagnostics), codes(&after.diagnostics));
    if let Some(domain) = before.model {
        let (before, after) = (parse_problem(source, &domain), parse_problem(&formatted, &domain));
        assert_eq!(support::without_spans(&before.model), support::without_spans(&after.model));
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

#[test]
fn expected_forms() {
    let folder = root().join("pddl/test_data/format");
    let files = support::files(&folder);
    assert!(files.len() >= 5, "{files:?}");
    for path in files {
        let source = read(&path);
        assert!(check(&source), "{} is balanced", path.display());
        let text = pddl::format(&source).expect("balanced");
        let ending = if path.extension().is_some_and(|e| e == "plan") { "plan.expected" } else { "expected" };
        expect_test::expect_file![path.with_extension(ending)].assert_eq(&text);
    }
}

#[test]
fn every_file_of_ours() {
    let mut formatted = 0;
    for folder in ["pddl/test_data", "robots", "domains"] {
        for path in support::files(&root().join(folder)) {
            let source = read(&path);
            if check(&source) {
                formatted += 1;
                check_model(&source);
            }
        }
    }
    assert!(formatted > 40, "{formatted}");
}

#[test]
fn every_file_of_the_corpus() {
    let folder =
        std::env::var_os("PELEA_BENCH").map_or_else(|| root().join("../shared/bench"), PathBuf::from);
    if !folder.is_dir() {
        println!("skipped: no corpus in {}", folder.display());
        return;
    }
    let files = support::files(&folder);
    let mut formatted = 0;
    for path in &files {
        let source = read(path);
        let balanced = check(&source);
        formatted += usize::from(balanced);
        if balanced && source.text().len() < 20_000 {
            check_model(&source);
        }
    }
    println!("{formatted} of {} files formatted", files.len());
    assert!(formatted > 0, "the corpus holds files");
}

/// All cases, as material to mutate.
static TEXTS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let files = support::files(&root().join("pddl/test_data"));
    files.iter().map(|path| read(path).text().to_owned()).collect()
});

const WORDS: &[&str] = &[
    "(define (domain d)",
    "(and",
    "(forall (?x - t)",
    "(when",
    "(:action a",
    ":effect",
    "(:init",
    "(:goal",
    "(:types",
    "(at start",
    "(",
    "(p ?x)",
    ")",
    ")",
    ")",
    "))",
    "-",
    "object",
    "?x",
    "5",
    "a-name-that-takes-a-good-part-of-a-line",
    "\n",
    "\n",
    "\n\n\n",
    " ; one\n",
    "    ; two\n",
    "\n; three\n",
    "\r\n",
    "\t",
];

proptest! {
    /// Words at random, closed at the end so that most are balanced.
    #[test]
    fn any_balanced_text(words in prop::collection::vec(prop::sample::select(WORDS), 0..80)) {
        let mut text = String::new();
        let mut open = 0usize;
        for word in words {
            let closing = word.matches(')').count();
            let opening = word.matches('(').count();
            if open + opening < closing {
                continue;
            }
            open = open + opening - closing;
            text.push_str(word);
            text.push(' ');
        }
        text.push_str(&")".repeat(open));
        check(&Source::new("text", text));
    }

    /// Line ends and comments put anywhere into good files.
    #[test]
    fn mutated_cases(
        index in any::<prop::sample::Index>(),
        edits in prop::collection::vec((any::<usize>(), prop::sample::select(&WORDS[21..])), 0..8),
    ) {
        let mut chars: Vec<char> = index.get::<String>(&TEXTS).chars().collect();
        for (at, word) in edits {
            let at = at % (chars.len() + 1);
            chars.splice(at..at, word.chars());
        }
        check(&Source::new("text", chars.into_iter().collect::<String>()));
    }
}

#[test]
fn deep_lists_are_formatted_or_refused_but_never_overflow() {
    for form in ["(not ", "(and ", "(and\n", "(forall (?x)\n", "(a (b) ", "(:a :b ", "("] {
        let lists = form.matches('(').count() - form.matches(')').count();
        for depth in [900, 100_000] {
            let text = form.repeat(depth) + "(p)" + &")".repeat(depth * lists);
            assert_eq!(check(&Source::new("deep", text)), depth * lists < 1_000, "{form} {depth}");
        }
    }
}

#[test]
fn a_text_that_is_not_balanced_has_no_layout() {
    for text in ["(", ")", "(define (domain d) (:predicates (p))", "(a))"] {
        assert!(pddl::format(&Source::new("text", text)).is_err(), "{text}");
    }
    assert_eq!(pddl::format(&Source::new("text", " \r\n\n")).as_deref(), Ok(""));
}
