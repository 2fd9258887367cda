//! Verdicts as JSON, and as lines.
//!
//! ```json
//! {"kind": "verdict", "plan": "x.plan", "verdict": "valid", "steps": 4, "makespan": null, "violated": [],
//!  "cost": 4, "metric": null, "message": null, "trace": null, "failure": null}
//! ```
//!
//! `verdict` is `valid`, `invalid`, `unreadable` or `unsupported`. If a plan is not valid,
//! `message` has the reason, diagnostics with places come before it, and `failure` has the same as
//! data. `metric` is `{"objective": "minimize", "value": 4}` if the problem has a metric;
//! `makespan` is the end of a plan with times, and `violated` lists the violated preferences. With
//! `--trace`, `trace` has an array of changes for each executed step (with times: for each
//! happening), and `happenings` has the same as data. If the problem has a task network and the
//! plan gives no decomposition, `decomposition` has the one that was found.

use super::advice::AdviceRecord;
use super::decomposition::DecompositionRecord;
use super::failure::{FailureRecord, failure_record};
use super::trace::{HappeningRecord, happening_records};
use crate::advice::Repair;
use crate::number::Number;
use crate::report::explain::explain;
use crate::report::names::{show_diff, show_preference};
use crate::report::subject::Subject;
use crate::trace::{Happening, Trace};
use crate::verdict::{Failure, Valid, Verdict};
use pddl::model::Objective;
use serde::Serialize;

/// A verdict as one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Word {
    /// Every step is applicable, and the goal holds at the end.
    Valid,
    /// It is not a plan for the problem.
    Invalid,
    /// The plan or its task cannot be read, or the task has no meaning.
    Unreadable,
    /// The task or the plan uses a feature that is not supported.
    Unsupported,
}

impl Word {
    /// The word for a verdict.
    pub fn of(verdict: &Verdict) -> Self {
        match verdict {
            Verdict::Valid(_) => Self::Valid,
            Verdict::Invalid(_) => Self::Invalid,
            Verdict::Unsupported(_) => Self::Unsupported,
            Verdict::IllFormed(_) => Self::Unreadable,
        }
    }

    /// The word itself.
    pub fn text(self) -> &'static str {
        match self {
            Self::Valid => "valid",
            Self::Invalid => "invalid",
            Self::Unreadable => "unreadable",
            Self::Unsupported => "unsupported",
        }
    }
}

#[derive(Serialize)]
struct MetricRecord {
    objective: &'static str,
    value: Number,
}

/// The record of a verdict.
#[derive(Serialize)]
pub struct VerdictRecord {
    kind: &'static str,
    plan: String,
    verdict: Word,
    steps: Option<u32>,
    makespan: Option<Number>,
    violated: Vec<String>,
    cost: Option<Number>,
    metric: Option<MetricRecord>,
    message: Option<String>,
    trace: Option<Vec<Vec<String>>>,
    failure: Option<FailureRecord>,
    /// The decomposition that the validator found, if the plan gave none.
    #[serde(skip_serializing_if = "Option::is_none")]
    decomposition: Option<DecompositionRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    advice: Option<AdviceRecord>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    other_advice: Vec<AdviceRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    happenings: Option<Vec<HappeningRecord>>,
}

impl VerdictRecord {
    /// The record of a plan that was not judged.
    pub fn unread(plan: &str, verdict: Word, message: Option<String>) -> Self {
        Self {
            kind: "verdict",
            plan: plan.to_owned(),
            verdict,
            steps: None,
            makespan: None,
            violated: Vec::new(),
            cost: None,
            metric: None,
            message,
            trace: None,
            failure: None,
            decomposition: None,
            advice: None,
            other_advice: Vec::new(),
            happenings: None,
        }
    }

    /// The record of a plan that was judged: the verdict, its figures and its sentence.
    pub fn new(subject: &Subject<'_>, verdict: &Verdict) -> Self {
        let Subject { domain, problem, plan, .. } = *subject;
        let message = explain(domain, problem, plan, verdict).map(|finding| finding.sentence);
        let mut record = Self::unread(subject.plan_text.name(), Word::of(verdict), message);
        if let Verdict::Valid(valid) = verdict {
            record.fill(subject, valid);
        }
        record
    }

    fn fill(&mut self, subject: &Subject<'_>, valid: &Valid) {
        self.steps = Some(valid.steps);
        self.makespan = valid.makespan;
        let violated = valid.violations.instances().iter();
        self.violated = violated.map(|v| show_preference(subject.problem, v)).collect();
        self.cost = Some(valid.cost());
        self.metric = valid.metric.map(|metric| MetricRecord {
            objective: match metric.objective {
                Objective::Minimize => "minimize",
                Objective::Maximize => "maximize",
            },
            value: metric.value,
        });
        let found = valid.decomposition.as_deref();
        self.decomposition = found.map(|found| DecompositionRecord::of(subject, found));
    }

    /// Adds the changes of each step, as lines.
    pub fn add_trace(&mut self, subject: &Subject<'_>, trace: &Trace) {
        let lines = |happening: &Happening| show_diff(subject.domain, subject.problem, &happening.diff);
        self.trace = Some(trace.happenings.iter().map(lines).collect());
    }

    /// Adds the changes of each step, as data.
    pub fn add_happenings(&mut self, subject: &Subject<'_>, trace: &Trace) {
        self.happenings = Some(happening_records(subject, trace));
    }

    /// Adds the reason why the plan is not valid, as data.
    pub fn add_failure(&mut self, subject: &Subject<'_>, fault: &Failure) {
        self.failure = Some(failure_record(subject, fault));
    }

    /// Adds advice: changes that make the plan valid.
    pub fn add_advice(&mut self, subject: &Subject<'_>, repairs: &[Repair]) {
        let mut advice = repairs.iter().map(|repair| AdviceRecord::of(subject, repair));
        self.advice = advice.next();
        self.other_advice = advice.collect();
    }

    /// The advice, one sentence each.
    pub fn advice(&self) -> impl Iterator<Item = &str> {
        self.advice.iter().chain(&self.other_advice).map(|advice| advice.text.as_str())
    }

    /// The name of the plan file.
    pub fn plan(&self) -> &str {
        &self.plan
    }

    /// The verdict as one word.
    pub fn word(&self) -> Word {
        self.verdict
    }

    /// The known figures, by name.
    pub(crate) fn figures(&self) -> Vec<(&'static str, String)> {
        let mut figures = Vec::new();
        figures.extend(self.makespan.map(|makespan| ("makespan", format!("{makespan} s"))));
        figures.extend(self.metric.as_ref().map(|m| ("metric", format!("{} {}", m.objective, m.value))));
        if !self.violated.is_empty() {
            figures.push(("violated preferences", self.violated.join(", ")));
        }
        figures
    }

    /// The verdict and its figures in one line.
    pub fn line(&self) -> String {
        let mut line = self.verdict.text().to_owned();
        line += &match (&self.message, self.steps, self.cost) {
            (Some(message), _, _) => format!(": {message}"),
            (None, Some(1), Some(cost)) => format!(", 1 step, cost {cost}"),
            (None, Some(steps), Some(cost)) => format!(", {steps} steps, cost {cost}"),
            _ => String::new(),
        };
        if self.decomposition.is_some() {
            line += ", by a decomposition that was found";
        }
        if !self.violated.is_empty() {
            line += &format!(", violates {}", self.violated.join(", "));
        }
        line
    }
}
