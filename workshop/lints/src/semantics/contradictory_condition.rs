//! Two conditions that exclude each other.

use analysis::changes::{Change, changes};
use analysis::happening::{Schema, happenings};
use analysis::invariants::literals;
use analysis::text::shortened;
use pddl::model::{Condition, Term, Variables};

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{ProblemView, is_here};
use crate::{Level, Lint, place};

use super::exclusion::{find, words};

pub(crate) static LINT: Lint = Lint {
    name: "contradictory-condition",
    level: Level::Default,
    explanation: explanation!("W0857"),
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    let domain = view.domain.domain;
    for happening in happenings(domain) {
        if judge(view, &happening.schema, happening.variables, &happening.just_before, found) {
            continue;
        }
        for effect in &happening.effects {
            changes(effect, &mut |context, change| {
                if !context.when.is_empty() && !matches!(change, Change::Assign(..)) {
                    let mut all = happening.just_before.clone();
                    all.extend(&context.when);
                    judge(view, &happening.schema, happening.variables, &all, found);
                }
            });
        }
    }
    for (id, method) in domain.methods.enumerate() {
        judge(view, &Schema::Method(id), &method.variables, &[&method.precondition], found);
    }
}

/// Reports the first contradiction; whether there is one.
fn judge(
    view: &ProblemView<'_, '_>,
    schema: &Schema,
    variables: &Variables,
    conditions: &[&Condition],
    found: &mut Findings,
) -> bool {
    let domain = view.domain.domain;
    let (mut held, mut different) = (Vec::new(), Vec::new());
    conditions.iter().for_each(|c| literals(c, &mut held, &mut different));
    let Some((a, b, exclusion, instance)) = find(view.analysis(), domain, variables, &held, &different)
    else {
        return false;
    };
    if !is_here(b.span) || !is_here(schema.span(domain)) {
        return true;
    }
    let term = |t: &Term| match t {
        Term::Object(o) => view.problem.objects[*o].name.to_string(),
        Term::Variable(v) => format!("?{}", variables[*v].name),
    };
    let reason = words(&exclusion.invariant, domain, &instance.iter().map(term).collect::<Vec<_>>());
    let text = |span| shortened(view.domain.source.slice(span));
    let message = format!(
        "`{}` and `{}` of {} never hold together: {reason}",
        text(a.span),
        text(b.span),
        view.wording().schema(schema)
    );
    found.report(LINT.finding(place::domain(b.span), message).label(place::domain(a.span), "excludes it"));
    true
}
