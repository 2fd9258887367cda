//! Reading the PDDL layers, and resolving the tokens that the manifest names.

use pddl::model::{
    Action, Condition, ConditionKind, Domain, Effect, EffectKind, Feature, Problem, TimeSpecifier,
};
use pddl::{Parsed, Source, Span};

use super::loader::Loader;
use crate::files::{FileError, join};
use crate::layers::{Layer, Layers, NamedTokens};
use crate::manifest::{Manifest, Mention};
use diagnostics::did_you_mean;
use diagnostics::{Finding, Place, SourceId};

/// All layers; `None` if one is missing, which the loader has reported.
pub(super) fn read(loader: &mut Loader<'_>, from: SourceId, manifest: &Manifest) -> Option<Layers> {
    let paths = &manifest.paths;
    let robot = Place { source: from, span: manifest.robot_span };
    let here = Place { source: from, span: Span::default() };

    let vocabulary = parse(loader, &paths.vocabulary, robot, |s| pddl::parse_domain(s, &[]));
    let domain = parse(loader, &paths.domain, here, |s| pddl::parse_domain(s, &[]));
    let problem = domain
        .as_ref()
        .and_then(|d| parse(loader, &paths.problem, here, |s| pddl::parse_problem(s, &d.model)));

    let vocabulary = vocabulary?;
    let agents = agents(loader, &paths.agents, robot, &vocabulary.model);
    let world: Layer<Problem> =
        parse(loader, &paths.world, robot, |s| pddl::parse_problem(s, &vocabulary.model))?;
    let seen = with_nodes(&vocabulary.model, &world.model);
    let graph: Layer<Problem> = parse(loader, &paths.graph, here, |s| pddl::parse_problem(s, &seen))?;
    let nodes = with_nodes(&vocabulary.model, &graph.model);

    let methods = parse(loader, &paths.methods, here, |s| pddl::parse_domain(s, &[&nodes]));
    let safety = safety(loader, from, manifest, &seen, &nodes);
    let domain = domain?;
    let perception = parse_with(loader, &paths.perception, here, Feature::DerivedFunctions, |s| {
        pddl::parse_domain(s, &[&nodes, &domain.model])
    });
    let tokens = tokens(loader, from, manifest, &nodes);
    Some(Layers {
        vocabulary,
        world,
        agents: agents?,
        graph,
        nodes,
        steps: steps(&domain.model),
        domain,
        problem: problem?,
        perception: perception?,
        methods: methods?,
        safety: safety?,
        tokens: tokens?,
    })
}

/// The domain with each durative action as an action too.
fn steps(domain: &Domain) -> Domain {
    let mut steps = domain.clone();
    for action in &domain.durative_actions {
        let at_start = action.conditions.iter().filter(|timed| timed.when == TimeSpecifier::Start);
        let conditions = at_start.map(|timed| timed.condition.clone()).collect();
        let effects = action.effects.iter().map(|timed| timed.effect.clone()).collect();
        let (span, name_span) = (action.span, action.name_span);
        steps.actions.push(Action {
            name: action.name.clone(),
            variables: action.variables.clone(),
            precondition: Condition { kind: ConditionKind::And(conditions), span: name_span },
            preferences: Vec::new(),
            effect: Effect { kind: EffectKind::And(effects), span: name_span },
            span,
            name_span,
        });
    }
    steps
}

/// The model of a layer.
trait Model {
    fn features(&self) -> Vec<(Feature, Span)>;
}

impl Model for Domain {
    fn features(&self) -> Vec<(Feature, Span)> {
        Domain::features(self)
    }
}

impl Model for Problem {
    fn features(&self) -> Vec<(Feature, Span)> {
        Problem::features(self)
    }
}

fn parse<M: Model>(
    loader: &mut Loader<'_>,
    path: &str,
    asked_at: Place,
    parse: impl FnOnce(&Source) -> Parsed<M>,
) -> Option<Layer<M>> {
    // HighToLow evaluates the constraints of methods.
    parse_with(loader, path, asked_at, Feature::NetworkConstraints, parse)
}

/// Reads a layer in which one feature is evaluated that other layers may not use.
fn parse_with<M: Model>(
    loader: &mut Loader<'_>,
    path: &str,
    asked_at: Place,
    evaluated: Feature,
    parse: impl FnOnce(&Source) -> Parsed<M>,
) -> Option<Layer<M>> {
    let source = loader.source(path, asked_at)?;
    let parsed = parse(&loader.sources[source]);
    loader.findings.extend(parsed.diagnostics.iter().map(|d| d.finding(source)));
    let features = parsed.model.iter().flat_map(Model::features);
    let features = features.filter(|(feature, _)| *feature != evaluated);
    loader.findings.extend(features.map(|(feature, span)| {
        let message = format!("a mission does not support {feature}");
        Finding::error("E0709", Place { source, span }, message)
    }));
    parsed.model.map(|model| Layer { source, model })
}

fn agents(
    loader: &mut Loader<'_>,
    folder: &str,
    asked_at: Place,
    vocabulary: &Domain,
) -> Option<Vec<Layer<Domain>>> {
    let names = loader.names(folder, ".pddl", asked_at);
    let parsed: Vec<Option<Layer<Domain>>> = names
        .iter()
        .map(|name| parse(loader, &join(folder, name), asked_at, |s| pddl::parse_domain(s, &[vocabulary])))
        .collect();
    parsed.into_iter().collect()
}

