//! Why a plan is not valid, as JSON: the failing step, and each unsatisfied part as data.
//!
//! A part has a `kind`, a `place`, and of the other fields those that its kind needs; the rest is left out. Parts of
//! alternatives, counterexamples and almost-witnesses are nested.

use super::network::NetworkRecord;
use super::record::Figure;
use crate::render::{At, PlaceRecord};
use crate::task::TaskFiles;
use pddl::model::{GroundApplication, Name, ObjectId, TypeId};
use pddl::{Plan, Source, Span};
use serde::Serialize;
use validator::{
    Breach, Cause, ChangeFault, Access, EffectFault, Failure, File, GroundAtom, NetworkFault, NumericFault,
    Operand, Parent, Place, Interference, Shared, StepFault, StepIndex, Unsatisfied, cause_place, cause_time,
    interference_of, show_application, show_atom, show_cause, show_object,
};

/// Where names and spans of a verdict are looked up.
pub(super) struct Places<'a> {
    pub(super) task: &'a TaskFiles,
    pub(super) plan: &'a Plan,
    pub(super) source: &'a Source,
}

/// Why a plan is not valid.
#[derive(Default, Serialize)]
pub(super) struct FailureRecord {
    reason: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    at: Option<CauseRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    with: Option<CauseRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    time: Option<Figure>,
    #[serde(skip_serializing_if = "Option::is_none")]
    about: Option<String>,
    #[serde(flatten)]
    compared: Option<ComparisonRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    place: Option<PlaceRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    network: Option<NetworkRecord>,
    /// Of which kind the fault is, where there are several.
    #[serde(skip_serializing_if = "Option::is_none")]
    fault: Option<&'static str>,
    /// What each of two does that interfere, and the two effects that are in conflict.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    roles: Vec<RoleRecord>,
    /// For which values of its variables a constraint is broken.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    binding: Vec<(String, String)>,
    /// How many states break it.
    #[serde(skip_serializing_if = "Option::is_none")]
    states: Option<usize>,
    /// The times of the first of them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    times: Vec<Figure>,
    parts: Vec<PartRecord>,
}

/// What something does: `adds`, `deletes`, `changes` or `needs`, and where that stands.
#[derive(Serialize)]
struct RoleRecord {
    does: &'static str,
    place: PlaceRecord,
}

/// Something that happens: what it is (a step, its start, …), its step's number, when, and where it stands.
#[derive(Serialize)]
pub(super) struct CauseRecord {
    what: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    step: Option<u64>,
    text: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    time: Option<Figure>,
    place: PlaceRecord,
}

/// What was compared, and how.
#[derive(Serialize)]
struct ComparisonRecord {
    comparison: &'static str,
    left: OperandRecord,
    right: OperandRecord,
}

/// A side of a comparison. `value` is null where it is undefined.
#[derive(Serialize)]
struct OperandRecord {
    value: Option<Figure>,
    fluents: Vec<(String, Option<Figure>)>,
}

/// A smallest unsatisfied part.
#[derive(Default, Serialize)]
struct PartRecord {
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
    /// Who deleted what is missing, or added what should not be there.
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
    /// Why an atom does not follow by the axioms, or does.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    because: Vec<PartRecord>,
}

