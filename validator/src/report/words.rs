//! Steps, causes and unsatisfied parts in words.

use super::finding::Place;
use super::names::{show_application, show_atom, show_binding, show_object, show_step, show_timed_step};
use crate::cause::Cause;
use crate::number::Number;
use crate::plan::{PlanRef, StepIndex, end, start};
use crate::value::GroundAtom;
use crate::verdict::{File, NumericFault, Operand, Unsatisfied};
use pddl::Span;
use pddl::model::{Comparison, Domain, GroundApplication, Name, ObjectId, Problem};
use std::fmt::Write;

pub(super) struct Words<'a> {
    pub(super) domain: &'a Domain,
    pub(super) problem: &'a Problem,
    pub(super) plan: PlanRef<'a>,
}

impl Words<'_> {
    pub(super) fn atom(&self, atom: &GroundAtom) -> String {
        show_atom(self.domain, self.problem, atom)
    }

    pub(super) fn application(&self, fluent: &GroundApplication) -> String {
        show_application(self.domain, self.problem, fluent)
    }

    pub(super) fn object(&self, object: ObjectId) -> String {
        show_object(self.problem, object)
    }

    pub(super) fn binding(&self, binding: &[(Name, ObjectId)]) -> String {
        show_binding(self.problem, binding)
    }

    /// A step in PDDL syntax, and its place.
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

    pub(super) fn step_place(&self, step: StepIndex) -> Place {
        Place { file: File::Plan, span: self.step_text(step).map_or_else(Span::default, |(_, span)| span) }
    }

    pub(super) fn step(&self, step: StepIndex) -> String {
        match self.step_text(step) {
            Some((text, _)) => format!("step {} {text}", step.number()),
            None => format!("step {}", step.number()),
        }
    }

    /// The time of a cause in a plan with times.
    pub(super) fn time(&self, cause: Cause) -> Option<Number> {
        let PlanRef::Temporal(plan) = self.plan else { return None };
        match cause {
            Cause::Step(step) | Cause::Start(step) => plan.steps.get(step.0 as usize).map(start),
            Cause::End(step) => plan.steps.get(step.0 as usize).map(end),
            Cause::Timed(index) => {
                self.problem.timed.get(index as usize).map(|timed| Number::from_decimal(timed.time))
            }
            Cause::Event(_) => None,
        }
    }

    pub(super) fn cause_place(&self, cause: Cause) -> Place {
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
    pub(super) fn cause(&self, cause: Cause) -> String {
        let at = self.time(cause).map_or_else(String::new, |time| format!(" at {time}"));
        match cause {
            Cause::Step(step) => format!("{}{at}", self.step(step)),
            Cause::Start(step) => format!("the start of {}{at}", self.step(step)),
            Cause::End(step) => format!("the end of {}{at}", self.step(step)),
            Cause::Timed(_) => format!("a timed change{at}"),
            Cause::Event(event) => format!("event `{}`", self.domain.events[event].name),
        }
    }

    pub(super) fn numeric(&self, fault: &NumericFault) -> String {
        match fault {
            NumericFault::Undefined { fluent, .. } => format!("{} is undefined", self.application(fluent)),
            NumericFault::DivisionByZero { .. } => "division by zero".to_owned(),
            NumericFault::Overflow { .. } => "the result is too large".to_owned(),
            NumericFault::Duration { .. } => "an instantaneous action has no duration".to_owned(),
        }
    }

    pub(super) fn notes(&self, parts: &[Unsatisfied], file: File) -> Vec<(Place, String)> {
        let mut notes = Vec::new();
        for part in parts {
            let text = match part {
                // The notes of the reasons explain this.
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

    pub(super) fn part(&self, part: &Unsatisfied) -> String {
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

    pub(super) fn parts(&self, parts: &[Unsatisfied]) -> String {
        parts.iter().map(|part| self.part(part)).collect::<Vec<_>>().join(", ")
    }

    pub(super) fn comparison(
        &self,
        comparison: Comparison,
        wanted: bool,
        left: &Operand,
        right: &Operand,
    ) -> String {
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
    pub(super) fn with_fluents<'f>(
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
