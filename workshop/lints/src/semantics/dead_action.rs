//! An action that no plan of any problem can contain.

use crate::lint::{Check, explanation};
use crate::{Level, Lint};
use analysis::happening::Schema;

use super::dead::{Verdict, in_domain, in_problem};

pub(crate) static LINT: Lint = Lint {
    name: "dead-action",
    level: Level::Default,
    explanation: explanation!("W0850"),
    checks: &[
        Check::Domain(|view, found| in_domain(view, &VERDICT, found)),
        Check::Problem(|view, found| in_problem(view, &VERDICT, found)),
    ],
};

static VERDICT: Verdict = Verdict {
    lint: &LINT,
    about: |o| {
        o.when.is_none() && matches!(o.schema, Schema::Action(_) | Schema::Durative(_) | Schema::Event(_))
    },
    text: "can never apply",
};
