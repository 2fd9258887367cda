//! A task whose methods all lead to a task of that kind.

use pddl::Explanation;
use pddl::model::{Idx, Method, SubtaskHead};

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::DomainView;
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "endless-recursion",
    level: Level::Default,
    explanation: Explanation {
        code: "W0903",
        title: "recursion without an end",
        meaning: "Whatever method is chosen for the task, some task without a method for the end is left to be \
         carried out, the task itself again or another one of that kind.",
        why: "It can never be carried out. Add a method for the case in which nothing is left to do.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing :hierarchy)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:task brighten
    :parameters (?x - lamp))
  (:method next
    :parameters (?x - lamp)
    :task (brighten ?x)
    :ordered-subtasks (and (switch ?x) (brighten ?x)))
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
  (:method next
    :parameters (?x - lamp)
    :task (brighten ?x)
    :ordered-subtasks (and (switch ?x) (brighten ?x)))
  (:method done
    :parameters (?x - lamp)
    :task (brighten ?x)
    :ordered-subtasks ())
  (:action switch
    :parameters (?x - lamp)
    :effect (lit ?x)))"],
    },
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    let domain = view.domain;
    // What has no method at all is another mistake, and must not make others look endless.
    let mut ends: Vec<bool> =
        domain.tasks.ids().map(|id| domain.methods.iter().all(|method| method.task != id)).collect();
    loop {
        let ready = |method: &&Method| {
            !ends[method.task.index()]
                && method.network.subtasks.iter().all(|subtask| match subtask.head {
                    SubtaskHead::Task(task) => ends[task.index()],
                    SubtaskHead::Action(_) | SubtaskHead::DurativeAction(_) => true,
                })
        };
        match domain.methods.iter().find(ready).map(|method| method.task.index()) {
            Some(task) => ends[task] = true,
            None => break,
        }
    }
    for (_, task) in domain.tasks.enumerate().filter(|(id, _)| !ends[id.index()]) {
        let message = format!(
            "every method for the task `{}` leads to a task like it again, without an end",
            task.name
        );
        found.report(Finding::new(&LINT, Place::domain(task.span), message));
    }
}
