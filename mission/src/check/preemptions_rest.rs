//! C0702: a rule that another one starts, only to be preempted by it.
//!
//! **What** No rule waits for what another rule writes when it starts, if it takes that rule's resource by a higher
//! priority.
//! **Why** The first rule starts, the second one aborts it in the same instant, and the first one starts again: no time
//! passes between them.
//! **Example** A rule of priority 100 that claims `loudspeaker` as soon as `(is ?r speaking)`, beside `say` of priority 50.

use std::collections::BTreeSet;

use pddl::model::{DurativeAction, Name, Term};

use super::context::Context;
use crate::mission::Mission;
use diagnostics::{Finding, Place};

pub(super) fn check(context: &Context<'_>, findings: &mut Vec<Finding>) {
    let (mission, grounding) = (context.mission, context.grounding);
    let mut reported = BTreeSet::new();
    for victim in &grounding.rules {
        let (first, first_place) = rule(mission, victim.agent, victim.rule);
        if claims(mission, victim.agent, first).is_empty() {
            continue;
        }
        for other in &grounding.rules {
            let (second, place) = rule(mission, other.agent, other.rule);
            let preempts = priority(second) > priority(first)
                && !claims(mission, victim.agent, first).is_disjoint(&claims(mission, other.agent, second));
            if !preempts || reported.contains(&(victim.agent, victim.rule, other.agent, other.rule)) {
                continue;
            }
            if let Some(fact) = victim.start.true_.iter().find(|fact| other.waits_for.contains(fact)) {
                reported.insert((victim.agent, victim.rule, other.agent, other.rule));
                let message = format!(
                    "`{}` waits for `{}`, which `{}` writes when it starts, and takes its resource",
                    second.name,
                    fact.text(&grounding.classes),
                    first.name
                );
                let finding = Finding::warning("C0702", place, message);
                findings.push(finding.related(first_place, format!("`{}`", first.name)));
            }
        }
    }
}

fn rule(mission: &Mission, agent: usize, id: pddl::model::DurativeActionId) -> (&DurativeAction, Place) {
    let agent = &mission.layers.agents[agent];
    let rule = &agent.model.durative_actions[id];
    (rule, Place { source: agent.source, span: rule.name_span })
}

fn priority(rule: &DurativeAction) -> i32 {
    rule.rule.as_ref().map_or(0, |rule| rule.priority)
}

fn claims<'m>(mission: &'m Mission, agent: usize, rule: &'m DurativeAction) -> BTreeSet<&'m Name> {
    let domain = &mission.layers.agents[agent].model;
    let claims = rule.rule.iter().flat_map(|rule| &rule.claims);
    let names = claims.map(|claim| match claim {
        Term::Object(id) => &domain.constants[*id].name,
        Term::Variable(id) => &rule.variables[*id].name,
    });
    names.collect()
}
