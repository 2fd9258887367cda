//! A result of a skill that is used before the skill has ended.

use pddl::Explanation;
use pddl::model::{Term, TimeSpecifier};

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::DomainView;
use crate::walk::{self, Part, Polarity};
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "early-result",
    level: Level::Default,
    explanation: Explanation {
        code: "W0811",
        title: "result is used too early",
        meaning: "A rule names a result of its skill in a condition, in an effect at the start, or in what the \
         skill is given.",
        why: "Results are bound when the skill ends. Before, nothing is known of them.",
        wrong: &["\
(define (domain ear)
  (:requirements :typing :durative-actions :agent-rules)
  (:types person answer)
  (:predicates (asked ?p - person) (said ?p - person ?a - answer))
  (:durative-action listen
    :parameters (?p - person)
    :duration (<= ?duration 10)
    :condition (at start (asked ?p))
    :effect (and (at start (said ?p ?a)) (at end (not (asked ?p))))
    :skill (listen)
    :results (?a - answer)))"],
        right: &["\
(define (domain ear)
  (:requirements :typing :durative-actions :agent-rules)
  (:types person answer)
  (:predicates (asked ?p - person) (said ?p - person ?a - answer))
  (:durative-action listen
    :parameters (?p - person)
    :duration (<= ?duration 10)
    :condition (at start (asked ?p))
    :effect (and (at end (said ?p ?a)) (at end (not (asked ?p))))
    :skill (listen)
    :results (?a - answer)))"],
    },
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    for action in &view.domain.durative_actions {
        let Some(rule) = action.rule.as_ref().filter(|rule| !rule.results.is_empty()) else { continue };
        let mut look = |when: &str, span, part: Part<'_>| {
            let is_result = |term: &Term| matches!(term, Term::Variable(v) if rule.results.contains(v));
            if let Some(Term::Variable(variable)) = part.terms().iter().find(|term| is_result(term)) {
                let name = &action.variables[*variable].name;
                let message = format!("the result `?{name}` is not known {when}");
                found.report(Finding::new(&LINT, Place::domain(span), message));
            }
        };
        for timed in &action.conditions {
            let span = timed.condition.span;
            walk::condition(&timed.condition, Polarity::Positive, &mut |part| {
                look("in a condition", span, part);
            });
        }
        for timed in action.effects.iter().filter(|e| e.when == TimeSpecifier::Start) {
            walk::effect(&timed.effect, &mut |part| look("at the start", timed.effect.span, part));
        }
        if let Some(skill) = &rule.skill {
            skill
                .arguments
                .iter()
                .for_each(|&term| look("when the skill starts", skill.span, Part::Term(term)));
        }
    }
}
