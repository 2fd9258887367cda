//! A part of a domain that no given problem has data for.

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::ProblemView;
use crate::{Level, Lint};
use analysis::reachability::RootCause;

use super::dead::{Verdict, report};

pub(crate) static LINT: Lint = Lint {
    name: "idle-schema",
    level: Level::Pedantic,
    explanation: explanation!("W0856"),
    checks: &[Check::Problem(check)],
};

static VERDICT: Verdict = Verdict { lint: &LINT, about: |_| true, text: "has no data in any problem" };

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    report(view.analysis(), &view.wording(), &VERDICT, &|dead| dead.root_cause == RootCause::Data, found);
}
