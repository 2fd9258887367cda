//! C0901, C0902: an item of the report that the plan never asks, or whose option has no score.
//!
//! **What** Each node of the type of items is an object of `problem.pddl`, and each option that it offers has a score.
//! **Why** A plan speaks of the problem's objects only: the item is never asked, and the report says "not reached".
//! An option without a score counts as nothing, and a total that is too low looks like any other.
//! **Example** `(offers bathing option-2)` without `(= (score bathing option-2) 0)`.

use pddl::model::{FluentValue, ObjectId};

use super::context::Context;
use crate::mission::Mission;
use diagnostics::{Finding, Place};

pub(super) fn check(context: &Context<'_>, findings: &mut Vec<Finding>) {
    let mission = context.mission;
    let layers = &mission.layers;
    let graph = &layers.graph;
    for item in layers.items() {
        let name = layers.name(item);
        let place = Place { source: graph.source, span: graph.model.objects[item].span };
        if layers.problem.model.object(name).is_none() {
            let message = format!("no plan asks the item `{name}`: it is no object of the problem");
            let help = format!("add `{name}` to the objects of the problem, and its place in the order");
            findings.push(Finding::error("C0901", place, message).help(help));
        }
        for option in layers.options(item) {
            if !has_score(mission, item, option) {
                let (score, option) = (&mission.manifest.report.score.name, layers.name(option));
                let message = format!("the option `{option}` of the item `{name}` has no score");
                let help = format!("add (= ({score} {name} {option}) N) to the graph; 0 is a score");
                findings.push(Finding::error("C0902", place, message).help(help));
            }
        }
    }
}

fn has_score(mission: &Mission, item: ObjectId, option: ObjectId) -> bool {
    let layers = &mission.layers;
    layers.graph.model.fluents.iter().any(|fluent| {
        let application = &fluent.application;
        application.function == layers.tokens.score
            && application.arguments == [item, option]
            && matches!(fluent.value, FluentValue::Number(_))
    })
}
