//! A condition that can never hold.

use diagnostics::Place;
use pddl::model::{Comparison, Condition, ConditionKind, Expression, ExpressionKind, Term};

use super::literals::{Fact, Group, Literal, contradictions, groups};
use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::shape::Shape;
use crate::view::{DomainView, ProblemView};
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "always-false",
    level: Level::Default,
    explanation: explanation!("W0801"),
    checks: &[Check::Domain(in_domain), Check::Problem(in_goal)],
};

fn in_domain(view: &DomainView<'_>, found: &mut Findings) {
    for conditions in view.schemas().flat_map(|schema| schema.conditions()) {
        check(&groups(conditions), place::domain, found);
    }
}

fn in_goal(view: &ProblemView<'_, '_>, found: &mut Findings) {
    check(&groups([&view.problem.goal]), place::problem, found);
}

fn check(groups: &[Group<'_>], place: fn(pddl::Span) -> Place, found: &mut Findings) {
    for group in groups {
        let parts = match group {
            Group::Any(parts) if parts.is_empty() => continue,
            Group::All(parts) | Group::Any(parts) => parts,
        };
        for part in parts.iter().filter(|part| verdict(part) == Some(false)) {
            found.report(LINT.finding(place(part.span), "this can never hold"));
        }
        let Group::All(parts) = group else { continue };
        let literals: Vec<Literal> = parts.iter().filter_map(|part| Literal::of(part)).collect();
        for (literal, earlier) in contradictions(&literals) {
            let message = "this can never hold together with another part";
            let finding = LINT.finding(place(literal.span), message);
            found.report(finding.label(place(earlier.span), "with this"));
        }
    }
}

/// Whether a condition holds whatever the state and whatever the variables are, if that is plain to see.
pub(super) fn verdict(condition: &Condition) -> Option<bool> {
    match &condition.kind {
        ConditionKind::Or(parts) if parts.is_empty() => Some(false),
        ConditionKind::Same(..) | ConditionKind::Not(_) => {
            let literal = Literal::of(condition)?;
            let Fact::Same(a, b) = literal.fact else { return None };
            let same = match (a, b) {
                _ if a == b => true,
                (Term::Object(_), Term::Object(_)) => false,
                _ => return None,
            };
            Some(same == literal.positive)
        }
        ConditionKind::Compare(how, left, right) => {
            if let (Some(left), Some(right)) = (number(left), number(right)) {
                return Some(match how {
                    Comparison::Less => left < right,
                    Comparison::LessEqual => left <= right,
                    Comparison::Equal => left == right,
                    Comparison::GreaterEqual => left >= right,
                    Comparison::Greater => left > right,
                });
            }
            let reflexive =
                matches!(how, Comparison::LessEqual | Comparison::Equal | Comparison::GreaterEqual);
            (Shape::PLAIN.expression(left) == Shape::PLAIN.expression(right)).then_some(reflexive)
        }
        _ => None,
    }
}

fn number(expression: &Expression) -> Option<f64> {
    match expression.kind {
        ExpressionKind::Number(number) => Some(number),
        _ => None,
    }
}
