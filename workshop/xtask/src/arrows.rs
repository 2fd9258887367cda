//! Which crate may depend on which: ARCHITECTURE.md draws it, cargo does it, both must agree.
//!
//! The drawing is the fenced block that opens with ```` ```arrows ````, a line per crate:
//! `planner: pddl`. Dependencies of tests and benches are not arrows of the architecture.

use crate::failure::Failure;
use cargo_metadata::{DependencyKind, MetadataCommand};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

type Arrows = BTreeMap<String, BTreeSet<String>>;

/// What differs, a sentence each.
pub(crate) fn check(root: &Path) -> Result<Vec<String>, Failure> {
    let page = root.join("ARCHITECTURE.md");
    let text =
        std::fs::read_to_string(&page).map_err(|error| Failure::File(page.display().to_string(), error))?;
    Ok(differences(&drawn(&text), &actual(root)?))
}

fn drawn(page: &str) -> Arrows {
    page.lines()
        .skip_while(|line| line.trim() != "```arrows")
        .skip(1)
        .take_while(|line| line.trim() != "```")
        .filter_map(|line| line.split_once(':'))
        .map(|(from, to)| {
            (from.trim().to_owned(), to.split_whitespace().map(|t| t.trim_matches(',').to_owned()).collect())
        })
        .collect()
}

fn actual(root: &Path) -> Result<Arrows, Failure> {
    let metadata = MetadataCommand::new().manifest_path(root.join("Cargo.toml")).no_deps().exec()?;
    let folder = |manifest: &Path| {
        manifest.parent().and_then(|p| p.file_name()).map(|n| n.to_string_lossy().into_owned())
    };
    Ok(metadata
        .packages
        .iter()
        .filter_map(|package| {
            let name = folder(package.manifest_path.as_std_path())?;
            let arrows = package
                .dependencies
                .iter()
                .filter(|d| d.kind == DependencyKind::Normal)
                .filter_map(|d| d.path.as_ref()?.file_name().map(str::to_owned))
                .collect();
            Some((name, arrows))
        })
        .collect())
}

fn differences(drawn: &Arrows, actual: &Arrows) -> Vec<String> {
    let none = BTreeSet::new();
    let crates: BTreeSet<_> = drawn.keys().chain(actual.keys()).collect();
    let mut findings = Vec::new();
    for name in crates {
        let (is_drawn, is_there) = (drawn.get(name), actual.get(name));
        if is_drawn.is_none() {
            findings.push(format!("crate {name} is not drawn in ARCHITECTURE.md"));
        }
        if is_there.is_none() {
            findings.push(format!("ARCHITECTURE.md draws {name}, which is no crate"));
        }
        let (is_drawn, is_there) = (is_drawn.unwrap_or(&none), is_there.unwrap_or(&none));
        for to in is_there.difference(is_drawn) {
            findings.push(format!("{name} depends on {to}; ARCHITECTURE.md does not draw that arrow"));
        }
        for to in is_drawn.difference(is_there) {
            findings.push(format!("ARCHITECTURE.md draws {name} -> {to}; {name} does not depend on it"));
        }
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "text\n```arrows\npddl:\nplanner: pddl\n```\nmore: text\n";

    #[test]
    fn agreement_is_silent() {
        assert!(differences(&drawn(PAGE), &drawn(PAGE)).is_empty());
    }

    #[test]
    fn an_arrow_that_is_not_drawn_is_named() {
        let mut actual = drawn(PAGE);
        actual.entry("pddl".into()).or_default().insert("planner".into());
        assert_eq!(
            differences(&drawn(PAGE), &actual),
            ["pddl depends on planner; ARCHITECTURE.md does not draw that arrow"]
        );
    }

    #[test]
    fn a_crate_that_is_gone_is_named() {
        let mut actual = drawn(PAGE);
        actual.remove("planner");
        assert_eq!(differences(&drawn(PAGE), &actual).len(), 2);
    }
}
