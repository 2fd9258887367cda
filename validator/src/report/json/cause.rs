//! A cause as JSON.

use super::place::{PlaceRecord, place_record};
use crate::cause::Cause;
use crate::number::Number;
use crate::plan::StepIndex;
use crate::report::causes::{cause_place, cause_time, show_cause};
use crate::report::subject::Subject;
use serde::Serialize;

/// A cause: its kind (a step, its start, …), the number of its step, its time and its place.
#[derive(Serialize)]
pub(super) struct CauseRecord {
    what: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    step: Option<u64>,
    text: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    time: Option<Number>,
    place: PlaceRecord,
}

pub(super) fn cause_record(subject: &Subject<'_>, cause: Cause) -> CauseRecord {
    let Subject { domain, problem, plan, .. } = *subject;
    CauseRecord {
        what: match cause {
            Cause::Step(_) => "step",
            Cause::Start(_) => "start",
            Cause::End(_) => "end",
            Cause::Timed(_) => "timed",
            Cause::Event(_) => "event",
        },
        step: cause.step().map(StepIndex::number),
        text: show_cause(domain, problem, plan, cause),
        time: cause_time(domain, problem, plan, cause),
        place: place_record(subject, cause_place(domain, problem, plan, cause)),
    }
}
