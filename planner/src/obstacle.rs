//! Why an atom is never true: the chain of preconditions that nothing reaches.
//!
//! Idea: grounding knows every atom that is reached when nothing is ever deleted. Of an atom that is
//! not among them, each action (or axiom) that would add it has a precondition that none of these
//! matches, or several that never come together; the same is asked of the first such precondition,
//! until nothing adds what is wanted. Arguments that the wanted atom leaves open stay open. Cost: one
//! walk over the reached atoms per precondition looked at, and a bounded chain.
//!
//! Source: Göbelbecker et al., "Coming up with good excuses", ICAPS 2010, for the question; the
//! answer is read off the relaxed reachability.

use crate::task::{AtomStatus, GroundAtom, Task};
use pddl::model::{
    Action, Atom, Axiom, Condition, ConditionKind, Domain, Effect, EffectKind, Name, ObjectId, PredicateId,
    Term, Variables,
};

/// Links of a chain.
const LINKS: usize = 8;

/// An atom with open arguments.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    /// Its predicate.
    pub predicate: PredicateId,
    /// Its arguments: an object, or the variable that stands for any.
    pub arguments: Vec<Result<ObjectId, Name>>,
}

/// What stands in the way of an atom.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Obstacle {
    /// No action and no axiom gives it, and it does not hold initially.
    NothingGives(Pattern),
    /// What would give it needs something that is never true; so does everything else that would.
    Needs {
        /// What is wanted.
        wanted: Pattern,
        /// The action, or the derived predicate.
        by: Name,
        /// What that needs.
        needs: Pattern,
    },
    /// What would give it needs what was asked about before: each waits for the other.
    Circle {
        /// What is wanted.
        wanted: Pattern,
        /// The action, or the derived predicate.
        by: Name,
        /// What that needs, an atom further up the chain.
        needs: Pattern,
    },
    /// Each condition of what would give it is true at some time, but they never come together.
    NeverTogether {
        /// What is wanted.
        wanted: Pattern,
        /// The action, or the derived predicate.
        by: Name,
    },
}

/// The chain of obstacles before an atom that is never true; empty if it may be. `task` is the
/// grounding of a problem of `domain`.
pub fn obstacles(domain: &Domain, task: &Task, atom: &GroundAtom) -> Vec<Obstacle> {
    let mut wanted = Pattern {
        predicate: atom.predicate,
        arguments: atom.arguments.iter().map(|&object| Ok(object)).collect(),
    };
    let mut chain = Vec::new();
    let mut seen: Vec<Pattern> = Vec::new();
    while chain.len() < LINKS && !seen.contains(&wanted) && !is_reached(task, &wanted) {
        seen.push(wanted.clone());
        let givers = givers(domain, &wanted);
        // A giver that one missing precondition stops says most, if it is a new one.
        let missing = |known: bool| {
            givers.iter().find_map(|giver| {
                let mut needs = giver.needs.iter().filter(|needs| seen.contains(needs) == known);
                let missing = needs.find(|needs| !is_reached(task, needs));
                missing.map(|needs| (giver.name.clone(), needs.clone()))
            })
        };
        if let Some((by, needs)) = missing(false) {
            chain.push(Obstacle::Needs { wanted, by, needs: needs.clone() });
            wanted = needs;
            continue;
        }
        chain.push(match (missing(true), givers.first()) {
            (Some((by, needs)), _) => Obstacle::Circle { wanted, by, needs },
            (None, Some(giver)) => Obstacle::NeverTogether { wanted, by: giver.name.clone() },
            (None, None) => Obstacle::NothingGives(wanted),
        });
        break;
    }
    chain
}

impl Task {
    /// A pattern as PDDL writes it, `(road ?from b)`.
    pub fn pattern_name(&self, pattern: &Pattern) -> String {
        self.names.pattern(pattern)
    }
}

fn is_reached(task: &Task, pattern: &Pattern) -> bool {
    let fits =
        |row: &[u32]| row.iter().zip(&pattern.arguments).all(|(&o, a)| a.as_ref().map_or(true, |a| a.0 == o));
    let mut atoms = 0..crate::ids::id32(task.atoms.len());
    atoms.any(|atom| {
        task.atoms.predicate(atom) == pattern.predicate
            && task.status[atom as usize] != AtomStatus::NeverTrue
            && fits(task.atoms.row(atom))
    })
}

/// What would give an atom, and the positive atoms that it needs.
struct Giver {
    name: Name,
    needs: Vec<Pattern>,
}

fn givers(domain: &Domain, wanted: &Pattern) -> Vec<Giver> {
    let mut found = Vec::new();
    domain.actions.iter().for_each(|action| of_action(action, wanted, &mut found));
    for axiom in domain.axioms.iter().filter(|axiom| axiom.predicate == wanted.predicate) {
        of_axiom(domain, axiom, wanted, &mut found);
    }
    found
}

fn of_action(action: &Action, wanted: &Pattern, found: &mut Vec<Giver>) {
    each_add(&action.effect, &mut Vec::new(), &mut |atom, conditions| {
        let Some(binding) = unified(atom, wanted, &action.variables) else { return };
        let mut needs = Vec::new();
        conditions.iter().for_each(|c| positive(c, &binding, &action.variables, &mut needs));
        positive(&action.precondition, &binding, &action.variables, &mut needs);
        found.push(Giver { name: action.name.clone(), needs });
    });
}

