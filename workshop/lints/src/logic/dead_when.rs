//! `when` with a condition that the precondition rules out.

use pddl::Explanation;

use super::changes::Changes;
use super::literals::required;
use crate::finding::Findings;
use crate::lint::Check;
use crate::view::DomainView;
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "dead-when",
    level: Level::Default,
    explanation: Explanation {
        code: "W0808",
        title: "`when` never happens",
        meaning: "The condition of a conditional effect contradicts the precondition.",
        why: "The effect never happens. Mostly one of the two conditions has the wrong sign.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing :conditional-effects :negative-preconditions)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (not (broken ?x))
    :effect (when (broken ?x) (lit ?x))))"],
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
    for action in &view.domain.actions {
        let asked = required([&action.precondition]);
        for when in &Changes::of([&action.effect]).whens {
            for literal in required([when.condition]) {
                if let Some(other) = asked.iter().find(|a| a.contradicts(&literal)) {
                    let message = "this never holds here, so that the effect never happens";
                    let finding = Finding::new(&LINT, Place::domain(literal.span), message);
                    found.report(finding.label(Place::domain(other.span), "the precondition asks for this"));
                }
            }
        }
    }
}
