//! A result of a skill that is used before the skill has ended.

use pddl::model::{Term, TimeSpecifier};

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::DomainView;
use crate::{Level, Lint, place};
use analysis::walk::{self, Part, Polarity};

pub(crate) static LINT: Lint = Lint {
    name: "early-result",
    level: Level::Default,
    explanation: explanation!("W0811"),
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
                found.report(LINT.finding(place::domain(span), message));
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
