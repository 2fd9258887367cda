//! One file per mistake in a rule: the error and its place stand beside it.
#![allow(clippy::unwrap_used, reason = "a test")]

mod common;

use std::fs;

use agents::compile;
use common::{Lab, domain, root, source};
use expect_test::expect_file;

#[test]
fn mistakes_are_reported_where_they_are() {
    let lab = Lab::new();
    let folder = root().join("test_data/err");
    let mut files: Vec<_> = fs::read_dir(&folder).unwrap().map(|file| file.unwrap().path()).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "pddl"));
    files.sort();
    assert!(!files.is_empty());
    for file in files {
        let rules = domain(&file, &[&lab.words]);
        let text = source(&file);
        let errors = compile(&rules, &lab.tokens, &agents::skills::standard())
            .err()
            .unwrap_or_else(|| panic!("{} compiles", file.display()));
        let mut lines = String::new();
        for error in errors {
            let place = text.line_column(error.span.start);
            lines += &format!("{}:{}: {error}\n", place.line, place.column);
        }
        expect_file![file.with_extension("txt")].assert_eq(&lines);
    }
}
