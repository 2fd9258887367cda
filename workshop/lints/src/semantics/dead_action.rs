//! An action that no plan of any problem can contain.

use crate::lint::{Check, explanation};
use crate::reachability::Schema;
use crate::{Level, Lint};

use super::dead::{Wording, in_domain, in_problem};

pub(crate) static LINT: Lint = Lint {
    name: "dead-action",
    level: Level::Default,
    explanation: explanation!("W0850"),
    checks: &[
        Check::Domain(|view, found| in_domain(view, &WORDING, found)),
        Check::Problem(|view, found| in_problem(view, &WORDING, found)),
    ],
};

static WORDING: Wording = Wording {
    lint: &LINT,
    about: |o| {
        o.when.is_none() && matches!(o.schema, Schema::Action(_) | Schema::Durative(_) | Schema::Event(_))
    },
    verdict: "can never apply",
};
