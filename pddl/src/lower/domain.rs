//! `(define (domain …) …)`: the sections in the order in which they depend on each other.
//!
//! Sections may stand in any order in the source. Declarations are read first, then the sections that use
//! them: types, constants, predicates, functions; which predicates are derived; actions, durative actions,
//! axioms; tasks, then methods, which may name all of them.

use super::action::action;
use super::axiom::{axiom, derived_predicate, implication, implied_predicate};
use super::body::Body;
use super::constants::{Foreign, objects};
use super::constraint::constraints;
use super::derived_function::{derived_function, derives_function};
use super::durative::durative_action;
use super::functions::functions;
use super::header::{Header, header};
use super::htn::{method, task};
use super::init::Init;
use super::invariant::invariant;
use super::permissions::permission;
use super::predicates::predicates;
use super::process::{event, process};
use super::requirements::requirements;
use super::sink::{Lowered, Sink};
use super::types::types;
use super::world::World;
use super::{htn, imports, sink};
use crate::Span;
use crate::diagnostic::{DiagnosticKind, FileKind, Label, SymbolKind, UnsupportedFeature};
use crate::model::{Domain, Event, IndexVec, Invariant, Name, Process, SubtaskHead};
use crate::syntax::Tree;

const SECTIONS: &[&str] = &[
    ":requirements",
    ":import",
    ":types",
    ":constants",
    ":predicates",
    ":functions",
    ":action",
    ":durative-action",
    ":derived",
    ":task",
    ":method",
    ":writes",
    ":constraints",
    ":invariant",
    // PDDL 1.2.
    ":axiom",
    ":timeless",
    ":safety",
    ":extends",
    // Read by planners for PDDL+.
    ":constraint",
    ":tasks",
    ":process",
    ":event",
];

pub(crate) fn domain(mut sink: Sink, tree: &Tree<'_>, given: &[&Domain]) -> Lowered<Domain> {
    let domain = header(&mut sink, tree, FileKind::Domain, SECTIONS).map(|h| read(&mut sink, &h, given));
    let mut finished = sink.finish();
    let draft = domain.map(|mut domain| {
        domain.unsupported = std::mem::take(&mut finished.unsupported);
        domain
    });
    Lowered::new(draft, finished)
}

