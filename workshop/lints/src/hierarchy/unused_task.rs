//! A compound task that nobody names.

use pddl::Explanation;
use pddl::model::SubtaskHead;

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::ProblemView;
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "unused-task",
    level: Level::Default,
    explanation: Explanation {
        code: "W0902",
        title: "unused task",
        meaning: "No method has the task as a subtask, other than methods for that task itself, and no problem \
         that was looked at asks for it.",
        why: "Its methods are never used. Often a subtask somewhere should be this one.",
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
  (:task darken
    :parameters (?x - lamp))
  (:method never
    :parameters (?x - lamp)
    :task (darken ?x)
    :ordered-subtasks ())
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
    let domain = view.domain.domain;
    if !view.is_complete() || view.problem.htn.is_none() {
        return;
    }
    for (id, task) in domain.tasks.enumerate() {
        let others = domain.methods.iter().filter(|method| method.task != id);
        let mut subtasks = others.flat_map(|method| &method.network.subtasks);
        if !view.usage().tasks[id] && !subtasks.any(|subtask| subtask.head == SubtaskHead::Task(id)) {
            let message = format!("nothing asks for the task `{}`", task.name);
            found.report(Finding::new(&LINT, Place::domain(task.span), message));
        }
    }
}
