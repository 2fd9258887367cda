//! A verdict in words, each with its place.
//!
//! The verdict is data; whoever shows it to people (the command line, the executive's log) says the same
//! sentences. A [`Finding`] has one sentence and a place, and notes with places of their own, which may
//! lie in another file: a failing step in the plan, its unsatisfied parts in the domain.

use crate::cause::Cause;
use crate::expression::NumericFault;
use crate::number::Number;
use crate::preference::ViolatedPreference;
use crate::role::{Deed, Role, role_of};
use crate::run::PlanRef;
use crate::state::{GroundAtom, Value};
use crate::temporal;
use crate::trace::{Diff, FluentChange};
use crate::trajectory::Breach;
use crate::verdict::{
    ChangeFault, EffectFault, Failure, Feature, IllFormed, Operand, Shared, StepFault, StepIndex,
    Unsatisfied, Verdict,
};
use pddl::model::{Comparison, Domain, GroundApplication, Name, ObjectId, Problem};
use pddl::{PlanStep, Span, StepHead, TemporalStep};
use serde::Serialize;
use std::fmt::Write;

/// One of the three texts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum File {
    /// The domain.
    Domain,
    /// The problem.
    Problem,
    /// The plan.
    Plan,
}

/// A place in one of the three texts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Place {
    /// Which text.
    pub file: File,
    /// Where in it.
    pub span: Span,
}

/// Something to say about a plan.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// One sentence without a full stop.
    pub sentence: String,
    /// Where.
    pub place: Place,
    /// What it consists in, most important first.
    pub notes: Vec<(Place, String)>,
}

/// What to say about a verdict; nothing about a valid plan.
pub fn explain<'p>(
    domain: &Domain,
    problem: &Problem,
    plan: impl Into<PlanRef<'p>>,
    verdict: &Verdict,
) -> Option<Finding> {
    let words = Words { domain, problem, plan: plan.into() };
    match verdict {
        Verdict::Valid(_) => None,
        Verdict::Invalid(failure) => Some(words.failure(failure)),
        Verdict::Unsupported(unsupported) => {
            let (file, sentence) = match &unsupported.feature {
                Feature::InDomain(what) => (File::Domain, what.clone()),
                Feature::InProblem(what) => (File::Problem, what.clone()),
                Feature::LanguageOfDomain(what) => (File::Domain, format!("{what} are not supported")),
                Feature::LanguageOfProblem(what) => (File::Problem, format!("{what} are not supported")),
                Feature::TimedTaskNetwork => {
                    (File::Problem, "a plan with times for a task network is not supported".into())
                }
                Feature::DurativeSubtaskOfProblem => (
                    File::Problem,
                    "an action that takes time is not supported as a subtask of this plan".into(),
                ),
                Feature::DurativeSubtaskOfDomain => (
                    File::Domain,
                    "an action that takes time is not supported as a subtask of this plan".into(),
                ),
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
                    "quantifiers over more combinations of objects than can be tried are not supported"
                        .into(),
                ),
            };
            Some(Finding { sentence, place: Place { file, span: unsupported.span }, notes: Vec::new() })
        }
        Verdict::IllFormed(fault) => Some(words.ill_formed(fault)),
    }
}

/// An atom as PDDL.
pub fn show_atom(domain: &Domain, problem: &Problem, atom: &GroundAtom) -> String {
    show_list(&domain.predicates[atom.predicate].name, &atom.arguments, problem)
}

/// A fluent as PDDL.
pub fn show_application(domain: &Domain, problem: &Problem, fluent: &GroundApplication) -> String {
    show_list(&domain.functions[fluent.function].name, &fluent.arguments, problem)
}

/// A step as PDDL.
pub fn show_step(domain: &Domain, problem: &Problem, step: &PlanStep) -> String {
    let unknown = Name::new("?");
    let name = domain.actions.get(step.action).map_or(&unknown, |action| &action.name);
    show_list(name, &step.arguments, problem)
}

