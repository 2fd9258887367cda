//! Reads, judges and reports one plan.

use crate::console::{Console, Form};
use crate::render::{show, show_all};
use crate::task::{TaskFiles, read_source};
use diagnostics::SourceId;
use pddl::{Diagnostic, Plan, Severity, Source, parse_plan, print_plan};
use std::path::Path;
use validator::{
    AdviceLimits, Feature, File, Finding, Place, Repair, Subject, Trace, Unsupported, Validator, Verdict,
    VerdictRecord, Word, explain, html, show_cause, show_diff,
};

/// The outcome of a plan.
#[derive(Debug)]
pub(super) struct Outcome {
    pub(super) word: Word,
    /// Its section of the page.
    pub(super) section: Option<String>,
    /// The plan after a change that makes it valid.
    pub(super) fixed: Option<String>,
}

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
            Err(_) => self.unread(&path.display().to_string(), Word::Unreadable, None, console),
        }
    }

    /// A plan that cannot be judged.
    fn unread(&self, plan: &str, word: Word, message: Option<String>, console: &mut Console<'_>) -> Outcome {
        let record = VerdictRecord::unread(plan, word, message);
        show_verdict(&record, console);
        Outcome { word, section: self.html.then(|| html::section_unread(&record)), fixed: None }
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
            let message = parsed.diagnostics.iter().find(|d| Some(d.severity) == worst);
            return self.unread(source.name(), word, message.map(Diagnostic::message), console);
        };
        let (verdict, trace) = match self.validator {
            Ok(validator) if self.trace || self.html => {
                let (verdict, trace) = validator.trace(&plan);
                (verdict, Some(trace))
            }
            Ok(validator) => (validator.validate(&plan), None),
            Err(refusal) => ((**refusal).clone(), None),
        };
        let subject = Subject {
            domain: &task.domain,
            problem: &task.problem,
            plan: &plan,
            domain_text: task.domain_source(),
            problem_text: task.problem_source(),
            plan_text: source,
        };
        let mut record = VerdictRecord::new(&subject, &verdict);
        if let Some(trace) = trace.as_ref().filter(|_| self.trace) {
            self.show_trace(&plan, trace, console);
            self.show_decomposition(&verdict, console);
            record.add_trace(&subject, trace);
            if console.form() == Form::Json {
                record.add_happenings(&subject, trace);
            }
        }
        let repairs = self.advise(&plan, &verdict);
        record.add_advice(&subject, &repairs);
        let finding = explain(&task.domain, &task.problem, &plan, &verdict);
        if let Some(finding) = &finding
            && !reported_by_the_parser(&verdict)
        {
            show(&sources, &answer(finding, &verdict, task, file).help_if(help(&record)), console);
        }
        if let Verdict::Invalid(failure) = &verdict
            && console.form() == Form::Json
        {
            record.add_failure(&subject, failure);
        }
        show_verdict(&record, console);
        let section = self.html.then(|| match &trace {
            Some(trace) => html::section(&subject, &record, &verdict, finding.as_ref(), trace),
            None => html::section_unread(&record),
        });
        let repaired = repairs.iter().find_map(|repair| repair.applied(&plan));
        let fixed = repaired.map(|plan| print_plan(&plan, &task.domain, &task.problem));
        Outcome { word: record.word(), section, fixed }
    }

    /// Changes that make the plan valid, with `--advice`.
    fn advise(&self, plan: &Plan, verdict: &Verdict) -> Vec<Repair> {
        match (self.validator, verdict, self.advice) {
            (Ok(validator), Verdict::Invalid(failure), true) => {
                validator.advise(plan, failure, AdviceLimits::default())
            }
            _ => Vec::new(),
        }
    }

    /// The decomposition that was found, in the format of a plan file.
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

/// Shows a verdict: a line for people, a record for programs.
pub(super) fn show_verdict(record: &VerdictRecord, console: &mut Console<'_>) {
    console.result(&format!("{}: {}", record.plan(), record.line()));
    console.record(record);
}

/// The advice as the help of an error: one sentence, or a line for each.
fn help(record: &VerdictRecord) -> Option<String> {
    let texts: Vec<&str> = record.advice().collect();
    (!texts.is_empty()).then(|| texts.join("\nor "))
}

/// Whether the parser has already reported the same finding.
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
