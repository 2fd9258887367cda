//! Two atoms that an invariant lets never hold together.

use analysis::invariants::{Invariant, Member, differ};
use pddl::model::{Atom, Domain, ObjectId, Term, Variables};
use rustc_hash::FxHashMap;

use crate::analysis::{Analysis, Exclusion};
use analysis::text::listed;

/// Atoms of one instance that another one is compared with.
const MOST: usize = 16;

/// Two of the atoms that exclude each other, with the reason; `parameters` are in their terms.
pub(crate) fn find<'a>(
    analysis: &'a Analysis<'_>,
    domain: &Domain,
    variables: &Variables,
    held: &[&'a Atom],
    different: &[(Term, Term)],
) -> Option<(&'a Atom, &'a Atom, &'a Exclusion, Vec<Term>)> {
    for exclusion in &analysis.exclusions {
        let members = held.iter().filter_map(|a| Some((*a, exclusion.invariant.member(a.predicate)?)));
        // A long goal is about many instances, and only within one can atoms exclude each other.
        let mut instances: FxHashMap<Vec<Term>, Vec<&Atom>> = FxHashMap::default();
        for (b, member) in members {
            let instance = member.instance(&b.arguments);
            let before = instances.entry(instance.clone()).or_default();
            for &a in before.iter().take(MOST) {
                let apart = a.predicate != b.predicate
                    || a.arguments
                        .iter()
                        .zip(&b.arguments)
                        .any(|(&x, &y)| differ(domain, variables, x, y, different));
                if apart && exclusive(exclusion, &instance) {
                    return Some((a, b, exclusion, instance));
                }
            }
            before.push(b);
        }
    }
    None
}

/// Whether at most one atom of the instance ever holds; with variables, of every instance.
fn exclusive(exclusion: &Exclusion, instance: &[Term]) -> bool {
    let ground: Option<Vec<ObjectId>> = instance
        .iter()
        .map(|t| match t {
            Term::Object(o) => Some(*o),
            Term::Variable(_) => None,
        })
        .collect();
    ground.map_or(exclusion.counts.all_exclusive(), |g| exclusion.counts.is_exclusive(&g))
}

/// The invariant in words, with these terms for its parameters.
pub(crate) fn words(invariant: &Invariant, domain: &Domain, parameters: &[String]) -> String {
    let atom = |m: &Member| {
        let mut arguments = vec!["_".to_owned(); m.parameters.len() + usize::from(m.counted.is_some())];
        for (&at, name) in m.parameters.iter().zip(parameters) {
            arguments[at].clone_from(name);
        }
        arguments.insert(0, domain.predicates[m.predicate].name.to_string());
        format!("`({})`", arguments.join(" "))
    };
    let atoms: Vec<String> = invariant.members.iter().map(atom).collect();
    format!("at most one of {} holds at a time", listed(&atoms, "and"))
}
