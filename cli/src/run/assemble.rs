//! From a mission's text to everything that runs it: graph, agents, PELEA.
//!
//! What does not fit together is found here, before anything moves, and said with its place.

use agents::{Agent, skills};
use dsr::{Graph, Time};
use executive::{Model, Policy, Step, Wheel};
use high_to_low::Methods;
use low_to_high::Perception;
use mission::{Finding, Mission, Place, SourceId};
use pddl::Span;
use pddl::model::Name;
use std::fmt::Display;
use std::sync::Arc;
use vocabulary::Vocabulary;

/// A mission ready to run.
pub(super) struct Assembly {
    pub(super) vocabulary: Vocabulary,
    pub(super) graph: Graph,
    pub(super) agents: Vec<Arc<Agent>>,
    pub(super) wheel: Wheel,
}

/// Puts a mission together.
pub(super) fn assemble(mission: &Mission) -> Result<Assembly, Vec<Finding>> {
    let layers = &mission.layers;
    let mut findings = Vec::new();

    let vocabulary = Vocabulary::new(&layers.vocabulary.model).map_err(|errors| {
        errors.iter().map(|e| finding("E1001", layers.vocabulary.source, e.span, e)).collect::<Vec<_>>()
    })?;
    // The graph's problem holds the world's objects, but not what the world says of them.
    let graph =
        vocabulary.populate(&[&layers.world.model, &layers.graph.model], Time(0)).map_err(|errors| {
            errors
                .iter()
                .map(|e| {
                    let source = if e.problem == 0 { layers.world.source } else { layers.graph.source };
                    finding("E1002", source, e.span, e)
                })
                .collect::<Vec<_>>()
        })?;

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
    let (Ok(perception), Ok(methods), Ok(model)) = (perception, methods, model) else { return Err(findings) };
    if !findings.is_empty() {
        return Err(findings);
    }

    let policy = Policy {
        fallback: Step {
            action: mission.fallback.name.clone(),
            arguments: mission.fallback.arguments.clone(),
        },
        expansions: u64::from(mission.manifest.budget.replan_expansions),
        attempts: mission.manifest.budget.attempts,
    };
    let wheel = Wheel::new(Arc::new(model), Arc::new(perception), Arc::new(methods), policy);
    Ok(Assembly { vocabulary, graph, agents, wheel })
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
