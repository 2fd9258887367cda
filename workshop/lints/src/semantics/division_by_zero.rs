//! A divisor that is zero for ever.

use analysis::Number;
use analysis::changes::{Change, changes};
use pddl::model::{ArithmeticOperator, AssignedValue, Condition, ConditionKind, Expression, ExpressionKind};

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{DomainView, ProblemView, is_here};
use crate::{Level, Lint, place};
use analysis::happening::happenings;
use analysis::intervals::{Hulls, Interval, Value};
use analysis::text::shortened;

pub(crate) static LINT: Lint = Lint {
    name: "division-by-zero",
    level: Level::Default,
    explanation: explanation!("W0860"),
    checks: &[Check::Domain(in_domain), Check::Problem(in_problem)],
};

fn in_domain(view: &DomainView<'_>, found: &mut Findings) {
    if view.is_complete() {
        check(view, &view.analysis().hulls, found);
    }
}

fn in_problem(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if view.is_complete() {
        check(view.domain, &view.analysis().hulls, found);
    }
}

fn check(view: &DomainView<'_>, hulls: &Hulls, found: &mut Findings) {
    let mut look = |expression: &Expression| {
        expression.each(&mut |part| {
            let ExpressionKind::Arithmetic(ArithmeticOperator::Divide, operands) = &part.kind else { return };
            for divisor in operands.iter().skip(1) {
                let zero = Value::In(Interval::point(Number::ZERO));
                if hulls.hull(divisor) == zero && is_here(divisor.span) {
                    let text = shortened(view.source.slice(divisor.span));
                    let message = format!("division by `{text}`, which is always 0");
                    found.report(LINT.finding(place::domain(divisor.span), message));
                }
            }
        });
    };
    for happening in happenings(view.domain) {
        happening.conditions.iter().for_each(|c| expressions(c, &mut look));
        for effect in &happening.effects {
            changes(effect, &mut |context, change| {
                context.when.iter().for_each(|c| expressions(c, &mut look));
                if let Change::Assign(_, _, AssignedValue::Number(value)) = change {
                    look(value);
                }
            });
        }
    }
    for action in &view.domain.durative_actions {
        action.duration.iter().for_each(|c| look(&c.bound));
    }
    view.domain.axioms.iter().for_each(|a| expressions(&a.body, &mut look));
}

fn expressions(of: &Condition, look: &mut dyn FnMut(&Expression)) {
    of.each(&mut |part| {
        if let ConditionKind::Compare(_, left, right) = &part.kind {
            look(left);
            look(right);
        }
    });
}
