//! Why a plan is not valid, as JSON: the failing step, and each unsatisfied part as data.

use super::cause::{CauseRecord, cause_record};
use super::network::{NetworkRecord, network_record};
use super::place::{PlaceRecord, at};
use super::unsatisfied::{
    ComparisonRecord, OperandRecord, PartRecord, binding_record, operand_record, part_records,
};
use crate::cause::Cause;
use crate::number::Number;
use crate::report::interference::{Access, Interference, interference_of};
use crate::report::subject::Subject;
use crate::verdict::{
    Breach, ChangeFault, EffectFault, Failure, File, NetworkFault, NumericFault, Parent, Shared, StepFault,
};
use serde::Serialize;

/// Why a plan is not valid.
#[derive(Default, Serialize)]
pub(super) struct FailureRecord {
    reason: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    at: Option<CauseRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    with: Option<CauseRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    time: Option<Number>,
    #[serde(skip_serializing_if = "Option::is_none")]
    about: Option<String>,
    #[serde(flatten)]
    compared: Option<ComparisonRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    place: Option<PlaceRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    network: Option<NetworkRecord>,
    /// The kind of fault, if there are several.
    #[serde(skip_serializing_if = "Option::is_none")]
    fault: Option<&'static str>,
    /// The accesses of two interfering happenings, or the two conflicting effects.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    roles: Vec<RoleRecord>,
    /// The values of the variables for which a constraint is violated.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    binding: Vec<(String, String)>,
    /// The number of violating states.
    #[serde(skip_serializing_if = "Option::is_none")]
    states: Option<usize>,
    /// The times of the first violating states.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    times: Vec<Number>,
    parts: Vec<PartRecord>,
}

/// An access: `adds`, `deletes`, `changes` or `needs`, and its place.
#[derive(Serialize)]
struct RoleRecord {
    does: &'static str,
    place: PlaceRecord,
}

/// The complete record of a failure.
pub(super) fn failure_record(subject: &Subject<'_>, failure: &Failure) -> FailureRecord {
    let mut record = FailureRecord::default();
    match failure {
        Failure::Step { step, fault } => {
            record.reason = "step";
            record.fault = Some(match fault {
                StepFault::UnknownAction => "unknown_action",
                StepFault::Arity { .. } => "arity",
                StepFault::NoDuration => "no_duration",
                StepFault::Type { .. } => "type",
            });
            record.at = Some(cause_record(subject, Cause::Step(*step)));
        }
        Failure::Precondition { at, parts } => {
            record.reason = "precondition";
            record.at = Some(cause_record(subject, *at));
            record.parts = part_records(subject, parts, File::Domain);
        }
        Failure::Duration { step, actual, comparison, bound, span } => {
            record.reason = "duration";
            record.at = Some(cause_record(subject, Cause::Start(*step)));
            record.compared = Some(ComparisonRecord {
                comparison: comparison.symbol(),
                left: OperandRecord { value: Some(*actual), fluents: Vec::new() },
                right: operand_record(subject, bound),
            });
            record.place = at(subject, File::Domain, *span);
        }
        Failure::Invariant { step, time, parts } => {
            record.reason = "over_all";
            record.at = Some(cause_record(subject, Cause::Start(*step)));
            record.time = Some(*time);
            record.parts = part_records(subject, parts, File::Domain);
        }
        Failure::Interference { first, second, over } => {
            record.reason = "interference";
            record.at = Some(cause_record(subject, *first));
            record.with = Some(cause_record(subject, *second));
            record.about = Some(match over {
                Shared::Atom(atom) | Shared::Derived { atom, .. } => subject.atom(atom),
                Shared::Fluent(fluent) => subject.fluent(fluent),
            });
            let roles =
                [first, second].map(|&cause| interference_of(subject.domain, subject.plan, cause, over));
            record.roles =
                roles.into_iter().flatten().filter_map(|role| role_record(subject, role)).collect();
        }
        Failure::Effect { at, fault } => {
            record.reason = "effect";
            record.at = Some(cause_record(subject, *at));
            match fault {
                EffectFault::Conflict { fluent, first, second } => {
                    record.fault = Some("conflict");
                    record.about = Some(subject.fluent(fluent));
                    let changes = [first, second].map(|&span| Interference { access: Access::Changes, span });
                    record.roles =
                        changes.into_iter().filter_map(|found| role_record(subject, found)).collect();
                }
                EffectFault::Numeric(fault) => numeric(subject, fault, &mut record),
            }
        }
        Failure::Change { time, fault } => {
            record.reason = "continuous_change";
            record.time = Some(*time);
            match fault {
                ChangeFault::Numeric(fault) => numeric(subject, fault, &mut record),
                ChangeFault::NotPolynomial { fluent, span } => {
                    record.fault = Some("not_polynomial");
                    record.about = Some(subject.fluent(fluent));
                    record.place = at(subject, File::Domain, *span);
                }
                ChangeFault::Unsteady => record.fault = Some("unsteady"),
                ChangeFault::NotPolynomialExpression { span } => {
                    record.fault = Some("not_polynomial");
                    record.place = at(subject, File::Domain, *span);
                }
            }
        }
        Failure::EndlessEvents { time, event } => {
            record.reason = "endless_events";
            record.time = Some(*time);
            record.at = Some(cause_record(subject, Cause::Event(*event)));
        }
        Failure::Constraint { file, span, breach, time, binding, states, times, parts } => {
            record.reason = "constraint";
            record.time = *time;
            record.place = at(subject, *file, *span);
            record.fault = Some(match breach {
                Breach::Here(_) => "does_not_hold",
                Breach::NeverAfter(_) => "never_after",
                Breach::NeverBefore(_) => "never_before",
                Breach::Again(_) => "again",
                Breach::Nowhere => "nowhere",
            });
            record.binding = binding_record(subject, binding);
            record.states = Some(*states);
            record.times = times.clone();
            record.parts = part_records(subject, parts, *file);
        }
        Failure::Network { fault } => {
            record.reason = "task_network";
            record.network = Some(network_record(subject, fault));
            record.parts = match fault {
                NetworkFault::Precondition { parts, .. }
                | NetworkFault::Constraints { parts, of: Parent::Task(_) } => {
                    part_records(subject, parts, File::Domain)
                }
                NetworkFault::Constraints { parts, of: Parent::Root } => {
                    part_records(subject, parts, File::Problem)
                }
                _ => Vec::new(),
            };
        }
        Failure::Goal { parts } => {
            record.reason = "goal";
            record.place = at(subject, File::Problem, subject.problem.goal_span);
            record.parts = part_records(subject, parts, File::Problem);
        }
    }
    record
}

fn role_record(subject: &Subject<'_>, role: Interference) -> Option<RoleRecord> {
    let does = match role.access {
        Access::Adds => "adds",
        Access::Deletes => "deletes",
        Access::Changes => "changes",
        Access::Needs => "needs",
    };
    Some(RoleRecord { does, place: at(subject, File::Domain, role.span)? })
}

fn numeric(subject: &Subject<'_>, fault: &NumericFault, record: &mut FailureRecord) {
    record.place = at(subject, File::Domain, fault.span());
    record.fault = Some(match fault {
        NumericFault::Undefined { fluent, .. } => {
            record.about = Some(subject.fluent(fluent));
            "undefined"
        }
        NumericFault::DivisionByZero { .. } => "division_by_zero",
        NumericFault::Overflow { .. } => "overflow",
        NumericFault::Duration { .. } => "no_duration",
    });
}
