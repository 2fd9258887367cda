//! A method that can never carry out its task.

use crate::lint::{Check, explanation};
use crate::reachability::Schema;
use crate::{Level, Lint};

use super::dead::{Wording, in_domain, in_problem};

pub(crate) static LINT: Lint = Lint {
    name: "dead-method",
    level: Level::Default,
    explanation: explanation!("W0853"),
    checks: &[
        Check::Domain(|view, found| in_domain(view, &WORDING, found)),
        Check::Problem(|view, found| in_problem(view, &WORDING, found)),
    ],
};

static WORDING: Wording =
    Wording { lint: &LINT, about: |o| matches!(o.schema, Schema::Method(_)), verdict: "can never be used" };
