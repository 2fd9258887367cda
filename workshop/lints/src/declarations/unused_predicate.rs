//! A predicate that nobody names.

use pddl::Explanation;

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::{DomainView, is_here};
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "unused-predicate",
    level: Level::Default,
    explanation: Explanation {
        code: "W0703",
        title: "unused predicate",
        meaning: "A predicate is declared, but no condition, effect, axiom or task of the domain names it.",
        why: "Whatever a problem says about it changes nothing. Often an action lacks the condition or the \
         effect that it was declared for, or its name is misspelled the same way twice. Domains that \
         only declare, for others to import, are not looked at.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :effect (lit ?x)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing :negative-preconditions)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (not (broken ?x))
    :effect (lit ?x)))"],
    },
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    if !view.is_complete() || view.is_vocabulary() {
        return;
    }
    let usage = view.usage();
    for (id, predicate) in view.domain.predicates.enumerate() {
        let used = usage.predicates[id];
        if is_here(predicate.span) && !used.needed() && !used.fluent() {
            let message = format!("nothing in this domain names the predicate `{}`", predicate.name);
            found.report(Finding::new(&LINT, Place::domain(predicate.span), message));
        }
    }
}
