//! A goal that no plan reaches.

use pddl::Explanation;

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::ProblemView;
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "unreachable-goal",
    level: Level::Default,
    explanation: Explanation {
        code: "W0855",
        title: "goal can never be reached",
        meaning: "A conjunct of the goal can never hold, even if nothing that was made true ever became false \
         again. The message follows what it needs to the root.",
        why: "The problem has no solution, and a planner may search for long to say no more than that.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?l - lamp) (plugged ?l - lamp))
  (:action switch
    :parameters (?l - lamp)
    :precondition (plugged ?l)
    :effect (lit ?l)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left right - lamp)
  (:init (plugged left))
  (:goal (and (lit left) (lit right))))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?l - lamp) (plugged ?l - lamp))
  (:action switch
    :parameters (?l - lamp)
    :precondition (plugged ?l)
    :effect (lit ?l)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left right - lamp)
  (:init (plugged left) (plugged right))
  (:goal (and (lit left) (lit right))))",
        ],
    },
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    let objects = &view.problem.objects;
    for unreachable in &view.analysis().goals {
        let goal = &unreachable.goal;
        let span = goal.condition.span;
        let with: Vec<String> = goal
            .values
            .iter()
            .map(|&(v, o)| format!("`?{}` = `{}`", view.problem.goal_variables[v].name, objects[o].name))
            .collect();
        let with = if with.is_empty() { String::new() } else { format!(" for {}", with.join(", ")) };
        let message = format!("the goal can never be reached{with}: {}", unreachable.reason);
        found.report(Finding::new(&LINT, Place::problem(span), message));
    }
}
