//! C0501, C0502: a name of another layer that is not a node of the graph.
//!
//! **What** Each object of `problem.pddl` whose type is in the vocabulary is a node of the initial graph, of
//! that type; so is each constant of `perception.pddl` and `methods.hddl`.
//! **Why** Perception derives facts about nodes only; it never perceives a fact about another object.
//! **Example** `drinks - item` in the problem, `drink - item` in the graph.

use pddl::model::{Domain, Object};

use super::context::Context;
use crate::mission::Mission;
use diagnostics::did_you_mean;
use diagnostics::{Finding, Place, SourceId};

pub(super) fn check(context: &Context<'_>, findings: &mut Vec<Finding>) {
    let mission = context.mission;
    let layers = &mission.layers;
    let (domain, problem) = (&layers.domain.model, &layers.problem);
    for (_, object) in problem.model.objects.enumerate() {
        check_name(mission, domain, object, problem.source, "C0501", findings);
    }
    for layer in [&layers.perception, &layers.methods] {
        let constants = layer.model.constants.enumerate().map(|(_, c)| c);
        // Imported constants are nodes.
        for constant in constants.filter(|c| layers.nodes.constant(&c.name).is_none()) {
            check_name(mission, &layer.model, constant, layer.source, "C0502", findings);
        }
    }
}

fn check_name(
    mission: &Mission,
    domain: &Domain,
    object: &Object,
    source: SourceId,
    code: &'static str,
    findings: &mut Vec<Finding>,
) {
    let layers = &mission.layers;
    let types = &layers.nodes.types;
    for ty in object.types.declared().iter().filter_map(|&t| types.find(&domain.types[t].name)) {
        if layers.graph.model.object(&object.name).is_some_and(|id| layers.is_a(id, ty)) {
            continue;
        }
        let place = Place { source, span: object.span };
        let message = format!("the graph has no node `{}` of type `{}`", object.name, types[ty].name);
        let nodes = layers.graph.model.objects.ids().filter(|&id| layers.is_a(id, ty));
        let help = did_you_mean(&object.name, nodes.map(|id| layers.name(id)));
        findings.push(Finding::error(code, place, message).help_if(help));
    }
}
