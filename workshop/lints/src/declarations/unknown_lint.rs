//! `; allow(no-such-lint)`

use diagnostics::Place;
use pddl::{Source, Span};

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "unknown-lint",
    level: Level::Default,
    explanation: explanation!("W0700"),
    checks: &[
        Check::Domain(|view, found| check(view.source, &view.allows.unknown, place::domain, found)),
        Check::Problem(|view, found| check(view.source, &view.allows.unknown, place::problem, found)),
    ],
};

fn check(source: &Source, unknown: &[Span], place: fn(Span) -> Place, found: &mut Findings) {
    for &span in unknown {
        let message = format!("no lint is called `{}`", source.slice(span));
        found.report(LINT.finding(place(span), message).help("`pelea explain` lists all lints"));
    }
}
