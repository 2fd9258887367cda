//! The verdict on a plan, as far as `expected.toml` can name it: the kind of fault, the step, the literals that are
//! missing, and the sentences.

use crate::Fault;
use crate::expected::literal;
use crate::suite::Suite;
use diagnostics::{Place, SourceId};
use pddl::{Severity, Source, Span, parse_plan};
use project::Task;
use validator::{
    Cause, Failure, File, NetworkFault, Number, Parent, StepFault, StepIndex, Unsatisfied, Verdict, explain,
    validate,
};

/// What the validator reports of a plan.
#[derive(Clone, Debug)]
pub(crate) enum Found {
    Valid {
        cost: Number,
    },
    Invalid {
        fault: Fault,
        /// From 1; `None` for what is not about one step.
        step: Option<u64>,
        missing: Vec<String>,
        says: Says,
    },
    /// The plan's text has errors: codes and lines in order, and the first one.
    Unreadable {
        errors: Vec<(&'static str, u32)>,
        says: Says,
    },
    Unsupported {
        says: Says,
    },
}

/// A sentence at its place.
#[derive(Clone, Debug)]
pub(crate) struct Says {
    pub(crate) sentence: String,
    pub(crate) place: Place,
    pub(crate) notes: Vec<(Place, String)>,
}

impl Says {
    /// Whether a text stands in one of the sentences.
    pub(crate) fn says(&self, text: &str) -> bool {
        self.sentence.contains(text) || self.notes.iter().any(|(_, note)| note.contains(text))
    }
}

impl Suite {
    /// Judges a plan.
    pub(crate) fn found(&self, task: &Task<'_>, file: SourceId) -> Found {
        let source = self.source(file);
        let parsed = parse_plan(source, task.domain, task.problem);
        let Some(plan) = parsed.model else {
            let errors = parsed.diagnostics.iter().filter(|d| d.severity == Severity::Error);
            let errors: Vec<_> = errors.map(|d| (d.code(), source.line_column(d.span.start).line)).collect();
            let worst = parsed.diagnostics.iter().max_by_key(|d| d.severity);
            let says = worst.map_or_else(
                || Says {
                    sentence: "no plan".to_owned(),
                    place: place(file, Span::default()),
                    notes: vec![],
                },
                |d| Says { sentence: d.message(), place: place(file, d.span), notes: vec![] },
            );
            return if errors.is_empty() {
                Found::Unsupported { says }
            } else {
                Found::Unreadable { errors, says }
            };
        };
        let verdict = validate(task.domain, task.problem, &plan);
        let says = explain(task.domain, task.problem, &plan, &verdict).map_or_else(
            || Says { sentence: String::new(), place: place(file, Span::default()), notes: vec![] },
            |finding| {
                let at = |at: validator::Place| place(of(at.file, task, file), at.span);
                let notes = finding.notes.into_iter().map(|(place, text)| (at(place), text)).collect();
                Says { sentence: finding.sentence, place: at(finding.place), notes }
            },
        );
        let failure = match verdict {
            Verdict::Valid(valid) => return Found::Valid { cost: valid.cost() },
            Verdict::Unsupported(_) => return Found::Unsupported { says },
            Verdict::IllFormed(_) => {
                return Found::Invalid { fault: Fault::IllFormed, step: None, missing: vec![], says };
            }
            Verdict::Invalid(failure) => failure,
        };
        let (fault, step) = kind(&failure);
        let mut missing = Vec::new();
        match &failure {
            Failure::Precondition { parts, .. }
            | Failure::Invariant { parts, .. }
            | Failure::Network { fault: NetworkFault::Precondition { parts, .. } } => {
                Literals { suite: self, task, file: task.domain_file }.of(parts, &mut missing);
            }
            Failure::Goal { parts } => {
                Literals { suite: self, task, file: task.problem_file }.of(parts, &mut missing);
            }
            Failure::Step { .. }
            | Failure::Duration { .. }
            | Failure::Interference { .. }
            | Failure::Effect { .. }
            | Failure::Change { .. }
            | Failure::EndlessEvents { .. }
            | Failure::Constraint { .. }
            | Failure::Network { .. } => {}
        }
        Found::Invalid { fault, step, missing, says }
    }
}

pub(crate) fn place(source: SourceId, span: Span) -> Place {
    Place { source, span }
}

fn of(file: File, task: &Task<'_>, plan: SourceId) -> SourceId {
    match file {
        File::Domain => task.domain_file,
        File::Problem => task.problem_file,
        File::Plan => plan,
    }
}

fn kind(failure: &Failure) -> (Fault, Option<u64>) {
    let number = |cause: &Cause| cause.step().map(StepIndex::number);
    match failure {
        Failure::Step { step, fault } => {
            let fault = match fault {
                StepFault::UnknownAction => Fault::UnknownAction,
                StepFault::Arity { .. } => Fault::Arity,
                StepFault::Type { .. } => Fault::Type,
                StepFault::NoDuration => Fault::Duration,
            };
            (fault, Some(step.number()))
        }
        Failure::Precondition { at, .. } => (Fault::Precondition, number(at)),
        Failure::Duration { step, .. } => (Fault::Duration, Some(step.number())),
        Failure::Invariant { step, .. } => (Fault::Invariant, Some(step.number())),
        Failure::Interference { first, second, .. } => {
            (Fault::Interference, number(second).or_else(|| number(first)))
        }
        Failure::Effect { at, fault } => {
            let fault = match fault {
                validator::EffectFault::Conflict { .. } => Fault::Conflict,
                validator::EffectFault::Numeric(_) => Fault::Undefined,
            };
            (fault, number(at))
        }
        Failure::Change { .. } | Failure::EndlessEvents { .. } => (Fault::Change, None),
        Failure::Constraint { .. } => (Fault::Constraint, None),
        Failure::Network { fault } => (network(fault), None),
        Failure::Goal { .. } => (Fault::Goal, None),
    }
}

fn network(fault: &NetworkFault) -> Fault {
    match fault {
        NetworkFault::Subtasks { of: Parent::Root, .. } | NetworkFault::NoNetwork => Fault::Root,
        NetworkFault::Subtasks { of: Parent::Task(_), .. } => Fault::Subtasks,
        NetworkFault::Unknown { .. }
        | NetworkFault::Arguments { .. }
        | NetworkFault::Method { .. }
        | NetworkFault::MethodArguments { .. } => Fault::Method,
        NetworkFault::Cycle { .. } => Fault::Cycle,
        NetworkFault::Shared { .. } => Fault::Shared,
        NetworkFault::Orphan { .. } => Fault::Orphan,
        NetworkFault::Constraints { .. } => Fault::MethodConstraint,
        NetworkFault::Ordering { .. } => Fault::Ordering,
        NetworkFault::Precondition { .. } => Fault::MethodPrecondition,
        NetworkFault::NoDecomposition { .. } => Fault::Decomposition,
    }
}

/// The literals that a condition lacks, as PDDL.
struct Literals<'a> {
    suite: &'a Suite,
    task: &'a Task<'a>,
    /// The file that the condition stands in.
    file: SourceId,
}

