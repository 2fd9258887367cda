//! `pelea validate DOMAIN PROBLEM PLAN...`: one verdict a line.
//!
//! As JSON a verdict is
//!
//! ```json
//! {"kind": "verdict", "plan": "x.plan", "verdict": "valid", "steps": 4, "makespan": null, "violated": [],
//!  "cost": 4, "metric": null, "message": null, "trace": null}
//! ```
//!
//! `verdict` is `valid`, `invalid`, `unreadable` or `unsupported`; what is not valid says why in
//! `message` and is preceded by diagnostics with places. `metric` is `{"objective": "minimize",
//! "value": 4}` where the problem has one; `makespan` is the end of a plan with times, `violated` has the
//! preferences that do not hold. With `--verbose`, `trace` has an array of changes per step (with times:
//! per happening) that could be taken.

use crate::console::{Console, Form};
use crate::exit::Exit;
use crate::render::{At, Message, show_all};
use crate::task::{TaskFiles, read_source};
use clap::Args;
use pddl::model::Objective;
use pddl::{Plan, Severity, Source, parse_plan};
use serde::Serialize;
use std::path::PathBuf;
use validator::{
    Feature, File, Finding, Number, Place, Precision, Trace, Unsupported, Validator, Verdict, explain,
    show_cause, show_diff, show_preference,
};

/// What to validate.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The domain file.
    domain: PathBuf,
    /// The problem file.
    problem: PathBuf,
    /// Plan files, one ground action after the other; `-` is standard input.
    #[arg(required = true)]
    plans: Vec<PathBuf>,
    /// Show what each step changes.
    #[arg(short, long)]
    verbose: bool,
    /// What is nearer than this, in seconds, must not interfere; 0 asks only of what happens at exactly one time.
    #[arg(long, value_name = "SECONDS", default_value = "0.001", value_parser = seconds)]
    epsilon: Number,
    /// How far a duration may be from what it must be, in seconds: planners round what they write.
    #[arg(long, value_name = "SECONDS", default_value = "0.01", value_parser = seconds)]
    tolerance: Number,
}

/// A length of time, exactly as it is written.
fn seconds(text: &str) -> Result<Number, &'static str> {
    let decimal: pddl::Decimal = text.parse().map_err(|_| "a number of seconds such as 0.001 is wanted")?;
    if decimal.is_negative() { Err("it must not be negative") } else { Ok(Number::from_decimal(decimal)) }
}

pub(crate) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Exit {
    let task = match TaskFiles::read(&arguments.domain, &arguments.problem, console) {
        Ok(task) => task,
        Err(exit) => return exit,
    };
    let precision = Precision { tolerance: arguments.tolerance, separation: arguments.epsilon };
    let validator = Validator::new(&task.domain, &task.problem).map(|v| v.with_precision(precision));
    let mut exit = Exit::Yes;
    for path in &arguments.plans {
        let judge = Judge { task: &task, validator: &validator, verbose: arguments.verbose };
        exit = exit.and(match read_source(path, console) {
            Ok(source) => judge.plan(&source, console),
            Err(exit) => {
                say(console, &VerdictRecord::of(&path.display().to_string(), "unreadable"));
                exit
            }
        });
    }
    exit
}

struct Judge<'a> {
    task: &'a TaskFiles,
    validator: &'a Result<Validator<'a>, Box<Verdict>>,
    verbose: bool,
}

