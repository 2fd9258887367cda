//! C0601: a rule that writes what its agent may not write.
//!
//! **What** Each effect of a rule is permitted by the `:writes` of its agent, whose name is that of the
//! rule's domain. Each effect of an intention is permitted by the `:writes` of some agent.
//! **Why** The graph refuses the whole commit: the rule's skill runs, and its result never appears.
//! **Example** `(at end (is_with ?p ?r))` in `speech.pddl`.

use pddl::Span;
use pddl::model::{
    Domain, DurativeAction, Effect, EffectKind, Name, Permission, Term, TimeSpecifier, TokenSymbol, TypeSet,
};

use crate::layers::Layers;
use crate::mission::Mission;
use diagnostics::{Finding, Place};

/// A written token, with the possible nodes of each argument.
struct Written {
    token: Name,
    arguments: Vec<Vec<Name>>,
    span: Span,
}

pub(super) fn check(mission: &Mission, findings: &mut Vec<Finding>) {
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
                let message = format!(
                    "`{}` writes `{}`, which the agent `{}` may not write",
                    rule.name, written.token, agent.model.name
                );
                let help = format!("add it to (:writes {} …) in the vocabulary", agent.model.name);
                findings.push(Finding::error("C0601", place, message).help(help));
            }
        }
    }
    let methods = &mission.layers.methods;
    for (_, intention) in methods.model.durative_actions.enumerate() {
        let ends: Vec<Span> = intention
            .effects
            .iter()
            .filter(|e| e.when == TimeSpecifier::End)
            .map(|e| e.effect.span)
            .collect();
        for written in effects(&mission.layers, &methods.model, intention) {
            // The effects at the end of an intention are expectations, not edits.
            let expected = ends.iter().any(|s| s.start <= written.span.start && written.span.end <= s.end);
            if expected || vocabulary.permissions.iter().any(|p| permits(vocabulary, p, &written)) {
                continue;
            }
            let place = Place { source: methods.source, span: written.span };
            let message =
                format!("`{}` writes `{}`, which no agent may write", intention.name, written.token);
            findings.push(Finding::error("C0601", place, message));
        }
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
        let nodes = layers.nodes.constants.enumerate();
        nodes
            .filter(|(_, n)| layers.nodes.types.is_subset(&n.types, &types))
            .map(|(_, n)| n.name.clone())
            .collect()
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
        let symbol = match pattern.symbol {
            TokenSymbol::Predicate(id) => &vocabulary.predicates[id].name,
            TokenSymbol::Function(id) => &vocabulary.functions[id].name,
            TokenSymbol::Type(_) => return false,
        };
        let fits = |(fixed, candidates): (&Option<_>, &Vec<Name>)| {
            fixed.is_none_or(|id| candidates.iter().all(|c| vocabulary.constants[id].name == *c))
        };
        *symbol == written.token && pattern.arguments.iter().zip(&written.arguments).all(fits)
    })
}
