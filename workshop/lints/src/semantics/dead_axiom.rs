//! An axiom whose body never holds.

use crate::lint::{Check, explanation};
use crate::{Level, Lint};
use analysis::happening::Schema;

use super::dead::{Verdict, in_domain, in_problem};

pub(crate) static LINT: Lint = Lint {
    name: "dead-axiom",
    level: Level::Default,
    explanation: explanation!("W0851"),
    checks: &[
        Check::Domain(|view, found| in_domain(view, &VERDICT, found)),
        Check::Problem(|view, found| in_problem(view, &VERDICT, found)),
    ],
};

static VERDICT: Verdict =
    Verdict { lint: &LINT, about: |o| matches!(o.schema, Schema::Axiom(_)), text: "never derives anything" };
