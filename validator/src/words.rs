//! A verdict in words, each with its place.
//!
//! The verdict is data; whoever shows it to people (the command line, the executive's log) says the same
//! sentences. A [`Finding`] has one sentence and a place, and notes with places of their own, which may
//! lie in another file: a failing step in the plan, its unsatisfied parts in the domain.

use crate::expression::NumericFault;
use crate::state::{GroundAtom, Value};
use crate::trace::Diff;
use crate::verdict::{
    EffectFault, Failure, Feature, IllFormed, Operand, StepFault, StepIndex, Unsatisfied, Verdict,
};
use pddl::model::{Comparison, Domain, GroundApplication, Name, ObjectId, Problem};
use pddl::{PlanStep, SequentialPlan, Span};
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
pub fn explain(
    domain: &Domain,
    problem: &Problem,
    plan: &SequentialPlan,
    verdict: &Verdict,
) -> Option<Finding> {
    let words = Words { domain, problem, plan };
    match verdict {
        Verdict::Valid(_) => None,
        Verdict::Invalid(failure) => Some(words.failure(failure)),
        Verdict::Unsupported(unsupported) => {
            let (file, sentence) = match &unsupported.feature {
                Feature::InDomain(what) => (File::Domain, what.clone()),
                Feature::InProblem(what) => (File::Problem, what.clone()),
                Feature::LanguageOfDomain(what) => (File::Domain, format!("{what} are not supported")),
                Feature::LanguageOfProblem(what) => (File::Problem, format!("{what} are not supported")),
                Feature::TaskNetwork => (
                    File::Problem,
                    "not supported: a plan for a task network without its decomposition".into(),
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

/// A step's changes, one a line: `+ (at b)`, `- (at a)`, `(fuel) 3 -> 2`.
pub fn show_diff(domain: &Domain, problem: &Problem, diff: &Diff) -> Vec<String> {
    let value = |value: Option<Value>| match value {
        None => "undefined".to_owned(),
        Some(Value::Number(number)) => number.to_string(),
        Some(Value::Object(object)) => show_object(object, problem),
    };
    let deleted = diff.deleted.iter().map(|atom| format!("- {}", show_atom(domain, problem, atom)));
    let added = diff.added.iter().map(|atom| format!("+ {}", show_atom(domain, problem, atom)));
    let fluents = diff.fluents.iter().map(|change| {
        let fluent = show_application(domain, problem, &change.fluent);
        format!("  {fluent} {} -> {}", value(change.before), value(change.after))
    });
    deleted.chain(added).chain(fluents).collect()
}

fn show_object(object: ObjectId, problem: &Problem) -> String {
    problem.objects.get(object).map_or_else(|| "?".to_owned(), |o| o.name.to_string())
}

fn show_list(name: &Name, arguments: &[ObjectId], problem: &Problem) -> String {
    let mut text = format!("({name}");
    for &argument in arguments {
        text.push(' ');
        text.push_str(&show_object(argument, problem));
    }
    text.push(')');
    text
}

const fn symbol(comparison: Comparison) -> &'static str {
    match comparison {
        Comparison::Less => "<",
        Comparison::LessEqual => "<=",
        Comparison::Equal => "=",
        Comparison::GreaterEqual => ">=",
        Comparison::Greater => ">",
    }
}

struct Words<'a> {
    domain: &'a Domain,
    problem: &'a Problem,
    plan: &'a SequentialPlan,
}

impl Words<'_> {
    fn atom(&self, atom: &GroundAtom) -> String {
        show_atom(self.domain, self.problem, atom)
    }

    fn application(&self, fluent: &GroundApplication) -> String {
        show_application(self.domain, self.problem, fluent)
    }

    fn object(&self, object: ObjectId) -> String {
        show_object(object, self.problem)
    }

    fn binding(&self, binding: &[(Name, ObjectId)]) -> String {
        let mut text = String::new();
        for (index, (name, object)) in binding.iter().enumerate() {
            let comma = if index == 0 { "" } else { ", " };
            write!(text, "{comma}?{name} = {}", self.object(*object)).expect("a string takes all");
        }
        text
    }

    fn step_place(&self, step: StepIndex) -> Place {
        let span = self.plan.steps.get(step.0 as usize).map_or_else(Span::default, |s| s.span);
        Place { file: File::Plan, span }
    }

    fn step(&self, step: StepIndex) -> String {
        match self.plan.steps.get(step.0 as usize) {
            Some(s) => format!("step {} {}", step.number(), show_step(self.domain, self.problem, s)),
            None => format!("step {}", step.number()),
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
                    StepFault::Type { object, .. } => {
                        format!("has an argument of the wrong type: {}", self.object(*object))
                    }
                };
                let sentence = format!("{} {what}", self.step(*step));
                Finding { sentence, place: self.step_place(*step), notes: Vec::new() }
            }
            Failure::Precondition { step, parts } => {
                let sentence =
                    format!("{} cannot be taken: its precondition does not hold", self.step(*step));
                Finding { sentence, place: self.step_place(*step), notes: self.notes(parts, File::Domain) }
            }
            Failure::Effect { step, fault } => {
                let sentence = format!("{} has no result", self.step(*step));
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
                Finding { sentence, place: self.step_place(*step), notes }
            }
            Failure::Goal { parts } => {
                let sentence = match self.plan.steps.len() {
                    0 => "the goal does not hold, and the plan is empty".to_owned(),
                    1 => "the goal does not hold after the only step".to_owned(),
                    n => format!("the goal does not hold after the last of {n} steps"),
                };
                let place = Place { file: File::Problem, span: self.problem.goal_span };
                Finding { sentence, place, notes: self.notes(parts, File::Problem) }
            }
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

    fn notes(&self, parts: &[Unsatisfied], file: File) -> Vec<(Place, String)> {
        let mut notes = Vec::new();
        for part in parts {
            notes.push((Place { file, span: part.span() }, self.part(part)));
            let cause = match part {
                Unsatisfied::Missing { atom, deleted_by: Some(step), .. } => {
                    Some((*step, format!("this deletes {}", self.atom(atom))))
                }
                Unsatisfied::Present { atom, added_by: Some(step), .. } => {
                    Some((*step, format!("this adds {}", self.atom(atom))))
                }
                _ => None,
            };
            notes.extend(cause.map(|(step, text)| (self.step_place(step), text)));
        }
        notes
    }

    fn part(&self, part: &Unsatisfied) -> String {
        match part {
            Unsatisfied::Missing { atom, deleted_by, derived, .. } => {
                let atom = self.atom(atom);
                match deleted_by {
                    _ if *derived => format!("{atom} does not follow"),
                    None => format!("{atom} does not hold; it never did"),
                    Some(step) => format!("{atom} does not hold; {} deleted it", self.step(*step)),
                }
            }
            Unsatisfied::Present { atom, added_by, derived, .. } => {
                let atom = self.atom(atom);
                match added_by {
                    None if *derived => format!("{atom} should not hold, but follows"),
                    None => format!("{atom} should not hold, but does from the beginning"),
                    Some(step) => format!("{atom} should not hold; {} added it", self.step(*step)),
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
        let mut text = format!("{} {is_not} {} {}", side(left), symbol(comparison), side(right));
        for (index, (fluent, value)) in left.fluents.iter().chain(&right.fluents).enumerate() {
            let start = if index == 0 { "; " } else { ", " };
            let value = value.map_or_else(|| "undefined".to_owned(), |v| v.to_string());
            write!(text, "{start}{} = {value}", self.application(fluent)).expect("a string takes all");
        }
        text
    }
}
