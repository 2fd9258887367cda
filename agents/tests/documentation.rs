//! The rule in docs/rules.md compiles against the robot's vocabulary, so that the page cannot show what is refused.
#![allow(clippy::unwrap_used, reason = "a test")]

use std::fs;
use std::path::{Path, PathBuf};

use agents::{compile, skills};
use pddl::{Source, parse_domain};
use vocabulary::Tokens;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned()
}

#[test]
fn the_example_of_the_page_compiles() {
    let words = fs::read_to_string(root().join("robots/clarc/vocabulary.pddl")).unwrap();
    let words = parse_domain(&Source::new("vocabulary.pddl", words), &[]).model.unwrap();
    let page = fs::read_to_string(root().join("docs/rules.md")).unwrap();
    let example = page.split("```pddl\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    let parsed = parse_domain(&Source::new("docs/rules.md", example), &[&words]);
    assert!(parsed.diagnostics.is_empty(), "{:#?}", parsed.diagnostics);
    let agent = compile(&parsed.model.unwrap(), &Tokens::new(&words).unwrap(), &skills::standard());
    assert_eq!(agent.unwrap().rule_names().count(), 1);
}
