//! C0303: a rule that never starts.
//!
//! **What** For some binding, everything that a rule needs to start may hold in some state of some run.
//! **Why** A rule that never starts is a reaction that the author believes to have, such as a call for help.
//! **Example** `(at start (asks ?p hlep))` after renaming the request.

use super::context::Context;
use super::nearest::{blocked, one_line};
use diagnostics::{Finding, Place};

pub(super) fn check(context: &Context<'_>, findings: &mut Vec<Finding>) {
    let grounding = context.grounding;
    for (position, agent) in context.mission.layers.agents.iter().enumerate() {
        for (id, rule) in agent.model.durative_actions.enumerate() {
            if grounding.rules.iter().any(|i| i.agent == position && i.rule == id) {
                continue;
            }
            let place = Place { source: agent.source, span: rule.name_span };
            let message = format!("`{}` never starts", rule.name);
            let mut scope = grounding.scope(&agent.model, &rule.variables);
            let help = blocked(grounding, &mut scope, rule).map(|condition| {
                let text = context.mission.sources[agent.source].slice(condition.span);
                format!("`{}` never holds", one_line(text))
            });
            findings.push(Finding::warning("C0303", place, message).help_if(help));
        }
    }
}
