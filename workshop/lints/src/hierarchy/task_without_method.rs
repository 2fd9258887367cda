//! A compound task that nothing can carry out.

use pddl::Explanation;

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::DomainView;
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "task-without-method",
    level: Level::Default,
    explanation: Explanation {
        code: "W0901",
        title: "task without a method",
        meaning: "A compound task is declared, but no method is for it.",
        why: "It can never be carried out, and neither can any method that has it as a subtask.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing :hierarchy)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:task brighten
    :parameters (?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :effect (lit ?x)))"],
        right: &["\
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
    :effect (lit ?x)))"],
    },
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    for (id, task) in view.domain.tasks.enumerate() {
        if view.domain.methods.iter().all(|method| method.task != id) {
            let message = format!("no method is for the task `{}`", task.name);
            found.report(Finding::new(&LINT, Place::domain(task.span), message));
        }
    }
}
