//! Code actions: fixes for findings, and refactorings of names.

mod declare;
mod insert;
mod remove;

use diagnostics::{Place, SourceId};
use pddl::{Diagnostic, DiagnosticKind, Severity, Span};
use project::{FileKind, Linted, Project, Reading};

use crate::{Edits, TextEdit};

use declare::{declare, of_one};
use insert::{before_line, into_section};
use remove::remove;

/// The kind of an action.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ActionKind {
    /// It removes a finding.
    Fix,
    /// It preserves the meaning.
    Refactor,
}

/// A change that an editor can offer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CodeAction {
    /// Its title, in the imperative.
    pub title: String,
    /// Its kind.
    pub kind: ActionKind,
    /// The finding's code and place if it is a fix.
    pub fixes: Option<(&'static str, Span)>,
    /// Whether it is the preferred one of several.
    pub preferred: bool,
    /// The edits.
    pub edits: Edits,
}

/// The actions for `range`: the nearest name for a misspelt one, a declaration for an undeclared name, a
/// missing requirement, and the fixes of lints that have run.
pub fn code_actions(project: &Project, source: SourceId, range: Span) -> Vec<CodeAction> {
    let touches = |span: Span| span.start <= range.end && range.start <= span.end;
    let mut actions = Vec::new();
    let diagnostics = project.reading(source).map_or(&[][..], Reading::diagnostics);
    let needs_domain = project.kind(source) == FileKind::Problem && project.domain_of(source).is_none();
    // A domain of another name beside the problem is used with a warning.
    let misnamed = diagnostics.iter().any(|d| d.code() == "W0223");
    if needs_domain || misnamed {
        let is_read = !needs_domain && diagnostics.iter().all(|d| d.severity != Severity::Error);
        let code = if is_read { "W0223" } else { "E0212" };
        let offered = other_domain(project, source, code);
        actions.extend(offered.filter(|action| action.fixes.is_some_and(|(_, s)| touches(s))));
    }
    // Without a domain every name is unknown; the names are not the mistake.
    for diagnostic in diagnostics.iter().filter(|d| touches(d.span) && !needs_domain) {
        of_diagnostic(project, source, diagnostic, &mut actions);
    }
    for linted in project.cached_lint_findings(source).iter().filter(|l| touches(l.finding.place.span)) {
        of_lint(project, source, linted, &mut actions);
    }
    actions
}

fn of_lint(project: &Project, source: SourceId, linted: &Linted, actions: &mut Vec<CodeAction>) {
    let (code, span) = (linted.finding.code, linted.finding.place.span);
    let mended = match &linted.fix {
        Some(fix) => Some((fix.title.clone(), of_places(&fix.edits))),
        None => remove(project, source, linted).map(|edit| {
            let name = project.source(source).slice(span);
            (format!("remove `{name}`"), of_one(source, edit))
        }),
    };
    if let Some((title, edits)) = mended {
        let fixes = code.map(|code| (code, span));
        actions.push(CodeAction { title, kind: ActionKind::Fix, fixes, preferred: true, edits });
    }
    let comment = format!("; allow({})", linted.lint);
    actions.push(CodeAction {
        title: format!("Allow it here: `{comment}`"),
        kind: ActionKind::Refactor,
        fixes: code.map(|code| (code, span)),
        preferred: false,
        edits: of_one(source, before_line(project.source(source), span.start, &comment)),
    });
}

fn of_diagnostic(
    project: &Project,
    source: SourceId,
    diagnostic: &Diagnostic,
    actions: &mut Vec<CodeAction>,
) {
    let span = diagnostic.span;
    let mut fix = |title: String, preferred: bool, edits: Edits| {
        let fixes = Some((diagnostic.code(), span));
        actions.push(CodeAction { title, kind: ActionKind::Fix, fixes, preferred, edits });
    };
    if let DiagnosticKind::Unknown { suggestion: Some(near), .. }
    | DiagnosticKind::UnknownSection { suggestion: Some(near), .. }
    | DiagnosticKind::UnknownKey { suggestion: Some(near), .. } = &diagnostic.kind
    {
        let edit = TextEdit { span, text: near.clone() };
        fix(format!("Change to `{near}`"), true, of_one(source, edit));
    }
    match &diagnostic.kind {
        DiagnosticKind::Unknown { symbol, suggestion, .. } => {
            if let Some((title, edits)) = declare(project, source, span, *symbol) {
                fix(title, suggestion.is_none(), edits);
            }
        }
        DiagnosticKind::NeedsRequirement { requirement, .. } => {
            if let Some(edit) = into_section(project.source(source), ":requirements", requirement) {
                fix(format!("Add the requirement `{requirement}`"), true, of_one(source, edit));
            }
        }
        _ => {}
    }
}

/// The nearest known domain for a problem whose domain does not exist.
fn other_domain(project: &Project, source: SourceId, code: &'static str) -> impl Iterator<Item = CodeAction> {
    let need = project.header(source).and_then(|header| header.needs.first());
    let domains = project.ids().filter(|&id| project.kind(id) == FileKind::Domain);
    let names: Vec<&str> = domains.filter_map(|id| Some(project.header(id)?.name.as_str())).collect();
    let found = need.and_then(|need| Some((need, diagnostics::nearest(&need.name, names)?)));
    found.into_iter().map(move |(need, near)| CodeAction {
        title: format!("Change to `{near}`"),
        kind: ActionKind::Fix,
        fixes: Some((code, need.span)),
        preferred: true,
        edits: of_one(source, TextEdit { span: need.span, text: near }),
    })
}

fn of_places(places: &[(Place, String)]) -> Edits {
    let mut edits = Edits::default();
    for (place, text) in places {
        let edit = TextEdit { span: place.span, text: text.clone() };
        edits.files.entry(place.source).or_default().push(edit);
    }
    edits.files.values_mut().for_each(|edits| edits.sort());
    edits
}
