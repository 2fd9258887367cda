//! Two methods that say the same.

use pddl::model::{Name, TaskId};
use pddl::{Explanation, Span};
use rustc_hash::FxHashMap;

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::DomainView;
use crate::{Finding, Level, Lint, Place, shape};

pub(crate) static LINT: Lint = Lint {
    name: "duplicate-method",
    level: Level::Default,
    explanation: Explanation {
        code: "W0906",
        title: "method stands twice",
        meaning: "Two methods for one task have parameters of the same types, the same precondition and the same \
         subtasks in the same order; only names differ.",
        why: "Everything is tried twice. Mostly one was copied from the other and not finished.",
        wrong: &["\
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
  (:method by-foot
    :parameters (?x - lamp)
    :task (brighten ?x)
    :ordered-subtasks (switch ?x))
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
    if !view.is_complete() {
        return;
    }
    let mut first: FxHashMap<(TaskId, String), (&Name, Span)> = FxHashMap::default();
    for method in &view.domain.methods {
        let shape = shape::schema(&method.variables, |shape| {
            shape.terms(&method.task_arguments)
                + &shape.condition(&method.precondition)
                + &shape.network(&method.network)
        });
        if let Some((other, earlier)) = first.get(&(method.task, shape.clone())) {
            let message = format!("method `{}` says the same as `{other}`", method.name);
            let finding = Finding::new(&LINT, Place::domain(method.span), message);
            found.report(finding.label(Place::domain(*earlier), "the other one"));
        } else {
            first.insert((method.task, shape), (&method.name, method.span));
        }
    }
}
