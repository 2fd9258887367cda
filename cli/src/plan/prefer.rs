//! `--prefer`: chooses between the two plans of `pelea plan --repair`.

use clap::ValueEnum;
use planner::Preference;
use serde::Serialize;

/// The criterion that decides between the repaired plan and the new one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Prefer {
    /// The plan that is closer to the old plan
    #[default]
    Stability,
    /// The cheaper plan
    Cost,
    /// The first plan found; plans anew only if nothing can be reused
    Speed,
}

impl Prefer {
    /// The planner's preference.
    pub(super) fn preference(self) -> Preference {
        match self {
            Self::Stability => Preference::Stability,
            Self::Cost => Preference::Cost,
            Self::Speed => Preference::Fastest,
        }
    }
}
