//! `[report]`: the headings and marks of the report, in one language.

use diagnostics::toml::{Reader, Table};

/// Headings and marks of the report.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReportLabels {
    /// Title.
    pub heading: String,
    /// Column of the items.
    pub item: String,
    /// Column of the answers.
    pub answer: String,
    /// Column of the scores.
    pub score: String,
    /// The sum.
    pub total: String,
    /// Mark of an item without an answer.
    pub unanswered: String,
    /// Mark of an item of which it is not known whether the person perceived the question.
    pub not_perceived: String,
    /// Mark of an item that was asked, and something came between.
    pub interrupted: String,
    /// Mark of an item that was not asked.
    pub not_reached: String,
    /// Remark when all items were answered.
    pub complete: String,
    /// Remark otherwise.
    pub incomplete: String,
}

/// Reads `[report]`.
pub(super) fn read(reader: &mut Reader<'_>, root: &mut Table<'_>) -> ReportLabels {
    root.require(reader, "report");
    let Some(mut table) = root.table(reader, "report") else { return ReportLabels::default() };
    let not_perceived = table.text(reader, "not-perceived").map(|t| t.value);
    let interrupted = table.text(reader, "interrupted").map(|t| t.value);
    let mut of = |key: &str| table.required_text(reader, key).map(|t| t.value).unwrap_or_default();
    let (unanswered, not_reached) = (of("unanswered"), of("not-reached"));
    let labels = ReportLabels {
        heading: of("heading"),
        item: of("item"),
        answer: of("answer"),
        score: of("score"),
        total: of("total"),
        not_perceived: not_perceived.unwrap_or_else(|| unanswered.clone()),
        unanswered,
        interrupted: interrupted.unwrap_or_else(|| not_reached.clone()),
        not_reached,
        complete: of("complete"),
        incomplete: of("incomplete"),
    };
    table.finish(reader);
    labels
}
