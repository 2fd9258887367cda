//! C0401: a derived predicate that depends on a token that is never written.
//!
//! **What** Each token in a body of `perception.pddl` is written by a rule of an agent or by an intention,
//! holds in the initial graph, is computed by the graph, or is derived itself.
//! **Why** The value of such a predicate never changes: a plan waits for it in vain, or relies on it wrongly.
//! **Example** `(:derived (present ?p) (exists (?r - robot) (is_wth ?p ?r)))` after renaming a token.

use super::context::Context;
use super::tokens::{Tokens, written_by_intentions, written_by_rules};
use diagnostics::{Finding, Place};

pub(super) fn check(context: &Context<'_>, findings: &mut Vec<Finding>) {
    let mission = context.mission;
    let layers = &mission.layers;
    let (perception, nodes) = (&layers.perception, &layers.nodes);
    let mut written = written_by_rules(mission);
    written.append(&mut written_by_intentions(mission));
    for problem in [&layers.world.model, &layers.graph.model] {
        written.extend(problem.init.iter().map(|f| nodes.predicates[f.predicate].name.clone()));
        let fluents = problem.fluents.iter();
        written.extend(fluents.map(|f| nodes.functions[f.application.function].name.clone()));
    }
    let axioms = &perception.model.axioms;
    written.extend(axioms.iter().map(|a| perception.model.predicates[a.predicate].name.clone()));
    // An initial fact of the planning problem holds for ever unless perception derives its predicate.
    let (domain, problem) = (&layers.domain.model, &layers.problem.model);
    written.extend(problem.init.iter().map(|f| domain.predicates[f.predicate].name.clone()));
    let of_axioms = axioms.iter().map(|axiom| {
        let mut looked_at = Tokens::of(&perception.model);
        looked_at.condition(&axiom.body);
        (&perception.model.predicates[axiom.predicate].name, axiom.span, looked_at)
    });
    let of_functions = perception.model.derived_functions.iter().map(|function| {
        let mut looked_at = Tokens::of(&perception.model);
        looked_at.derived(function);
        (&perception.model.functions[function.function].name, function.span, looked_at)
    });
    for (head, span, looked_at) in of_axioms.chain(of_functions) {
        for name in looked_at.names.difference(&written) {
            // Numbers between frames are computed from poses.
            if nodes.function(name).is_some() {
                continue;
            }
            let place = Place { source: perception.source, span };
            let message = format!("`{head}` depends on `{name}`, which is never written");
            findings.push(Finding::warning("C0401", place, message));
        }
    }
}
