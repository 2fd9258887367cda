//! A verdict in sentences, each with its place.
//!
//! The verdict is data. The command line and the executive's log use the same sentences for it. A
//! [`Finding`] is one sentence with a place and notes. Each note has its own place, possibly in
//! another file: a failing step in the plan, its unsatisfied parts in the domain.

use super::finding::{Finding, Place};
use super::interference::{Access, Interference, interference_of};
use super::network::network_fault;
use super::words::Words;
use crate::cause::Cause;
use crate::number::Number;
use crate::plan::PlanRef;
use crate::verdict::{
    Breach, ChangeFault, EffectFault, Failure, Feature, File, IllFormed, Shared, StepFault, Unsupported,
    Verdict,
};
use pddl::Span;
use pddl::model::{Domain, Problem};

/// Explains a verdict; `None` for a valid plan.
pub fn explain<'p>(
    domain: &Domain,
    problem: &Problem,
    plan: impl Into<PlanRef<'p>>,
    verdict: &Verdict,
) -> Option<Finding> {
    let words = Words { domain, problem, plan: plan.into() };
    match verdict {
        Verdict::Valid(_) => None,
        Verdict::Invalid(fault) => Some(failure(&words, fault)),
        Verdict::Unsupported(what) => Some(unsupported(what)),
        Verdict::IllFormed(fault) => Some(ill_formed(&words, fault)),
    }
}

fn unsupported(unsupported: &Unsupported) -> Finding {
    let (file, sentence) = match &unsupported.feature {
        Feature::InDomain(what) => (File::Domain, what.clone()),
        Feature::InProblem(what) => (File::Problem, what.clone()),
        Feature::LanguageOfDomain(what) => (File::Domain, format!("{what} are not supported")),
        Feature::LanguageOfProblem(what) => (File::Problem, format!("{what} are not supported")),
        Feature::TimedTaskNetwork => {
            (File::Problem, "a plan with times for a task network is not supported".into())
        }
        Feature::DurativeSubtaskOfProblem => {
            (File::Problem, "an action that takes time is not supported as a subtask of this plan".into())
        }
        Feature::DurativeSubtaskOfDomain => {
            (File::Domain, "an action that takes time is not supported as a subtask of this plan".into())
        }
        Feature::MatchLimit => {
            (File::Plan, "limit reached: the subtasks can be read in too many ways".into())
        }
        Feature::DecompositionLimit => (
            File::Problem,
            "limit reached: whether the task network can become these steps was not found out".into(),
        ),
        Feature::TimesMissingForProblem => (
            File::Problem,
            "a plan without times is not supported where the problem has timed changes".into(),
        ),
        Feature::TimesMissingForDomain => (
            File::Domain,
            "a plan without times is not supported where the domain has processes or events".into(),
        ),
        Feature::Undecided => (
            File::Problem,
            "values that change continuously come too near to each other here to tell which is greater; \
             this is not supported"
                .into(),
        ),
        Feature::TooMuch => (
            File::Problem,
            "quantifiers over more combinations of objects than can be tried are not supported".into(),
        ),
    };
    Finding { sentence, place: Place { file, span: unsupported.span }, notes: Vec::new() }
}

