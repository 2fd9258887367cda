//! The rule that comes nearest to a fact: what a finding about a missing rule names.

use pddl::model::{
    AssignedValue, Condition, ConditionKind, Domain, DurativeAction, Effect, EffectKind, Idx, Name, Term,
    TimeSpecifier,
};

use super::grounding::{Fact, Grounding, Scope};
use crate::mission::Mission;
use diagnostics::Place;

/// What a rule would have to do with the fact.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// Wait for it.
    Waits,
    /// Make it true.
    Makes,
    /// Make it false.
    Ends,
}

/// The nearest rule, and why it does not fit.
pub(super) struct Nearest {
    pub(super) place: Place,
    pub(super) reason: String,
}

/// The nearest rule of all agents; `None` if no rule mentions the token in that role.
pub(super) fn find(mission: &Mission, grounding: &Grounding<'_>, fact: &Fact, role: Role) -> Option<Nearest> {
    let mut best: Option<(usize, Nearest)> = None;
    for agent in &mission.layers.agents {
        for (_, rule) in agent.model.durative_actions.enumerate() {
            for terms in mentions(&agent.model, rule, fact, role) {
                let mut scope = grounding.scope(&agent.model, &rule.variables);
                let unfit = unfit(&mut scope, &terms, fact);
                let count = unfit.len();
                if best.as_ref().is_some_and(|(least, _)| *least <= count) {
                    continue;
                }
                let why = if unfit.is_empty() {
                    let source = &mission.sources[agent.source];
                    blocked(grounding, &mut scope, rule).map_or_else(
                        || "it never starts".to_owned(),
                        |c| format!("it also needs `{}`, which never holds", one_line(source.slice(c.span))),
                    )
                } else {
                    unfit.join(", ")
                };
                let reason = format!("the nearest rule is `{}` of `{}`: {why}", rule.name, agent.model.name);
                let place = Place { source: agent.source, span: rule.name_span };
                best = Some((count, Nearest { place, reason }));
            }
        }
    }
    best.map(|(_, nearest)| nearest)
}

/// Text of a source on one line.
pub(super) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Why the terms are not the arguments of the fact; binds the variables that are.
fn unfit(scope: &mut Scope<'_>, terms: &[Term], fact: &Fact) -> Vec<String> {
    let mut reasons = Vec::new();
    for (&term, &class) in terms.iter().zip(&fact.arguments) {
        let node = scope.classes.name(class).clone();
        match term {
            Term::Object(id) => {
                let constant = &scope.domain.constants[id].name;
                if scope.classes.of(constant) != Some(class) {
                    reasons.push(format!("it names `{constant}`, not `{node}`"));
                }
            }
            Term::Variable(id) => {
                let variable = &scope.variables[id];
                if scope.classes.is_a(class, scope.layers, scope.domain, &variable.types) {
                    scope.binding[id.index()].get_or_insert(class);
                } else {
                    let types = variable.types.0.iter().map(|&t| scope.domain.types[t].name.as_str());
                    let wanted = types.collect::<Vec<_>>().join(" or ");
                    let own = scope.classes.type_names(class, scope.layers).join(" or ");
                    reasons.push(format!(
                        "`?{}` is of type `{wanted}`, `{node}` of type `{own}`",
                        variable.name
                    ));
                }
            }
        }
    }
    reasons
}

/// The first condition of the rule that no binding satisfies, given the variables bound so far.
pub(super) fn blocked<'r>(
    grounding: &Grounding<'_>,
    scope: &mut Scope<'_>,
    rule: &'r DurativeAction,
) -> Option<&'r Condition> {
    let mut conditions = Vec::new();
    for timed in &rule.conditions {
        super::grounding::conjuncts(&timed.condition, &mut conditions);
    }
    let free: Vec<_> =
        rule.variables.parameter_ids().filter(|p| scope.binding[p.index()].is_none()).collect();
    conditions.into_iter().find(|condition| {
        let mut holds = false;
        grounding.visit(scope, &free, &[condition], &mut |_| holds = true);
        !holds
    })
}

/// The argument lists with which the rule mentions the fact's token in that role.
fn mentions(domain: &Domain, rule: &DurativeAction, fact: &Fact, role: Role) -> Vec<Vec<Term>> {
    let mut found = Vec::new();
    let mut add = |symbol: &Name, arguments: &[Term], value: Option<Term>| {
        if *symbol == fact.symbol && arguments.len() + usize::from(value.is_some()) == fact.arguments.len() {
            found.push(arguments.iter().copied().chain(value).collect());
        }
    };
    if role == Role::Waits {
        for timed in &rule.conditions {
            reads(domain, &timed.condition, true, &mut add);
        }
    } else {
        for timed in rule.effects.iter().filter(|e| e.when != TimeSpecifier::OverAll) {
            writes(domain, &timed.effect, role == Role::Makes, &mut add);
        }
    }
    found
}

fn reads(
    domain: &Domain,
    condition: &Condition,
    positive: bool,
    add: &mut impl FnMut(&Name, &[Term], Option<Term>),
) {
    match &condition.kind {
        ConditionKind::Not(part) => reads(domain, part, !positive, add),
        ConditionKind::Atom(atom) if positive => {
            add(&domain.predicates[atom.predicate].name, &atom.arguments, None);
        }
        ConditionKind::FluentIs(application, value) if positive => {
            add(&domain.functions[application.function].name, &application.arguments, Some(*value));
        }
        _ => condition.parts().for_each(|part| reads(domain, part, positive, add)),
    }
}

fn writes(domain: &Domain, effect: &Effect, makes: bool, add: &mut impl FnMut(&Name, &[Term], Option<Term>)) {
    effect.each(&mut |part| match &part.kind {
        EffectKind::Add(atom) if makes => {
            add(&domain.predicates[atom.predicate].name, &atom.arguments, None);
        }
        EffectKind::Delete(atom) if !makes => {
            add(&domain.predicates[atom.predicate].name, &atom.arguments, None);
        }
        EffectKind::Assign(_, application, AssignedValue::Object(value)) if makes => {
            add(&domain.functions[application.function].name, &application.arguments, Some(*value));
        }
        EffectKind::Assign(_, application, AssignedValue::Undefined) if !makes => {
            add(&domain.functions[application.function].name, &application.arguments, None);
        }
        _ => {}
    });
}
