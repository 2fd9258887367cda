//! Two goals that exclude each other.

use analysis::invariants::literals;
use pddl::Explanation;
use pddl::model::Term;

use crate::finding::Findings;
use crate::lint::Check;
use crate::reachability::shortened;
use crate::view::ProblemView;
use crate::{Finding, Level, Lint, Place};

use super::exclusion::{find, words};

pub(crate) static LINT: Lint = Lint {
    name: "contradictory-goal",
    level: Level::Default,
    explanation: Explanation {
        code: "W0858",
        title: "goals exclude each other",
        meaning: "Two atoms of the goal are among a set of which at most one holds at a time: it is so initially, \
         and no effect makes another one true without making the one that held false.",
        why: "The problem has no solution, although each goal alone can be reached.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types cart place)
  (:predicates (at ?c - cart ?p - place))
  (:action move
    :parameters (?c - cart ?p ?q - place)
    :precondition (at ?c ?p)
    :effect (and (not (at ?c ?p)) (at ?c ?q))))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects c d - cart a b - place)
  (:init (at c a) (at d a))
  (:goal (and (at c b) (at c a))))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types cart place)
  (:predicates (at ?c - cart ?p - place))
  (:action move
    :parameters (?c - cart ?p ?q - place)
    :precondition (at ?c ?p)
    :effect (and (not (at ?c ?p)) (at ?c ?q))))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects c d - cart a b - place)
  (:init (at c a) (at d a))
  (:goal (and (at c b) (at d b))))",
        ],
    },
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    let (mut held, mut different) = (Vec::new(), Vec::new());
    literals(&view.problem.goal, &mut held, &mut different);
    let domain = view.domain.domain;
    let variables = &view.problem.goal_variables;
    let Some((a, b, exclusion, instance)) = find(view.analysis(), domain, variables, &held, &different)
    else {
        return;
    };
    let term = |t: &Term| match t {
        Term::Object(o) => view.problem.objects[*o].name.to_string(),
        Term::Variable(v) => format!("?{}", variables[*v].name),
    };
    let reason = words(&exclusion.invariant, domain, &instance.iter().map(term).collect::<Vec<_>>());
    let text = |span| shortened(view.source.slice(span));
    let message = format!("goals `{}` and `{}` exclude each other: {reason}", text(a.span), text(b.span));
    found.report(
        Finding::new(&LINT, Place::problem(b.span), message).label(Place::problem(a.span), "excludes it"),
    );
}
