//! Reads `expected.toml`, and reports every mistake in it at its place.
//!
//! An entry names a file by any end of its path that is unambiguous: `[plan.late]` or `[plan."invalid/late"]`.

use crate::Fault;
use crate::expected::{
    Bounds, CodeAt, Details, DiagnosticsEntry, Expected, PlanEntry, ProblemEntry, Solvable, Verdict,
    Warnings, Why, Written, literal,
};
use crate::folder::{names, stem};
use diagnostics::did_you_mean;
use diagnostics::toml::{Reader, Table, Text};
use diagnostics::{Finding, SourceId};
use pddl::{Source, Span};
use validator::Number;

/// The files that an entry may name, each with its path from the folder.
#[derive(Clone, Debug, Default)]
pub(crate) struct Known {
    pub(crate) domains: Vec<(SourceId, String)>,
    pub(crate) problems: Vec<(SourceId, String)>,
    pub(crate) plans: Vec<(SourceId, String)>,
}

pub(crate) fn read(id: SourceId, source: &Source, known: &Known) -> (Expected, Vec<Finding>) {
    Reader::read(id, source, |reader, table| expected(reader, table, known))
}

fn expected(reader: &mut Reader<'_>, mut table: Table<'_>, known: &Known) -> Expected {
    let mut expected = Expected::default();
    if let Some(text) = table.text(reader, "warnings") {
        match text.value.as_str() {
            "allow" => {}
            "deny" => expected.warnings = Warnings::Deny,
            _ => unknown_word(reader, &text, "a word for warnings", &["allow", "deny"]),
        }
    }
    expected.timeout = table.seconds(reader, "timeout");
    for (key, span, mut entry) in entries(reader, &mut table, "problem") {
        let file = find(reader, &key, span, "problem", &known.problems);
        let problem = problem(reader, &mut entry, span);
        entry.finish(reader);
        let Some(file) = file else { continue };
        if expected.problems.iter().any(|p| p.file == file) {
            twice(reader, span, &key);
        }
        expected.problems.push(ProblemEntry { file, ..problem });
    }
    for (key, span, mut entry) in entries(reader, &mut table, "plan") {
        let file = find(reader, &key, span, "plan", &known.plans);
        let plan = plan(reader, &mut entry, span, known);
        entry.finish(reader);
        let Some(file) = file else { continue };
        if expected.plans.iter().any(|p| p.file == file) {
            twice(reader, span, &key);
        }
        expected.plans.push(PlanEntry { file, ..plan });
    }
    if let Some(mut entries) = table.table(reader, "diagnostics") {
        let all: Vec<_> = known.domains.iter().chain(&known.problems).cloned().collect();
        for (key, span) in entries.rest() {
            let file = find(reader, &key, span, "domain or problem", &all);
            let texts = entries.texts(reader, &key).unwrap_or_default();
            let codes = texts.iter().filter_map(|text| code_at(reader, text)).collect();
            let Some(file) = file else { continue };
            if expected.diagnostics.iter().any(|d| d.file == file) {
                twice(reader, span, &key);
            }
            expected.diagnostics.push(DiagnosticsEntry { file, span, expected: codes });
        }
    }
    table.finish(reader);
    expected
}

/// The tables in the table of that name.
fn entries<'d>(reader: &mut Reader<'_>, table: &mut Table<'d>, name: &str) -> Vec<(String, Span, Table<'d>)> {
    let Some(mut table) = table.table(reader, name) else { return Vec::new() };
    let keys = table.rest();
    keys.into_iter()
        .filter_map(|(key, span)| table.table(reader, &key).map(|entry| (key, span, entry)))
        .collect()
}

/// The placeholder of entries until their file is known.
const NOWHERE: SourceId = SourceId(u32::MAX);

fn problem(reader: &mut Reader<'_>, entry: &mut Table<'_>, span: Span) -> ProblemEntry {
    let solvable_at = entry.key_span("solvable");
    let solvable = entry.boolean(reader, "solvable");
    let bounds = Bounds {
        optimal_cost: number(reader, entry, "optimal-cost"),
        cost_at_most: number(reader, entry, "cost-at-most"),
        steps_at_most: count(reader, entry, "steps-at-most", 0),
    };
    let bound = [
        bounds.optimal_cost.map(|b| b.span),
        bounds.cost_at_most.map(|b| b.span),
        bounds.steps_at_most.map(|b| b.span),
    ];
    let bound = bound.into_iter().flatten().min();
    let solvable = match (solvable, bound) {
        (Some(false), Some(bound)) => {
            reader.error("T0103", bound, "a problem that has no plan has no cheapest or shortest one");
            Some(Written { value: Solvable::No, span: solvable_at })
        }
        (Some(false), None) => Some(Written { value: Solvable::No, span: solvable_at }),
        (Some(true), _) => Some(Written { value: Solvable::Yes(bounds), span: solvable_at }),
        (None, Some(at)) => Some(Written { value: Solvable::Yes(bounds), span: at }),
        (None, None) => None,
    };
    let timeout = entry.seconds(reader, "timeout");
    ProblemEntry { file: NOWHERE, span, solvable, timeout }
}

