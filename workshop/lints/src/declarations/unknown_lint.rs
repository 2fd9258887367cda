//! `; allow(no-such-lint)`

use pddl::{Explanation, Source, Span};

use crate::finding::Findings;
use crate::lint::Check;
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "unknown-lint",
    level: Level::Default,
    explanation: Explanation {
        code: "W0700",
        title: "unknown lint",
        meaning: "A comment `; allow(…)` names something that is no lint.",
        why: "It silences nothing; a misspelled name leaves the warning that it was to silence. `pelea explain` \
         lists all lints.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp room)
  (:predicates (lit ?x - lamp))
  (:action switch
    ; allow(unused-paramter)
    :parameters (?x - lamp ?y - room)
    :effect (lit ?x)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp room)
  (:predicates (lit ?x - lamp))
  (:action switch
    ; allow(unused-parameter)
    :parameters (?x - lamp ?y - room)
    :effect (lit ?x)))"],
    },
    checks: &[
        Check::Domain(|view, found| check(view.source, &view.allows.unknown, Place::domain, found)),
        Check::Problem(|view, found| check(view.source, &view.allows.unknown, Place::problem, found)),
    ],
};

fn check(source: &Source, unknown: &[Span], place: fn(Span) -> Place, found: &mut Findings) {
    for &span in unknown {
        let message = format!("no lint is called `{}`", source.slice(span));
        found.report(Finding::new(&LINT, place(span), message).help("`pelea explain` lists all lints"));
    }
}
