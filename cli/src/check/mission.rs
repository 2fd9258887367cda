//! A mission checked as a whole: its files, the layers against each other, their compilation, and all its scenarios.
//!
//! Lints run on those of its files that form a project by themselves.
//!
//! The check takes the same steps as `pelea run` before it moves anything. With `--json`, a line follows its
//! diagnostics:
//!
//! ```json
//! {"kind": "checked", "mission": "domains/tea", "files": 12, "agents": 1, "rules": 2, "methods": 2,
//!  "languages": ["en", "fr"], "scenarios": ["plain"], "errors": 0, "warnings": 0, "unsupported": 0,
//!  "checked": true}
//! ```
//!
//! If an error in one file prevents the rest from being read, `checked` is false and the counts of its contents are
//! missing.

use super::tally::Tally;
use crate::assemble::{LoadError, assemble, load};
use crate::console::Console;
use crate::disk::show;
use crate::exit::Exit;
use crate::nearby::is_source;
use crate::render::counted;
use crate::scenario::{self, ScenarioError};
use diagnostics::{Finding, SourceId};
use lints::Level;
use mission::Mission;
use pddl::Source;
use project::Project;
use serde::Serialize;
use std::path::Path;

/// Checks the mission in a folder, or of the `mission.toml` at that path.
pub(super) fn check(path: &Path, level: Level, console: &mut Console<'_>) -> Exit {
    let folder = path.to_string_lossy();
    let mission = match load(path) {
        Ok(mission) => mission,
        Err(error) => {
            let shown = error.show(console);
            let LoadError::Wrong(errors) = error else { return shown };
            let tally = Tally { checked: false, ..tally(&errors.findings) };
            console.result(&format!("{folder}: {}; the rest was not checked", tally.verdict()));
            console.record(&Record { kind: "checked", mission: &folder, content: None, tally });
            return Exit::No;
        }
    };
    let (assembly, mut findings) = assemble(&mission);
    findings.extend(lints(&mission, level));
    show(&mission.sources, &findings, console);
    for name in mission.scenarios() {
        let read = scenario::read(&mission, name);
        let error = match &assembly {
            Some(assembly) => {
                read.and_then(|read| scenario::stage(read, &mission, &assembly.vocabulary)).err()
            }
            None => read.err(),
        };
        if let Some(error) = error {
            error.show(console);
            if let ScenarioError::Wrong(errors) = error {
                findings.extend(errors.findings);
            }
        }
    }
    let tally = tally(&findings);
    let content = Content::of(&mission);
    console.result(&format!("{folder}: {} in {}", tally.verdict(), content.sentence()));
    console.record(&Record { kind: "checked", mission: &folder, content: Some(content), tally });
    if tally.errors == 0 { Exit::Yes } else { Exit::No }
}

/// The lint findings of the mission's PDDL, with the mission's ids of the files. Lints skip a layer whose names come
/// from more than the domain that it names, since it is not a project's file by itself.
fn lints(mission: &Mission, level: Level) -> Vec<Finding> {
    let mut project = Project::without_names();
    project.set_lint_level(level);
    let (own, sources): (Vec<SourceId>, Vec<Source>) = mission
        .sources
        .iter()
        .filter(|(_, source)| is_source(Path::new(source.name())))
        .map(|(id, source)| (id, source.clone()))
        .unzip();
    let ids = project.set_all(sources);
    let back = |id: SourceId| ids.iter().position(|&i| i == id).map(|at| own[at]);
    let moved = |mut finding: Finding| {
        finding.place.source = back(finding.place.source)?;
        for (place, _) in &mut finding.related {
            place.source = back(place.source)?;
        }
        Some(finding)
    };
    let linted = ids.iter().flat_map(|&id| project.lint_findings(id));
    linted.filter_map(|linted| moved(linted.finding.clone())).collect()
}

fn tally(findings: &[Finding]) -> Tally {
    Tally::of(findings.iter().map(|f| f.severity))
}

/// The contents of a checked mission.
#[derive(Serialize)]
struct Content<'a> {
    files: usize,
    agents: usize,
    rules: usize,
    methods: usize,
    languages: Vec<&'a str>,
    scenarios: Vec<&'a str>,
}

impl<'a> Content<'a> {
    fn of(mission: &'a Mission) -> Self {
        let layers = &mission.layers;
        let scenarios: Vec<_> = mission.scenarios().collect();
        Self {
            files: mission.sources.iter().count() + scenarios.len(),
            agents: layers.agents.len(),
            rules: layers.agents.iter().map(|agent| agent.model.durative_actions.len()).sum(),
            methods: layers.methods.model.methods.len(),
            languages: mission.languages().collect(),
            scenarios,
        }
    }

    fn sentence(&self) -> String {
        format!(
            "{}: {} of {}, {}, {} ({}), {}",
            counted(self.files, "file", "files"),
            counted(self.rules, "rule", "rules"),
            counted(self.agents, "agent", "agents"),
            counted(self.methods, "method", "methods"),
            counted(self.languages.len(), "language", "languages"),
            self.languages.join(", "),
            counted(self.scenarios.len(), "scenario", "scenarios"),
        )
    }
}

#[derive(Serialize)]
struct Record<'a> {
    kind: &'static str,
    mission: &'a str,
    #[serde(flatten)]
    content: Option<Content<'a>>,
    #[serde(flatten)]
    tally: Tally,
}
