//! A condition that always holds.

use super::always_false::verdict;
use super::literals::{Group, Literal, contradictions, groups};
use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{DomainView, ProblemView};
use crate::{Level, Lint, place};
use diagnostics::Place;

pub(crate) static LINT: Lint = Lint {
    name: "always-true",
    level: Level::Default,
    explanation: explanation!("W0802"),
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
        let (Group::All(parts) | Group::Any(parts)) = group;
        for part in parts.iter().filter(|part| verdict(part) == Some(true)) {
            found.report(LINT.finding(place(part.span), "this always holds"));
        }
        let Group::Any(parts) = group else { continue };
        let literals: Vec<Literal> = parts.iter().filter_map(|part| Literal::of(part)).collect();
        for (literal, earlier) in contradictions(&literals) {
            let finding = LINT.finding(place(literal.span), "this or another part always holds");
            found.report(finding.label(place(earlier.span), "or this"));
        }
    }
}
