//! The repair of a plan as JSON, and its figures in words.
//!
//! ```json
//! {"repair": {"old": "OLD_PLAN", "old_steps": 4, "left_out": ["(fly a b)"], "prefer": "stability", "way": "reuse",
//!   "reused": {"steps": 5, "cost": 5, "distance": 1, "removed": 0, "added": 1, "moved": 0, "search_ms": 0.1,
//!              "expanded": 3},
//!   "scratch": {…}, "scratch_limit": null}}
//! ```
//!
//! `reused` and `scratch` are null if there is no such plan; `scratch_limit` names the limit that ended the search for a
//! new plan.

use crate::plan::prefer::Prefer;
use planner::Way;
use serde::Serialize;
use validator::Number;

/// The repair of an old plan.
#[derive(Serialize)]
pub(crate) struct RepairRecord {
    pub(crate) old: String,
    pub(crate) old_steps: usize,
    pub(crate) left_out: Vec<String>,
    pub(crate) prefer: Prefer,
    pub(crate) way: Option<Way>,
    pub(crate) reused: Option<Figures>,
    pub(crate) scratch: Option<Figures>,
    pub(crate) scratch_limit: Option<&'static str>,
}

/// A plan's cost, its distance from the old plan, and the effort of its search.
#[derive(Serialize)]
pub(crate) struct Figures {
    pub(crate) steps: usize,
    pub(crate) cost: Number,
    pub(crate) distance: usize,
    pub(crate) removed: usize,
    pub(crate) added: usize,
    pub(crate) moved: usize,
    pub(crate) search_ms: f64,
    pub(crate) expanded: u64,
}

impl Figures {
    /// `repaired: 5 steps, cost 5, …`.
    pub(crate) fn line(&self, name: &str) -> String {
        let moved = if self.moved > 0 { format!(", {} moved", self.moved) } else { String::new() };
        format!(
            "{name}: {} steps, cost {}, distance {} (+{} -{}{moved}), {} ms, {} expanded",
            self.steps, self.cost, self.distance, self.added, self.removed, self.search_ms, self.expanded
        )
    }
}
