//! A requirement without its feature.

use pddl::model::Requirement;
use pddl::{FileKind, Span};

use super::features::{Need, grants, of_domain, of_problem};
use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{DomainView, ProblemView};
use crate::{Level, Lint, place, text};

pub(crate) static LINT: Lint = Lint {
    name: "unused-requirement",
    level: Level::Pedantic,
    explanation: explanation!("W0702"),
    checks: &[Check::Domain(in_domain), Check::Problem(with_problem)],
};

/// What only a domain can use.
const OF_DOMAINS: &[Requirement] = &[
    Requirement::Typing,
    Requirement::ConditionalEffects,
    Requirement::Fluents,
    Requirement::NumericFluents,
    Requirement::ObjectFluents,
    Requirement::DurationInequalities,
    Requirement::ContinuousEffects,
    Requirement::DerivedPredicates,
    Requirement::Time,
    Requirement::MethodPreconditions,
];

/// What a problem can use, too.
const OF_BOTH: &[Requirement] = &[
    Requirement::NegativePreconditions,
    Requirement::DisjunctivePreconditions,
    Requirement::Equality,
    Requirement::ExistentialPreconditions,
    Requirement::UniversalPreconditions,
    Requirement::QuantifiedPreconditions,
    Requirement::Adl,
    Requirement::DurativeActions,
    Requirement::TimedInitialLiterals,
    Requirement::TimedInitialFluents,
    Requirement::Preferences,
    Requirement::Constraints,
    Requirement::Hierarchy,
    Requirement::ActionCosts,
];

fn in_domain(view: &DomainView<'_>, found: &mut Findings) {
    check(view, OF_DOMAINS, &of_domain(view), found);
}

fn with_problem(view: &ProblemView<'_, '_>, found: &mut Findings) {
    let mut needs = of_domain(view.domain);
    needs.extend(of_problem(view));
    check(view.domain, OF_BOTH, &needs, found);
}

fn check(view: &DomainView<'_>, of: &[Requirement], needs: &[Need], found: &mut Findings) {
    let sections = text::sections(view.tree(), FileKind::Domain).filter(|s| s.is_headed(":requirements"));
    for section in sections {
        let mut end = section.span().start + 1;
        for node in section.children() {
            let (before, span) = (end, node.span());
            end = span.end;
            let Some(&flag) = of.iter().find(|flag| node.is(flag.as_str())) else { continue };
            if !needs.iter().any(|need| grants(flag, need)) {
                let message = format!("nothing here needs the requirement `{}`", flag.as_str());
                let edit = (place::domain(Span::new(before, end)), String::new());
                let finding = LINT.finding(place::domain(span), message);
                found.report(finding.fix(format!("remove `{}`", flag.as_str()), vec![edit]));
            }
        }
    }
}
