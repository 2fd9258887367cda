//! A type that nothing is of.

use pddl::Explanation;
use pddl::model::{Feature, TypeTable};

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::{DomainView, is_here};
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "unused-type",
    level: Level::Default,
    explanation: Explanation {
        code: "W0707",
        title: "unused type",
        meaning: "No variable, predicate, function, task or constant of the domain has this type, one of its \
         supertypes (other than `object`) or one of its subtypes.",
        why: "An object of it could take part in nothing. Often a parameter should have it and has a wider \
         type.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp room)
  (:predicates (lit ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :effect (lit ?x)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp room)
  (:predicates (lit ?x - lamp) (in ?x - lamp ?r - room))
  (:action switch
    :parameters (?x - lamp ?r - room)
    :precondition (in ?x ?r)
    :effect (lit ?x)))"],
    },
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    // What is an `object` somewhere may be of any type.
    // Conditions name types as well where they are predicates.
    let named = view.domain.features().iter().any(|(f, _)| *f == Feature::TypePredicates);
    if named || !view.is_complete() || view.is_vocabulary() || view.usage().types[TypeTable::OBJECT] {
        return;
    }
    let (types, used) = (&view.domain.types, &view.usage().types);
    for (id, declared) in types.enumerate().filter(|(_, t)| is_here(t.span)) {
        let relative = |&(other, _): &(_, _)| types.is_subtype(other, id) || types.is_subtype(id, other);
        if !types.enumerate().filter(relative).any(|(other, _)| used[other]) {
            let message = format!("nothing in this domain is about the type `{}`", declared.name);
            found.report(Finding::new(&LINT, Place::domain(declared.span), message));
        }
    }
}