fn read(sink: &mut Sink, header: &Header<'_>, given: &[&Domain]) -> Domain {
    let requirements = requirements(sink, header);
    let imported = imports::imports(sink, header, given);
    let origins: Vec<&Domain> = imported.iter().map(|(d, _)| *d).collect();
    let mut world = World::new(requirements, types(sink, header, &origins));
    imports::declare(&mut world, sink, &imported);
    let foreign = Foreign { count: world.objects.len(), repeatable: true, imports: &origins };
    objects(&mut world, sink, header.all(":constants"), foreign);
    let count = world.predicates.len();
    predicates(&mut world, sink, header.all(":predicates"), count, &origins);
    let count = world.functions.len();
    functions(&mut world, sink, header.all(":functions"), count, &origins);
    for section in header.all(":axiom") {
        if let Some(id) = implied_predicate(&world, section) {
            world.predicates[id].derived = true;
        }
    }
    for section in header.all(":safety") {
        sink.unsupported(sink::first_word(section), UnsupportedFeature::SafetyConditions);
    }
    let mut timeless = Init::default();
    for section in header.all(":timeless") {
        Body::new(&world, sink).init(section.children().skip(1), &mut timeless);
    }
    for section in header.all(":derived") {
        if let Some(id) = derived_predicate(&world, section) {
            world.predicates[id].derived = true;
        }
    }

    let mut actions = IndexVec::new();
    let mut durative_actions = IndexVec::new();
    let mut tasks = IndexVec::new();
    for section in header.all(":action") {
        if let Some(action) = action(&world, sink, section) {
            let (name, parameters) = (action.name.clone(), action.variables.parameters().to_vec());
            unique(&world, sink, SymbolKind::Action, &name, action.name_span);
            let head = SubtaskHead::Action(actions.push(action));
            world.add_signature(&name, head, &parameters);
        }
    }
    for section in header.all(":durative-action") {
        if let Some(action) = durative_action(&world, sink, section) {
            let (name, parameters) = (action.name.clone(), action.variables.parameters().to_vec());
            unique(&world, sink, SymbolKind::Action, &name, action.name_span);
            let head = SubtaskHead::DurativeAction(durative_actions.push(action));
            world.add_signature(&name, head, &parameters);
        }
    }
    let processes = header.all(":process").filter_map(|s| process(&world, sink, s)).collect();
    let events = header.all(":event").filter_map(|s| event(&world, sink, s)).collect();
    distinct(sink, SymbolKind::Process, &processes, |p: &Process| (&p.name, p.name_span));
    distinct(sink, SymbolKind::Event, &events, |e: &Event| (&e.name, e.name_span));
    let constraints = constraints(&world, sink, header.all(":constraints"), header.all(":constraint"));
    let (of_functions, of_predicates): (Vec<_>, Vec<_>) =
        header.all(":derived").partition(|section| derives_function(&world, *section));
    let mut axioms: Vec<_> = of_predicates.into_iter().filter_map(|s| axiom(&world, sink, s)).collect();
    let derived_functions =
        of_functions.into_iter().filter_map(|s| derived_function(&world, sink, s)).collect();
    axioms.extend(header.all(":axiom").filter_map(|s| implication(&world, sink, s)));
    for section in header.all(":tasks") {
        for task in htn::tasks(&world, sink, section) {
            let (name, parameters) = (task.name.clone(), task.variables.parameters().to_vec());
            unique(&world, sink, SymbolKind::Task, &name, task.span);
            let head = SubtaskHead::Task(tasks.push(task));
            world.add_signature(&name, head, &parameters);
        }
    }
    for section in header.all(":task") {
        if let Some(task) = task(&world, sink, section) {
            let (name, parameters) = (task.name.clone(), task.variables.parameters().to_vec());
            unique(&world, sink, SymbolKind::Task, &name, sink::first_word(section));
            let head = SubtaskHead::Task(tasks.push(task));
            world.add_signature(&name, head, &parameters);
        }
    }
    let mut methods: IndexVec<_, crate::model::Method> = IndexVec::new();
    let mut names = rustc_hash::FxHashMap::default();
    for section in header.all(":method") {
        if let Some(method) = method(&world, sink, section) {
            let span = sink::first_word(section);
            if let Some(first) = names.insert(method.name.clone(), span) {
                let kind =
                    DiagnosticKind::Duplicate { symbol: SymbolKind::Method, name: method.name.clone() };
                sink.report_with(span, kind, first, Label::First);
            }
            methods.push(method);
        }
    }
    let invariants: Vec<_> = header.all(":invariant").filter_map(|s| invariant(&world, sink, s)).collect();
    distinct(sink, SymbolKind::Invariant, &invariants, |i: &Invariant| (&i.name, i.name_span));
    let permissions = header.all(":writes").filter_map(|s| permission(&world, sink, s)).collect();
    Domain {
        name: header.name.clone(),
        requirements: world.requirements,
        imports: origins.iter().map(|d| d.name.clone()).collect(),
        types: world.types,
        constants: world.objects,
        predicates: world.predicates,
        functions: world.functions,
        actions,
        durative_actions,
        processes,
        events,
        axioms,
        derived_functions,
        constraints,
        invariants,
        tasks,
        methods,
        permissions,
        timeless: timeless.facts,
        unsupported: Vec::new(),
    }
}

/// Reports names that are declared twice.
fn distinct<'a, T: 'a>(
    sink: &mut Sink,
    symbol: SymbolKind,
    all: impl IntoIterator<Item = &'a T>,
    name: impl Fn(&T) -> (&Name, Span),
) {
    let mut names = rustc_hash::FxHashMap::default();
    for item in all {
        let (name, span) = name(item);
        if let Some(first) = names.insert(name.clone(), span) {
            sink.report_with(
                span,
                DiagnosticKind::Duplicate { symbol, name: name.clone() },
                first,
                Label::First,
            );
        }
    }
}

/// Tasks and actions share one namespace, since a subtask names either.
fn unique(world: &World, sink: &mut Sink, symbol: SymbolKind, name: &Name, span: Span) {
    if world.task_or_action(name).is_some() {
        sink.report(span, DiagnosticKind::Duplicate { symbol, name: name.clone() });
    }
}