fn of_axiom(domain: &Domain, axiom: &Axiom, wanted: &Pattern, found: &mut Vec<Giver>) {
    let mut binding = vec![None; axiom.variables.slots.len()];
    for (slot, argument) in binding.iter_mut().zip(&wanted.arguments) {
        *slot = argument.clone().ok();
    }
    let mut needs = Vec::new();
    positive(&axiom.body, &binding, &axiom.variables, &mut needs);
    found.push(Giver { name: domain.predicates[axiom.predicate].name.clone(), needs });
}

fn each_add<'e>(
    effect: &'e Effect,
    conditions: &mut Vec<&'e Condition>,
    visit: &mut dyn FnMut(&Atom, &[&'e Condition]),
) {
    match &effect.kind {
        EffectKind::And(parts) => parts.iter().for_each(|part| each_add(part, conditions, visit)),
        EffectKind::Forall(_, inner) => each_add(inner, conditions, visit),
        EffectKind::When(when, inner) => {
            conditions.push(when);
            each_add(inner, conditions, visit);
            conditions.pop();
        }
        EffectKind::Add(atom) => visit(atom, conditions),
        EffectKind::Delete(_) | EffectKind::Assign(..) => {}
    }
}

/// What the variables must be for `atom` to fit the pattern.
fn unified(atom: &Atom, wanted: &Pattern, variables: &Variables) -> Option<Vec<Option<ObjectId>>> {
    if atom.predicate != wanted.predicate {
        return None;
    }
    let mut binding = vec![None; variables.slots.len()];
    for (term, argument) in atom.arguments.iter().zip(&wanted.arguments) {
        let Ok(object) = argument else { continue };
        match term {
            Term::Object(own) if own != object => return None,
            Term::Object(_) => {}
            Term::Variable(v) => match binding[v.0 as usize] {
                Some(other) if other != *object => return None,
                _ => binding[v.0 as usize] = Some(*object),
            },
        }
    }
    Some(binding)
}

/// The atoms that a condition certainly needs.
fn positive(
    condition: &Condition,
    binding: &[Option<ObjectId>],
    variables: &Variables,
    out: &mut Vec<Pattern>,
) {
    match &condition.kind {
        ConditionKind::And(parts) => parts.iter().for_each(|part| positive(part, binding, variables, out)),
        ConditionKind::Exists(_, inner) => positive(inner, binding, variables, out),
        ConditionKind::Atom(atom) => {
            let argument = |term: &Term| match term {
                Term::Object(object) => Ok(*object),
                Term::Variable(v) => binding[v.0 as usize].ok_or_else(|| variables[*v].name.clone()),
            };
            let arguments = atom.arguments.iter().map(argument).collect();
            out.push(Pattern { predicate: atom.predicate, arguments });
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::{Obstacle, obstacles};
    use crate::{GroundAtom, GroundOptions, ground};

    const DOMAIN: &str = "(define (domain house) (:requirements :typing :derived-predicates)
        (:types room) (:predicates (at ?r - room) (open ?a ?b - room) (key ?r - room) (lit) (calm))
        (:derived (calm) (and (lit) (at hall)))
        (:constants hall - room)
        (:action go :parameters (?a ?b - room) :precondition (and (at ?a) (open ?a ?b))
          :effect (and (at ?b) (not (at ?a))))
        (:action unlock :parameters (?a ?b - room) :precondition (and (at ?a) (key ?b)) :effect (open ?a ?b)))";

    fn chain(goal: &str) -> Vec<String> {
        let problem = format!(
            "(define (problem p) (:domain house) (:objects attic - room) (:init (at hall)) (:goal {goal}))"
        );
        let domain = pddl::parse_domain(&pddl::Source::new("d", DOMAIN), &[]).model.expect("it is correct");
        let problem =
            pddl::parse_problem(&pddl::Source::new("p", problem), &domain).model.expect("so is this");
        let task = ground(&domain, &problem, &GroundOptions::default()).expect("nothing is refused");
        let pddl::model::ConditionKind::Atom(atom) = &problem.goal.kind else { panic!("an atom") };
        let arguments = atom.arguments.iter().map(|term| match term {
            pddl::model::Term::Object(object) => *object,
            pddl::model::Term::Variable(_) => panic!("an object"),
        });
        let wanted = GroundAtom { predicate: atom.predicate, arguments: arguments.collect() };
        let told = |obstacle: &Obstacle| match obstacle {
            Obstacle::NothingGives(wanted) => format!("nothing gives {}", task.pattern_name(wanted)),
            Obstacle::Needs { wanted, by, needs } => {
                format!("{} by {by} needs {}", task.pattern_name(wanted), task.pattern_name(needs))
            }
            Obstacle::Circle { wanted, by, needs } => {
                format!("{} by {by} needs {} again", task.pattern_name(wanted), task.pattern_name(needs))
            }
            Obstacle::NeverTogether { by, .. } => format!("{by}: never together"),
        };
        obstacles(&domain, &task, &wanted).iter().map(told).collect()
    }

    #[test]
    fn a_chain_goes_down_to_what_nothing_gives() {
        assert_eq!(
            chain("(at attic)"),
            [
                "(at attic) by go needs (open ?a attic)",
                "(open ?a attic) by unlock needs (key attic)",
                "nothing gives (key attic)",
            ]
        );
        assert_eq!(chain("(calm)"), ["(calm) by calm needs (lit)", "nothing gives (lit)"]);
        assert_eq!(chain("(at hall)"), Vec::<String>::new());
    }
}
