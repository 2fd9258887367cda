//! A page that shows plans: a Gantt chart, the state at each step with what changed, and why a plan fails.
//!
//! The page is one file that asks for no other. What the text says is in it as HTML; the chart and the states are
//! drawn from data in the page, and only as much of them as is in view, so that plans may have many thousand steps.
//! Invariant: nothing of a file gets into the page but escaped, as HTML or as JSON without `<`.

use super::failure::Places;
use super::record::VerdictRecord;
use super::tree::tree;
use pddl::Span;
use pddl::{Plan, PlanStep};
use serde::Serialize;
use std::fmt::Write;
use validator::{
    Cause, Demand, Diff, Failure, File, Finding, FluentChange, Stretch, Trace, Value, Verdict, Watched,
    cause_time, show_cause, show_step, show_timed_step,
};

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

/// A constraint or preference: when each of its conditions holds, and where it is broken.
#[derive(Serialize)]
struct Row {
    text: String,
    soft: bool,
    broken: bool,
    at: Option<f64>,
    conditions: Vec<(String, Vec<While>)>,
}

/// From when to when a condition holds; without an end, to the end of the plan.
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

/// The part of the page about a plan that could not be judged.
pub(super) fn without_plan(record: &VerdictRecord) -> String {
    format!("<section><h1>{}</h1>{}</section>\n", escaped(record.plan()), verdict(record))
}

/// The part of the page about a plan.
pub(super) fn section(
    places: &Places<'_>,
    record: &VerdictRecord,
    outcome: &Verdict,
    finding: Option<&Finding>,
    trace: &Trace,
) -> String {
    let mut html = format!("<section data-plan><h1>{}</h1>{}", escaped(record.plan()), verdict(record));
    if let Some(finding) = finding {
        html += "<div class=\"why\"><strong>";
        html += &escaped(&finding.sentence);
        html += "</strong><ul>";
        for (_, note) in &finding.notes {
            html += &format!("<li>{}</li>", escaped(note));
        }
        html += "</ul>";
        for advice in record.advice.iter().chain(&record.other_advice) {
            html += &format!("<p>{}</p>", escaped(&advice.text));
        }
        html += "</div>";
    }
    let decomposed = match (outcome, places.plan) {
        (_, Plan::Hierarchical(plan)) => Some(plan),
        (Verdict::Valid(valid), _) => valid.decomposition.as_deref(),
        _ => None,
    };
    if let Some(plan) = decomposed {
        let failure = match outcome {
            Verdict::Invalid(failure) => Some(failure),
            _ => None,
        };
        html += &tree(&places.task.domain, &places.task.problem, plan, failure);
    }
    let fails = match outcome {
        Verdict::Invalid(failure) => failing_step(failure),
        _ => None,
    };
    let mut watched_heading = "";
    let data = Data {
        steps: bars(places),
        fails,
        why: finding.map(|finding| finding.sentence.as_str()),
        initial: changes(places, &trace.initial, &[]),
        happenings: trace.happenings.iter().map(|h| changes(places, &h.diff, &h.causes)).collect(),
        watched: trace.watched.iter().map(|watched| row(places, watched)).collect(),
    };
    if !trace.watched.is_empty() {
        watched_heading =
            "<h2>Constraints and preferences: when their conditions hold</h2><div class=\"watched\"></div>";
    }
    html += "<h2>Plan</h2><div class=\"gantt\"></div>";
    html += watched_heading;
    html += "<div class=\"both\"><div><h2>Steps</h2>\
             <div class=\"happenings\"></div></div><div><h2>State after the chosen step</h2>\
             <div class=\"state\"></div></div></div><script type=\"application/json\">";
    html += &serde_json::to_string(&data).unwrap_or_default().replace('<', "\\u003c");
    html += "</script></section>\n";
    html
}

/// The whole page.
pub(super) fn page(sections: &[String]) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Plans</title>\n\
         <meta name=\"viewport\" content=\"width=device-width\"><style>\n{STYLE}</style></head><body>\n{}\
         <script>\n{SCRIPT}</script></body></html>\n",
        sections.concat()
    )
}

