//! A part of a domain that the problems at hand have no data for.

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::reachability::Nature;
use crate::view::ProblemView;
use crate::{Level, Lint};

use super::dead::{Wording, report};

pub(crate) static LINT: Lint = Lint {
    name: "idle-schema",
    level: Level::Pedantic,
    explanation: explanation!("W0856"),
    checks: &[Check::Problem(check)],
};

static WORDING: Wording = Wording { lint: &LINT, about: |_| true, verdict: "has no data in any problem" };

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    report(view.analysis(), &view.words(), &WORDING, &|dead| dead.nature == Nature::Data, found);
}