/// The invariants of the robot and of the test. Either file may be missing, but not both, unless the manifest says so.
fn safety(
    loader: &mut Loader<'_>,
    from: SourceId,
    manifest: &Manifest,
    robot: &Domain,
    nodes: &Domain,
) -> Option<Vec<Layer<Domain>>> {
    let here = Place { source: from, span: manifest.no_invariants.unwrap_or_default() };
    let mut layers = Vec::new();
    // The robot's invariants know the nodes of the world only, so that they fit every test.
    for (path, known) in [(&manifest.paths.robot_safety, robot), (&manifest.paths.safety, nodes)] {
        if loader.files.read(path).err() != Some(FileError::NotFound) {
            let read = |source: &Source| pddl::parse_domain(source, &[known]);
            layers.push(parse_with(loader, path, here, Feature::Invariants, read)?);
        }
    }
    let mut all = layers.iter().flat_map(|layer| layer.model.invariants.iter().map(|i| (layer.source, i)));
    let first = all.next();
    match (first, manifest.no_invariants) {
        (None, None) => {
            let message = "the mission has no invariants: nothing says what must never happen in a run";
            let help = format!(
                "write `(:invariant …)` into `{}` or `{}`, or say `invariants = \"none\"`",
                manifest.paths.safety, manifest.paths.robot_safety
            );
            loader.findings.push(Finding::error("E0710", here, message).help(help));
        }
        (Some((source, invariant)), Some(_)) => {
            let message = "`invariants = \"none\"`, but there are some";
            let place = Place { source, span: invariant.name_span };
            let finding = Finding::error("E0711", here, message);
            loader.findings.push(finding.related(place, format!("`{}` is one", invariant.name)));
        }
        _ => {}
    }
    twice(loader, &layers);
    Some(layers)
}

/// Reports invariants of the test that have the name of one of the robot's: a report could not tell them apart.
fn twice(loader: &mut Loader<'_>, layers: &[Layer<Domain>]) {
    let [robot, test] = layers else { return };
    for invariant in &test.model.invariants {
        if let Some(first) = robot.model.invariants.iter().find(|i| i.name == invariant.name) {
            let place = Place { source: test.source, span: invariant.name_span };
            let message = format!("the robot has an invariant `{}` already", invariant.name);
            let at = Place { source: robot.source, span: first.name_span };
            loader.findings.push(Finding::error("E0712", place, message).related(at, "here"));
        }
    }
}

/// The vocabulary with the objects of `problem` as constants. The vocabulary's own constants come first among them.
fn with_nodes(vocabulary: &Domain, problem: &Problem) -> Domain {
    Domain { constants: problem.objects.clone(), ..vocabulary.clone() }
}

fn tokens(
    loader: &mut Loader<'_>,
    from: SourceId,
    manifest: &Manifest,
    nodes: &Domain,
) -> Option<NamedTokens> {
    let mut resolve = Resolve { loader, from };
    let types: Vec<&str> = nodes.types.enumerate().map(|(_, t)| t.name.as_str()).collect();
    let predicates: Vec<&str> = nodes.predicates.enumerate().map(|(_, p)| p.name.as_str()).collect();
    let functions: Vec<&str> = nodes.functions.enumerate().map(|(_, f)| f.name.as_str()).collect();
    let constants: Vec<&str> = nodes.constants.enumerate().map(|(_, o)| o.name.as_str()).collect();

    let (report, words) = (&manifest.report, &manifest.words);
    let document = resolve.name("node", &report.document, &constants, nodes.constant(&report.document.name));
    let mut ty = |m: &Mention| resolve.name("type", m, &types, nodes.types.find(&m.name));
    let (items, utterances, parts, requests) =
        (ty(&report.items), ty(&words.utterances), ty(&words.parts), ty(&words.requests));
    let mut predicate = |m: &Mention| resolve.name("predicate", m, &predicates, nodes.predicate(&m.name));
    let (offers, answer, unanswered) =
        (predicate(&report.offers), predicate(&report.answer), predicate(&report.unanswered));
    for mention in report.sensed.iter().chain(&report.lasting) {
        predicate(mention)?;
    }
    let score = resolve.name("function", &report.score, &functions, nodes.function(&report.score.name));
    Some(NamedTokens {
        document: document?,
        items: items?,
        offers: offers?,
        answer: answer?,
        unanswered: unanswered?,
        score: score?,
        utterances: utterances?,
        parts: parts?,
        requests: requests?,
    })
}

/// Looks up names of the manifest, and reports those that are missing.
struct Resolve<'l, 'f> {
    loader: &'l mut Loader<'f>,
    from: SourceId,
}

impl Resolve<'_, '_> {
    fn name<T>(&mut self, kind: &str, mention: &Mention, known: &[&str], found: Option<T>) -> Option<T> {
        if found.is_none() {
            let place = Place { source: self.from, span: mention.span };
            let help = did_you_mean(&mention.name, known.iter().copied());
            let message = format!("the graph has no {kind} `{}`", mention.name);
            self.loader.findings.push(Finding::error("E0706", place, message).help_if(help));
        }
        found
    }
}
