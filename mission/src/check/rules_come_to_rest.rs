//! C0803, C0804: a rule that leaves behind what it wrote at its start, or starts again as soon as it has ended.
//!
//! **What** Each outcome of a rule takes back the facts that its effects at start added. After an outcome at which the
//! rule's work was done, some condition of the rule no longer holds.
//! **Why** Rules wait for states: `(is ?r speaking)` that nobody takes back stops the robot from ever speaking again, and
//! a rule whose condition still holds runs again at once.
//! **Example** `(at start (is ?r speaking))` without `(at timeout (not (is ?r speaking)))`.

use std::collections::{BTreeMap, BTreeSet};

use pddl::model::{
    AssignedValue, Condition, ConditionKind, Domain, DurativeAction, EffectKind, Idx, Name, Term,
    TimeSpecifier,
};

use super::context::Context;
use super::grounding::{conjuncts, list};
use crate::layers::Layer;
use diagnostics::{Finding, Place};

/// A token of a rule: its symbol and terms. A fluent has no value here.
type Token = (Name, Vec<Term>);

/// Outcomes after which a rule may start again: the runtime makes it wait, or time has passed.
const MAY_REPEAT: [&str; 3] = ["abort", "failure", "timeout"];

pub(super) fn check(context: &Context<'_>, findings: &mut Vec<Finding>) {
    for agent in &context.mission.layers.agents {
        for (_, rule) in agent.model.durative_actions.enumerate() {
            one(context, agent, rule, findings);
        }
    }
}

fn one(context: &Context<'_>, agent: &Layer<Domain>, rule: &DurativeAction, findings: &mut Vec<Finding>) {
    let domain = &agent.model;
    let place = Place { source: agent.source, span: rule.name_span };
    let start = writes(domain, rule, &TimeSpecifier::Start);
    for outcome in outcomes(context, domain, rule) {
        let time = time(&outcome);
        let handled = rule.effects.iter().any(|effect| effect.when == time);
        let abort = TimeSpecifier::Outcome(Name::new("abort"));
        let end = writes(domain, rule, if handled || outcome == "end" { &time } else { &abort });
        for (token, _) in start.iter().filter(|(token, added)| **added && end.get(*token) != Some(&false)) {
            let text = text(domain, rule, token);
            let message = format!("`{}` leaves `{text}` behind when it ends with `{outcome}`", rule.name);
            let help = format!("take it back: `(at {outcome} (not {text}))`");
            findings.push(Finding::warning("C0803", place, message).help(help));
        }
        if handled && !MAY_REPEAT.contains(&outcome.as_str()) && !rests(domain, rule, &start, &end) {
            let message = format!("`{}` starts again as soon as it has ended with `{outcome}`", rule.name);
            let help = format!("let an effect `at {outcome}` end a condition of the rule");
            findings.push(Finding::warning("C0804", place, message).help(help));
        }
    }
}

fn time(outcome: &str) -> TimeSpecifier {
    if outcome == "end" { TimeSpecifier::End } else { TimeSpecifier::Outcome(Name::new(outcome)) }
}

/// The outcomes with which a rule may end; none without a skill.
fn outcomes(context: &Context<'_>, domain: &Domain, rule: &DurativeAction) -> BTreeSet<String> {
    let Some(own) = &rule.rule else { return BTreeSet::new() };
    let Some(skill) = own.skill.as_ref().and_then(|skill| context.skills.get(skill.name.as_str())) else {
        return BTreeSet::new();
    };
    let mut all: BTreeSet<String> = skill.iter().map(|&outcome| outcome.to_owned()).collect();
    // A skill that only waits has no effects at its end.
    if rule.effects.iter().any(|effect| effect.when == TimeSpecifier::End) {
        all.insert("end".to_owned());
    }
    if !rule.duration.is_empty() {
        all.insert("timeout".to_owned());
    }
    if !own.claims.is_empty() || may_stop(domain, rule) {
        all.insert("abort".to_owned());
    }
    all
}

