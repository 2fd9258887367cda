//! An action that no task network has.

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::ProblemView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "unused-action",
    level: Level::Default,
    explanation: explanation!("W0904"),
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if !view.is_complete() || view.problem.htn.is_none() {
        return;
    }
    let (domain, used, asked) = (view.domain.domain, view.domain.usage(), view.usage());
    let actions = domain.actions.enumerate().filter(|&(id, _)| !used.actions[id] && !asked.actions[id]);
    let durative = domain
        .durative_actions
        .enumerate()
        .filter(|&(id, _)| !used.durative_actions[id] && !asked.durative_actions[id]);
    let names = actions
        .map(|(_, action)| (&action.name, action.name_span))
        .chain(durative.map(|(_, action)| (&action.name, action.name_span)));
    for (name, span) in names {
        let message = format!("no method and no task network has the action `{name}`");
        found.report(LINT.finding(place::domain(span), message));
    }
}
