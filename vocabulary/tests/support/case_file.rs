//! Case files: several PDDL sources in one file, and the expected result in a second one.
//!
//! A line `;;; NAME` starts a source. Each source keeps its line numbers in the file, so an expected `7:3` is a place
//! that an editor finds. `UPDATE_EXPECT=1 cargo test` writes the expectations.

use std::fs;
use std::path::Path;

use pddl::{Diagnostic, Severity, Source, Span};

/// The sources of a case, by the name after `;;;`, in order.
pub(crate) fn sources(text: &str) -> Vec<(String, Source)> {
    let mut found: Vec<(String, String)> = Vec::new();
    for (at, line) in text.lines().enumerate() {
        match line.strip_prefix(";;;") {
            Some(name) => found.push((name.trim().to_owned(), "\n".repeat(at + 1))),
            None => {
                if let Some((_, text)) = found.last_mut() {
                    text.push_str(line);
                    text.push('\n');
                }
            }
        }
    }
    found.into_iter().map(|(name, text)| (name.clone(), Source::new(name, text))).collect()
}

/// A message with its place: `7:3 message`.
pub(crate) fn place(source: &Source, span: Span, what: &dyn std::fmt::Display) -> String {
    let at = source.line_column(span.start);
    format!("{}:{} {what}\n", at.line, at.column)
}

/// The errors of a source.
pub(crate) fn diagnostics(source: &Source, diagnostics: &[Diagnostic]) -> String {
    diagnostics
        .iter()
        .filter(|diagnostic| diagnostic.severity == Severity::Error)
        .map(|diagnostic| place(source, diagnostic.span, &diagnostic.message()))
        .collect()
}

/// Runs every `.pddl` file of a folder and compares with the `.txt` file beside it.
pub(crate) fn run(folder: &str, case: impl Fn(&str) -> String) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut cases: Vec<_> = fs::read_dir(&folder)
        .expect("the folder is in the repository")
        .map(|entry| entry.expect("readable").path())
        .filter(|path| path.extension().is_some_and(|end| end == "pddl"))
        .collect();
    cases.sort();
    assert!(!cases.is_empty(), "no cases in {}", folder.display());
    for path in cases {
        let text = fs::read_to_string(&path).expect("readable");
        expect_test::expect_file![path.with_extension("txt")].assert_eq(&case(&text));
    }
}
