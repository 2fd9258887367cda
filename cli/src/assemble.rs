//! Loads a mission's folder and builds everything that runs it: text, graph, agents, PELEA.
//!
//! Layers that do not fit together are reported here with their places, before anything moves.
//! `run` and `check` both use this, so a mission that passes the check can run.
//!
//! Codes: E10xx. E1001 vocabulary, E1002 world and graph, E1003 rules, E1004 perception, E1005 methods,
//! E1006 planning problem, E1007 a condition of a scenario (`scenario`), E1008 no agent for PELEA to write as,
//! E1009 invariants, E1010 a device that the robot does not have (`devices`), E1011 a durative action that cannot be
//! planned as one step.

mod devices;

use crate::console::Console;
use crate::disk::{Disk, show};
use crate::exit::Exit;
use crate::goals;
use crate::render;
use agents::{Agent, RuleErrorKind, skills};
use diagnostics::{Finding, Place, SourceId, did_you_mean};
use dsr::{AgentId, Graph, Interest, LabelId, Time};
use executive::{Arrivals, Bounds, Model, ModelError, Policy, Sensed, Step, Wheel};
use high_to_low::Methods;
use low_to_high::Perception;
use mission::{Mission, MissionErrors, MissionTask, SkillOutcomes};
use pddl::Span;
use pddl::model::Name;
use safety::Invariants;
use std::collections::BTreeSet;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use vocabulary::Tokens;

/// A mission that is ready to run.
pub(crate) struct Assembly {
    pub(crate) vocabulary: Arc<Tokens>,
    pub(crate) graph: Graph,
    pub(crate) agents: Vec<Arc<Agent>>,
    /// What every wheel of the mission is made from.
    parts: Parts,
    /// The agent that PELEA writes as.
    pub(crate) writer: AgentId,
    /// What a run must satisfy.
    pub(crate) invariants: Arc<Invariants>,
    /// The labels of what must outlive the process.
    pub(crate) lasting: Vec<LabelId>,
}

/// What a wheel is made from.
#[derive(Clone)]
struct Parts {
    model: Arc<Model>,
    perception: Arc<Perception>,
    methods: Arc<Methods>,
    policy: Policy,
    /// Which nodes are objects that have appeared.
    arrivals: Arc<Arrivals>,
}

impl Assembly {
    /// A wheel that has not turned yet.
    pub(crate) fn wheel(&self) -> Wheel {
        let Parts { model, perception, methods, policy, arrivals } = self.parts.clone();
        Wheel::new(model, perception, methods, policy).with_arrivals(arrivals)
    }

    /// The same mission on a graph of its own, which begins like this one is now.
    pub(crate) fn again(&self) -> Self {
        Self {
            vocabulary: Arc::clone(&self.vocabulary),
            graph: Graph::from_snapshot(&self.graph.snapshot()),
            agents: self.agents.clone(),
            parts: self.parts.clone(),
            writer: self.writer,
            invariants: Arc::clone(&self.invariants),
            lasting: self.lasting.clone(),
        }
    }

    /// The same mission on a graph that goes on.
    pub(crate) fn on(self, graph: Graph) -> Self {
        Self { graph, ..self }
    }

    /// What PELEA and each agent see of the graph.
    pub(crate) fn interests(&self) -> Vec<Interest> {
        let agents = self.agents.iter().map(|agent| agent.interest());
        std::iter::once(self.wheel().interest(self.writer)).chain(agents).collect()
    }
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
    findings.extend(mission.check(&outcomes()));
    let places: BTreeSet<_> = findings.iter().map(|f| (f.place.source, f.place.span)).collect();
    let mut objections = Vec::new();
    let assembly = put_together(mission, &mut objections);
    let good = objections.is_empty() && !findings.iter().any(Finding::is_error);
    // The checks between the layers may have reported the same place already, or what the planner does not support.
    let domain = mission.layers.domain.source;
    let refused = findings.iter().any(|f| f.is_error() && f.place.source == domain);
    objections.retain(|f| !places.contains(&(f.place.source, f.place.span)));
    objections.retain(|f| f.code != Some(UNPLANNABLE) || !refused);
    findings.append(&mut objections);
    findings.sort_by_key(|f| (f.place.source, f.place.span));
    (assembly.filter(|_| good), findings)
}

