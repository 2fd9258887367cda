//! Comparing the outcome of a run with the expectations. Pure: facts in, violations out.

use pddl::Span;
use pddl::model::Name;

use super::{Expectation, GraphCondition};
use crate::errors::counted;
use crate::report::Report;

/// The part of a replan that a scenario judges.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Replan {
    /// The tokens in its reason.
    pub names: Vec<Name>,
}

/// The outcome of a run.
#[derive(Clone, Copy, Debug)]
pub struct Outcome<'a> {
    /// Whether the mission reached its goal.
    pub accomplished: bool,
    /// The name of its ending.
    pub ending: &'a str,
    /// The report over the final graph.
    pub report: &'a Report,
    /// All replans.
    pub replans: &'a [Replan],
    /// Answered items that were asked again.
    pub asked_again: &'a [Name],
    /// The goals, and the stages in which their lives are.
    pub goals: &'a [(Name, String)],
    /// The places of the disruptions that did not happen.
    pub idle: &'a [Span],
}

/// An expectation that was not met.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are the terms of the message")]
pub enum Violation {
    /// The mission missed its goal, or reached it against the expectation.
    #[error("the mission was {}accomplished", if *expected { "not " } else { "" })]
    Accomplished { expected: bool, span: Span },
    /// The mission ended in another way.
    #[error("the mission ended {found}, {expected} expected")]
    Ended { expected: String, found: String, span: Span },
    /// A condition does not hold in the final graph.
    #[error("{condition} does not hold in the end")]
    DoesNotHold { condition: String, span: Span },
    /// Another number of items was answered.
    #[error("{} answered, {expected} expected", counted(*found, "item was", "items were"))]
    Answered { expected: u32, found: usize, span: Span },
    /// Another total.
    #[error("the total is {found}, {expected} expected")]
    Total { expected: u32, found: String, span: Span },
    /// Other items are unanswered.
    #[error("unanswered: [{}], expected: [{}]", found.join(", "), expected.join(", "))]
    Unanswered { expected: Vec<String>, found: Vec<String>, span: Span },
    /// Too few replans.
    #[error("{}, at least {expected} expected", counted(*found, "replan", "replans"))]
    TooFewReplans { expected: u32, found: usize, span: Span },
    /// Too many replans.
    #[error("{}, at most {expected} expected", counted(*found, "replan", "replans"))]
    TooManyReplans { expected: u32, found: usize, span: Span },
    /// No replan names the token.
    #[error("no replan names `{token}`")]
    NotNamed { token: Name, span: Span },
    /// The life of a goal is in another stage.
    #[error("the goal `{goal}` is {found} in the end, {expected} expected")]
    Goal { goal: Name, expected: String, found: String, span: Span },
    /// An item that was answered was asked again.
    #[error("`{item}` was asked again after it had been answered")]
    AskedAgain { item: Name, span: Span },
    /// A disruption never happened, so the run was not the one that the scenario describes.
    #[error("this disruption did not happen: the run ended before its trigger, or before its delay was over")]
    DidNotHappen { span: Span },
}

impl Violation {
    /// The place of the expectation.
    pub fn span(&self) -> Span {
        match self {
            Self::Accomplished { span, .. }
            | Self::Ended { span, .. }
            | Self::DoesNotHold { span, .. }
            | Self::Answered { span, .. }
            | Self::Total { span, .. }
            | Self::Unanswered { span, .. }
            | Self::TooFewReplans { span, .. }
            | Self::TooManyReplans { span, .. }
            | Self::NotNamed { span, .. }
            | Self::Goal { span, .. }
            | Self::AskedAgain { span, .. }
            | Self::DidNotHappen { span } => *span,
        }
    }
}

impl Expectation {
    /// The expectations that were not met. `holds` evaluates a condition in the final graph.
    pub fn judge(
        &self,
        outcome: &Outcome<'_>,
        mut holds: impl FnMut(&GraphCondition) -> bool,
    ) -> Vec<Violation> {
        // A scenario without its disruptions tests nothing, whatever else it expects.
        let mut violations: Vec<Violation> =
            outcome.idle.iter().map(|&span| Violation::DidNotHappen { span }).collect();
        if let Some(e) = self.accomplished.as_ref().filter(|e| e.value != outcome.accomplished) {
            violations.push(Violation::Accomplished { expected: e.value, span: e.span });
        }
        if let Some(e) = self.ending.as_ref().filter(|e| e.value != outcome.ending) {
            let (expected, found) = (e.value.clone(), outcome.ending.to_owned());
            violations.push(Violation::Ended { expected, found, span: e.span });
        }
        for condition in self.holds.iter().filter(|c| !holds(c)) {
            let (condition, span) = (condition.text.clone(), condition.span);
            violations.push(Violation::DoesNotHold { condition, span });
        }
        let found = outcome.report.answered();
        if let Some(e) = self.answered.as_ref().filter(|e| e.value as usize != found) {
            violations.push(Violation::Answered { expected: e.value, found, span: e.span });
        }
        let total = outcome.report.total;
        if let Some(e) = self.total.as_ref().filter(|e| !total.is(e.value)) {
            violations.push(Violation::Total { expected: e.value, found: total.to_string(), span: e.span });
        }
        if let Some(e) = &self.unanswered {
            let mut found: Vec<String> = outcome.report.unanswered().map(ToString::to_string).collect();
            let mut expected: Vec<String> = e.value.iter().map(ToString::to_string).collect();
            found.sort_unstable();
            expected.sort_unstable();
            if found != expected {
                violations.push(Violation::Unanswered { expected, found, span: e.span });
            }
        }
        for (goal, e) in &self.goals {
            let found = outcome.goals.iter().find(|(name, _)| name == goal);
            let found = found.map_or("dormant", |(_, stage)| stage);
            if e.value != found {
                let (goal, expected, found) = (goal.clone(), e.value.clone(), found.to_owned());
                violations.push(Violation::Goal { goal, expected, found, span: e.span });
            }
        }
        self.judge_replans(outcome, &mut violations);
        if let Some(e) = &self.asked_again {
            for item in outcome.asked_again.iter().filter(|i| !e.value.contains(i)) {
                violations.push(Violation::AskedAgain { item: item.clone(), span: e.span });
            }
        }
        violations
    }

    fn judge_replans(&self, outcome: &Outcome<'_>, violations: &mut Vec<Violation>) {
        let found = outcome.replans.len();
        if let Some(e) = self.replans.at_least.as_ref().filter(|e| found < e.value as usize) {
            violations.push(Violation::TooFewReplans { expected: e.value, found, span: e.span });
        }
        if let Some(e) = self.replans.at_most.as_ref().filter(|e| found > e.value as usize) {
            violations.push(Violation::TooManyReplans { expected: e.value, found, span: e.span });
        }
        for naming in &self.replans.naming {
            if !outcome.replans.iter().any(|r| r.names.contains(&naming.token)) {
                violations.push(Violation::NotNamed { token: naming.token.clone(), span: naming.span });
            }
        }
    }
}
