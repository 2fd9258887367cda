//! Two goals that exclude each other.

use analysis::invariants::literals;
use pddl::model::Term;

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::ProblemView;
use crate::{Level, Lint, place};
use analysis::text::shortened;

use super::exclusion::{find, words};

pub(crate) static LINT: Lint = Lint {
    name: "contradictory-goal",
    level: Level::Default,
    explanation: explanation!("W0858"),
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    let (mut held, mut different) = (Vec::new(), Vec::new());
    literals(&view.problem.goal, &mut held, &mut different);
    let domain = view.domain.domain;
    let variables = &view.problem.goal_variables;
    let Some((a, b, exclusion, instance)) = find(view.analysis(), domain, variables, &held, &different)
    else {
        return;
    };
    let term = |t: &Term| match t {
        Term::Object(o) => view.problem.objects[*o].name.to_string(),
        Term::Variable(v) => format!("?{}", variables[*v].name),
    };
    let reason = words(&exclusion.invariant, domain, &instance.iter().map(term).collect::<Vec<_>>());
    let text = |span| shortened(view.source.slice(span));
    let message = format!("goals `{}` and `{}` exclude each other: {reason}", text(a.span), text(b.span));
    found.report(LINT.finding(place::problem(b.span), message).label(place::problem(a.span), "excludes it"));
}
