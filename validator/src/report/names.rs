//! Atoms, fluents, steps and changes in PDDL syntax.

use crate::trace::{Diff, FluentChange};
use crate::value::{GroundAtom, Value};
use crate::verdict::ViolatedPreference;
use pddl::model::{Domain, GroundApplication, Name, ObjectId, Problem};
use pddl::{PlanStep, StepHead, TemporalStep};

/// An atom as PDDL.
pub fn show_atom(domain: &Domain, problem: &Problem, atom: &GroundAtom) -> String {
    show_list(&domain.predicates[atom.predicate].name, &atom.arguments, problem)
}

/// A fluent as PDDL.
pub fn show_application(domain: &Domain, problem: &Problem, fluent: &GroundApplication) -> String {
    show_list(&domain.functions[fluent.function].name, &fluent.arguments, problem)
}

/// A step as PDDL.
pub(super) fn show_step(domain: &Domain, problem: &Problem, step: &PlanStep) -> String {
    let unknown = Name::new("?");
    let name = domain.actions.get(step.action).map_or(&unknown, |action| &action.name);
    show_list(name, &step.arguments, problem)
}

/// A step of a plan with times as PDDL, without its times.
pub(super) fn show_timed_step(domain: &Domain, problem: &Problem, step: &TemporalStep) -> String {
    let unknown = Name::new("?");
    let name = match step.head {
        StepHead::Action(id) => domain.actions.get(id).map(|action| &action.name),
        StepHead::DurativeAction(id) => domain.durative_actions.get(id).map(|action| &action.name),
    };
    show_list(name.unwrap_or(&unknown), &step.arguments, problem)
}

/// A violated preference: `p1 (?x = a)`.
pub(super) fn show_preference(problem: &Problem, violated: &ViolatedPreference) -> String {
    let name = violated.name.as_ref().map_or("a preference without a name", Name::as_str);
    if violated.binding.is_empty() {
        return name.to_owned();
    }
    format!("{name} ({})", show_binding(problem, &violated.binding))
}

pub(super) fn show_binding(problem: &Problem, binding: &[(Name, ObjectId)]) -> String {
    let value = |(name, object): &(Name, ObjectId)| format!("?{name} = {}", show_object(problem, *object));
    binding.iter().map(value).collect::<Vec<_>>().join(", ")
}

/// The changes of a step, one per line: `+ (at b)`, `- (at a)`, ` (fuel) 3 -> 2`. A derived atom is
/// `+ (near b), which follows`; a continuous change since the last step is ` (level) 1 -> 2,
/// continuously`.
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
pub(super) fn show_object(problem: &Problem, object: ObjectId) -> String {
    problem.objects.get(object).map_or_else(|| "?".to_owned(), |o| o.name.to_string())
}

pub(super) fn show_list(name: &Name, arguments: &[ObjectId], problem: &Problem) -> String {
    let mut text = format!("({name}");
    for &argument in arguments {
        text.push(' ');
        text.push_str(&show_object(problem, argument));
    }
    text.push(')');
    text
}
