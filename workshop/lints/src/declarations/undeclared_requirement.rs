//! A feature without its requirement.

use diagnostics::Place;
use pddl::model::Requirements;
use pddl::syntax::Tree;
use pddl::{FileKind, Span};

use super::features::{Need, is_granted, of_domain, of_problem};
use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{DomainView, ProblemView, is_here};
use crate::{Level, Lint, place, text};

pub(crate) static LINT: Lint = Lint {
    name: "undeclared-requirement",
    level: Level::Default,
    explanation: explanation!("W0701"),
    checks: &[Check::Domain(in_domain), Check::Problem(in_problem)],
};

fn in_domain(view: &DomainView<'_>, found: &mut Findings) {
    check(&of_domain(view), &view.domain.requirements, view.tree(), FileKind::Domain, found);
}

fn in_problem(view: &ProblemView<'_, '_>, found: &mut Findings) {
    // What the domain lacks for itself is said there, and the domain's requirements hold here.
    let lacking = of_domain(view.domain);
    let mut needs = of_problem(view);
    needs.retain(|need| lacking.iter().all(|n| n.requirement != need.requirement));
    let mut declared = view.domain.domain.requirements.clone();
    declared.0.extend(&view.problem.requirements.0);
    check(&needs, &declared, view.tree(), FileKind::Problem, found);
}

fn check(needs: &[Need], declared: &Requirements, tree: &Tree<'_>, file: FileKind, found: &mut Findings) {
    for need in needs.iter().filter(|need| is_here(need.span) && !is_granted(need, declared)) {
        let flag = need.requirement.as_str();
        let message = format!("{} needs the requirement `{flag}`", need.what);
        let mut finding = LINT.finding(place::of_file(file, need.span), message);
        if let Some(edit) = declare(tree, file, flag) {
            finding = finding.fix(format!("declare `{flag}`"), vec![edit]);
        }
        found.report(finding);
    }
}

/// Adds a flag to the requirements; writes the section if there is none.
fn declare(tree: &Tree<'_>, file: FileKind, flag: &str) -> Option<(Place, String)> {
    let section = text::sections(tree, file).find(|section| section.is_headed(":requirements"));
    if let Some(last) = section.and_then(|section| section.children().last()) {
        return Some((after(file, last.span()), format!(" {flag}")));
    }
    let mut sections = text::definition(tree, file)?.children().skip(1);
    // Behind `(domain NAME)`, or behind the problem's `(:domain NAME)`, which stands first by custom.
    let name = sections.next()?;
    let before =
        sections.next().filter(|s| file == FileKind::Problem && s.is_headed(":domain")).unwrap_or(name);
    Some((after(file, before.span()), format!("\n  (:requirements {flag})")))
}

fn after(file: FileKind, span: Span) -> Place {
    place::of_file(file, Span::new(span.end, span.end))
}