fn failure(words: &Words<'_>, failure: &Failure) -> Finding {
    match failure {
        Failure::Step { step, fault } => {
            let what = match fault {
                StepFault::UnknownAction => "names no action".to_owned(),
                StepFault::Arity { expected, found } => {
                    format!("has {found} arguments where the action has {expected} parameters")
                }
                StepFault::NoDuration => "says not how long it takes".to_owned(),
                StepFault::Type { object, .. } => {
                    format!("has an argument of the wrong type: {}", words.object(*object))
                }
            };
            let sentence = format!("{} {what}", words.step(*step));
            Finding { sentence, place: words.step_place(*step), notes: Vec::new() }
        }
        Failure::Precondition { at, parts } => {
            let (what, condition) = match at {
                Cause::Start(_) => ("begin", "condition at the start"),
                Cause::End(_) => ("end", "condition at the end"),
                _ => ("be taken", "precondition"),
            };
            let subject = match at {
                Cause::Start(step) | Cause::End(step) => {
                    let time = words.time(*at).map_or_else(String::new, |time| format!(" at {time}"));
                    format!("{} cannot {what}{time}", words.step(*step))
                }
                _ => format!("{} cannot {what}", words.cause(*at)),
            };
            let sentence = format!("{subject}: its {condition} does not hold");
            Finding { sentence, place: words.cause_place(*at), notes: words.notes(parts, File::Domain) }
        }
        Failure::Duration { step, actual, comparison, bound, span } => {
            let sentence = match &bound.value {
                Ok(value) => format!(
                    "{} takes {actual} s, and its duration must be {} {value}",
                    words.step(*step),
                    comparison.symbol()
                ),
                Err(fault) => {
                    format!("{} has no duration that could fit: {}", words.step(*step), words.numeric(fault))
                }
            };
            let mut note = "asked for here".to_owned();
            words.with_fluents(&mut note, bound.fluents.iter());
            let notes = vec![(Place { file: File::Domain, span: *span }, note)];
            Finding { sentence, place: words.step_place(*step), notes }
        }
        Failure::Invariant { step, time, parts } => {
            let sentence = format!(
                "{} is disturbed: what must hold all the time does not hold after {time}",
                words.step(*step)
            );
            Finding { sentence, place: words.step_place(*step), notes: words.notes(parts, File::Domain) }
        }
        Failure::Interference { first, second, over } => {
            let sentence = format!(
                "{} and {} are at one time, and interfere",
                words.cause(*first),
                words.cause(*second)
            );
            let mut notes = Vec::new();
            for (cause, when) in [(*first, ""), (*second, ", at the same time")] {
                let role = interference_of(words.domain, words.plan, cause, over);
                let does = does(words, role, over);
                notes.push((words.cause_place(cause), format!("this {does}{when}")));
                let here = role.map(|role| (Place { file: File::Domain, span: role.span }, does));
                notes.extend(here.map(|(place, does)| (place, format!("{} {does}", words.cause(cause)))));
            }
            Finding { sentence, place: words.cause_place(*second), notes }
        }
        Failure::Change { time, fault } => {
            let (why, span) = match fault {
                ChangeFault::Numeric(fault) => (words.numeric(fault), fault.span()),
                ChangeFault::NotPolynomial { fluent, span } => {
                    (format!("the rate of {} depends on itself", words.application(fluent)), *span)
                }
                ChangeFault::Unsteady => {
                    ("processes begin and end without end at one time".to_owned(), Span::default())
                }
                ChangeFault::NotPolynomialExpression { span } => {
                    ("divided by what changes continuously".to_owned(), *span)
                }
            };
            let sentence = format!("continuous change after {time} has no result: {why}");
            Finding { sentence, place: Place { file: File::Domain, span }, notes: Vec::new() }
        }
        Failure::EndlessEvents { time, event } => {
            let sentence = format!(
                "events cause each other without end at {time}, `{}` among them",
                words.domain.events[*event].name
            );
            Finding { sentence, place: words.cause_place(Cause::Event(*event)), notes: Vec::new() }
        }
        Failure::Constraint { file, span, breach, time, binding, states, times, parts } => {
            let when = match (words.plan, time) {
                (_, None) => String::new(),
                (PlanRef::Temporal(_), Some(time)) => format!("at {time}"),
                (_, Some(step)) if *step == Number::ZERO => "in the initial state".to_owned(),
                (_, Some(step)) => format!("after step {step}"),
            };
            let how = match breach {
                Breach::Here(_) => format!("{when} it does not hold"),
                Breach::NeverAfter(_) => format!("what must follow never comes, or too late, {when}"),
                Breach::NeverBefore(_) => format!("what must come before did not, {when}"),
                Breach::Again(_) => format!("{when} it becomes true again"),
                Breach::Nowhere => "no state satisfies it in time".to_owned(),
            };
            let sentence = format!("the plan breaks a constraint: {how}");
            let place = Place { file: *file, span: *span };
            let mut notes = Vec::new();
            if !binding.is_empty() {
                notes.push((place, format!("with {}", words.binding(binding))));
            }
            if *states > 1 {
                notes.push((place, times_of_breach(words, *states, times)));
            }
            notes.extend(words.notes(parts, *file));
            Finding { sentence, place, notes }
        }
        Failure::Effect { at, fault } => {
            let sentence = format!("{} has no result", words.cause(*at));
            let note = |span, text| (Place { file: File::Domain, span }, text);
            let notes = match fault {
                EffectFault::Conflict { fluent, first, second } => {
                    let fluent = words.application(fluent);
                    vec![
                        note(*second, format!("this changes {fluent} in conflict with another effect")),
                        note(*first, format!("this changes {fluent} as well")),
                    ]
                }
                EffectFault::Numeric(fault) => vec![note(fault.span(), words.numeric(fault))],
            };
            Finding { sentence, place: words.cause_place(*at), notes }
        }
        Failure::Network { fault } => network_fault(words, fault),
        Failure::Goal { parts } => {
            let sentence = match words.plan.steps() {
                0 => "the goal does not hold, and the plan is empty".to_owned(),
                1 => "the goal does not hold after the only step".to_owned(),
                n => format!("the goal does not hold after the last of {n} steps"),
            };
            let place = Place { file: File::Problem, span: words.problem.goal_span };
            Finding { sentence, place, notes: words.notes(parts, File::Problem) }
        }
    }
}

