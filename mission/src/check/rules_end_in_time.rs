//! C0304: a rule that ends later than the intention that it serves.
//!
//! **What** A rule with effects `at timeout` that waits, over all its time, for what an intention writes at its start, and
//! that brings about what the intention waits for, has a shorter duration than the intention.
//! **Why** When the intention's deadline comes first, what it wrote is withdrawn and a reflex stops the rule: its effects
//! `at timeout` never happen. A silence is then no silence but a failure of the robot.
//! **Example** `hear` listens for 40 seconds, and the intention `await-answer` fails after 30.

use std::collections::BTreeSet;

use pddl::model::{Comparison, DurativeAction, ExpressionKind, Name, TimeSpecifier};

use super::context::Context;
use super::tokens::Tokens;
use diagnostics::{Finding, Place};

pub(super) fn check(context: &Context<'_>, findings: &mut Vec<Finding>) {
    let (grounding, layers) = (context.grounding, &context.mission.layers);
    let methods = &layers.methods;
    let mut reported = BTreeSet::new();
    for (id, bindings) in grounding.intentions() {
        let intention = &methods.model.durative_actions[id];
        let Some(deadline) = seconds(intention) else { continue };
        for binding in bindings {
            let start = grounding.effects(intention, binding, |when| *when == TimeSpecifier::Start);
            let end = grounding.effects(intention, binding, |when| *when == TimeSpecifier::End);
            for instance in &grounding.rules {
                let agent = &layers.agents[instance.agent];
                let rule = &agent.model.durative_actions[instance.rule];
                let timeout = TimeSpecifier::Outcome(Name::new("timeout"));
                let Some(limit) = seconds(rule).filter(|limit| *limit >= deadline) else { continue };
                let mut lasting = Tokens::of(&agent.model);
                let over_all = rule.conditions.iter().filter(|timed| timed.when == TimeSpecifier::OverAll);
                over_all.for_each(|timed| lasting.condition(&timed.condition));
                let held = |fact: &&super::grounding::Fact| {
                    instance.waits_for.contains(*fact) && lasting.names.contains(&fact.symbol)
                };
                let serves = start.true_.iter().any(|fact| held(&fact))
                    && end.true_.iter().any(|fact| instance.writes.may_hold(fact));
                let handles = rule.effects.iter().any(|effect| effect.when == timeout);
                if !serves || !handles || !reported.insert((id, instance.agent, instance.rule)) {
                    continue;
                }
                let place = Place { source: agent.source, span: rule.name_span };
                let message = format!(
                    "`{}` has {limit} s, but the intention `{}`, which starts it, fails after {deadline} s",
                    rule.name, intention.name
                );
                let at = Place { source: methods.source, span: intention.name_span };
                let help =
                    "its effects `at timeout` never happen then: give the intention more time than the rule";
                let finding = Finding::warning("C0304", place, message).help(help);
                findings.push(finding.related(at, format!("`{}`", intention.name)));
            }
        }
    }
}

/// The longest time that a rule or an intention takes, in seconds.
fn seconds(action: &DurativeAction) -> Option<f64> {
    let bounds = action.duration.iter().filter_map(|constraint| {
        match (&constraint.comparison, &constraint.bound.kind) {
            (Comparison::LessEqual | Comparison::Equal, ExpressionKind::Number(seconds)) => Some(*seconds),
            _ => None,
        }
    });
    bounds.reduce(f64::min)
}
