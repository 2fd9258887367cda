//! A subtask of the problem's network that no method can carry out.

use pddl::Explanation;

use crate::finding::Findings;
use crate::lint::Check;
use crate::reachability::Schema;
use crate::view::ProblemView;
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "impossible-task",
    level: Level::Default,
    explanation: Explanation {
        code: "W0854",
        title: "task of the problem can never be carried out",
        meaning: "A subtask of the problem's task network cannot be decomposed to actions that ever apply, even \
         if nothing that was made true became false again.",
        why: "The problem has no solution.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing :hierarchy :method-preconditions)
  (:types lamp)
  (:predicates (lit ?l - lamp) (plugged ?l - lamp))
  (:task brighten :parameters (?l - lamp))
  (:method by-hand
    :parameters (?l - lamp)
    :task (brighten ?l)
    :precondition (plugged ?l)
    :ordered-subtasks (switch ?l))
  (:action switch
    :parameters (?l - lamp)
    :effect (lit ?l)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left right - lamp)
  (:htn
    :ordered-subtasks (and (brighten left) (brighten right)))
  (:init (plugged left)))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :typing :hierarchy :method-preconditions)
  (:types lamp)
  (:predicates (lit ?l - lamp) (plugged ?l - lamp))
  (:task brighten :parameters (?l - lamp))
  (:method by-hand
    :parameters (?l - lamp)
    :task (brighten ?l)
    :precondition (plugged ?l)
    :ordered-subtasks (switch ?l))
  (:action switch
    :parameters (?l - lamp)
    :effect (lit ?l)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left right - lamp)
  (:htn
    :ordered-subtasks (and (brighten left) (brighten right)))
  (:init (plugged left) (plugged right)))",
        ],
    },
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    let Some((_, network)) = &view.problem.htn else { return };
    for subtask in &view.analysis().impossible {
        let Schema::Initial(at) = subtask.schema else { continue };
        let Some(task) = network.subtasks.get(at) else { continue };
        let message = format!("this task can never be carried out: {}", subtask.reason);
        found.report(Finding::new(&LINT, Place::problem(task.span), message));
    }
}
