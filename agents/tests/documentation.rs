//! The rule in docs/rules.md compiles against the robot's vocabulary, so that the page cannot show what is refused; its
//! table of skills is that of the code.
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

#[test]
fn the_table_of_skills_is_that_of_the_code() {
    let page = fs::read_to_string(root().join("docs/rules.md")).unwrap();
    let table = page.split("## Skills").nth(1).unwrap();
    let rows: Vec<&str> = table.lines().filter(|line| line.starts_with("| `")).collect();
    let row = |skill: agents::Signature| {
        let results: Vec<String> = skill.results.iter().map(ToString::to_string).collect();
        let name = format!("`{}`", skill.name);
        let cells = [name, skill.arguments.join(", "), results.join(", "), skill.outcomes.join(", ")];
        let cells =
            cells.iter().map(|cell| if cell.is_empty() { " ".to_owned() } else { format!(" {cell} ") });
        cells.fold("|".to_owned(), |row, cell| row + &cell + "|")
    };
    let skills: Vec<String> = skills::standard().signatures().map(row).collect();
    assert_eq!(rows, skills, "docs/rules.md should have\n{}", skills.join("\n"));
}