impl Places<'_> {
    pub(super) fn atom(&self, atom: &GroundAtom) -> String {
        show_atom(&self.task.domain, &self.task.problem, atom)
    }

    pub(super) fn fluent(&self, fluent: &GroundApplication) -> String {
        show_application(&self.task.domain, &self.task.problem, fluent)
    }

    pub(super) fn object(&self, object: ObjectId) -> String {
        show_object(&self.task.problem, object)
    }

    pub(super) fn place(&self, place: Place) -> PlaceRecord {
        let source = match place.file {
            File::Domain => self.task.domain_source(),
            File::Problem => self.task.problem_source(),
            File::Plan => self.source,
        };
        PlaceRecord::of(At { source, span: place.span })
    }

    fn at(&self, file: File, span: Span) -> Option<PlaceRecord> {
        Some(self.place(Place { file, span }))
    }

    pub(super) fn cause(&self, cause: Cause) -> CauseRecord {
        let (domain, problem) = (&self.task.domain, &self.task.problem);
        CauseRecord {
            what: match cause {
                Cause::Step(_) => "step",
                Cause::Start(_) => "start",
                Cause::End(_) => "end",
                Cause::Timed(_) => "timed",
                Cause::Event(_) => "event",
            },
            step: cause.step().map(StepIndex::number),
            text: show_cause(domain, problem, self.plan, cause),
            time: cause_time(domain, problem, self.plan, cause).map(Figure),
            place: self.place(cause_place(domain, problem, self.plan, cause)),
        }
    }

    fn operand(&self, operand: &Operand) -> OperandRecord {
        OperandRecord {
            value: operand.value.as_ref().ok().copied().map(Figure),
            fluents: operand.fluents.iter().map(|(f, v)| (self.fluent(f), v.map(Figure))).collect(),
        }
    }

    /// Everything about a failure.
    pub(super) fn failure(&self, failure: &Failure) -> FailureRecord {
        let mut record = FailureRecord::default();
        match failure {
            Failure::Step { step, fault } => {
                record.reason = "step";
                record.fault = Some(match fault {
                    StepFault::UnknownAction => "unknown action",
                    StepFault::Arity { .. } => "arity",
                    StepFault::NoDuration => "no duration",
                    StepFault::Type { .. } => "type",
                });
                record.at = Some(self.cause(Cause::Step(*step)));
            }
            Failure::Precondition { at, parts } => {
                record.reason = "precondition";
                record.at = Some(self.cause(*at));
                record.parts = self.parts(parts, File::Domain);
            }
            Failure::Duration { step, actual, comparison, bound, span } => {
                record.reason = "duration";
                record.at = Some(self.cause(Cause::Start(*step)));
                record.compared = Some(ComparisonRecord {
                    comparison: comparison.symbol(),
                    left: OperandRecord { value: Some(Figure(*actual)), fluents: Vec::new() },
                    right: self.operand(bound),
                });
                record.place = self.at(File::Domain, *span);
            }
            Failure::Invariant { step, time, parts } => {
                record.reason = "over all";
                record.at = Some(self.cause(Cause::Start(*step)));
                record.time = Some(Figure(*time));
                record.parts = self.parts(parts, File::Domain);
            }
            Failure::Interference { first, second, over } => {
                record.reason = "interference";
                record.at = Some(self.cause(*first));
                record.with = Some(self.cause(*second));
                record.about = Some(match over {
                    Shared::Atom(atom) | Shared::Derived { atom, .. } => self.atom(atom),
                    Shared::Fluent(fluent) => self.fluent(fluent),
                });
                let roles = [first, second].map(|&cause| interference_of(&self.task.domain, self.plan, cause, over));
                record.roles = roles.into_iter().flatten().filter_map(|role| self.role(role)).collect();
            }
            Failure::Effect { at, fault } => {
                record.reason = "effect";
                record.at = Some(self.cause(*at));
                match fault {
                    EffectFault::Conflict { fluent, first, second } => {
                        record.fault = Some("conflict");
                        record.about = Some(self.fluent(fluent));
                        let changes = [first, second].map(|&span| Interference { access: Access::Changes, span });
                        record.roles = changes.into_iter().filter_map(|role| self.role(role)).collect();
                    }
                    EffectFault::Numeric(fault) => self.numeric(fault, &mut record),
                }
            }
            Failure::Change { time, fault } => {
                record.reason = "continuous change";
                record.time = Some(Figure(*time));
                match fault {
                    ChangeFault::Numeric(fault) => self.numeric(fault, &mut record),
                    ChangeFault::NotPolynomial { fluent, span } => {
                        record.fault = Some("not polynomial");
                        record.about = Some(self.fluent(fluent));
                        record.place = self.at(File::Domain, *span);
                    }
                    ChangeFault::Unsteady => record.fault = Some("unsteady"),
                    ChangeFault::NotPolynomialExpression { span } => {
                        record.fault = Some("not polynomial");
                        record.place = self.at(File::Domain, *span);
                    }
                }
            }
            Failure::EndlessEvents { time, event } => {
                record.reason = "endless events";
                record.time = Some(Figure(*time));
                record.at = Some(self.cause(Cause::Event(*event)));
            }
            Failure::Constraint { file, span, breach, time, binding, states, times, parts } => {
                record.reason = "constraint";
                record.time = time.map(Figure);
                record.place = self.at(*file, *span);
                record.fault = Some(match breach {
                    Breach::Here(_) => "does not hold",
                    Breach::NeverAfter(_) => "never after",
                    Breach::NeverBefore(_) => "never before",
                    Breach::Again(_) => "again",
                    Breach::Nowhere => "nowhere",
                });
                record.binding = self.binding(binding);
                record.states = Some(*states);
                record.times = times.iter().copied().map(Figure).collect();
                record.parts = self.parts(parts, *file);
            }
            Failure::Network { fault } => {
                record.reason = "task network";
                record.network = Some(self.network(fault));
                record.parts = match fault {
                    NetworkFault::Precondition { parts, .. }
                    | NetworkFault::Constraints { parts, of: Parent::Task(_) } => {
                        self.parts(parts, File::Domain)
                    }
                    NetworkFault::Constraints { parts, of: Parent::Root } => self.parts(parts, File::Problem),
                    _ => Vec::new(),
                };
            }
            Failure::Goal { parts } => {
                record.reason = "goal";
                record.place = self.at(File::Problem, self.task.problem.goal_span);
                record.parts = self.parts(parts, File::Problem);
            }
        }
        record
    }

    fn role(&self, role: Interference) -> Option<RoleRecord> {
        let does = match role.access {
            Access::Adds => "adds",
            Access::Deletes => "deletes",
            Access::Changes => "changes",
            Access::Needs => "needs",
        };
        Some(RoleRecord { does, place: self.at(File::Domain, role.span)? })
    }

    fn numeric(&self, fault: &NumericFault, record: &mut FailureRecord) {
        record.place = self.at(File::Domain, fault.span());
        record.fault = Some(match fault {
            NumericFault::Undefined { fluent, .. } => {
                record.about = Some(self.fluent(fluent));
                "undefined"
            }
            NumericFault::DivisionByZero { .. } => "division by zero",
            NumericFault::Overflow { .. } => "overflow",
            NumericFault::Duration { .. } => "no duration",
        });
    }

    fn parts(&self, parts: &[Unsatisfied], file: File) -> Vec<PartRecord> {
        parts.iter().map(|part| self.part(part, file)).collect()
    }

    fn binding(&self, binding: &[(Name, ObjectId)]) -> Vec<(String, String)> {
        binding.iter().map(|(name, object)| (format!("?{name}"), self.object(*object))).collect()
    }

    fn part(&self, part: &Unsatisfied, file: File) -> PartRecord {
        let mut record = PartRecord { place: self.at(file, part.span()), ..PartRecord::default() };
        let cause = |cause: &Option<Cause>| cause.map(|cause| self.cause(cause));
        match part {
            Unsatisfied::Missing { atom, deleted_by, derived, because, .. } => {
                record.kind = "missing";
                record.because = self.parts(because, File::Domain);
                record.atom = Some(self.atom(atom));
                record.derived = Some(*derived);
                record.by = cause(deleted_by);
            }
            Unsatisfied::Present { atom, added_by, derived, because, .. } => {
                record.kind = "present";
                record.because = self.parts(because, File::Domain);
                record.atom = Some(self.atom(atom));
                record.derived = Some(*derived);
                record.by = cause(added_by);
            }
            Unsatisfied::Type { object, types, wanted, .. } => {
                record.kind = "type";
                record.objects = vec![self.object(*object)];
                let name = |&t: &TypeId| self.task.domain.types[t].name.to_string();
                record.types = types.0.iter().map(name).collect();
                record.wanted = Some(*wanted);
            }
            Unsatisfied::Different { left, right, .. } => {
                record.kind = "different";
                record.objects = vec![self.object(*left), self.object(*right)];
            }
            Unsatisfied::Same { object, .. } => {
                record.kind = "same";
                record.objects = vec![self.object(*object)];
            }
            Unsatisfied::Comparison { comparison, wanted, left, right, .. } => {
                record.kind = "comparison";
                record.wanted = Some(*wanted);
                record.compared = Some(ComparisonRecord {
                    comparison: comparison.symbol(),
                    left: self.operand(left),
                    right: self.operand(right),
                });
            }
            Unsatisfied::Fluent { fluent, value, wanted, actual, .. } => {
                record.kind = "fluent";
                record.fluent = Some(self.fluent(fluent));
                record.value = Some(self.object(*value));
                record.wanted = Some(*wanted);
                record.actual = actual.map(|object| self.object(object));
            }
            Unsatisfied::Alternatives { branches, .. } => {
                record.kind = "alternatives";
                record.branches = branches.iter().map(|branch| self.parts(branch, file)).collect();
            }
            Unsatisfied::Counterexample { binding, parts, .. } => {
                record.kind = "counterexample";
                record.binding = self.binding(binding);
                record.branches = vec![self.parts(parts, file)];
            }
            Unsatisfied::NoWitness { closest, .. } => {
                record.kind = "no witness";
                if let Some(near) = closest {
                    record.binding = self.binding(&near.binding);
                    record.branches = vec![self.parts(&near.parts, file)];
                }
            }
        }
        record
    }
}
