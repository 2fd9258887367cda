//! Loads a mission's folder and builds everything that runs it: text, graph, agents, PELEA.
//!
//! Layers that do not fit together are reported here with their places, before anything moves.
//! `run` and `check` both use this, so a mission that passes the check can run.
//!
//! Codes: E10xx. E1001 vocabulary, E1002 world and graph, E1003 rules, E1004 perception, E1005 methods,
//! E1006 planning problem, E1007 a condition of a scenario (`scenario`).

use crate::console::Console;
use crate::disk::{Disk, show};
use crate::exit::Exit;
use crate::render;
use agents::{Agent, skills};
use diagnostics::{Finding, Place, SourceId};
use dsr::{Graph, Time};
use executive::{Model, Policy, Step, Wheel};
use high_to_low::Methods;
use low_to_high::Perception;
use mission::{Mission, MissionErrors};
use pddl::Span;
use pddl::model::Name;
use std::collections::BTreeSet;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use vocabulary::Tokens;

/// A mission that is ready to run.
pub(crate) struct Assembly {
    pub(crate) vocabulary: Tokens,
    pub(crate) graph: Graph,
    pub(crate) agents: Vec<Arc<Agent>>,
    pub(crate) wheel: Wheel,
}

/// Why a mission cannot be loaded.
#[derive(Debug, thiserror::Error)]
pub(crate) enum LoadError {
    #[error("cannot read `{}`: there is no such folder", path.display())]
    Missing { path: PathBuf },
    #[error("`{}` is no mission: it has no `mission.toml`", path.display())]
    NoManifest { path: PathBuf },
    #[error(transparent)]
    Wrong(#[from] MissionErrors),
}

impl LoadError {
    /// Shows the reason.
    pub(crate) fn show(&self, console: &mut Console<'_>) -> Exit {
        match self {
            Self::Wrong(errors) => show(&errors.sources, &errors.findings, console),
            Self::Missing { .. } | Self::NoManifest { .. } => {
                render::error(self.to_string(), console);
                Exit::Unreadable
            }
        }
    }
}

/// Reads the mission in a folder, or of the `mission.toml` at that path.
pub(crate) fn load(path: &Path) -> Result<Mission, LoadError> {
    if !path.exists() {
        return Err(LoadError::Missing { path: path.to_owned() });
    }
    if path.is_dir() && !path.join("mission.toml").is_file() {
        return Err(LoadError::NoManifest { path: path.to_owned() });
    }
    Ok(Mission::load(&Disk, &path.to_string_lossy())?)
}

/// The findings about a parsed mission, and its assembly if no finding is an error.
pub(crate) fn assemble(mission: &Mission) -> (Option<Assembly>, Vec<Finding>) {
    let mut findings = mission.warnings.clone();
    findings.extend(mission.check());
    let places: BTreeSet<_> = findings.iter().map(|f| (f.place.source, f.place.span)).collect();
    let mut objections = Vec::new();
    let assembly = put_together(mission, &mut objections);
    let good = objections.is_empty() && !findings.iter().any(Finding::is_error);
    // The checks between the layers may have reported the same place already.
    findings.extend(objections.into_iter().filter(|f| !places.contains(&(f.place.source, f.place.span))));
    findings.sort_by_key(|f| (f.place.source, f.place.span));
    (assembly.filter(|_| good), findings)
}

/// Compiles all layers; `None` if one has errors, which are added to `findings`.
fn put_together(mission: &Mission, findings: &mut Vec<Finding>) -> Option<Assembly> {
    let layers = &mission.layers;
    let vocabulary = Tokens::new(&layers.vocabulary.model).map_err(|errors| {
        findings.extend(errors.iter().map(|e| finding("E1001", layers.vocabulary.source, e.span, e)));
    });
    // Without a vocabulary no other layer can be read.
    let vocabulary = vocabulary.ok()?;
    // The graph's problem has the world's objects, but not the world's facts about them.
    let graph = vocabulary.populate(&[&layers.world.model, &layers.graph.model], Time(0)).map_err(|errors| {
        findings.extend(errors.iter().map(|e| {
            let source = if e.problem == 0 { layers.world.source } else { layers.graph.source };
            finding("E1002", source, e.span, e)
        }));
    });

    let skills = skills::standard();
    let mut agents = Vec::new();
    for layer in &layers.agents {
        match agents::compile(&layer.model, &vocabulary, &skills) {
            Ok(agent) => agents.push(Arc::new(agent)),
            Err(errors) => {
                findings.extend(errors.iter().map(|e| finding("E1003", layer.source, e.span, e)));
            }
        }
    }
    let perception = Perception::new(&layers.perception.model, &vocabulary).map_err(|errors| {
        findings.extend(errors.iter().map(|e| finding("E1004", layers.perception.source, e.span, e)));
    });
    let methods = Methods::new(&layers.methods.model, &vocabulary).map_err(|errors| {
        findings.extend(errors.iter().map(|e| finding("E1005", layers.methods.source, e.span(), e)));
    });
    let model = Model::new(layers.domain.model.clone(), layers.problem.model.clone(), &perceived(mission));
    let model = model.map_err(|error| {
        findings.push(finding("E1006", layers.problem.source, layers.problem.model.goal_span, &error));
    });
    let (Ok(graph), Ok(perception), Ok(methods), Ok(model)) = (graph, perception, methods, model) else {
        return None;
    };
    let policy = Policy {
        fallback: Step {
            action: mission.fallback.name.clone(),
            arguments: mission.fallback.arguments.clone(),
        },
        expansions: u64::from(mission.manifest.budget.replan_expansions),
        attempts: mission.manifest.budget.attempts,
    };
    let wheel = Wheel::new(Arc::new(model), Arc::new(perception), Arc::new(methods), policy);
    Some(Assembly { vocabulary, graph, agents, wheel })
}

/// The predicates of the planning domain that perception derives.
fn perceived(mission: &Mission) -> Vec<Name> {
    let perception = &mission.layers.perception.model;
    let mut names: Vec<Name> =
        perception.axioms.iter().map(|axiom| perception.predicates[axiom.predicate].name.clone()).collect();
    names.sort_unstable();
    names.dedup();
    names
}

fn finding(code: &'static str, source: SourceId, span: Span, what: &dyn Display) -> Finding {
    Finding::error(code, Place { source, span }, what.to_string())
}