impl Judge<'_> {
    fn plan(&self, source: &Source, console: &mut Console<'_>) -> Exit {
        let task = self.task;
        let parsed = parse_plan(source, &task.domain, &task.problem);
        let worst = show_all(source, &parsed.diagnostics, console);
        let Some(plan) = parsed.model else {
            let unsupported = worst == Some(Severity::Unsupported);
            let (word, exit) = if unsupported {
                ("unsupported", Exit::Unsupported)
            } else {
                ("unreadable", Exit::Unreadable)
            };
            let mut record = VerdictRecord::of(source.name(), word);
            record.message =
                parsed.diagnostics.iter().find(|d| Some(d.severity) == worst).map(pddl::Diagnostic::message);
            say(console, &record);
            return exit;
        };
        let (verdict, trace) = match self.validator {
            Ok(validator) if self.verbose => {
                let (verdict, trace) = validator.trace(&plan);
                (verdict, Some(trace))
            }
            Ok(validator) => (validator.validate(&plan), None),
            Err(refusal) => ((**refusal).clone(), None),
        };
        let (word, exit) = match &verdict {
            Verdict::Valid(_) => ("valid", Exit::Yes),
            Verdict::Invalid(_) => ("invalid", Exit::No),
            Verdict::Unsupported(_) => ("unsupported", Exit::Unsupported),
            Verdict::IllFormed(_) => ("unreadable", Exit::Unreadable),
        };
        let mut record = VerdictRecord::of(source.name(), word);
        if let Verdict::Valid(valid) = &verdict {
            record.steps = Some(valid.steps);
            record.makespan = valid.makespan.map(Figure);
            let violated = valid.violations.instances().iter();
            record.violated = violated.map(|v| show_preference(&task.problem, v)).collect();
            record.cost = Some(Figure(valid.cost()));
            record.metric = valid.metric.map(|metric| MetricRecord {
                objective: match metric.objective {
                    Objective::Minimize => "minimize",
                    Objective::Maximize => "maximize",
                },
                value: Figure(metric.value),
            });
        }
        if let Some(trace) = &trace {
            self.show_trace(&plan, trace, console);
            let diffs = trace.happenings.iter().map(|h| show_diff(&task.domain, &task.problem, &h.diff));
            record.trace = Some(diffs.collect());
        }
        if let Some(finding) = explain(&task.domain, &task.problem, &plan, &verdict) {
            if !reported_by_the_parser(&verdict) {
                finding_message(&finding, &verdict, task, source).show(console);
            }
            record.message = Some(finding.sentence);
        }
        say(console, &record);
        exit
    }

    fn show_trace(&self, plan: &Plan, trace: &Trace, console: &mut Console<'_>) {
        if console.form() == Form::Json {
            return;
        }
        let TaskFiles { domain, problem, .. } = self.task;
        for happening in &trace.happenings {
            for &cause in &happening.causes {
                console.note(&show_cause(domain, problem, plan, cause));
            }
            for line in show_diff(domain, problem, &happening.diff) {
                console.note(&format!("    {line}"));
            }
        }
    }
}

/// Whether reading the files has said the same already.
fn reported_by_the_parser(verdict: &Verdict) -> bool {
    matches!(
        verdict,
        Verdict::Unsupported(Unsupported { feature: Feature::InDomain(_) | Feature::InProblem(_), .. })
    )
}

/// A finding with its excerpts.
pub(crate) fn finding_message<'a>(
    finding: &Finding,
    verdict: &Verdict,
    task: &'a TaskFiles,
    plan: &'a Source,
) -> Message<'a> {
    let at = |place: Place| At {
        source: match place.file {
            File::Domain => &task.domain_source,
            File::Problem => &task.problem_source,
            File::Plan => plan,
        },
        span: place.span,
    };
    let mut message = Message::error(finding.sentence.clone());
    if matches!(verdict, Verdict::Unsupported(_)) {
        message.severity = Severity::Unsupported;
    }
    message.at = Some(at(finding.place));
    message.labels = finding.notes.iter().map(|(place, text)| (at(*place), text.clone())).collect();
    message
}

fn say(console: &mut Console<'_>, record: &VerdictRecord) {
    let mut detail = match (&record.message, record.steps, &record.cost) {
        (Some(message), _, _) => format!(": {message}"),
        (None, Some(1), Some(cost)) => format!(", 1 step, cost {}", cost.0),
        (None, Some(steps), Some(cost)) => format!(", {steps} steps, cost {}", cost.0),
        _ => String::new(),
    };
    if !record.violated.is_empty() {
        detail += &format!(", violates {}", record.violated.join(", "));
    }
    console.result(&format!("{}: {}{detail}", record.plan, record.verdict));
    console.record(record);
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

#[derive(Serialize)]
struct VerdictRecord {
    kind: &'static str,
    plan: String,
    verdict: &'static str,
    steps: Option<u32>,
    makespan: Option<Figure>,
    violated: Vec<String>,
    cost: Option<Figure>,
    metric: Option<MetricRecord>,
    message: Option<String>,
    trace: Option<Vec<Vec<String>>>,
}

impl VerdictRecord {
    fn of(plan: &str, verdict: &'static str) -> Self {
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
        }
    }
}
