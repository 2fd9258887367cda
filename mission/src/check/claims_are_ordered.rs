//! C0701: two rules that claim the same resource and have the same priority.
//!
//! **What** Different rules, of any agents, that claim the same resource differ in priority.
//! **Why** Otherwise the order of commits would decide which rule speaks first, and the other would wait for
//! a sentence that may never end.
//! **Example** `say` and `call-out` both `:claims (loudspeaker) :priority 50`.

use std::collections::BTreeMap;

use pddl::model::{Name, Term};

use super::context::Context;
use diagnostics::{Finding, Place};

pub(super) fn check(context: &Context<'_>, findings: &mut Vec<Finding>) {
    let mission = context.mission;
    let mut claimed: BTreeMap<(Name, i32), (Name, Place)> = BTreeMap::new();
    for agent in &mission.layers.agents {
        for (_, action) in agent.model.durative_actions.enumerate() {
            let Some(rule) = &action.rule else { continue };
            for claim in &rule.claims {
                let resource = match claim {
                    Term::Object(id) => &agent.model.constants[*id].name,
                    Term::Variable(id) => &action.variables[*id].name,
                };
                let place = Place { source: agent.source, span: action.name_span };
                let key = (resource.clone(), rule.priority);
                if let Some((other, first)) = claimed.get(&key) {
                    let message = format!(
                        "`{}` and `{other}` claim `{resource}` with the same priority {}",
                        action.name, rule.priority
                    );
                    findings
                        .push(Finding::error("C0701", place, message).related(*first, format!("`{other}`")));
                } else {
                    claimed.insert(key, (action.name.clone(), place));
                }
            }
        }
    }
}