fn plan(reader: &mut Reader<'_>, entry: &mut Table<'_>, span: Span, known: &Known) -> PlanEntry {
    let problem = entry
        .text(reader, "problem")
        .and_then(|text| find(reader, &text.value, text.span, "problem", &known.problems));
    let verdict = entry.text(reader, "verdict").and_then(|text| {
        let verdict = Verdict::of_word(&text.value);
        if verdict.is_none() {
            unknown_word(reader, &text, "a verdict", &Verdict::ALL.map(Verdict::word));
        }
        Some(Written { value: verdict?, span: text.span })
    });
    let details = Details {
        cost: number(reader, entry, "cost"),
        why: entry.text(reader, "why").and_then(|text| why(reader, &text)),
        step: count(reader, entry, "step", 1),
        line: count(reader, entry, "line", 1),
        missing: entry
            .one_or_more(reader, "missing")
            .into_iter()
            .map(|text| Written { value: literal(&text.value), span: text.span })
            .collect(),
        says: entry
            .one_or_more(reader, "says")
            .into_iter()
            .map(|text| Written { span: text.span, value: text.value })
            .collect(),
    };
    PlanEntry { file: NOWHERE, span, problem, verdict, details }
}

fn why(reader: &mut Reader<'_>, text: &Text) -> Option<Written<Why>> {
    let value = match Fault::of_word(&text.value) {
        Some(fault) => Why::Fault(fault),
        None if is_code(&text.value) => Why::Code(text.value.clone()),
        None => {
            let words: Vec<_> = Fault::ALL.iter().map(|fault| fault.word()).collect();
            unknown_word(reader, text, "a fault of a plan", &words);
            return None;
        }
    };
    Some(Written { value, span: text.span })
}

/// `E0202 at 12`, or the code alone.
fn code_at(reader: &mut Reader<'_>, text: &Text) -> Option<Written<CodeAt>> {
    let mut words = text.value.split_whitespace();
    let code = words.next().filter(|code| is_code(code));
    let line = match (words.next(), words.next().map(str::parse::<u32>), words.next()) {
        (None, None, None) => Some(None),
        (Some("at"), Some(Ok(line)), None) if line > 0 => Some(Some(line)),
        _ => None,
    };
    let (Some(code), Some(line)) = (code, line) else {
        let message = format!("`{}` is no diagnostic", text.value);
        let help = "write `E0202 at 12`, a code and a line, or the code alone";
        let place = reader.place(text.span);
        reader.findings.push(Finding::error("T0104", place, message).help(help));
        return None;
    };
    Some(Written { value: CodeAt { code: code.to_owned(), line }, span: text.span })
}

/// A letter and four digits.
fn is_code(text: &str) -> bool {
    let bytes = text.as_bytes();
    bytes.len() == 5 && bytes[0].is_ascii_uppercase() && bytes[1..].iter().all(u8::is_ascii_digit)
}

fn number(reader: &mut Reader<'_>, table: &mut Table<'_>, key: &str) -> Option<Written<Number>> {
    let (value, span) = table.number(reader, key)?;
    Some(Written { value: Number::from_f64(value)?, span })
}

fn count(reader: &mut Reader<'_>, table: &mut Table<'_>, key: &str, least: u32) -> Option<Written<u32>> {
    table.count(reader, key, least).map(|(value, span)| Written { value, span })
}

fn unknown_word(reader: &mut Reader<'_>, text: &Text, what: &str, words: &[&str]) {
    let help = did_you_mean(&text.value, words.iter().copied())
        .unwrap_or_else(|| format!("one of: {}", words.join(", ")));
    let place = reader.place(text.span);
    let message = format!("`{}` is not {what}", text.value);
    reader.findings.push(Finding::error("T0104", place, message).help(help));
}

fn twice(reader: &mut Reader<'_>, span: Span, key: &str) {
    reader.error("T0102", span, format!("`{key}` is a file that has an entry already"));
}

/// The file that the key names; an unknown or ambiguous key is reported.
fn find(
    reader: &mut Reader<'_>,
    key: &str,
    span: Span,
    what: &str,
    files: &[(SourceId, String)],
) -> Option<SourceId> {
    let meant: Vec<_> = files.iter().filter(|(_, path)| path == key || names(key, path)).collect();
    let exact = meant.iter().find(|(_, path)| path == key);
    match (exact, meant.as_slice()) {
        (Some((id, _)), _) | (None, [(id, _)]) => Some(*id),
        (None, []) => {
            let known = files.iter().flat_map(|(_, path)| [stem(path), path.as_str()]);
            let help = did_you_mean(key, known);
            let place = reader.place(span);
            let message = format!("there is no {what} `{key}` in this suite");
            reader.findings.push(Finding::error("T0101", place, message).help_if(help));
            None
        }
        (None, several) => {
            let paths: Vec<_> = several.iter().map(|(_, path)| format!("`{path}`")).collect();
            reader.error("T0102", span, format!("`{key}` may be {}", paths.join(" or ")));
            None
        }
    }
}