/// A step of a plan with times as PDDL, without its times.
pub fn show_timed_step(domain: &Domain, problem: &Problem, step: &TemporalStep) -> String {
    let unknown = Name::new("?");
    let name = match step.head {
        StepHead::Action(id) => domain.actions.get(id).map(|action| &action.name),
        StepHead::DurativeAction(id) => domain.durative_actions.get(id).map(|action| &action.name),
    };
    show_list(name.unwrap_or(&unknown), &step.arguments, problem)
}

/// What happened, in words: `step 3 (go a b)`, `the end of step 3 (go a b) at 4.5`.
pub fn show_cause<'p>(
    domain: &Domain,
    problem: &Problem,
    plan: impl Into<PlanRef<'p>>,
    cause: Cause,
) -> String {
    Words { domain, problem, plan: plan.into() }.cause(cause)
}

/// Where what happened stands.
pub fn cause_place<'p>(
    domain: &Domain,
    problem: &Problem,
    plan: impl Into<PlanRef<'p>>,
    cause: Cause,
) -> Place {
    Words { domain, problem, plan: plan.into() }.cause_place(cause)
}

/// When it happened, in seconds; `None` for events and in plans without times.
pub fn cause_time<'p>(
    domain: &Domain,
    problem: &Problem,
    plan: impl Into<PlanRef<'p>>,
    cause: Cause,
) -> Option<Number> {
    Words { domain, problem, plan: plan.into() }.time(cause)
}

/// A violated preference: `p1 (?x = a)`.
pub fn show_preference(problem: &Problem, violated: &ViolatedPreference) -> String {
    let name = violated.name.as_ref().map_or("a preference without a name", Name::as_str);
    if violated.binding.is_empty() {
        return name.to_owned();
    }
    format!("{name} ({})", show_binding(problem, &violated.binding))
}

fn show_binding(problem: &Problem, binding: &[(Name, ObjectId)]) -> String {
    let value = |(name, object): &(Name, ObjectId)| format!("?{name} = {}", show_object(problem, *object));
    binding.iter().map(value).collect::<Vec<_>>().join(", ")
}

/// A step's changes, one a line: `+ (at b)`, `- (at a)`, `  (fuel) 3 -> 2`; what follows by axioms is
/// `+ (near b), which follows`, what changed by itself before `  (level) 1 -> 2, continuously`.
pub fn show_diff(domain: &Domain, problem: &Problem, diff: &Diff) -> Vec<String> {
    let value = |value: Option<Value>| match value {
        None => "undefined".to_owned(),
        Some(Value::Number(number)) => number.to_string(),
        Some(Value::Object(object)) => show_object(problem, object),
    };
    let atoms = |atoms: &[GroundAtom], sign: &str, how: &str| -> Vec<String> {
        atoms.iter().map(|atom| format!("{sign} {}{how}", show_atom(domain, problem, atom))).collect()
    };
    let fluents = |changes: &[FluentChange], how: &str| -> Vec<String> {
        let line = |change: &FluentChange| {
            let fluent = show_application(domain, problem, &change.fluent);
            format!("  {fluent} {} -> {}{how}", value(change.before), value(change.after))
        };
        changes.iter().map(line).collect()
    };
    [
        fluents(&diff.flowed, ", continuously"),
        atoms(&diff.deleted, "-", ""),
        atoms(&diff.added, "+", ""),
        fluents(&diff.fluents, ""),
        atoms(&diff.no_longer_derived, "-", ", which no longer follows"),
        atoms(&diff.derived, "+", ", which follows"),
    ]
    .concat()
}

/// An object's name.
pub fn show_object(problem: &Problem, object: ObjectId) -> String {
    problem.objects.get(object).map_or_else(|| "?".to_owned(), |o| o.name.to_string())
}

pub(crate) fn show_list(name: &Name, arguments: &[ObjectId], problem: &Problem) -> String {
    let mut text = format!("({name}");
    for &argument in arguments {
        text.push(' ');
        text.push_str(&show_object(problem, argument));
    }
    text.push(')');
    text
}