fn verdict(record: &VerdictRecord) -> String {
    let mut html = format!("<p class=\"{}\">{}</p>", record.word(), escaped(&record.line()));
    for (name, value) in record.figures() {
        write!(html, "<div>{name}: <strong>{}</strong></div>", escaped(&value)).expect("a string takes all");
    }
    html
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
    step.map(validator::StepIndex::number)
}

fn bars(places: &Places<'_>) -> Vec<Bar> {
    let (domain, problem, plan) = (&places.task.domain, &places.task.problem, places.plan);
    let one_by_one = |steps: &mut dyn Iterator<Item = &PlanStep>| {
        let bar = |(start, step)| Bar { text: show_step(domain, problem, step), start, end: start + 1.0 };
        let starts = std::iter::successors(Some(0.0), |start| Some(start + 1.0));
        starts.zip(steps).map(bar).collect()
    };
    match plan {
        Plan::Sequential(plan) => one_by_one(&mut plan.steps.iter()),
        Plan::Temporal(timed) => {
            let time =
                |cause| cause_time(domain, problem, plan, cause).map_or(0.0, validator::Number::to_f64);
            let bar = |(index, step)| Bar {
                text: show_timed_step(domain, problem, step),
                start: time(Cause::Start(validator::StepIndex(index))),
                end: time(Cause::End(validator::StepIndex(index))),
            };
            (0..).zip(&timed.steps).map(bar).collect()
        }
        Plan::Hierarchical(plan) => one_by_one(&mut plan.steps.iter().map(|step| &step.step)),
    }
}

fn changes(places: &Places<'_>, diff: &Diff, causes: &[Cause]) -> Changes {
    let (domain, problem) = (&places.task.domain, &places.task.problem);
    let what: Vec<String> = causes.iter().map(|&c| show_cause(domain, problem, places.plan, c)).collect();
    let fluent = |change: &FluentChange| {
        let value = match change.after {
            None => "undefined".to_owned(),
            Some(Value::Number(number)) => number.to_string(),
            Some(Value::Object(object)) => places.object(object),
        };
        (places.fluent(&change.fluent), value)
    };
    Changes {
        what: what.join(", "),
        steps: causes.iter().filter_map(|cause| cause.step()).map(validator::StepIndex::number).collect(),
        added: diff.added.iter().chain(&diff.derived).map(|atom| places.atom(atom)).collect(),
        deleted: diff.deleted.iter().chain(&diff.no_longer_derived).map(|atom| places.atom(atom)).collect(),
        fluents: diff.flowed.iter().chain(&diff.fluents).map(fluent).collect(),
    }
}

fn row(places: &Places<'_>, watched: &Watched) -> Row {
    let source = match watched.file {
        File::Domain => places.task.domain_source(),
        File::Problem | File::Plan => places.task.problem_source(),
    };
    // A constraint may stand on several lines.
    let text = |span: Span| source.slice(span).split_whitespace().collect::<Vec<_>>().join(" ");
    let binding: String = watched
        .binding
        .iter()
        .map(|(name, object)| format!(" ?{name} = {}", places.object(*object)))
        .collect();
    let name = match &watched.demand {
        Demand::Hard | Demand::Preference(None) => String::new(),
        Demand::Preference(Some(name)) => format!("{name}: "),
    };
    Row {
        text: format!("{name}{}{binding}", text(watched.span)),
        soft: watched.demand != Demand::Hard,
        broken: watched.broken.is_some(),
        at: watched.broken.and_then(|(_, time)| time).map(validator::Number::to_f64),
        conditions: watched
            .conditions
            .iter()
            .map(|(span, stretches)| {
                let ends = |s: &Stretch| (s.from.to_f64(), s.until.map(validator::Number::to_f64));
                (text(*span), stretches.iter().map(ends).collect())
            })
            .collect(),
    }
}

pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::{escaped, page};

    #[test]
    fn nothing_is_markup_that_was_text() {
        assert_eq!(escaped("<b a=\"&\">"), "&lt;b a=&quot;&amp;&quot;&gt;");
    }

    #[test]
    fn a_page_asks_for_no_other_file() {
        let page = page(&[]);
        for asking in ["src=", "href=", "url(", "@import", "fetch("] {
            assert!(!page.contains(asking), "{asking}");
        }
    }
}
