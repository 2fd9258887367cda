//! A trace as JSON.

use super::cause::{CauseRecord, cause_record};
use crate::number::Number;
use crate::report::subject::Subject;
use crate::trace::{FluentChange, Happening, Trace};
use crate::value::{GroundAtom, Value};
use serde::Serialize;

/// The changes at one time.
#[derive(Serialize)]
pub(super) struct HappeningRecord {
    time: Number,
    causes: Vec<CauseRecord>,
    added: Vec<String>,
    deleted: Vec<String>,
    derived: Vec<String>,
    no_longer_derived: Vec<String>,
    /// The continuous changes since the last happening.
    flowed: Vec<ChangeRecord>,
    fluents: Vec<ChangeRecord>,
}

#[derive(Serialize)]
struct ChangeRecord {
    fluent: String,
    before: Option<ValueRecord>,
    after: Option<ValueRecord>,
}

/// The value of a fluent.
#[derive(Serialize)]
#[serde(untagged)]
enum ValueRecord {
    Number(Number),
    Object(String),
}

/// A trace as data.
pub(super) fn happening_records(subject: &Subject<'_>, trace: &Trace) -> Vec<HappeningRecord> {
    let atoms = |atoms: &[GroundAtom]| atoms.iter().map(|atom| subject.atom(atom)).collect();
    let value = |value: Value| match value {
        Value::Number(number) => ValueRecord::Number(number),
        Value::Object(object) => ValueRecord::Object(subject.object(object)),
    };
    let changes = |changes: &[FluentChange]| {
        let record = |change: &FluentChange| ChangeRecord {
            fluent: subject.fluent(&change.fluent),
            before: change.before.map(value),
            after: change.after.map(value),
        };
        changes.iter().map(record).collect()
    };
    let record = |happening: &Happening| HappeningRecord {
        time: happening.time,
        causes: happening.causes.iter().map(|&at| cause_record(subject, at)).collect(),
        added: atoms(&happening.diff.added),
        deleted: atoms(&happening.diff.deleted),
        derived: atoms(&happening.diff.derived),
        no_longer_derived: atoms(&happening.diff.no_longer_derived),
        flowed: changes(&happening.diff.flowed),
        fluents: changes(&happening.diff.fluents),
    };
    trace.happenings.iter().map(record).collect()
}
