//! Verdicts as JSON, and as lines.
//!
//! ```json
//! {"kind": "verdict", "plan": "x.plan", "verdict": "valid", "steps": 4, "makespan": null, "violated": [],
//!  "cost": 4, "metric": null, "message": null, "trace": null, "failure": null}
//! ```
//!
//! `verdict` is `valid`, `invalid`, `unreadable` or `unsupported`; what is not valid says why in
//! `message` and is preceded by diagnostics with places; `failure` has the same as data. `metric` is
//! `{"objective": "minimize", "value": 4}` where the problem has one; `makespan` is the end of a plan with
//! times, `violated` has the preferences that do not hold. With `--trace`, `trace` has an array of changes per
//! step (with times: per happening) that could be taken, and `happenings` the same as data. Where a plan does not say
//! how it comes out of the problem's task network, `decomposition` has how it does.

use super::advice::AdviceRecord;
use super::failure::{CauseRecord, FailureRecord, Places};
use super::network::DecompositionRecord;
use crate::console::Console;
use crate::exit::Exit;
use pddl::model::{Objective, Problem};
use serde::Serialize;
use validator::{FluentChange, GroundAtom, Happening, Number, Trace, Valid, Value, Verdict, show_preference};

/// A verdict in a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Word {
    Valid,
    Invalid,
    Unreadable,
    Unsupported,
}

impl Word {
    pub(super) fn of(verdict: &Verdict) -> Self {
        match verdict {
            Verdict::Valid(_) => Self::Valid,
            Verdict::Invalid(_) => Self::Invalid,
            Verdict::Unsupported(_) => Self::Unsupported,
            Verdict::IllFormed(_) => Self::Unreadable,
        }
    }

    pub(super) fn text(self) -> &'static str {
        match self {
            Self::Valid => "valid",
            Self::Invalid => "invalid",
            Self::Unreadable => "unreadable",
            Self::Unsupported => "unsupported",
        }
    }
}

/// How many plans got which verdict.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Tally {
    kind: &'static str,
    valid: usize,
    invalid: usize,
    unreadable: usize,
    unsupported: usize,
}

impl Default for Tally {
    fn default() -> Self {
        Self { kind: "verdicts", valid: 0, invalid: 0, unreadable: 0, unsupported: 0 }
    }
}

impl Tally {
    pub(super) fn count(&mut self, word: Word) {
        *match word {
            Word::Valid => &mut self.valid,
            Word::Invalid => &mut self.invalid,
            Word::Unreadable => &mut self.unreadable,
            Word::Unsupported => &mut self.unsupported,
        } += 1;
    }

    pub(super) fn plans(&self) -> usize {
        self.valid + self.invalid + self.unreadable + self.unsupported
    }

    pub(super) fn line(&self) -> String {
        let parts = [
            (self.valid, Word::Valid),
            (self.invalid, Word::Invalid),
            (self.unreadable, Word::Unreadable),
            (self.unsupported, Word::Unsupported),
        ];
        let parts: Vec<String> =
            parts.iter().filter(|(n, _)| *n > 0).map(|(n, word)| format!("{n} {}", word.text())).collect();
        format!("{} plans: {}", self.plans(), parts.join(", "))
    }

    /// No plan at all is no success.
    pub(super) fn exit(&self) -> Exit {
        let outcomes = [
            (self.invalid > 0, Exit::No),
            (self.unreadable > 0 || self.plans() == 0, Exit::Unreadable),
            (self.unsupported > 0, Exit::Unsupported),
        ];
        outcomes.iter().filter(|(so, _)| *so).fold(Exit::Yes, |all, (_, exit)| all.and(*exit))
    }
}

/// A number as JSON: whole where it is whole.
pub(crate) struct Figure(pub(crate) Number);

impl Serialize for Figure {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self.0.to_string().parse::<i64>() {
            Ok(whole) => to.serialize_i64(whole),
            Err(_) => to.serialize_f64(self.0.to_f64()),
        }
    }
}

#[derive(Serialize)]
struct MetricRecord {
    objective: &'static str,
    value: Figure,
}

/// What is said of a plan.
#[derive(Serialize)]
pub(super) struct VerdictRecord {
    kind: &'static str,
    plan: String,
    verdict: Word,
    steps: Option<u32>,
    makespan: Option<Figure>,
    violated: Vec<String>,
    cost: Option<Figure>,
    metric: Option<MetricRecord>,
    pub(super) message: Option<String>,
    pub(super) trace: Option<Vec<Vec<String>>>,
    pub(super) failure: Option<FailureRecord>,
    /// A decomposition that the plan did not give and that was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) decomposition: Option<DecompositionRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) advice: Option<AdviceRecord>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) other_advice: Vec<AdviceRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) happenings: Option<Vec<HappeningRecord>>,
}

