//! Every lint has cases, an explanation that holds, and a fix that mends.

mod support;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use lints::{Level, Lint, Linted};
use pddl::Source;
use support::{Case, findings_of};

fn test_data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("test_data")
}

/// The PDDL files in a folder, in order.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let mut files: Vec<PathBuf> =
        entries.map(|entry| entry.expect("the folder can be read").path()).collect();
    files.retain(|path| path.extension().is_some_and(|e| e == "pddl"));
    files.sort();
    files
}

fn read(path: &Path) -> Case {
    let name = path.file_name().expect("a file has a name").to_string_lossy().into_owned();
    Case::new(&[Source::new(name, std::fs::read_to_string(path).expect("the case can be read"))])
}

/// Names of lints that a list of findings mentions.
fn names(findings: &[Linted]) -> BTreeSet<&'static str> {
    findings.iter().map(|f| f.lint).collect()
}

#[test]
fn codes_and_names_are_unique_and_in_order() {
    let codes: Vec<&str> = lints::all().map(Lint::code).collect();
    assert!(codes.is_sorted_by(|a, b| a < b), "{codes:?}");
    let names: BTreeSet<&str> = lints::all().map(|lint| lint.name).collect();
    assert_eq!(names.len(), codes.len());
    for lint in lints::all() {
        let Lint { name, explanation, .. } = lint;
        assert!(name.bytes().all(|b| b.is_ascii_lowercase() || b == b'-'), "{name}");
        assert!(explanation.code.starts_with('W') && explanation.code.len() == 5, "{name}");
        assert!(pddl::explain(explanation.code).is_none(), "{} is a code of another crate", explanation.code);
    }
}

#[test]
fn every_lint_is_explained_and_its_examples_are_examples_of_it() {
    let mut failed = String::new();
    for lint in lints::all() {
        let e = &lint.explanation;
        for text in [e.title, &e.meaning, &e.why] {
            assert!(!text.is_empty(), "{}", lint.name);
        }
        assert!(e.meaning.ends_with('.') && e.why.ends_with('.'), "{}", lint.name);
        let (wrong, right) = (Case::of_texts(&e.wrong), Case::of_texts(&e.right));
        let found = names(&findings_of(&wrong, Level::Pedantic));
        if !found.contains(lint.name) {
            failed += &format!("the wrong example of {} gives {found:?}\n", lint.name);
        }
        let found: Vec<Linted> = findings_of(&right, Level::Pedantic);
        if found
            .iter()
            .any(|f| lints::find(f.lint).is_some_and(|l| l.level == Level::Default) || f.lint == lint.name)
        {
            failed += &format!("the right example of {} gives\n{}", lint.name, right.describe(&found));
        }
        for file in e.right.iter().chain(&e.wrong) {
            let formatted = pddl::format(&Source::new(e.code, *file)).expect("parentheses match");
            if formatted.trim_end() != *file {
                failed += &format!("an example of {} should be\n{formatted}", lint.name);
            }
        }
    }
    assert!(failed.is_empty(), "{failed}");
}

#[test]
fn every_lint_finds_what_is_expected_in_its_cases() {
    for folder in std::fs::read_dir(test_data()).expect("there are cases") {
        let name = folder.expect("the folder can be read").file_name().to_string_lossy().into_owned();
        assert!(lints::find(&name).is_some_and(|l| l.name == name), "test_data/{name} belongs to no lint");
    }
    for lint in lints::all() {
        let files = files(&test_data().join(lint.name));
        assert!(!files.is_empty(), "{} has no case in test_data", lint.name);
        let mut count = 0;
        for path in files {
            let case = read(&path);
            let mut found = findings_of(&case, Level::Pedantic);
            found.retain(|f| f.lint == lint.name);
            count += found.len();
            expect_test::expect_file![path.with_extension("expected")].assert_eq(&case.describe(&found));
        }
        assert!(count > 0, "no case of {} triggers it", lint.name);
    }
}

#[test]
fn fixes_mend_what_they_are_for_and_nothing_else_breaks() {
    for lint in lints::all() {
        for path in files(&test_data().join(lint.name)) {
            let case = read(&path);
            let before = findings_of(&case, Level::Pedantic);
            for finding in before.iter().filter(|f| f.lint == lint.name) {
                let Some(fix) = &finding.fix else { continue };
                let mended = case.edited(&fix.edits);
                let after = findings_of(&mended, Level::Pedantic);
                let count = |all: &[Linted]| all.iter().filter(|f| f.lint == lint.name).count();
                assert!(count(&after) < count(&before), "{} in {}", fix.title, path.display());
                let new: Vec<_> = names(&after).difference(&names(&before)).copied().collect();
                assert!(new.is_empty(), "{} in {} causes {new:?}", fix.title, path.display());
            }
        }
    }
}

#[test]
fn findings_are_silent_where_a_comment_allows_them() {
    const HEAD: &str = "(define (domain hall) (:requirements :strips) (:predicates (lit ?x))\n";
    for (body, said) in [
        ("(:action a :parameters (?x ?y) :effect (lit ?x)))", true),
        ("(:action a :parameters (?x ?y) ; allow(unused-parameter)\n :effect (lit ?x)))", false),
        ("(:action a :parameters (?x ?y) ; allow(w0709): in a hurry\n :effect (lit ?x)))", false),
        (
            "; allow(unused-parameter)\n; since it is a case\n(:action a :parameters (?x ?y) :effect (lit ?x)))",
            false,
        ),
        ("(:action a ; allow(unused-parameter)\n :parameters (?x ?y) :effect (lit ?x)))", true),
        ("; do not allow(unused-parameter)\n(:action a :parameters (?x ?y) :effect (lit ?x)))", true),
        ("; allow(unknown-lint, unused-parameter)\n(:action a :parameters (?x ?y) :effect (lit ?x)))", false),
    ] {
        let case = Case::of_texts(&[&format!("{HEAD}{body}")]);
        let found = names(&findings_of(&case, Level::Default));
        assert_eq!(found.contains("unused-parameter"), said, "{body}");
        assert!(!found.contains("unknown-lint"), "{body}");
    }
}

#[test]
fn the_page_lists_all_lints() {
    let mut table = String::from("| code | name | what it finds |\n|---|---|---|\n");
    for lint in lints::all() {
        let pedantic = if lint.level == Level::Pedantic { " (pedantic)" } else { "" };
        let (code, name, meaning) = (lint.code(), lint.name, &lint.explanation.meaning);
        table += &format!("| {code} | `{name}`{pedantic} | {meaning} |\n");
    }
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/lints.md");
    let text = std::fs::read_to_string(&page).expect("the page can be read");
    let (head, _) = text.split_once("| code |").expect("the page has the table");
    expect_test::expect_file![page].assert_eq(&format!("{head}{table}"));
}
