//! A method that can never carry out its task.

use crate::lint::{Check, explanation};
use crate::{Level, Lint};
use analysis::happening::Schema;

use super::dead::{Verdict, in_domain, in_problem};

pub(crate) static LINT: Lint = Lint {
    name: "dead-method",
    level: Level::Default,
    explanation: explanation!("W0853"),
    checks: &[
        Check::Domain(|view, found| in_domain(view, &VERDICT, found)),
        Check::Problem(|view, found| in_problem(view, &VERDICT, found)),
    ],
};

static VERDICT: Verdict =
    Verdict { lint: &LINT, about: |o| matches!(o.schema, Schema::Method(_)), text: "can never be used" };