/// The times at which a constraint is violated.
fn times_of_breach(words: &Words<'_>, states: usize, times: &[Number]) -> String {
    let has_times = matches!(words.plan, PlanRef::Temporal(_));
    let unit = if has_times { "at" } else { "after steps" };
    let list: Vec<String> = times.iter().map(Number::to_string).collect();
    let more = if states > times.len() { ", …" } else { "" };
    format!("broken {states} times: {unit} {}{more}", list.join(", "))
}

/// The access of one of two interfering happenings: `deletes (a)`.
fn does(words: &Words<'_>, role: Option<Interference>, over: &Shared) -> String {
    let what = match over {
        Shared::Atom(atom) | Shared::Derived { atom, .. } => words.atom(atom),
        Shared::Fluent(fluent) => words.application(fluent),
    };
    match (role.map(|role| role.access), over) {
        (Some(Access::Adds), _) => format!("adds {what}"),
        (Some(Access::Deletes), _) => format!("deletes {what}"),
        (Some(Access::Changes), _) => format!("changes {what}"),
        (Some(Access::Needs), Shared::Derived { predicate, .. }) => {
            format!("needs `{}`, which depends on {what}", words.domain.predicates[*predicate].name)
        }
        (Some(Access::Needs), Shared::Atom(_)) => format!("needs {what} to stay as it is"),
        (Some(Access::Needs), Shared::Fluent(_)) => format!("reads {what}"),
        (None, _) => format!("changes or needs {what}"),
    }
}

fn ill_formed(words: &Words<'_>, fault: &IllFormed) -> Finding {
    let (sentence, span) = match fault {
        IllFormed::Unstratified { predicate, span } => (
            format!(
                "the axioms have no meaning: `{}` depends on its own negation",
                words.domain.predicates[*predicate].name
            ),
            *span,
        ),
        IllFormed::DerivedInEffect { predicate, span } => (
            format!("an effect changes `{}`, which axioms derive", words.domain.predicates[*predicate].name),
            *span,
        ),
    };
    Finding { sentence, place: Place { file: File::Domain, span }, notes: Vec::new() }
}
