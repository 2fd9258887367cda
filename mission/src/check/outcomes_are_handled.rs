//! C0801, C0802: an outcome that a rule does not handle, and a waiver that waives nothing.
//!
//! **What** A rule has effects for every outcome of its skill, and `at timeout` if it has a duration; or a comment in the
//! rule waives the outcome and gives the reason: `; waive(failure): the console is tried again at once`.
//! **Why** An outcome without effects has the effects of `abort`: a device that failed is then not reported, and is used
//! again as if it worked.
//! **Example** `:skill (deliver ?d)` without `at failure`.

use std::collections::BTreeSet;

use pddl::model::{Domain, DurativeAction, TimeSpecifier};
use pddl::syntax::{self, TokenKind};
use pddl::{Source, Span};

use super::context::Context;
use crate::layers::Layer;
use diagnostics::{Finding, Place};

/// A comment that waives an outcome.
struct Waiver {
    outcome: String,
    has_reason: bool,
    span: Span,
}

pub(super) fn check(context: &Context<'_>, findings: &mut Vec<Finding>) {
    for agent in &context.mission.layers.agents {
        let waivers = waivers(&context.mission.sources[agent.source]);
        for (_, rule) in agent.model.durative_actions.enumerate() {
            let own: Vec<&Waiver> = waivers
                .iter()
                .filter(|w| rule.span.start <= w.span.start && w.span.end <= rule.span.end)
                .collect();
            one(context, agent, rule, &own, findings);
        }
    }
}

fn one(
    context: &Context<'_>,
    agent: &Layer<Domain>,
    rule: &DurativeAction,
    waivers: &[&Waiver],
    findings: &mut Vec<Finding>,
) {
    let skill = rule.rule.as_ref().and_then(|rule| rule.skill.as_ref());
    // A skill that nobody knows is an error of the rule's compilation.
    let Some(outcomes) = skill.and_then(|skill| context.skills.get(skill.name.as_str())) else { return };
    let timeout = (!rule.duration.is_empty()).then_some("timeout");
    let possible: BTreeSet<&str> = outcomes.iter().copied().chain(timeout).collect();
    let handled: BTreeSet<&str> = rule
        .effects
        .iter()
        .filter_map(|effect| match &effect.when {
            TimeSpecifier::Outcome(name) => Some(name.as_str()),
            _ => None,
        })
        .collect();
    for &outcome in possible.difference(&handled) {
        if waivers.iter().any(|w| w.outcome == outcome && w.has_reason) {
            continue;
        }
        let place = Place { source: agent.source, span: rule.name_span };
        let message = format!("`{}` does not handle the outcome `{outcome}`", rule.name);
        let help = format!("add effects `at {outcome}`, or a comment `; waive({outcome}): REASON`");
        findings.push(Finding::warning("C0801", place, message).help(help));
    }
    for waiver in waivers {
        let outcome = waiver.outcome.as_str();
        let place = Place { source: agent.source, span: waiver.span };
        let message = if !possible.contains(outcome) {
            format!("`{}` cannot end with the outcome `{outcome}`", rule.name)
        } else if handled.contains(outcome) {
            format!("`{}` handles the outcome `{outcome}`, which this waives", rule.name)
        } else if !waiver.has_reason {
            "a waiver needs a reason: `; waive(OUTCOME): REASON`".to_owned()
        } else {
            continue;
        };
        findings.push(Finding::warning("C0802", place, message));
    }
}

/// The waivers in a file.
fn waivers(source: &Source) -> Vec<Waiver> {
    if !source.text().contains("waive(") {
        return Vec::new();
    }
    let (tree, _) = syntax::parse(source);
    let mut waivers = Vec::new();
    for (kind, span) in tree.tokens() {
        if kind != TokenKind::Comment {
            continue;
        }
        let said = source.slice(span).trim_start_matches([';', ' ', '\t']);
        let Some((outcomes, rest)) = said.strip_prefix("waive(").and_then(|rest| rest.split_once(')')) else {
            continue;
        };
        let has_reason = rest.strip_prefix(':').is_some_and(|reason| !reason.trim().is_empty());
        let each = outcomes.split(',').map(|o| Waiver { outcome: o.trim().to_owned(), has_reason, span });
        waivers.extend(each);
    }
    waivers
}
