//! Fixtures: files of a project in one text, `$0` where the cursor is.

#![allow(dead_code, reason = "each test file takes what it needs")]

use diagnostics::{Place, SourceId};
use ide::{Edits, Position, TextEdit};
use pddl::Span;
use project::Project;

/// Files with `//- path` before each (one without is `domain.pddl`), and the cursor.
pub(crate) fn fixture(text: &str) -> (Project, Position) {
    let (project, position) = files(text);
    (project, position.expect("the fixture has a `$0`"))
}

/// The same where no cursor is needed; the first file is what is asked about.
pub(crate) fn project(text: &str) -> (Project, SourceId) {
    (files(text).0, SourceId(0))
}

fn files(text: &str) -> (Project, Option<Position>) {
    let mut files: Vec<(String, String)> = Vec::new();
    for line in text.split_inclusive('\n') {
        if let Some(path) = line.strip_prefix("//- ") {
            files.push((path.trim().to_owned(), String::new()));
        } else {
            if files.is_empty() {
                files.push(("domain.pddl".to_owned(), String::new()));
            }
            files.last_mut().expect("there is one").1.push_str(line);
        }
    }
    let mut project = Project::new();
    let mut position = None;
    for (path, mut text) in files {
        let cursor = text.find("$0");
        if let Some(at) = cursor {
            text.replace_range(at..at + 2, "");
        }
        let source = project.set(&path, text);
        if let Some(at) = cursor {
            position = Some(Position { source, offset: u32::try_from(at).expect("a fixture is short") });
        }
    }
    (project, position)
}

/// `path:line:column text`.
pub(crate) fn show(project: &Project, place: Place) -> String {
    format!("{} {}", project.sources().place(place), one_line(project.source(place.source).slice(place.span)))
}

/// A text in one line.
pub(crate) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Files after their edits, with their paths.
pub(crate) fn apply(project: &Project, edits: &Edits) -> String {
    let changed = edits.files.iter().map(|(&source, edits)| {
        format!(
            "//- {}\n{}\n",
            project.path(source),
            apply_to(project.source(source).text(), edits).trim_end()
        )
    });
    changed.collect()
}

/// A text after edits that are in order and do not overlap.
pub(crate) fn apply_to(text: &str, edits: &[TextEdit]) -> String {
    let mut result = String::new();
    let mut from = 0;
    for TextEdit { span, text: new } in edits {
        let Span { start, end } = *span;
        assert!(from <= start && start <= end, "edits are in order");
        result += &text[from as usize..start as usize];
        result += new;
        from = end;
    }
    result + &text[from as usize..]
}
