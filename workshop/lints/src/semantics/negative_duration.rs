//! A duration below zero, or bounds without a duration between them.

use pddl::model::{Comparison, DurationConstraint, ExpressionKind, FluentValue};

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{DomainView, ProblemView, is_here};
use crate::{Level, Lint, place};
use analysis::Number;
use analysis::intervals::{Hulls, Interval, Value};

pub(crate) static LINT: Lint = Lint {
    name: "negative-duration",
    level: Level::Default,
    explanation: explanation!("W0859"),
    checks: &[Check::Domain(in_domain), Check::Problem(in_problem)],
};

const ZERO: Interval = Interval::point(Number::ZERO);

fn in_domain(view: &DomainView<'_>, found: &mut Findings) {
    if view.is_complete() {
        certain(view, &view.analysis().hulls, found);
    }
}

fn in_problem(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if !view.is_complete() {
        return;
    }
    let hulls = &view.analysis().hulls;
    certain(view.domain, hulls, found);
    for action in &view.domain.domain.durative_actions {
        for bound in action.duration.iter().filter(|c| bounds_above(c)) {
            let ExpressionKind::Fluent(application) = &bound.bound.kind else { continue };
            let some = hulls
                .of(application.function)
                .is_some_and(|i| i.may(Comparison::Less, ZERO) && i.may(Comparison::GreaterEqual, ZERO));
            if !some || hulls.changes(application.function) {
                continue;
            }
            let negative = view.problem.fluents.iter().find(|f| {
                f.application.function == application.function
                    && matches!(f.value, FluentValue::Number(value) if value < 0.0)
            });
            if let Some(fact) = negative {
                let message = format!("this makes a duration of action `{}` negative", action.name);
                let finding = LINT.finding(place::problem(fact.span), message);
                found.report(finding.label(place::domain(bound.span), "the duration"));
            }
        }
    }
}

fn bounds_above(constraint: &DurationConstraint) -> bool {
    matches!(constraint.comparison, Comparison::Equal | Comparison::LessEqual | Comparison::Less)
}

/// Reports durations that are impossible for all arguments and in all states.
fn certain(view: &DomainView<'_>, hulls: &Hulls, found: &mut Findings) {
    for action in &view.domain.durative_actions {
        let bounds: Vec<(&DurationConstraint, Interval)> = action
            .duration
            .iter()
            .filter_map(|c| match hulls.hull(&c.bound) {
                Value::In(interval) => Some((c, interval)),
                Value::Undefined => None,
            })
            .collect();
        for (constraint, interval) in &bounds {
            if bounds_above(constraint)
                && !interval.may(Comparison::GreaterEqual, ZERO)
                && is_here(constraint.span)
            {
                let message = format!("the duration of action `{}` is negative", action.name);
                found.report(
                    LINT.finding(place::domain(constraint.span), message).help(format!("it is {interval}")),
                );
            }
        }
        for (low, at_least) in
            bounds.iter().filter(|(c, _)| !matches!(c.comparison, Comparison::LessEqual | Comparison::Less))
        {
            for (high, at_most) in bounds.iter().filter(|(c, _)| bounds_above(c)) {
                let leaves_none = !at_least.may(Comparison::LessEqual, *at_most);
                let is_negative = !at_most.may(Comparison::GreaterEqual, ZERO);
                if leaves_none && !is_negative && is_here(high.span) {
                    let message = format!("no duration of action `{}` keeps both bounds", action.name);
                    let finding = LINT.finding(place::domain(high.span), message);
                    found.report(finding.label(place::domain(low.span), format!("{at_least}")));
                }
            }
        }
    }
}
