//! `(define (problem …) …)`, with the declarations of its domain.

use super::body::Body;
use super::constants::{Foreign, objects};
use super::constraint::constraints;
use super::header::{Header, header};
use super::htn::initial_network;
use super::init::Init;
use super::metric::{constraint_names, names, preference_names};
use super::requirements::requirements;
use super::sink::{Lowered, Sink, first_word};
use super::world::World;
use crate::diagnostic::{DiagnosticKind, FileKind, UnsupportedFeature};
use crate::model::{Condition, Domain, Fact, Name, ObjectId, PredicateId, Preference, Problem, Variables};
use crate::occurrence::NameKind;
use crate::syntax::{Node, Tree};
use rustc_hash::FxHashSet;

const SECTIONS: &[&str] = &[
    ":domain",
    ":requirements",
    ":objects",
    ":init",
    ":goal",
    ":metric",
    ":htn",
    ":constraints",
    ":situation",
    ":goal-reward",
    ":goal-probability",
    // Limits the length of a plan; PDDL 1.2 only, and no planner reads it.
    ":length",
];

pub(crate) fn problem(mut sink: Sink, tree: &Tree<'_>, domain: &Domain) -> Lowered<Problem> {
    let problem = header(&mut sink, tree, FileKind::Problem, SECTIONS).map(|h| read(&mut sink, &h, domain));
    let mut finished = sink.finish();
    let draft = problem.map(|mut problem| {
        problem.unsupported = std::mem::take(&mut finished.unsupported);
        problem
    });
    Lowered::new(draft, finished)
}

fn read(sink: &mut Sink, header: &Header<'_>, domain: &Domain) -> Problem {
    check_domain(sink, header, domain);
    let requirements = requirements(sink, header);
    let mut world = World::of(domain);
    let foreign = Foreign { count: world.objects.len(), repeatable: false, imports: &[] };
    objects(&mut world, sink, header.all(":objects"), foreign);

    let mut body = Body::new(&world, sink);
    let mut init = Init::default();
    if let Some(section) = header.one(body.sink, ":init") {
        body.init(section.children().skip(1), &mut init);
    }
    timeless(domain, header, &mut init);
    for (key, feature) in OTHERS {
        for section in header.all(key) {
            sink.unsupported(first_word(section), *feature);
        }
    }
    let constraints = constraints(&world, sink, header.all(":constraints"), std::iter::empty());
    let network = header.one(sink, ":htn");
    let htn = network.map(|section| initial_network(&world, sink, section));
    let ((goal, preferences), goal_variables, goal_span) = goal(&world, sink, header, network);
    let metric = header.one(sink, ":metric").and_then(|section| {
        let mut known = preference_names(domain);
        names(&preferences, &mut known);
        constraint_names(&constraints, &mut known);
        Body::new(&world, sink).metric(section, &known)
    });
    Problem {
        name: header.name.clone(),
        requirements,
        init: init.facts,
        fluents: init.fluents,
        timed: init.timed,
        goal_variables,
        goal,
        preferences,
        constraints,
        metric,
        htn,
        unsupported: Vec::new(),
        goal_span,
        objects: super::constants::take(&mut world),
    }
}

/// Sections that are read but not modelled.
const OTHERS: &[(&str, UnsupportedFeature)] = &[
    (":situation", UnsupportedFeature::Situations),
    (":goal-reward", UnsupportedFeature::Rewards),
    (":goal-probability", UnsupportedFeature::Rewards),
];

/// Adds the domain's timeless facts that `:init` does not repeat.
fn timeless(domain: &Domain, header: &Header<'_>, init: &mut Init) {
    if domain.timeless.is_empty() {
        return;
    }
    let known: FxHashSet<(PredicateId, Vec<ObjectId>)> =
        init.facts.iter().map(|f| (f.predicate, f.arguments.clone())).collect();
    let place = header.all(":init").next().unwrap_or(header.define);
    let more = domain.timeless.iter().filter(|f| !known.contains(&(f.predicate, f.arguments.clone())));
    init.facts.extend(more.map(|f| Fact { span: first_word(place), ..f.clone() }));
}

fn check_domain(sink: &mut Sink, header: &Header<'_>, domain: &Domain) {
    let Some(section) = header.one(sink, ":domain") else {
        return sink.missing(header.define, "the problem", "`(:domain NAME)`");
    };
    let name = section.children().nth(1);
    if let Some(name) = name.filter(|n| n.is_name()) {
        sink.mention(NameKind::Domain, name, None);
    }
    match name {
        Some(name) if name.is(&domain.name) => {}
        Some(name) if name.is_name() => {
            let (found, expected) = (Name::new(name.text()), domain.name.clone());
            sink.report(name.span(), DiagnosticKind::OtherDomain { found, expected });
        }
        Some(other) => sink.unexpected(other, "the name of a domain"),
        None => sink.missing(section, "`:domain`", "name"),
    }
}

/// A condition and the preferences beside it.
type SoftCondition = (Condition, Vec<Preference<Condition>>);

fn goal(
    world: &World,
    sink: &mut Sink,
    header: &Header<'_>,
    network: Option<Node<'_>>,
) -> (SoftCondition, Variables, crate::Span) {
    let section = header.one(sink, ":goal");
    let Some(section) = section else {
        if network.is_none() {
            sink.missing(header.define, "the problem", "`(:goal …)`");
        }
        let span = first_word(network.unwrap_or(header.define));
        return ((Condition::always(span), Vec::new()), Variables::default(), span);
    };
    let mut body = Body::new(world, sink);
    body.schema.scope = section.span();
    let goal = match body.parts(section, "`(:goal CONDITION)`") {
        Some([node]) => body.soft_condition(node),
        None => (Condition::always(section.span()), Vec::new()),
    };
    (goal, body.schema.variables, section.span())
}
