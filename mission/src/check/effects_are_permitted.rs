//! C0601: a rule that writes what its agent may not write.
//!
//! **What** Each effect of a rule is permitted by the `:writes` of its agent, whose name is that of the
//! rule's domain. Each effect of an intention at its start or timeout is permitted by the `:writes` of the agent `pelea`,
//! for each binding that methods give to it.
//! **Why** The graph refuses the whole commit: the rule's skill runs, and its result never appears.
//! **Example** `(at end (is_with ?p ?r))` in `speech.pddl`.

use std::collections::BTreeSet;

use pddl::Span;
use pddl::model::{
    Domain, DurativeAction, Effect, EffectKind, Name, Permission, Term, TimeSpecifier, TokenSymbol, TypeSet,
};

use super::context::Context;
use super::grounding::list;
use super::nearest::one_line;
use crate::layers::Layers;
use diagnostics::{Finding, Place};

/// A written token, with the possible nodes of each argument.
struct Written {
    token: Name,
    arguments: Vec<Vec<Name>>,
    span: Span,
}

pub(super) fn check(context: &Context<'_>, findings: &mut Vec<Finding>) {
    let mission = context.mission;
    let vocabulary = &mission.layers.vocabulary.model;
    for agent in &mission.layers.agents {
        let own: Vec<&Permission> =
            vocabulary.permissions.iter().filter(|p| p.agent == agent.model.name).collect();
        for (_, rule) in agent.model.durative_actions.enumerate() {
            for written in effects(&mission.layers, &agent.model, rule) {
                if own.iter().any(|p| permits(vocabulary, p, &written)) {
                    continue;
                }
                let place = Place { source: agent.source, span: written.span };
                let text = mission.sources[agent.source].slice(written.span);
                let message = format!(
                    "`{}` writes `{}`, which the agent `{}` may not write",
                    rule.name,
                    one_line(text),
                    agent.model.name
                );
                let help = help(vocabulary, &own, &written, &agent.model.name);
                findings.push(Finding::error("C0601", place, message).help(help));
            }
        }
    }
    intentions(context, findings);
}

/// The name under which the executive writes.
const EXECUTIVE: &str = "pelea";

/// What the executive may not write, for the bindings that methods give to its intentions.
fn intentions(context: &Context<'_>, findings: &mut Vec<Finding>) {
    let (layers, grounding) = (&context.mission.layers, context.grounding);
    let (vocabulary, methods) = (&layers.vocabulary.model, &layers.methods);
    if vocabulary.constant(EXECUTIVE).is_none() {
        // Nobody to write as: one finding of the assembly.
        return;
    }
    let own: Vec<&Permission> =
        vocabulary.permissions.iter().filter(|p| p.agent.as_str() == EXECUTIVE).collect();
    for (id, bindings) in grounding.intentions() {
        let intention = &methods.model.durative_actions[id];
        let mut reported = BTreeSet::new();
        for binding in bindings {
            // The effects at the end of an intention are expectations, not edits.
            let edits = grounding.effects(intention, binding, |when| *when != TimeSpecifier::End);
            for fact in edits.true_.iter().chain(&edits.false_) {
                let mut arguments: Vec<_> =
                    fact.arguments.iter().map(|&class| grounding.classes.nodes(class).to_vec()).collect();
                arguments.truncate(fact.arguments.len() - usize::from(fact.valued));
                let written = Written { token: fact.symbol.clone(), arguments, span: intention.name_span };
                if own.iter().any(|p| permits(vocabulary, p, &written))
                    || !reported.insert(fact.symbol.clone())
                {
                    continue;
                }
                let names: Vec<&str> = binding.iter().map(|&c| grounding.classes.name(c).as_str()).collect();
                let place = Place { source: methods.source, span: intention.name_span };
                let message = format!(
                    "`{}` writes `{}`, which the agent `{EXECUTIVE}` may not write",
                    list(&intention.name, &names),
                    fact.text(&grounding.classes)
                );
                let help = help(vocabulary, &own, &written, EXECUTIVE);
                findings.push(Finding::error("C0601", place, message).help(help));
            }
        }
    }
}

/// What to add to the permissions, and what the agent may write of the same token.
fn help(vocabulary: &Domain, own: &[&Permission], written: &Written, agent: &str) -> String {
    let patterns = own.iter().flat_map(|permission| &permission.tokens);
    let granted: Vec<String> = patterns
        .filter(|pattern| symbol(vocabulary, pattern.symbol).is_some_and(|name| *name == written.token))
        .map(|pattern| {
            let name = |fixed: &Option<_>| fixed.map_or("_", |id| vocabulary.constants[id].name.as_str());
            format!("`{}`", list(&written.token, &pattern.arguments.iter().map(name).collect::<Vec<_>>()))
        })
        .collect();
    let add = format!("add it to (:writes {agent} …) in the vocabulary");
    if granted.is_empty() { add } else { format!("it may write {}; {add}", granted.join(", ")) }
}

fn symbol(vocabulary: &Domain, symbol: TokenSymbol) -> Option<&Name> {
    match symbol {
        TokenSymbol::Predicate(id) => Some(&vocabulary.predicates[id].name),
        TokenSymbol::Function(id) => Some(&vocabulary.functions[id].name),
        TokenSymbol::Type(_) => None,
    }
}

fn effects(layers: &Layers, domain: &Domain, action: &DurativeAction) -> Vec<Written> {
    let candidates = |term: &Term| -> Vec<Name> {
        let variable = match term {
            Term::Object(id) => return vec![domain.constants[*id].name.clone()],
            Term::Variable(id) => &action.variables[*id],
        };
        let ids = variable.types.0.iter().filter_map(|&t| layers.nodes.types.find(&domain.types[t].name));
        let types = TypeSet(ids.collect());
        if types.is_unknown() {
            return Vec::new();
        }
        let nodes = layers.nodes.constants.iter().filter(|node| node.is_of(&types, &layers.nodes.types));
        nodes.map(|node| node.name.clone()).collect()
    };
    let mut all = Vec::new();
    for effect in &action.effects {
        collect(domain, &effect.effect, &mut |token, terms: &[Term], span| {
            all.push(Written { token, arguments: terms.iter().map(candidates).collect(), span });
        });
    }
    all
}

fn collect(domain: &Domain, effect: &Effect, add: &mut impl FnMut(Name, &[Term], Span)) {
    effect.each(&mut |part| match &part.kind {
        EffectKind::Add(atom) | EffectKind::Delete(atom) => {
            add(domain.predicates[atom.predicate].name.clone(), &atom.arguments, atom.span);
        }
        EffectKind::Assign(_, to, _) => {
            add(domain.functions[to.function].name.clone(), &to.arguments, to.span);
        }
        EffectKind::And(_) | EffectKind::Forall(..) | EffectKind::When(..) => {}
    });
}

/// Whether a permission covers a token under every binding of its variables.
fn permits(vocabulary: &Domain, permission: &Permission, written: &Written) -> bool {
    permission.tokens.iter().any(|pattern| {
        let Some(symbol) = symbol(vocabulary, pattern.symbol) else { return false };
        let fits = |(fixed, candidates): (&Option<_>, &Vec<Name>)| {
            fixed.is_none_or(|id| candidates.iter().all(|c| vocabulary.constants[id].name == *c))
        };
        *symbol == written.token && pattern.arguments.iter().zip(&written.arguments).all(fits)
    })
}
