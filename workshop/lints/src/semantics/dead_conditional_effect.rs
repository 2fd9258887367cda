//! A `when` whose condition never holds when its action applies.

use crate::lint::{Check, explanation};
use crate::{Level, Lint};

use super::dead::{Verdict, in_domain, in_problem};

pub(crate) static LINT: Lint = Lint {
    name: "dead-conditional-effect",
    level: Level::Default,
    explanation: explanation!("W0852"),
    checks: &[
        Check::Domain(|view, found| in_domain(view, &VERDICT, found)),
        Check::Problem(|view, found| in_problem(view, &VERDICT, found)),
    ],
};

static VERDICT: Verdict = Verdict { lint: &LINT, about: |o| o.when.is_some(), text: "never happens" };