pub(crate) struct Words<'a> {
    pub(crate) domain: &'a Domain,
    pub(crate) problem: &'a Problem,
    pub(crate) plan: PlanRef<'a>,
}

impl Words<'_> {
    fn atom(&self, atom: &GroundAtom) -> String {
        show_atom(self.domain, self.problem, atom)
    }

    fn application(&self, fluent: &GroundApplication) -> String {
        show_application(self.domain, self.problem, fluent)
    }

    pub(crate) fn object(&self, object: ObjectId) -> String {
        show_object(self.problem, object)
    }

    fn binding(&self, binding: &[(Name, ObjectId)]) -> String {
        show_binding(self.problem, binding)
    }

    /// A step as PDDL, and where it stands.
    fn step_text(&self, step: StepIndex) -> Option<(String, Span)> {
        let index = step.0 as usize;
        match self.plan {
            PlanRef::Sequential(plan) => {
                plan.steps.get(index).map(|s| (show_step(self.domain, self.problem, s), s.span))
            }
            PlanRef::Temporal(plan) => {
                plan.steps.get(index).map(|s| (show_timed_step(self.domain, self.problem, s), s.span))
            }
            PlanRef::Hierarchical(plan) => {
                let step = plan.steps.iter().nth(index)?;
                Some((show_step(self.domain, self.problem, &step.step), step.step.span))
            }
        }
    }

    pub(crate) fn step_place(&self, step: StepIndex) -> Place {
        Place { file: File::Plan, span: self.step_text(step).map_or_else(Span::default, |(_, span)| span) }
    }

    fn step(&self, step: StepIndex) -> String {
        match self.step_text(step) {
            Some((text, _)) => format!("step {} {text}", step.number()),
            None => format!("step {}", step.number()),
        }
    }

    /// When something happens, in a plan with times.
    fn time(&self, cause: Cause) -> Option<Number> {
        let PlanRef::Temporal(plan) = self.plan else { return None };
        match cause {
            Cause::Step(step) | Cause::Start(step) => plan.steps.get(step.0 as usize).map(temporal::start),
            Cause::End(step) => plan.steps.get(step.0 as usize).map(temporal::end),
            Cause::Timed(index) => {
                self.problem.timed.get(index as usize).map(|timed| Number::from_decimal(timed.time))
            }
            Cause::Event(_) => None,
        }
    }

    fn cause_place(&self, cause: Cause) -> Place {
        match cause {
            Cause::Step(step) | Cause::Start(step) | Cause::End(step) => self.step_place(step),
            Cause::Timed(index) => {
                let span = self.problem.timed.get(index as usize).map_or_else(Span::default, |t| t.span);
                Place { file: File::Problem, span }
            }
            Cause::Event(event) => Place { file: File::Domain, span: self.domain.events[event].name_span },
        }
    }

    /// `step 3 (a b)`, `the start of step 3 (a b) at 4.5`.
    fn cause(&self, cause: Cause) -> String {
        let at = self.time(cause).map_or_else(String::new, |time| format!(" at {time}"));
        match cause {
            Cause::Step(step) => format!("{}{at}", self.step(step)),
            Cause::Start(step) => format!("the start of {}{at}", self.step(step)),
            Cause::End(step) => format!("the end of {}{at}", self.step(step)),
            Cause::Timed(_) => format!("a timed change{at}"),
            Cause::Event(event) => format!("event `{}`", self.domain.events[event].name),
        }
    }

    fn failure(&self, failure: &Failure) -> Finding {
        match failure {
            Failure::Step { step, fault } => {
                let what = match fault {
                    StepFault::UnknownAction => "names no action".to_owned(),
                    StepFault::Arity { expected, found } => {
                        format!("has {found} arguments where the action has {expected} parameters")
                    }
                    StepFault::NoDuration => "says not how long it takes".to_owned(),
                    StepFault::Type { object, .. } => {
                        format!("has an argument of the wrong type: {}", self.object(*object))
                    }
                };
                let sentence = format!("{} {what}", self.step(*step));
                Finding { sentence, place: self.step_place(*step), notes: Vec::new() }
            }
            Failure::Precondition { at, parts } => {
                let (what, condition) = match at {
                    Cause::Start(_) => ("begin", "condition at the start"),
                    Cause::End(_) => ("end", "condition at the end"),
                    _ => ("be taken", "precondition"),
                };
                let subject = match at {
                    Cause::Start(step) | Cause::End(step) => {
                        let time = self.time(*at).map_or_else(String::new, |time| format!(" at {time}"));
                        format!("{} cannot {what}{time}", self.step(*step))
                    }
                    _ => format!("{} cannot {what}", self.cause(*at)),
                };
                let sentence = format!("{subject}: its {condition} does not hold");
                Finding { sentence, place: self.cause_place(*at), notes: self.notes(parts, File::Domain) }
            }
            Failure::Duration { step, actual, comparison, bound, span } => {
                let sentence = match &bound.value {
                    Ok(value) => format!(
                        "{} takes {actual} s, and its duration must be {} {value}",
                        self.step(*step),
                        comparison.symbol()
                    ),
                    Err(fault) => {
                        format!(
                            "{} has no duration that could fit: {}",
                            self.step(*step),
                            self.numeric(fault)
                        )
                    }
                };
                let mut note = "asked for here".to_owned();
                self.with_fluents(&mut note, bound.fluents.iter());
                let notes = vec![(Place { file: File::Domain, span: *span }, note)];
                Finding { sentence, place: self.step_place(*step), notes }
            }
            Failure::Invariant { step, time, parts } => {
                let sentence = format!(
                    "{} is disturbed: what must hold all the time does not hold after {time}",
                    self.step(*step)
                );
                Finding { sentence, place: self.step_place(*step), notes: self.notes(parts, File::Domain) }
            }
            Failure::Interference { first, second, over } => {
                let sentence = format!(
                    "{} and {} are at one time, and interfere",
                    self.cause(*first),
                    self.cause(*second)
                );
                let mut notes = Vec::new();
                for (cause, when) in [(*first, ""), (*second, ", at the same time")] {
                    let role = role_of(self.domain, self.plan, cause, over);
                    let does = self.does(role, over);
                    notes.push((self.cause_place(cause), format!("this {does}{when}")));
                    let here = role.map(|role| (Place { file: File::Domain, span: role.span }, does));
                    notes.extend(here.map(|(place, does)| (place, format!("{} {does}", self.cause(cause)))));
                }
                Finding { sentence, place: self.cause_place(*second), notes }
            }
            Failure::Change { time, fault } => {
                let (why, span) = match fault {
                    ChangeFault::Numeric(fault) => (self.numeric(fault), fault.span()),
                    ChangeFault::NotPolynomial { fluent, span } => {
                        (format!("the rate of {} depends on itself", self.application(fluent)), *span)
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
                    self.domain.events[*event].name
                );
                Finding { sentence, place: self.cause_place(Cause::Event(*event)), notes: Vec::new() }
            }
            Failure::Constraint { file, span, breach, time, binding, states, times, parts } => {
                let when = match (self.plan, time) {
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
                    notes.push((place, format!("with {}", self.binding(binding))));
                }
                if *states > 1 {
                    notes.push((place, self.times(*states, times)));
                }
                notes.extend(self.notes(parts, *file));
                Finding { sentence, place, notes }
            }
            Failure::Effect { at, fault } => {
                let sentence = format!("{} has no result", self.cause(*at));
                let note = |span, text| (Place { file: File::Domain, span }, text);
                let notes = match fault {
                    EffectFault::Conflict { fluent, first, second } => {
                        let fluent = self.application(fluent);
                        vec![
                            note(*second, format!("this changes {fluent} in conflict with another effect")),
                            note(*first, format!("this changes {fluent} as well")),
                        ]
                    }
                    EffectFault::Numeric(fault) => vec![note(fault.span(), self.numeric(fault))],
                };
                Finding { sentence, place: self.cause_place(*at), notes }
            }
            Failure::Network { fault } => self.network_fault(fault),
            Failure::Goal { parts } => {
                let sentence = match self.plan.steps() {
                    0 => "the goal does not hold, and the plan is empty".to_owned(),
                    1 => "the goal does not hold after the only step".to_owned(),
                    n => format!("the goal does not hold after the last of {n} steps"),
                };
                let place = Place { file: File::Problem, span: self.problem.goal_span };
                Finding { sentence, place, notes: self.notes(parts, File::Problem) }
            }
        }
    }

    /// At which times a constraint is broken.
    fn times(&self, states: usize, times: &[Number]) -> String {
        let has_times = matches!(self.plan, PlanRef::Temporal(_));
        let unit = if has_times { "at" } else { "after steps" };
        let list: Vec<String> = times.iter().map(Number::to_string).collect();
        let more = if states > times.len() { ", …" } else { "" };
        format!("broken {states} times: {unit} {}{more}", list.join(", "))
    }

    /// What one of two does that interfere: `deletes (a)`.
    fn does(&self, role: Option<Role>, over: &Shared) -> String {
        let what = match over {
            Shared::Atom(atom) | Shared::Derived { atom, .. } => self.atom(atom),
            Shared::Fluent(fluent) => self.application(fluent),
        };
        match (role.map(|role| role.deed), over) {
            (Some(Deed::Adds), _) => format!("adds {what}"),
            (Some(Deed::Deletes), _) => format!("deletes {what}"),
            (Some(Deed::Changes), _) => format!("changes {what}"),
            (Some(Deed::Needs), Shared::Derived { predicate, .. }) => {
                format!("needs `{}`, which depends on {what}", self.domain.predicates[*predicate].name)
            }
            (Some(Deed::Needs), Shared::Atom(_)) => format!("needs {what} to stay as it is"),
            (Some(Deed::Needs), Shared::Fluent(_)) => format!("reads {what}"),
            (None, _) => format!("changes or needs {what}"),
        }
    }

    fn ill_formed(&self, fault: &IllFormed) -> Finding {
        let (sentence, span) = match fault {
            IllFormed::Unstratified { predicate, span } => (
                format!(
                    "the axioms have no meaning: `{}` depends on its own negation",
                    self.domain.predicates[*predicate].name
                ),
                *span,
            ),
            IllFormed::DerivedInEffect { predicate, span } => (
                format!(
                    "an effect changes `{}`, which axioms derive",
                    self.domain.predicates[*predicate].name
                ),
                *span,
            ),
        };
        Finding { sentence, place: Place { file: File::Domain, span }, notes: Vec::new() }
    }

    fn numeric(&self, fault: &NumericFault) -> String {
        match fault {
            NumericFault::Undefined { fluent, .. } => format!("{} is undefined", self.application(fluent)),
            NumericFault::DivisionByZero { .. } => "division by zero".to_owned(),
            NumericFault::Overflow { .. } => "the result is too large".to_owned(),
            NumericFault::Duration { .. } => "an instantaneous action has no duration".to_owned(),
        }
    }

    pub(crate) fn notes(&self, parts: &[Unsatisfied], file: File) -> Vec<(Place, String)> {
        let mut notes = Vec::new();
        for part in parts {
            let text = match part {
                // The reasons have notes of their own.
                Unsatisfied::Missing { atom, because, .. } if !because.is_empty() => {
                    format!("{} does not follow", self.atom(atom))
                }
                _ => self.part(part),
            };
            notes.push((Place { file, span: part.span() }, text));
            let cause = match part {
                Unsatisfied::Missing { atom, deleted_by: Some(cause), .. } => {
                    Some((*cause, format!("this deletes {}", self.atom(atom))))
                }
                Unsatisfied::Present { atom, added_by: Some(cause), .. } => {
                    Some((*cause, format!("this adds {}", self.atom(atom))))
                }
                Unsatisfied::Missing { because, .. } | Unsatisfied::Present { because, .. } => {
                    notes.extend(self.notes(because, File::Domain));
                    None
                }
                _ => None,
            };
            notes.extend(cause.map(|(cause, text)| (self.cause_place(cause), text)));
        }
        notes
    }

    fn part(&self, part: &Unsatisfied) -> String {
        match part {
            Unsatisfied::Missing { atom, deleted_by, derived, because, .. } => {
                let atom = self.atom(atom);
                match deleted_by {
                    _ if *derived && because.is_empty() => format!("{atom} does not follow"),
                    _ if *derived => format!("{atom} does not follow: {}", self.parts(because)),
                    None => format!("{atom} does not hold; it never did"),
                    Some(cause) => format!("{atom} does not hold; {} deleted it", self.cause(*cause)),
                }
            }
            Unsatisfied::Present { atom, added_by, derived, .. } => {
                let atom = self.atom(atom);
                match added_by {
                    None if *derived => format!("{atom} should not hold, but follows"),
                    None => format!("{atom} should not hold, but does from the beginning"),
                    Some(cause) => format!("{atom} should not hold; {} added it", self.cause(*cause)),
                }
            }
            Unsatisfied::Type { object, types, wanted, .. } => {
                let name = |t: &pddl::model::TypeId| format!("`{}`", self.domain.types[*t].name);
                let types: Vec<String> = types.0.iter().map(name).collect();
                let is = if *wanted { "is not" } else { "is" };
                format!("{} {is} of type {}", self.object(*object), types.join(" or "))
            }
            Unsatisfied::Different { left, right, .. } => {
                format!("{} and {} are not the same", self.object(*left), self.object(*right))
            }
            Unsatisfied::Same { object, .. } => format!("both are {}", self.object(*object)),
            Unsatisfied::Comparison { comparison, wanted, left, right, .. } => {
                self.comparison(*comparison, *wanted, left, right)
            }
            Unsatisfied::Fluent { fluent, value, wanted, actual, .. } => {
                let fluent = self.application(fluent);
                let is = actual.map_or_else(|| "undefined".to_owned(), |object| self.object(object));
                let should = if *wanted { "should be" } else { "should not be" };
                format!("{fluent} is {is}, and {should} {}", self.object(*value))
            }
            Unsatisfied::Alternatives { branches, .. } => {
                let branches: Vec<String> = branches.iter().map(|parts| self.parts(parts)).collect();
                format!("no alternative holds: {}", branches.join(" | "))
            }
            Unsatisfied::Counterexample { binding, parts, .. } => {
                format!("not for {}: {}", self.binding(binding), self.parts(parts))
            }
            Unsatisfied::NoWitness { closest: None, .. } => "there are no objects of these types".to_owned(),
            Unsatisfied::NoWitness { closest: Some(near), .. } => format!(
                "for no objects; closest is {}: {}",
                self.binding(&near.binding),
                self.parts(&near.parts)
            ),
        }
    }

    fn parts(&self, parts: &[Unsatisfied]) -> String {
        parts.iter().map(|part| self.part(part)).collect::<Vec<_>>().join(", ")
    }

    fn comparison(&self, comparison: Comparison, wanted: bool, left: &Operand, right: &Operand) -> String {
        for side in [left, right] {
            if let Err(fault) = &side.value {
                return self.numeric(fault);
            }
        }
        let side = |operand: &Operand| match &operand.value {
            Ok(number) => number.to_string(),
            Err(fault) => self.numeric(fault),
        };
        let is_not = if wanted { "is not" } else { "should not be" };
        let mut text = format!("{} {is_not} {} {}", side(left), comparison.symbol(), side(right));
        self.with_fluents(&mut text, left.fluents.iter().chain(&right.fluents));
        text
    }

    /// Appends `; (fuel a) = 3, (fuel b) = undefined`.
    fn with_fluents<'f>(
        &self,
        text: &mut String,
        fluents: impl Iterator<Item = &'f (GroundApplication, Option<Number>)>,
    ) {
        for (index, (fluent, value)) in fluents.enumerate() {
            let start = if index == 0 { "; " } else { ", " };
            let value = value.map_or_else(|| "undefined".to_owned(), |v| v.to_string());
            write!(text, "{start}{} = {value}", self.application(fluent)).expect("a string takes all");
        }
    }
}
