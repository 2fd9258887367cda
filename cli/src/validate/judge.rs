//! One plan: read, judged, and what there is to say about it.

use super::advice::AdviceRecord;
use super::failure::Places;
use super::network::DecompositionRecord;
use super::record::{VerdictRecord, Word, happenings};
use super::{Outcome, page};
use crate::console::{Console, Form};
use crate::render::{show, show_all};
use crate::task::{TaskFiles, read_source};
use diagnostics::SourceId;
use pddl::{Plan, Severity, Source, parse_plan, print_plan};
use std::path::Path;
use validator::{
    Budget, Feature, File, Finding, Place, Repair, Trace, Unsupported, Validator, Verdict, explain,
    show_cause, show_diff,
};

/// A task that judges plans.
#[derive(Clone, Copy)]
pub(super) struct Judge<'a> {
    pub(super) task: &'a TaskFiles,
    pub(super) validator: &'a Result<Validator<'a>, Box<Verdict>>,
    pub(super) trace: bool,
    pub(super) advice: bool,
    pub(super) html: bool,
}

impl Judge<'_> {
    /// Judges the plan in a file.
    pub(super) fn plan(&self, path: &Path, console: &mut Console<'_>) -> Outcome {
        match read_source(path, console) {
            Ok(source) => self.source(source, console),
            Err(_) => {
                let record = VerdictRecord::of(&path.display().to_string(), Word::Unreadable);
                record.say(console);
                Outcome {
                    word: Word::Unreadable,
                    section: self.html.then(|| page::without_plan(&record)),
                    fixed: None,
                }
            }
        }
    }

    fn source(&self, source: Source, console: &mut Console<'_>) -> Outcome {
        let task = self.task;
        let mut sources = task.sources.clone();
        let file = sources.push(source);
        let source = &sources[file];
        let parsed = parse_plan(source, &task.domain, &task.problem);
        let findings: Vec<_> = parsed.diagnostics.iter().map(|d| d.finding(file)).collect();
        let worst = show_all(&sources, &findings, console);
        let Some(plan) = parsed.model else {
            let unsupported = worst == Some(Severity::Unsupported);
            let word = if unsupported { Word::Unsupported } else { Word::Unreadable };
            let mut record = VerdictRecord::of(source.name(), word);
            record.message =
                parsed.diagnostics.iter().find(|d| Some(d.severity) == worst).map(pddl::Diagnostic::message);
            record.say(console);
            return Outcome { word, section: self.html.then(|| page::without_plan(&record)), fixed: None };
        };
        let (verdict, trace) = match self.validator {
            Ok(validator) if self.trace || self.html => {
                let (verdict, trace) = validator.trace(&plan);
                (verdict, Some(trace))
            }
            Ok(validator) => (validator.validate(&plan), None),
            Err(refusal) => ((**refusal).clone(), None),
        };
        let word = Word::of(&verdict);
        let mut record = VerdictRecord::of(source.name(), word);
        if let Verdict::Valid(valid) = &verdict {
            record.fill(valid, &task.problem);
            let found = valid.decomposition.as_deref();
            record.decomposition =
                found.map(|found| DecompositionRecord::of(&task.domain, &task.problem, found));
        }
        let places = Places { task, plan: &plan, source };
        if let Some(trace) = trace.as_ref().filter(|_| self.trace) {
            self.show_trace(&plan, trace, console);
            self.show_decomposition(&verdict, console);
            let diffs = trace.happenings.iter().map(|h| show_diff(&task.domain, &task.problem, &h.diff));
            record.trace = Some(diffs.collect());
            record.happenings = (console.form() == Form::Json).then(|| happenings(&places, trace));
        }
        let repairs = self.advise(&plan, &verdict);
        let mut advice: Vec<AdviceRecord> =
            repairs.iter().map(|repair| AdviceRecord::of(task, &plan, repair)).collect();
        let help = help(&advice);
        if !advice.is_empty() {
            record.advice = Some(advice.remove(0));
            record.other_advice = advice;
        }
        let finding = explain(&task.domain, &task.problem, &plan, &verdict);
        if let Some(finding) = &finding {
            if !reported_by_the_parser(&verdict) {
                show(&sources, &answer(finding, &verdict, task, file).help_if(help), console);
            }
            record.message = Some(finding.sentence.clone());
        }
        if let Verdict::Invalid(failure) = &verdict {
            record.failure = (console.form() == Form::Json).then(|| places.failure(failure));
        }
        record.say(console);
        let section = self.html.then(|| match &trace {
            Some(trace) => page::section(&places, &record, &verdict, finding.as_ref(), trace),
            None => page::without_plan(&record),
        });
        let repaired = repairs.iter().find_map(|repair| repair.applied(&plan));
        let fixed = repaired.map(|plan| print_plan(&plan, &task.domain, &task.problem));
        Outcome { word, section, fixed }
    }

    /// Changes that were tried and help, if that is asked for.
    fn advise(&self, plan: &Plan, verdict: &Verdict) -> Vec<Repair> {
        match (self.validator, verdict, self.advice) {
            (Ok(validator), Verdict::Invalid(failure), true) => {
                validator.advise(plan, failure, Budget::default())
            }
            _ => Vec::new(),
        }
    }

    /// A decomposition that was found, as a plan file has it.
    fn show_decomposition(&self, verdict: &Verdict, console: &mut Console<'_>) {
        if let Verdict::Valid(valid) = verdict
            && let Some(found) = &valid.decomposition
            && console.form() != Form::Json
        {
            let plan = Plan::Hierarchical((**found).clone());
            console.note(print_plan(&plan, &self.task.domain, &self.task.problem).trim_end());
        }
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

/// The advice as the help of an error: one sentence, or a line for each.
fn help(advice: &[AdviceRecord]) -> Option<String> {
    let texts: Vec<&str> = advice.iter().map(|advice| advice.text.as_str()).collect();
    (!texts.is_empty()).then(|| texts.join("\nor "))
}

/// Whether reading the files has said the same already.
fn reported_by_the_parser(verdict: &Verdict) -> bool {
    matches!(
        verdict,
        Verdict::Unsupported(Unsupported { feature: Feature::InDomain(_) | Feature::InProblem(_), .. })
    )
}

/// A finding about a verdict, at its places.
pub(crate) fn answer(
    finding: &Finding,
    verdict: &Verdict,
    task: &TaskFiles,
    plan: SourceId,
) -> diagnostics::Finding {
    let at = |place: Place| diagnostics::Place {
        source: match place.file {
            File::Domain => task.domain_file,
            File::Problem => task.problem_file,
            File::Plan => plan,
        },
        span: place.span,
    };
    let mut answer = diagnostics::Finding::answer(at(finding.place), finding.sentence.clone());
    if matches!(verdict, Verdict::Unsupported(_)) {
        answer.severity = Severity::Unsupported;
    }
    answer.related = finding.notes.iter().map(|(place, text)| (at(*place), text.clone())).collect();
    answer
}
