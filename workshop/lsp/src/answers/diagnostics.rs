//! Findings in the protocol's form; `textDocument/diagnostic` for clients that pull.

use super::{Question, Refusal};
use crate::client::Client;
use crate::documents::Documents;
use crate::host::Remark;
use crate::job::About;
use diagnostics::{Finding, Place};
use lsp_types::{
    Code, Diagnostic, DiagnosticRelatedInformation, DiagnosticSeverity, DocumentDiagnosticParams,
    DocumentDiagnosticReport, FullDocumentDiagnosticReport, Message, RelatedFullDocumentDiagnosticReport,
};
use pddl::Severity;

const SOURCE: &str = "pelea";

pub(crate) fn answer(
    q: &Question<'_>,
    params: &DocumentDiagnosticParams,
) -> Result<DocumentDiagnosticReport, Refusal> {
    let items = q.documents.id(&params.text_document.uri).map(q.diagnostics).unwrap_or_default();
    Ok(DocumentDiagnosticReport::RelatedFullDocumentDiagnosticReport(RelatedFullDocumentDiagnosticReport {
        related_documents: None,
        full_document_diagnostic_report: FullDocumentDiagnosticReport { result_id: None, items },
    }))
}

/// A finding of the parser or of a lint.
pub(crate) fn of_finding(documents: &Documents, client: &Client, finding: &Finding) -> Diagnostic {
    let related = finding.related.iter().map(|(place, text)| (*place, text.clone())).collect();
    let mut message = finding.message.clone();
    if let Some(help) = &finding.help {
        message.push('\n');
        message.push_str(help);
    }
    let mut diagnostic = diagnostic(documents, client, finding.severity, finding.place, message, related);
    diagnostic.code = finding.code.map(|code| Code::String(code.to_owned()));
    diagnostic
}

/// A remark of the planner or the validator.
pub(crate) fn of_remark(
    documents: &Documents,
    client: &Client,
    about: &About,
    remark: &Remark,
) -> Diagnostic {
    let place = |(file, span)| Place { source: about.source(file), span };
    let related = remark.notes.iter().map(|(at, text)| (place(*at), text.clone())).collect();
    diagnostic(documents, client, remark.severity, place(remark.place), remark.sentence.clone(), related)
}

fn diagnostic(
    documents: &Documents,
    client: &Client,
    severity: Severity,
    place: Place,
    mut message: String,
    related: Vec<(Place, String)>,
) -> Diagnostic {
    let mut related_information = None;
    if client.related_places {
        let places = related.into_iter().map(|(place, message)| DiagnosticRelatedInformation {
            location: documents.location(place),
            message,
        });
        related_information = Some(places.collect());
    } else {
        for (place, text) in related {
            message.push_str(&format!("\n{text} ({})", documents.project().sources().place(place)));
        }
    }
    Diagnostic {
        range: documents.range(place.source, place.span),
        severity: Some(match severity {
            Severity::Error => DiagnosticSeverity::Error,
            Severity::Warning => DiagnosticSeverity::Warning,
            Severity::Unsupported => DiagnosticSeverity::Information,
        }),
        code: None,
        code_description: None,
        source: Some(SOURCE.to_owned()),
        message: Message::String(message),
        tags: None,
        related_information,
        data: None,
    }
}
