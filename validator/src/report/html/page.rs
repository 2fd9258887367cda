//! An HTML page of plans: a Gantt chart, the state and changes at each step, and the reason for a
//! failure.
//!
//! The page is one file that loads no others. It contains its text as HTML. The chart and the
//! states are drawn from data in the page, and only their visible part, so that plans may have many
//! thousand steps. Invariant: text from a file is always escaped, as HTML or as JSON without `<`.

use super::tree::tree;
use crate::cause::Cause;
use crate::number::Number;
use crate::plan::StepIndex;
use crate::report::causes::{cause_time, show_cause};
use crate::report::finding::Finding;
use crate::report::json::VerdictRecord;
use crate::report::names::{show_step, show_timed_step};
use crate::report::subject::Subject;
use crate::trace::{Demand, Diff, FluentChange, Stretch, Trace, Watched};
use crate::value::Value;
use crate::verdict::{Failure, Verdict};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use pddl::{Plan, PlanStep, Span};
use serde::Serialize;

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// The data of a plan.
#[derive(Serialize)]
struct Data<'a> {
    steps: Vec<Bar>,
    fails: Option<u64>,
    why: Option<&'a str>,
    initial: Changes,
    happenings: Vec<Changes>,
    watched: Vec<Row>,
}

/// A constraint or preference: the intervals in which its conditions hold, and its violation.
#[derive(Serialize)]
struct Row {
    text: String,
    soft: bool,
    broken: bool,
    at: Option<f64>,
    conditions: Vec<(String, Vec<While>)>,
}

/// The interval in which a condition holds; without an end, it lasts to the end of the plan.
type While = (f64, Option<f64>);

#[derive(Serialize)]
struct Bar {
    text: String,
    start: f64,
    end: f64,
}

#[derive(Serialize)]
struct Changes {
    what: String,
    steps: Vec<u64>,
    added: Vec<String>,
    deleted: Vec<String>,
    fluents: Vec<(String, String)>,
}

/// The section of a plan that could not be judged.
pub fn section_unread(record: &VerdictRecord) -> String {
    html! { section { h1 { (record.plan()) } (verdict(record)) } }.into_string() + "\n"
}

/// The section of a plan.
pub fn section(
    subject: &Subject<'_>,
    record: &VerdictRecord,
    outcome: &Verdict,
    finding: Option<&Finding>,
    trace: &Trace,
) -> String {
    let failure = match outcome {
        Verdict::Invalid(failure) => Some(failure),
        _ => None,
    };
    let decomposed = match (outcome, subject.plan) {
        (_, Plan::Hierarchical(plan)) => Some(plan),
        (Verdict::Valid(valid), _) => valid.decomposition.as_deref(),
        _ => None,
    };
    let data = Data {
        steps: bars(subject),
        fails: failure.and_then(failing_step),
        why: finding.map(|finding| finding.sentence.as_str()),
        initial: changes(subject, &trace.initial, &[]),
        happenings: trace.happenings.iter().map(|h| changes(subject, &h.diff, &h.causes)).collect(),
        watched: trace.watched.iter().map(|watched| row(subject, watched)).collect(),
    };
    let data = serde_json::to_string(&data).unwrap_or_default().replace('<', "\\u003c");
    let section = html! {
        section data-plan {
            h1 { (record.plan()) }
            (verdict(record))
            @if let Some(finding) = finding {
                div class="why" {
                    strong { (finding.sentence) }
                    ul { @for (_, note) in &finding.notes { li { (note) } } }
                    @for advice in record.advice() { p { (advice) } }
                }
            }
            @if let Some(plan) = decomposed { (tree(subject, plan, failure)) }
            h2 { "Plan" }
            div class="gantt" {}
            @if !trace.watched.is_empty() {
                h2 { "Constraints and preferences: when their conditions hold" }
                div class="watched" {}
            }
            div class="both" {
                div { h2 { "Steps" } div class="happenings" {} }
                div { h2 { "State after the chosen step" } div class="state" {} }
            }
            script type="application/json" { (PreEscaped(data)) }
        }
    };
    section.into_string() + "\n"
}

/// The whole page.
pub fn page(sections: &[String]) -> String {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                title { "Plans" }
                meta name="viewport" content="width=device-width";
                style { (PreEscaped(STYLE)) }
            }
            body {
                @for section in sections { (PreEscaped(section)) }
                script { (PreEscaped(SCRIPT)) }
            }
        }
    }
    .into_string()
}