/// Whether a reflex may stop the rule while everything holds that it wrote at its start.
fn may_stop(domain: &Domain, rule: &DurativeAction) -> bool {
    let start = writes(domain, rule, &TimeSpecifier::Start);
    let mut conditions = Vec::new();
    let lasting = rule.conditions.iter().filter(|timed| timed.when == TimeSpecifier::OverAll);
    lasting.for_each(|timed| conjuncts(&timed.condition, &mut conditions));
    conditions.into_iter().any(|condition| match &condition.kind {
        ConditionKind::Atom(atom) => {
            let symbol = domain.predicates[atom.predicate].name.clone();
            start.get(&(symbol, atom.arguments.clone())) != Some(&true)
        }
        _ => true,
    })
}

/// What the effects at a time make true and false. A fluent counts as false: its old value ends.
fn writes(domain: &Domain, rule: &DurativeAction, when: &TimeSpecifier) -> BTreeMap<Token, bool> {
    let mut written = BTreeMap::new();
    for timed in rule.effects.iter().filter(|effect| effect.when == *when) {
        timed.effect.each(&mut |part| match &part.kind {
            EffectKind::Add(atom) => {
                let symbol = domain.predicates[atom.predicate].name.clone();
                written.insert((symbol, atom.arguments.clone()), true);
            }
            EffectKind::Delete(atom) => {
                let symbol = domain.predicates[atom.predicate].name.clone();
                written.entry((symbol, atom.arguments.clone())).or_insert(false);
            }
            EffectKind::Assign(_, application, AssignedValue::Undefined | AssignedValue::Object(_)) => {
                let symbol = domain.functions[application.function].name.clone();
                written.insert((symbol, application.arguments.clone()), false);
            }
            _ => {}
        });
    }
    written
}

/// Whether a condition of the rule no longer holds after its effects.
fn rests(
    domain: &Domain,
    rule: &DurativeAction,
    start: &BTreeMap<Token, bool>,
    end: &BTreeMap<Token, bool>,
) -> bool {
    let mut after = start.clone();
    after.extend(end.iter().map(|(token, added)| (token.clone(), *added)));
    let mut conditions = Vec::new();
    rule.conditions.iter().for_each(|timed| conjuncts(&timed.condition, &mut conditions));
    conditions.into_iter().any(|condition| {
        let mut ends = false;
        literals(domain, condition, true, &mut |token, positive| {
            // What the rule itself writes at its start is no part of what starts it.
            let own = positive && start.get(&token) == Some(&true);
            ends |=
                !own && after.iter().any(|(other, added)| *added != positive && same(rule, &token, other));
        });
        ends
    })
}

/// Whether two tokens may be the same: equal, but for the variables of quantifiers.
fn same(rule: &DurativeAction, left: &Token, right: &Token) -> bool {
    let parameters = rule.variables.parameters;
    let quantified = |term: &Term| matches!(term, Term::Variable(v) if v.index() >= parameters);
    left.0 == right.0 && left.1.iter().zip(&right.1).all(|(l, r)| l == r || quantified(l) || quantified(r))
}

fn literals(domain: &Domain, condition: &Condition, positive: bool, visit: &mut impl FnMut(Token, bool)) {
    match &condition.kind {
        ConditionKind::Not(part) => literals(domain, part, !positive, visit),
        ConditionKind::Atom(atom) => {
            visit((domain.predicates[atom.predicate].name.clone(), atom.arguments.clone()), positive);
        }
        ConditionKind::FluentIs(application, _) => {
            let symbol = domain.functions[application.function].name.clone();
            visit((symbol, application.arguments.clone()), positive);
        }
        _ => condition.parts().for_each(|part| literals(domain, part, positive, visit)),
    }
}

fn text(domain: &Domain, rule: &DurativeAction, (symbol, terms): &Token) -> String {
    let names: Vec<String> = terms
        .iter()
        .map(|term| match term {
            Term::Object(id) => domain.constants[*id].name.to_string(),
            Term::Variable(id) => format!("?{}", rule.variables[*id].name),
        })
        .collect();
    list(symbol, &names.iter().map(String::as_str).collect::<Vec<_>>())
}
