//! `[[goal]]` of `mission.toml` as it is written; `goals` reads its conditions.

use std::collections::BTreeMap;
use std::time::Duration;

use pddl::Span;

use diagnostics::Finding;
use diagnostics::toml::{Reader, Table, Text};

/// A goal as the manifest gives it.
#[derive(Clone, Debug)]
pub(crate) struct GoalEntry {
    pub(crate) name: Text,
    pub(crate) goal: Option<Text>,
    pub(crate) worth: Worth,
    pub(crate) when: Option<Text>,
    pub(crate) hold: Option<Text>,
    pub(crate) drop: Option<Text>,
    pub(crate) deadline: Option<Duration>,
    pub(crate) urgent: bool,
    pub(crate) maintained: bool,
}

/// What a goal is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Worth {
    /// It must be achieved; the higher priority goes first.
    Priority(u32),
    /// A plan may go without it, at this price.
    Penalty(f64),
}

/// Reads `[[goal]]`.
pub(crate) fn entries(reader: &mut Reader<'_>, root: &mut Table<'_>) -> Vec<GoalEntry> {
    let mut names: BTreeMap<String, Span> = BTreeMap::new();
    let tables = root.tables(reader, "goal");
    let entries: Vec<GoalEntry> = tables.into_iter().filter_map(|table| entry(reader, table)).collect();
    for entry in &entries {
        if let Some(first) = names.insert(entry.name.value.to_lowercase(), entry.name.span) {
            let message =
                format!("there are two goals `{}`: a report could not tell them apart", entry.name.value);
            let finding = Finding::error("E0713", reader.place(entry.name.span), message);
            reader.findings.push(finding.related(reader.place(first), "the first one"));
        }
    }
    entries
}

fn entry(reader: &mut Reader<'_>, mut table: Table<'_>) -> Option<GoalEntry> {
    let name = table.required_text(reader, "name");
    let (goal, worth) = (table.text(reader, "goal"), worth(reader, &mut table));
    let when = table.text(reader, "when");
    let hold = table.text(reader, "hold-when");
    let drop = table.text(reader, "drop-when");
    let deadline = table.seconds(reader, "deadline");
    let urgent = table.boolean(reader, "urgent").unwrap_or_default();
    let maintained = table.boolean(reader, "maintained").unwrap_or_default();
    table.finish(reader);
    Some(GoalEntry { name: name?, goal, worth, when, hold, drop, deadline, urgent, maintained })
}

/// `priority = N`, or `soft = true` with `penalty = N`.
fn worth(reader: &mut Reader<'_>, table: &mut Table<'_>) -> Worth {
    let soft = table.boolean(reader, "soft").unwrap_or_default();
    let (priority, penalty) = (table.count(reader, "priority", 0), table.number(reader, "penalty"));
    match (soft, priority, penalty) {
        (true, None, Some((penalty, _))) if penalty > 0.0 => Worth::Penalty(penalty),
        (false, priority, None) => Worth::Priority(priority.map_or(0, |(priority, _)| priority)),
        (true, _, _) => {
            let message = "a soft goal has a `penalty` greater than 0, and no `priority`";
            reader.error("E0705", table.key_span("soft"), message);
            Worth::Priority(0)
        }
        (false, _, Some((_, span))) => {
            reader.error("E0705", span, "only a goal with `soft = true` has a `penalty`");
            Worth::Priority(0)
        }
    }
}
