//! What the lints about silent parts of a domain share.

use crate::analysis::{Analysis, Dead, place};
use crate::finding::Findings;
use crate::reachability::{Nature, Origin, Words, listed};
use crate::view::{DomainView, ProblemView, is_here};
use crate::{Finding, Lint, Place};

/// Consequences that are named.
const NAMED: usize = 6;

/// How a lint says it.
pub(crate) struct Wording {
    pub(crate) lint: &'static Lint,
    /// Which parts it is about.
    pub(crate) about: fn(&Origin) -> bool,
    /// `can never apply`
    pub(crate) verdict: &'static str,
}

/// What no problem of the domain can do.
pub(crate) fn in_domain(view: &DomainView<'_>, wording: &Wording, found: &mut Findings) {
    report(view.analysis(), &view.words(), wording, &|dead| dead.nature == Nature::Domain, found);
}

/// What this problem cannot do although the domain could.
pub(crate) fn in_problem(view: &ProblemView<'_, '_>, wording: &Wording, found: &mut Findings) {
    let always = &view.domain.analysis().silent;
    let own = |dead: &Dead| dead.nature == Nature::Domain && !always.contains(&dead.origin);
    report(view.analysis(), &view.words(), wording, &own, found);
}

/// Reports what the lint is about and `wanted`; equal reasons are one finding.
pub(crate) fn report(
    analysis: &Analysis<'_>,
    words: &Words<'_>,
    wording: &Wording,
    wanted: &dyn Fn(&Dead) -> bool,
    found: &mut Findings,
) {
    let mut said: Vec<(&str, usize)> = Vec::new();
    for dead in analysis.dead.iter().filter(|d| (wording.about)(&d.origin) && wanted(d)) {
        let span = dead.origin.when.unwrap_or_else(|| place(words.domain, &dead.origin.schema));
        if !is_here(span) {
            continue;
        }
        if let Some((_, at)) = said.iter().find(|(reason, _)| *reason == dead.reason) {
            let same = format!("{} for the same reason", words.title(&dead.origin));
            let first = &mut found.0[*at];
            first.labels.push((Place::domain(span), same));
            continue;
        }
        said.push((&dead.reason, found.0.len()));
        let title = words.title(&dead.origin);
        let message = format!("{title} {}: {}", wording.verdict, dead.reason);
        let mut finding = Finding::new(wording.lint, Place::domain(span), message);
        if let Some(needed) = dead.needed.filter(|&n| is_here(n) && n != span) {
            finding = finding.label(Place::domain(needed), "needed here");
        }
        if !dead.consequences.is_empty() {
            let mut titles: Vec<String> =
                dead.consequences.iter().take(NAMED).map(|o| words.title(o)).collect();
            let more = dead.consequences.len() - titles.len();
            if more > 0 {
                titles.push(format!("{more} more"));
            }
            finding = finding.help(format!("silent because of it: {}", listed(&titles)));
        }
        found.report(finding);
    }
}