/// The outcomes of the skills that rules may name.
fn outcomes() -> SkillOutcomes {
    skills::standard().signatures().map(|skill| (skill.name, skill.outcomes)).collect()
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
                findings.extend(
                    errors
                        .iter()
                        .map(|e| finding("E1003", layer.source, e.span, e).help_if(nearest_name(&e.kind))),
                );
            }
        }
    }
    devices::check(mission, &skills, findings);
    let (perception, conditions) = goals::perception(mission);
    let perception = Perception::new(&perception, &vocabulary).map_err(|errors| {
        findings.extend(errors.iter().map(|e| {
            let source = if conditions.contains(&e.span) {
                mission.manifest_source()
            } else {
                layers.perception.source
            };
            finding("E1004", source, e.span, e)
        }));
    });
    let methods = Methods::new(&layers.methods.model, &vocabulary).map_err(|errors| {
        findings.extend(errors.iter().map(|e| finding("E1005", layers.methods.source, e.span(), e)));
    });
    let predicates = perceived(mission);
    let numbers = perception.iter().flat_map(Perception::numbers);
    let numbers: Vec<_> = numbers.map(|(name, value)| (name.clone(), value)).collect();
    let sensed = Sensed { predicates: &predicates, numbers: &numbers };
    let (domain, problem) = (layers.domain.model.clone(), layers.problem.model.clone());
    let model = Model::with_goals(domain, problem, sensed, goals::texts(mission));
    let model = model.map_err(|error| {
        findings.push(match &error {
            ModelError::Concurrency(why) => finding("E1011", layers.domain.source, why.span(), &error),
            ModelError::Ground(_) => {
                finding(UNPLANNABLE, layers.problem.source, layers.problem.model.goal_span, &error)
            }
        });
    });
    let invariants = Invariants::new(layers.safety.iter().map(|layer| &layer.model), &vocabulary);
    let invariants = invariants.map_err(|errors| {
        findings.extend(
            errors
                .iter()
                .map(|(layer, error)| finding("E1009", layers.safety[*layer].source, error.span, error)),
        );
    });
    let (Ok(graph), Ok(perception), Ok(methods), Ok(model), Ok(invariants)) =
        (graph, perception, methods, model, invariants)
    else {
        return None;
    };
    let Some(writer) = graph.vocabulary().agent(PELEA) else {
        findings.push(nobody_to_write_as(mission, &graph));
        return None;
    };
    let (model, perception, methods) = (Arc::new(model), Arc::new(perception), Arc::new(methods));
    let arrivals = Arc::new(Arrivals::new(model.domain(), &graph.snapshot()));
    let parts = Parts { model, perception, methods, policy: policy(mission), arrivals };
    let invariants = Arc::new(invariants);
    let vocabulary = Arc::new(vocabulary);
    let labels = mission.manifest.report.lasting();
    let lasting = labels.filter_map(|mention| graph.vocabulary().label(&mention.name)).collect();
    Some(Assembly { vocabulary, graph, agents, parts, writer, invariants, lasting })
}

/// The planner cannot use the planning problem.
const UNPLANNABLE: &str = "E1006";

/// The skill or the outcome that a rule may mean.
fn nearest_name(mistake: &RuleErrorKind) -> Option<String> {
    match mistake {
        RuleErrorKind::UnknownSkill { skill, known } => did_you_mean(skill, known.iter().copied()),
        RuleErrorKind::UnknownOutcome { outcome, known, .. } => did_you_mean(outcome, known.iter().copied()),
        _ => None,
    }
}

/// The agent that PELEA writes as.
const PELEA: &str = "pelea";

/// Without an agent of its own, nothing would hold PELEA to what it may write.
fn nobody_to_write_as(mission: &Mission, graph: &Graph) -> Finding {
    let layer = &mission.layers.vocabulary;
    let is_agent = |o: &&pddl::model::Object| graph.vocabulary().agent(&o.name).is_some();
    let span = layer.model.constants.iter().find(is_agent).map(|o| o.span).unwrap_or_default();
    let text = format!("no agent is called `{PELEA}`: the executive has nobody to write as");
    let help = format!("declare `{PELEA} - agent`, and what the methods write under (:writes {PELEA} …)");
    finding("E1008", layer.source, span, &text).help_if(Some(help))
}

/// What the manifest decides about the executive, and its defaults.
fn policy(mission: &Mission) -> Policy {
    let step = |task: &MissionTask| Step { action: task.name.clone(), arguments: task.arguments.clone() };
    let default = Policy::new(step(&mission.fallback));
    let (budget, patience) = (mission.manifest.budget, &mission.manifest.patience);
    Policy {
        escalation: mission.escalation.as_ref().map(step),
        meanwhile: mission.meanwhile.as_ref().map(step),
        meanwhile_after: patience.meanwhile_after.unwrap_or(default.meanwhile_after),
        deciding: patience.deciding.unwrap_or(default.deciding),
        expansions: u64::from(budget.replan_expansions),
        attempts: budget.attempts,
        bounds: Bounds {
            replans: patience.replans.unwrap_or(default.bounds.replans),
            restarts: patience.restarts.unwrap_or(default.bounds.restarts),
            asks: patience.asks.unwrap_or(default.bounds.asks),
        },
        ..default
    }
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
