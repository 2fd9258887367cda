//! An action that no task network has.

use pddl::Explanation;

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::ProblemView;
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "unused-action",
    level: Level::Default,
    explanation: Explanation {
        code: "W0904",
        title: "action in no task network",
        meaning: "The domain has tasks, but no method has the action as a subtask, and no problem that was looked \
         at.",
        why: "In a hierarchical problem only what some task becomes is carried out: this action never is.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing :hierarchy)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:task brighten
    :parameters (?x - lamp))
  (:method by-hand
    :parameters (?x - lamp)
    :task (brighten ?x)
    :ordered-subtasks (switch ?x))
  (:action shout
    :parameters ()
    :effect ())
  (:action switch
    :parameters (?x - lamp)
    :effect (lit ?x)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:htn
    :ordered-subtasks (brighten left))
  (:init))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :typing :hierarchy)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:task brighten
    :parameters (?x - lamp))
  (:method by-hand
    :parameters (?x - lamp)
    :task (brighten ?x)
    :ordered-subtasks (switch ?x))
  (:action switch
    :parameters (?x - lamp)
    :effect (lit ?x)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:htn
    :ordered-subtasks (brighten left))
  (:init))",
        ],
    },
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if !view.is_complete() || view.problem.htn.is_none() {
        return;
    }
    let (domain, used, asked) = (view.domain.domain, view.domain.usage(), view.usage());
    let actions = domain.actions.enumerate().filter(|&(id, _)| !used.actions[id] && !asked.actions[id]);
    let durative = domain
        .durative_actions
        .enumerate()
        .filter(|&(id, _)| !used.durative_actions[id] && !asked.durative_actions[id]);
    let names = actions
        .map(|(_, action)| (&action.name, action.name_span))
        .chain(durative.map(|(_, action)| (&action.name, action.name_span)));
    for (name, span) in names {
        let message = format!("no method and no task network has the action `{name}`");
        found.report(Finding::new(&LINT, Place::domain(span), message));
    }
}