impl Literals<'_> {
    fn of(&self, parts: &[Unsatisfied], found: &mut Vec<String>) {
        let Task { domain, problem, .. } = self.task;
        let object = |id| problem.objects.get(id).map_or("?", |object| object.name.as_str()).to_owned();
        for part in parts {
            let (text, wanted) = match part {
                Unsatisfied::Missing { atom, .. } => (validator::show_atom(domain, problem, atom), true),
                Unsatisfied::Present { atom, .. } => (validator::show_atom(domain, problem, atom), false),
                Unsatisfied::Type { object: one, types, wanted, .. } => {
                    let names: Vec<&str> = types.0.iter().map(|&t| domain.types[t].name.as_str()).collect();
                    let types = match names.as_slice() {
                        [one] => (*one).to_owned(),
                        several => format!("(either {})", several.join(" ")),
                    };
                    (format!("(sortof {} - {types})", object(*one)), *wanted)
                }
                Unsatisfied::Different { left, right, .. } => {
                    (format!("(= {} {})", object(*left), object(*right)), true)
                }
                Unsatisfied::Same { object: one, .. } => {
                    (format!("(= {} {})", object(*one), object(*one)), false)
                }
                Unsatisfied::Comparison { wanted, span, .. } => (self.written(*span), *wanted),
                Unsatisfied::Fluent { fluent, value, wanted, .. } => {
                    let fluent = validator::show_application(domain, problem, fluent);
                    (format!("(= {fluent} {})", object(*value)), *wanted)
                }
                Unsatisfied::Alternatives { branches, .. } => {
                    for branch in branches {
                        self.of(branch, found);
                    }
                    continue;
                }
                Unsatisfied::Counterexample { parts, .. } => {
                    self.of(parts, found);
                    continue;
                }
                Unsatisfied::NoWitness { closest, .. } => {
                    if let Some(near) = closest {
                        self.of(&near.parts, found);
                    }
                    continue;
                }
            };
            let text = literal(&if wanted { text } else { format!("(not {text})") });
            if !found.contains(&text) {
                found.push(text);
            }
        }
    }

    fn written(&self, span: Span) -> String {
        let source: &Source = self.suite.source(self.file);
        source.text().get(span.range()).unwrap_or("").to_owned()
    }
}
