//! Every code has an explanation, and its examples are examples of it.

use std::collections::BTreeSet;

use pddl::model::{Domain, Problem};
use pddl::{Source, explain, explanations, parse_domain, parse_plan, parse_problem};

/// Every code in the file that gives kinds their codes.
fn codes() -> BTreeSet<&'static str> {
    let text = include_str!("../src/diagnostic/kind.rs");
    let is_code = |word: &&str| {
        word.len() == 5 && word.starts_with(['E', 'W', 'U']) && word[1..].bytes().all(|b| b.is_ascii_digit())
    };
    text.split('"').filter(is_code).collect()
}

/// The diagnostics of reading the files one after the other: domains import those before them, a problem
/// belongs to the last domain, a plan to the problem. `…` is a thousand repetitions.
fn said(files: &[&str]) -> (BTreeSet<&'static str>, String) {
    let (mut domains, mut problem): (Vec<Domain>, Option<Problem>) = (Vec::new(), None);
    let (mut codes, mut text) = (BTreeSet::new(), String::new());
    for file in files {
        let nested = file.replace("(and …", &"(and ".repeat(1000)).replace("…)", &")".repeat(1000));
        let source = Source::new("example", nested);
        let diagnostics = if let (Some(problem), Some(domain)) = (&problem, domains.last()) {
            parse_plan(&source, domain, problem).diagnostics
        } else if source.text().contains("(problem") {
            let parsed = parse_problem(&source, domains.last().expect("the domain comes first"));
            problem = parsed.model;
            parsed.diagnostics
        } else {
            let parsed = parse_domain(&source, &domains.iter().collect::<Vec<_>>());
            domains.extend(parsed.model);
            parsed.diagnostics
        };
        codes.extend(diagnostics.iter().map(pddl::Diagnostic::code));
        text.extend(diagnostics.iter().map(|d| d.describe(&source)));
    }
    (codes, text)
}

#[test]
fn every_code_is_explained_and_in_order() {
    let explained: Vec<&str> = explanations().map(|e| e.code).collect();
    assert_eq!(explained.iter().copied().collect::<BTreeSet<_>>(), codes());
    assert!(explained.is_sorted_by(|a, b| a[1..] < b[1..]), "{explained:?}");
}

#[test]
fn wrong_examples_give_their_code_and_right_ones_none() {
    let mut failed = String::new();
    for explanation in explanations() {
        let (wrong, text) = said(&explanation.wrong);
        if wrong != BTreeSet::from([explanation.code]) {
            failed += &format!("the wrong example of {} gives {wrong:?}\n{text}", explanation.code);
        }
        let (right, text) = said(&explanation.right);
        if explanation.right.is_empty() || !right.is_empty() {
            failed += &format!("the right example of {} gives {right:?}\n{text}", explanation.code);
        }
        for file in &explanation.right {
            let formatted = pddl::format(&Source::new(explanation.code, *file)).expect("right is balanced");
            if formatted.trim_end() != *file {
                failed += &format!("the right example of {} should be\n{formatted}", explanation.code);
            }
        }
    }
    assert!(failed.is_empty(), "{failed}");
}

#[test]
fn a_code_in_any_case_is_found() {
    assert_eq!(explain("e0202").map(|e| e.code), Some("E0202"));
    assert_eq!(explain("E0110"), None);
    assert_eq!(explain("é"), None);
}
