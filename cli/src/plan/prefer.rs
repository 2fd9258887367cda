//! `--prefer`: which of two plans `pelea plan --repair` takes.

use clap::ValueEnum;
use planner::Preference;
use serde::Serialize;

/// The criterion that decides between the repaired plan and the new one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Prefer {
    /// The one that is nearer to the old plan.
    #[default]
    Stability,
    /// The cheaper one.
    Cost,
    /// The first one: a new plan is looked for only where nothing can be reused.
    Speed,
}

impl Prefer {
    /// As the planner names it.
    pub(super) fn preference(self) -> Preference {
        match self {
            Self::Stability => Preference::Stability,
            Self::Cost => Preference::Cost,
            Self::Speed => Preference::Fastest,
        }
    }
}