fn verdict(record: &VerdictRecord) -> Markup {
    html! {
        p class=(record.word().text()) { (record.line()) }
        @for (name, value) in record.figures() {
            div { (name) ": " strong { (value) } }
        }
    }
}

fn failing_step(failure: &Failure) -> Option<u64> {
    let step = match failure {
        Failure::Step { step, .. } | Failure::Duration { step, .. } | Failure::Invariant { step, .. } => {
            Some(*step)
        }
        Failure::Precondition { at, .. } | Failure::Effect { at, .. } => at.step(),
        Failure::Interference { second, .. } => second.step(),
        _ => None,
    };
    step.map(StepIndex::number)
}

fn bars(subject: &Subject<'_>) -> Vec<Bar> {
    let (domain, problem, plan) = (subject.domain, subject.problem, subject.plan);
    let one_by_one = |steps: &mut dyn Iterator<Item = &PlanStep>| {
        let bar = |(start, step)| Bar { text: show_step(domain, problem, step), start, end: start + 1.0 };
        let starts = std::iter::successors(Some(0.0), |start| Some(start + 1.0));
        starts.zip(steps).map(bar).collect()
    };
    match plan {
        Plan::Sequential(plan) => one_by_one(&mut plan.steps.iter()),
        Plan::Temporal(timed) => {
            let time = |cause| cause_time(domain, problem, plan, cause).map_or(0.0, Number::to_f64);
            let bar = |(index, step)| Bar {
                text: show_timed_step(domain, problem, step),
                start: time(Cause::Start(StepIndex(index))),
                end: time(Cause::End(StepIndex(index))),
            };
            (0..).zip(&timed.steps).map(bar).collect()
        }
        Plan::Hierarchical(plan) => one_by_one(&mut plan.steps.iter().map(|step| &step.step)),
    }
}

fn changes(subject: &Subject<'_>, diff: &Diff, causes: &[Cause]) -> Changes {
    let (domain, problem) = (subject.domain, subject.problem);
    let what: Vec<String> = causes.iter().map(|&c| show_cause(domain, problem, subject.plan, c)).collect();
    let fluent = |change: &FluentChange| {
        let value = match change.after {
            None => "undefined".to_owned(),
            Some(Value::Number(number)) => number.to_string(),
            Some(Value::Object(object)) => subject.object(object),
        };
        (subject.fluent(&change.fluent), value)
    };
    Changes {
        what: what.join(", "),
        steps: causes.iter().filter_map(|cause| cause.step()).map(StepIndex::number).collect(),
        added: diff.added.iter().chain(&diff.derived).map(|atom| subject.atom(atom)).collect(),
        deleted: diff.deleted.iter().chain(&diff.no_longer_derived).map(|atom| subject.atom(atom)).collect(),
        fluents: diff.flowed.iter().chain(&diff.fluents).map(fluent).collect(),
    }
}

fn row(subject: &Subject<'_>, watched: &Watched) -> Row {
    let source = subject.text(watched.file);
    // A constraint may span several lines.
    let text = |span: Span| source.slice(span).split_whitespace().collect::<Vec<_>>().join(" ");
    let binding: String = watched
        .binding
        .iter()
        .map(|(name, object)| format!(" ?{name} = {}", subject.object(*object)))
        .collect();
    let name = match &watched.demand {
        Demand::Hard | Demand::Preference(None) => String::new(),
        Demand::Preference(Some(name)) => format!("{name}: "),
    };
    Row {
        text: format!("{name}{}{binding}", text(watched.span)),
        soft: watched.demand != Demand::Hard,
        broken: watched.broken.is_some(),
        at: watched.broken.and_then(|(_, time)| time).map(Number::to_f64),
        conditions: watched
            .conditions
            .iter()
            .map(|(span, stretches)| {
                let ends = |s: &Stretch| (s.from.to_f64(), s.until.map(Number::to_f64));
                (text(*span), stretches.iter().map(ends).collect())
            })
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::{VerdictRecord, page, section_unread};
    use crate::report::json::Word;

    #[test]
    fn nothing_is_markup_that_was_text() {
        let record = VerdictRecord::unread("<b a=\"&\">", Word::Unreadable, None);
        assert!(section_unread(&record).contains("<h1>&lt;b a=&quot;&amp;&quot;&gt;</h1>"));
    }

    #[test]
    fn a_page_asks_for_no_other_file() {
        let page = page(&[]);
        for asking in ["src=", "href=", "url(", "@import", "fetch("] {
            assert!(!page.contains(asking), "{asking}");
        }
    }
}
