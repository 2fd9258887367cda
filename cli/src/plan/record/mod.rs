//! The results of `pelea plan` as JSON:
//!
//! ```json
//! {"kind": "plan", "outcome": "solved", "steps": ["(go a b)"], "cost": 1, "cost_kind": "unit_cost",
//!  "search": "dual", "message": null,
//!  "statistics": {"read_ms": 1.2, "ground_ms": 0.4, "search_ms": 0.3, "facts": 3, "operators": 4,
//!                 "expanded": 2, "evaluated": 2, "generated": 4}}
//! ```
//!
//! With `--anytime` the record has `optimal`, whether no plan is better, and each plan before has a record of its own
//! (`anytime`). With `--repair` it has `repair`, both plans with their figures.
//!
//! `outcome` is `solved`, `unsolvable` (with the reason in `message` and, as data, in `unsolvable`), `limit` (with the
//! limit in `message`) or `unsupported`. `statistics` is null if grounding did not end.

mod repair;
mod unsolvable;

pub(super) use repair::{Figures, RepairRecord};
pub(super) use unsolvable::UnsolvableRecord;

use pddl::model::Problem;
use planner::{Report, Task};
use serde::Serialize;
use validator::{Number, Valid};

/// The quantity that a plan's cost counts.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum CostKind {
    /// Steps.
    UnitCost,
    /// The problem's metric.
    GeneralCost,
}

impl CostKind {
    /// The kind of cost of the plans of a problem.
    pub(super) fn of(problem: &Problem) -> Self {
        if problem.metric.is_some() { Self::GeneralCost } else { Self::UnitCost }
    }

    /// As plan files write it.
    pub(super) const fn text(self) -> &'static str {
        match self {
            Self::UnitCost => "unit cost",
            Self::GeneralCost => "general cost",
        }
    }
}

/// The result of `pelea plan`.
#[derive(Serialize)]
pub(super) struct PlanRecord {
    kind: &'static str,
    outcome: &'static str,
    pub(super) steps: Vec<String>,
    cost: Option<Number>,
    cost_kind: Option<CostKind>,
    search: &'static str,
    /// With `--anytime`: whether no plan is better.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) optimal: Option<bool>,
    /// With `--repair`: how the old plan was repaired.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) repair: Option<RepairRecord>,
    /// The reasons for an unsolvable problem.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) unsolvable: Option<UnsolvableRecord>,
    message: Option<String>,
    pub(super) statistics: Option<StatisticsRecord>,
}

impl PlanRecord {
    /// The record before the search has an outcome.
    pub(super) fn of(search: &'static str) -> Self {
        Self {
            kind: "plan",
            outcome: "limit",
            steps: Vec::new(),
            cost: None,
            cost_kind: None,
            search,
            optimal: None,
            repair: None,
            unsolvable: None,
            message: None,
            statistics: None,
        }
    }

    /// Sets an outcome without a plan, and its reason.
    pub(super) fn end(&mut self, outcome: &'static str, message: &str) {
        self.outcome = outcome;
        self.message = Some(message.to_owned());
    }

    /// Sets the outcome of a valid plan.
    pub(super) fn solved(&mut self, valid: &Valid, kind: CostKind) {
        self.outcome = "solved";
        self.cost = Some(valid.cost());
        self.cost_kind = Some(kind);
    }
}

/// What the search took.
#[derive(Serialize)]
pub(super) struct StatisticsRecord {
    read_ms: f64,
    ground_ms: f64,
    search_ms: f64,
    facts: usize,
    operators: usize,
    expanded: u64,
    evaluated: u64,
    generated: u64,
}

impl StatisticsRecord {
    /// The figures of a search; the times are those of reading, grounding and searching, in milliseconds.
    pub(super) fn of(task: &Task, report: &Report, [read_ms, ground_ms, search_ms]: [f64; 3]) -> Self {
        Self {
            read_ms,
            ground_ms,
            search_ms,
            facts: task.facts().len(),
            operators: task.operators().len(),
            expanded: report.statistics.expanded,
            evaluated: report.statistics.evaluated,
            generated: report.statistics.generated,
        }
    }

    /// The figures as a line.
    pub(super) fn line(&self, search: &str) -> String {
        format!(
            "read {} ms, ground {} ms ({} facts, {} operators), {search} {} ms ({} expanded, {} evaluated)",
            self.read_ms,
            self.ground_ms,
            self.facts,
            self.operators,
            self.search_ms,
            self.expanded,
            self.evaluated
        )
    }
}

/// A plan that `--anytime` found.
#[derive(Serialize)]
pub(super) struct BetterPlanRecord {
    pub(super) kind: &'static str,
    pub(super) number: usize,
    pub(super) steps: u32,
    pub(super) cost: Number,
    pub(super) cost_kind: CostKind,
    pub(super) after_ms: f64,
    pub(super) file: Option<String>,
}