impl VerdictRecord {
    pub(super) fn of(plan: &str, verdict: Word) -> Self {
        Self {
            kind: "verdict",
            plan: plan.to_owned(),
            verdict,
            steps: None,
            makespan: None,
            violated: Vec::new(),
            cost: None,
            metric: None,
            message: None,
            trace: None,
            failure: None,
            decomposition: None,
            advice: None,
            other_advice: Vec::new(),
            happenings: None,
        }
    }

    /// Enters a valid plan's figures.
    pub(super) fn fill(&mut self, valid: &Valid, problem: &Problem) {
        self.steps = Some(valid.steps);
        self.makespan = valid.makespan.map(Figure);
        let violated = valid.violations.instances().iter();
        self.violated = violated.map(|v| show_preference(problem, v)).collect();
        self.cost = Some(Figure(valid.cost()));
        self.metric = valid.metric.map(|metric| MetricRecord {
            objective: match metric.objective {
                Objective::Minimize => "minimize",
                Objective::Maximize => "maximize",
            },
            value: Figure(metric.value),
        });
    }

    pub(super) fn plan(&self) -> &str {
        &self.plan
    }

    pub(super) fn word(&self) -> &'static str {
        self.verdict.text()
    }

    /// The figures that there are, by name.
    pub(super) fn figures(&self) -> Vec<(&'static str, String)> {
        let mut figures = Vec::new();
        figures.extend(self.makespan.as_ref().map(|makespan| ("makespan", format!("{} s", makespan.0))));
        figures.extend(self.metric.as_ref().map(|m| ("metric", format!("{} {}", m.objective, m.value.0))));
        if !self.violated.is_empty() {
            figures.push(("violated preferences", self.violated.join(", ")));
        }
        figures
    }

    /// The verdict and its figures.
    pub(super) fn line(&self) -> String {
        let mut line = self.verdict.text().to_owned();
        line += &match (&self.message, self.steps, &self.cost) {
            (Some(message), _, _) => format!(": {message}"),
            (None, Some(1), Some(cost)) => format!(", 1 step, cost {}", cost.0),
            (None, Some(steps), Some(cost)) => format!(", {steps} steps, cost {}", cost.0),
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

    pub(super) fn say(&self, console: &mut Console<'_>) {
        console.result(&format!("{}: {}", self.plan, self.line()));
        console.record(self);
    }
}

/// What happened at one time.
#[derive(Serialize)]
pub(super) struct HappeningRecord {
    time: Figure,
    causes: Vec<CauseRecord>,
    added: Vec<String>,
    deleted: Vec<String>,
    derived: Vec<String>,
    no_longer_derived: Vec<String>,
    /// What changed by itself since the happening before.
    flowed: Vec<ChangeRecord>,
    fluents: Vec<ChangeRecord>,
}

#[derive(Serialize)]
struct ChangeRecord {
    fluent: String,
    before: Option<ValueRecord>,
    after: Option<ValueRecord>,
}

/// What a fluent is.
#[derive(Serialize)]
#[serde(untagged)]
enum ValueRecord {
    Number(Figure),
    Object(String),
}

/// A trace as data.
pub(super) fn happenings(places: &Places<'_>, trace: &Trace) -> Vec<HappeningRecord> {
    let atoms = |atoms: &[GroundAtom]| atoms.iter().map(|atom| places.atom(atom)).collect();
    let value = |value: Value| match value {
        Value::Number(number) => ValueRecord::Number(Figure(number)),
        Value::Object(object) => ValueRecord::Object(places.object(object)),
    };
    let changes = |changes: &[FluentChange]| {
        let record = |change: &FluentChange| ChangeRecord {
            fluent: places.fluent(&change.fluent),
            before: change.before.map(value),
            after: change.after.map(value),
        };
        changes.iter().map(record).collect()
    };
    let record = |happening: &Happening| HappeningRecord {
        time: Figure(happening.time),
        causes: happening.causes.iter().map(|&cause| places.cause(cause)).collect(),
        added: atoms(&happening.diff.added),
        deleted: atoms(&happening.diff.deleted),
        derived: atoms(&happening.diff.derived),
        no_longer_derived: atoms(&happening.diff.no_longer_derived),
        flowed: changes(&happening.diff.flowed),
        fluents: changes(&happening.diff.fluents),
    };
    trace.happenings.iter().map(record).collect()
}
