//! A condition that always holds.

use pddl::Explanation;

use super::always_false::verdict;
use super::literals::{Group, Literal, contradictions, groups};
use crate::finding::Findings;
use crate::lint::Check;
use crate::view::{DomainView, ProblemView};
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "always-true",
    level: Level::Default,
    explanation: Explanation {
        code: "W0802",
        title: "condition is always true",
        meaning: "A condition asks for something or its negation, or compares what is always equal.",
        why: "It asks for nothing. Mostly one of two terms is meant to be another one: `(= ?x ?x)` for `(= ?x \
         ?y)`.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing :equality)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (and (broken ?x) (= ?x ?x))
    :effect (lit ?x)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (broken ?x)
    :effect (lit ?x)))"],
    },
    checks: &[Check::Domain(in_domain), Check::Problem(in_goal)],
};

fn in_domain(view: &DomainView<'_>, found: &mut Findings) {
    for conditions in view.schemas().flat_map(|schema| schema.conditions()) {
        check(&groups(conditions), Place::domain, found);
    }
}

fn in_goal(view: &ProblemView<'_, '_>, found: &mut Findings) {
    check(&groups([&view.problem.goal]), Place::problem, found);
}

fn check(groups: &[Group<'_>], place: fn(pddl::Span) -> Place, found: &mut Findings) {
    for group in groups {
        let (Group::All(parts) | Group::Any(parts)) = group;
        for part in parts.iter().filter(|part| verdict(part) == Some(true)) {
            found.report(Finding::new(&LINT, place(part.span), "this always holds"));
        }
        let Group::Any(parts) = group else { continue };
        let literals: Vec<Literal> = parts.iter().filter_map(|part| Literal::of(part)).collect();
        for (literal, earlier) in contradictions(&literals) {
            let finding = Finding::new(&LINT, place(literal.span), "this or another part always holds");
            found.report(finding.label(place(earlier.span), "or this"));
        }
    }
}
