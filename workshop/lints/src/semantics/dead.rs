//! What the lints about silent parts of a domain share.

use analysis::reachability::{Dead, Origin, RootCause, Wording};
use analysis::text::listed;

use crate::analysis::Analysis;
use crate::finding::Findings;
use crate::view::{DomainView, ProblemView, is_here};
use crate::{Lint, place};

/// Consequences that are named.
const NAMED: usize = 6;

/// What one of these lints is about, and how it says so.
pub(crate) struct Verdict {
    pub(crate) lint: &'static Lint,
    /// Whether it is about an origin.
    pub(crate) about: fn(&Origin) -> bool,
    /// `can never apply`
    pub(crate) text: &'static str,
}

/// What no problem of the domain can do.
pub(crate) fn in_domain(view: &DomainView<'_>, verdict: &Verdict, found: &mut Findings) {
    let own = |dead: &Dead| dead.root_cause == RootCause::Domain && !view.types_are_combined.get();
    report(view.analysis(), &view.wording(), verdict, &own, found);
}

/// What this problem cannot do although the domain could.
pub(crate) fn in_problem(view: &ProblemView<'_, '_>, verdict: &Verdict, found: &mut Findings) {
    let always = &view.domain.analysis().never.silent;
    let is_always = |dead: &Dead| !view.domain.types_are_combined.get() && always.contains(&dead.origin);
    let own = |dead: &Dead| dead.root_cause == RootCause::Domain && !is_always(dead);
    report(view.analysis(), &view.wording(), verdict, &own, found);
}

/// Reports what the lint is about and `wanted`; equal reasons are one finding.
pub(crate) fn report(
    analysis: &Analysis<'_>,
    wording: &Wording<'_>,
    verdict: &Verdict,
    wanted: &dyn Fn(&Dead) -> bool,
    found: &mut Findings,
) {
    let mut said: Vec<(&str, usize)> = Vec::new();
    for dead in analysis.never.dead.iter().filter(|d| (verdict.about)(&d.origin) && wanted(d)) {
        let span = dead.origin.when.unwrap_or_else(|| dead.origin.schema.span(wording.domain));
        if !is_here(span) {
            continue;
        }
        if let Some((_, at)) = said.iter().find(|(reason, _)| *reason == dead.reason) {
            let same = format!("{} for the same reason", wording.title(&dead.origin));
            let first = &mut found.0[*at];
            first.finding.related.push((place::domain(span), same));
            continue;
        }
        said.push((&dead.reason, found.0.len()));
        let title = wording.title(&dead.origin);
        let message = format!("{title} {}: {}", verdict.text, dead.reason);
        let mut finding = verdict.lint.finding(place::domain(span), message);
        if let Some(needed) = dead.needed.filter(|&n| is_here(n) && n != span) {
            finding = finding.label(place::domain(needed), "needed here");
        }
        if !dead.consequences.is_empty() {
            let mut titles: Vec<String> =
                dead.consequences.iter().take(NAMED).map(|o| wording.title(o)).collect();
            let more = dead.consequences.len() - titles.len();
            if more > 0 {
                titles.push(format!("{more} more"));
            }
            finding = finding.help(format!("silent because of it: {}", listed(&titles, "and")));
        }
        found.report(finding);
    }
}
