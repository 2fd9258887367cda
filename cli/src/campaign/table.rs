//! The quiet table: a row per disruption, a column per outcome that occurred.

use super::library::Disturbance;
use super::record::{Outcome, Run};
use crate::console::Console;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The counts of one disruption.
#[derive(Clone, Debug, Default)]
pub(super) struct Row {
    /// Runs by how they ended.
    pub(super) outcomes: BTreeMap<Outcome, usize>,
    /// Runs that broke an invariant.
    pub(super) broken: usize,
    /// New plans, over all runs.
    pub(super) replans: u64,
}

impl Row {
    pub(super) fn count(&mut self, run: &Run) {
        *self.outcomes.entry(run.outcome).or_default() += 1;
        self.broken += usize::from(!run.broken.is_empty());
        self.replans += u64::from(run.replans);
    }

    pub(super) fn runs(&self) -> usize {
        self.outcomes.values().sum()
    }

    /// New plans in a run.
    fn mean(&self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "a mean for people")]
        let mean = self.replans as f64 / self.runs().max(1) as f64;
        mean
    }

    pub(super) fn of(&self, outcome: Outcome) -> usize {
        self.outcomes.get(&outcome).copied().unwrap_or_default()
    }
}

/// A row as a record.
#[derive(Serialize)]
struct Record<'a> {
    kind: &'static str,
    disruption: &'a str,
    runs: usize,
    outcomes: &'a BTreeMap<Outcome, usize>,
    broken: usize,
    replans: f64,
}

impl<'a> Record<'a> {
    fn new(disruption: &'a str, row: &'a Row) -> Self {
        let (runs, outcomes, broken) = (row.runs(), &row.outcomes, row.broken);
        Self {
            kind: "disruption",
            disruption,
            runs,
            outcomes,
            broken,
            replans: (row.mean() * 10.0).round() / 10.0,
        }
    }
}

/// The rows of some runs, by disruption.
pub(super) fn rows(runs: &[Run]) -> BTreeMap<&str, Row> {
    let mut rows: BTreeMap<&str, Row> = BTreeMap::new();
    for run in runs {
        rows.entry(&run.key.disruption).or_default().count(run);
    }
    rows
}

/// Writes the table.
pub(super) fn show(library: &[Disturbance], runs: &[Run], console: &mut Console<'_>) {
    let rows = rows(runs);
    let mut total = Row::default();
    runs.iter().for_each(|run| total.count(run));
    let columns: Vec<Outcome> = Outcome::ALL.into_iter().filter(|&o| total.of(o) > 0).collect();
    let widest = library.iter().map(|d| d.name.chars().count()).max().unwrap_or_default();
    let mut head = format!("{:widest$}  {:>7}", "", "runs");
    for outcome in &columns {
        let _ = write!(head, "  {:>13}", outcome.name());
    }
    console.result(&format!("{head}  {:>7}  {:>8}", "broken", "replans"));
    for (name, row) in &rows {
        console.record(&Record::new(name, row));
    }
    let line = |name: &str, row: &Row| {
        let mut line = format!("{name:widest$}  {:>7}", row.runs());
        for &outcome in &columns {
            let _ = write!(line, "  {:>13}", number(row.of(outcome)));
        }
        format!("{line}  {:>7}  {:>8.1}", number(row.broken), row.mean())
    };
    for disturbance in library {
        if let Some(row) = rows.get(disturbance.name.as_str()) {
            console.result(&line(&disturbance.name, row));
        }
    }
    console.result(&line("all", &total));
}

/// A count that is quiet where there is nothing.
fn number(count: usize) -> String {
    if count == 0 { "·".to_owned() } else { count.to_string() }
}
