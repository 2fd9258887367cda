//! The unsatisfied parts of a condition, as JSON.
//!
//! A part has a `kind`, a `place`, and the other fields that its kind needs; the rest is omitted.
//! Parts of alternatives, counterexamples and almost-witnesses are nested.

use super::cause::{CauseRecord, cause_record};
use super::place::{PlaceRecord, at};
use crate::cause::Cause;
use crate::number::Number;
use crate::report::subject::Subject;
use crate::verdict::{File, Operand, Unsatisfied};
use pddl::model::{Name, ObjectId, TypeId};
use serde::Serialize;

/// A comparison and its sides.
#[derive(Serialize)]
pub(super) struct ComparisonRecord {
    pub(super) comparison: &'static str,
    pub(super) left: OperandRecord,
    pub(super) right: OperandRecord,
}

/// A side of a comparison. `value` is null if it is undefined.
#[derive(Serialize)]
pub(super) struct OperandRecord {
    pub(super) value: Option<Number>,
    pub(super) fluents: Vec<(String, Option<Number>)>,
}

/// A smallest unsatisfied part.
#[derive(Default, Serialize)]
pub(super) struct PartRecord {
    kind: &'static str,
    place: Option<PlaceRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    atom: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fluent: Option<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    objects: Vec<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    types: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    wanted: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    derived: Option<bool>,
    /// The cause that deleted a missing atom, or added an unwanted one.
    #[serde(skip_serializing_if = "Option::is_none")]
    by: Option<CauseRecord>,
    #[serde(flatten)]
    compared: Option<ComparisonRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    value: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    actual: Option<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    binding: Vec<(String, String)>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    branches: Vec<Vec<PartRecord>>,
    /// The reason why the axioms derive an atom, or do not.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    because: Vec<PartRecord>,
}

pub(super) fn operand_record(subject: &Subject<'_>, operand: &Operand) -> OperandRecord {
    OperandRecord {
        value: operand.value.as_ref().ok().copied(),
        fluents: operand.fluents.iter().map(|(f, v)| (subject.fluent(f), *v)).collect(),
    }
}

pub(super) fn part_records(subject: &Subject<'_>, parts: &[Unsatisfied], file: File) -> Vec<PartRecord> {
    parts.iter().map(|part| part_record(subject, part, file)).collect()
}

pub(super) fn binding_record(subject: &Subject<'_>, binding: &[(Name, ObjectId)]) -> Vec<(String, String)> {
    binding.iter().map(|(name, object)| (format!("?{name}"), subject.object(*object))).collect()
}

fn part_record(subject: &Subject<'_>, part: &Unsatisfied, file: File) -> PartRecord {
    let mut record = PartRecord { place: at(subject, file, part.span()), ..PartRecord::default() };
    let by = |by: &Option<Cause>| by.map(|by| cause_record(subject, by));
    match part {
        Unsatisfied::Missing { atom, deleted_by, derived, because, .. } => {
            record.kind = "missing";
            record.because = part_records(subject, because, File::Domain);
            record.atom = Some(subject.atom(atom));
            record.derived = Some(*derived);
            record.by = by(deleted_by);
        }
        Unsatisfied::Present { atom, added_by, derived, because, .. } => {
            record.kind = "present";
            record.because = part_records(subject, because, File::Domain);
            record.atom = Some(subject.atom(atom));
            record.derived = Some(*derived);
            record.by = by(added_by);
        }
        Unsatisfied::Type { object, types, wanted, .. } => {
            record.kind = "type";
            record.objects = vec![subject.object(*object)];
            let name = |&t: &TypeId| subject.domain.types[t].name.to_string();
            record.types = types.0.iter().map(name).collect();
            record.wanted = Some(*wanted);
        }
        Unsatisfied::Different { left, right, .. } => {
            record.kind = "different";
            record.objects = vec![subject.object(*left), subject.object(*right)];
        }
        Unsatisfied::Same { object, .. } => {
            record.kind = "same";
            record.objects = vec![subject.object(*object)];
        }
        Unsatisfied::Comparison { comparison, wanted, left, right, .. } => {
            record.kind = "comparison";
            record.wanted = Some(*wanted);
            record.compared = Some(ComparisonRecord {
                comparison: comparison.symbol(),
                left: operand_record(subject, left),
                right: operand_record(subject, right),
            });
        }
        Unsatisfied::Fluent { fluent, value, wanted, actual, .. } => {
            record.kind = "fluent";
            record.fluent = Some(subject.fluent(fluent));
            record.value = Some(subject.object(*value));
            record.wanted = Some(*wanted);
            record.actual = actual.map(|object| subject.object(object));
        }
        Unsatisfied::Alternatives { branches, .. } => {
            record.kind = "alternatives";
            record.branches = branches.iter().map(|branch| part_records(subject, branch, file)).collect();
        }
        Unsatisfied::Counterexample { binding, parts, .. } => {
            record.kind = "counterexample";
            record.binding = binding_record(subject, binding);
            record.branches = vec![part_records(subject, parts, file)];
        }
        Unsatisfied::NoWitness { closest, .. } => {
            record.kind = "no_witness";
            if let Some(near) = closest {
                record.binding = binding_record(subject, &near.binding);
                record.branches = vec![part_records(subject, &near.parts, file)];
            }
        }
    }
    record
}
