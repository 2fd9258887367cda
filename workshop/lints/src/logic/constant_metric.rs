//! A metric that is the same for every plan.

use pddl::model::{Expression, ExpressionKind};

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::ProblemView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "constant-metric",
    level: Level::Default,
    explanation: explanation!("W0817"),
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if !view.is_complete() {
        return;
    }
    if let Some(metric) = &view.problem.metric
        && !depends_on_plan(view, &metric.expression)
    {
        let message = "no action changes what the metric is about: all plans are equally good";
        found.report(LINT.finding(place::problem(metric.expression.span), message));
    }
}

fn depends_on_plan(view: &ProblemView<'_, '_>, expression: &Expression) -> bool {
    match &expression.kind {
        ExpressionKind::Number(_) => false,
        ExpressionKind::Fluent(application) => {
            let function = application.function;
            view.domain.usage().functions[function].written || view.usage().functions[function].timed
        }
        ExpressionKind::Arithmetic(_, operands) => {
            operands.iter().any(|operand| depends_on_plan(view, operand))
        }
        // Time passes, and whatever else there is depends on the plan.
        _ => true,
    }
}
