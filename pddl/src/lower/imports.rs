//! `(:import a b)`: declarations of other domains, under this domain's ids.
//!
//! Types, constants, predicates and functions are imported; actions, axioms, tasks and methods are not.
//! Symbols of two imports with one name are one symbol if their declarations agree, else an error at the
//! import's name. A derived predicate of an import is a basic one here, since its axioms are not imported.

use super::header::Header;
use super::predicates::same_parameters;
use super::sink::Sink;
use super::world::World;
use crate::Span;
use crate::diagnostic::{DiagnosticKind, SymbolKind};
use crate::model::{
    Domain, Function, FunctionValue, Name, Object, ObjectTypes, Predicate, TypeId, TypeSet, Variable,
    Variables,
};
use crate::occurrence::NameKind;

/// The imported domains with the places of their names.
pub(crate) fn imports<'d>(
    sink: &mut Sink,
    header: &Header<'_>,
    given: &[&'d Domain],
) -> Vec<(&'d Domain, Span)> {
    let mut found: Vec<(&Domain, Span)> = Vec::new();
    for section in header.all(":import").chain(header.all(":extends")) {
        for node in section.children().skip(1) {
            if !node.is_name() {
                sink.unexpected(node, "the name of a domain");
                continue;
            }
            sink.mention(NameKind::Domain, node, None);
            match given.iter().find(|d| node.is(&d.name)) {
                Some(domain) if found.iter().any(|(d, _)| d.name == domain.name) => {
                    sink.report(node.span(), DiagnosticKind::Repeated { name: node.text().to_owned() });
                }
                Some(domain) => found.push((domain, node.span())),
                None => {
                    let name = node.text().to_owned();
                    let suggestion = sink.suggest(&name, given.iter().map(|d| d.name.as_str()));
                    let symbol = SymbolKind::Domain;
                    sink.report(node.span(), DiagnosticKind::Unknown { symbol, name, suggestion });
                }
            }
        }
    }
    found
}

/// Declares the symbols of the domains in `world`, whose types include theirs already.
pub(crate) fn declare(world: &mut World, sink: &mut Sink, imports: &[(&Domain, Span)]) {
    for (i, &(domain, span)) in imports.iter().enumerate() {
        let earlier: Vec<&Domain> = imports[..i].iter().map(|(d, _)| *d).collect();
        let mut conflict = |symbol, name: &Name, origin: Option<&&Domain>| {
            let import = origin.map_or_else(|| domain.name.clone(), |d| d.name.clone());
            sink.report(span, DiagnosticKind::ImportConflict { symbol, name: name.clone(), import });
        };
        for object in &domain.constants {
            let types = ObjectTypes::each_of(map_types(world, domain, object.types.declared()));
            match world.object(&object.name) {
                Some(first) if world.objects[first].types == types => {}
                Some(_) => {
                    let origin = earlier.iter().find(|d| d.constant(&object.name).is_some());
                    conflict(SymbolKind::Object, &object.name, origin);
                }
                None => {
                    world.add_object(Object { name: object.name.clone(), types, span: Span::default() });
                }
            }
        }
        for predicate in &domain.predicates {
            let variables = map_variables(world, domain, &predicate.variables);
            match world.predicate(&predicate.name) {
                Some(first) if same_parameters(&world.predicates[first].variables, &variables) => {}
                Some(_) => {
                    let origin = earlier.iter().find(|d| d.predicate(&predicate.name).is_some());
                    conflict(SymbolKind::Predicate, &predicate.name, origin);
                }
                None => {
                    let name = predicate.name.clone();
                    world.add_predicate(Predicate { name, variables, derived: false, span: Span::default() });
                }
            }
        }
        for function in &domain.functions {
            let variables = map_variables(world, domain, &function.variables);
            let value = match &function.value {
                FunctionValue::Number => FunctionValue::Number,
                FunctionValue::Object(types) => FunctionValue::Object(map_types(world, domain, &types.0)),
            };
            match world.function(&function.name).map(|f| &world.functions[f]) {
                Some(first) if first.value == value && same_parameters(&first.variables, &variables) => {}
                Some(_) => {
                    let origin = earlier.iter().find(|d| d.function(&function.name).is_some());
                    conflict(SymbolKind::Function, &function.name, origin);
                }
                None => {
                    let name = function.name.clone();
                    world.add_function(Function { name, variables, value, span: Span::default() });
                }
            }
        }
    }
}

fn map_types(world: &World, from: &Domain, types: &[TypeId]) -> TypeSet {
    let here = types.iter().filter_map(|&t| world.type_id(&from.types[t].name)).collect();
    TypeSet(here)
}

fn map_variables(world: &World, from: &Domain, variables: &Variables) -> Variables {
    let slots = variables
        .slots
        .iter()
        .map(|v| Variable {
            name: v.name.clone(),
            types: map_types(world, from, &v.types.0),
            span: Span::default(),
        })
        .collect();
    Variables { slots, parameters: variables.parameters }
}
