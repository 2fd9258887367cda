//! Scenarios from a mission's folder or any other file, with their conditions compiled.
//!
//! A parsed scenario refers only to tokens and nodes that exist. This module also compiles its
//! conditions to patterns of the graph. A condition that cannot be watched (because it has too many
//! alternatives) is therefore reported before anything moves.

use crate::console::Console;
use crate::disk::{Disk, show};
use crate::exit::Exit;
use crate::files;
use crate::render;
use diagnostics::{Finding, Place};
use dsr::{Interest, PatternId, Snapshot};
use mission::scenario::{Disruption, GraphCondition, Scenario, Trigger};
use mission::{Mission, MissionErrors};
use pddl::Span;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use vocabulary::{Binding, Condition, Tokens};

/// A compiled condition over the graph.
pub(crate) struct Watch {
    condition: Condition,
    binding: Binding,
}

impl Watch {
    /// Its alternatives as patterns: it holds whenever one of them has a match.
    pub(crate) fn interest(&self) -> (Interest, Vec<PatternId>) {
        let mut interest = Interest::default();
        let alternatives = self.condition.alternatives().iter();
        let patterns =
            alternatives.map(|alternative| interest.add(Arc::clone(alternative.pattern()))).collect();
        (interest, patterns)
    }

    pub(crate) fn holds(&self, snapshot: &Snapshot) -> bool {
        self.condition.holds(snapshot, &self.binding)
    }
}

/// A disruption with its condition compiled.
pub(crate) struct Cue {
    pub(crate) disruption: Disruption,
    /// For a `when`: the condition over the graph.
    pub(crate) condition: Option<Watch>,
}

/// A scenario with its conditions compiled.
pub(crate) struct Staged {
    pub(crate) scenario: Scenario,
    pub(crate) cues: Vec<Cue>,
    /// Its `holds` expectations, by their places.
    expected: BTreeMap<Span, Watch>,
}

impl Staged {
    /// Whether a condition of its expectations holds.
    pub(crate) fn holds(&self, condition: &GraphCondition, snapshot: &Snapshot) -> bool {
        self.expected.get(&condition.span).is_some_and(|watch| watch.holds(snapshot))
    }
}

/// Why a scenario cannot be used.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ScenarioError {
    #[error("`{mission}` has no scenario `{name}`")]
    Unknown { mission: String, name: String, help: Option<String> },
    #[error(transparent)]
    Wrong(#[from] MissionErrors),
}

impl ScenarioError {
    /// Shows the reason.
    pub(crate) fn show(&self, console: &mut Console<'_>) -> Exit {
        match self {
            Self::Wrong(errors) => show(&errors.sources, &errors.findings, console),
            Self::Unknown { help, .. } => {
                render::error_with_help(self.to_string(), help.as_deref(), console);
                Exit::Unreadable
            }
        }
    }
}

/// Reads a scenario: the path of a file, or a name in the mission's folder.
pub(crate) fn read(mission: &Mission, name: &str) -> Result<Scenario, ScenarioError> {
    let path = Path::new(name);
    if path.extension().is_some()
        && path.is_file()
        && let Ok(source) = files::read(path)
    {
        return Ok(mission.read_scenario(source)?);
    }
    mission.scenario(&Disk, name).map_err(|errors| {
        if mission.scenarios().any(|known| known == name) {
            return errors.into();
        }
        // The error is in an argument, so it has no place in a file.
        let help = errors.findings.into_iter().find_map(|finding| finding.help);
        ScenarioError::Unknown { mission: mission.folder.clone(), name: name.to_owned(), help }
    })
}

/// Compiles its conditions.
pub(crate) fn stage(
    scenario: Scenario,
    mission: &Mission,
    vocabulary: &Tokens,
) -> Result<Staged, ScenarioError> {
    let link = vocabulary.link(&mission.layers.nodes);
    let mut mistakes = Vec::new();
    let mut watch = |condition: &GraphCondition| {
        let GraphCondition { condition, variables, span, .. } = condition;
        match link.condition(variables, [condition]) {
            Ok(condition) => Some(Watch { condition, binding: Binding::of(variables) }),
            Err(errors) => {
                mistakes.extend(errors.iter().map(|error| (*span, error.to_string())));
                None
            }
        }
    };
    let cues = scenario
        .disruptions
        .iter()
        .map(|disruption| {
            let condition = match &disruption.trigger {
                Trigger::When { condition, .. } => watch(condition),
                Trigger::At(_) | Trigger::Version(_) | Trigger::Instant | Trigger::Step { .. } => None,
            };
            Cue { disruption: disruption.clone(), condition }
        })
        .collect();
    let expected = scenario.expect.holds.iter().filter_map(|c| Some((c.span, watch(c)?))).collect();
    if mistakes.is_empty() {
        return Ok(Staged { scenario, cues, expected });
    }
    let mut sources = mission.sources.clone();
    let source = sources.push((*scenario.source).clone());
    let findings = mistakes
        .into_iter()
        .map(|(span, message)| Finding::error("E1007", Place { source, span }, message))
        .collect();
    Err(MissionErrors { sources, findings }.into())
}
