//! `textDocument/codeLens`.

use super::{Question, Refusal};
use ide::Lens;
use lsp_types::{CodeLens, CodeLensParams, Command};
use serde_json::json;

/// Plans for a problem.
pub(crate) const PLAN: &str = "pelea.plan";
/// Validates a plan.
pub(crate) const VALIDATE: &str = "pelea.validate";

pub(crate) fn answer(q: &Question<'_>, params: &CodeLensParams) -> Result<Option<Vec<CodeLens>>, Refusal> {
    let Some(source) = q.documents.id(&params.text_document.uri) else { return Ok(None) };
    if !q.options.code_lens {
        return Ok(Some(Vec::new()));
    }
    let uri = q.documents.uri(source);
    let lenses = ide::code_lenses(q.project(), source).into_iter().map(|found| {
        let (title, command) = match found.lens {
            Lens::Plan { .. } => ("Plan".to_owned(), PLAN),
            Lens::Validate { .. } => ("Validate".to_owned(), VALIDATE),
            Lens::References { count: 1 } => ("1 reference".to_owned(), ""),
            Lens::References { count } => (format!("{count} references"), ""),
        };
        // A lens without a command is only a text.
        let arguments = (!command.is_empty()).then(|| vec![json!(uri)]);
        CodeLens {
            range: q.documents.range(source, found.span),
            command: Some(Command { title, tooltip: None, command: command.to_owned(), arguments }),
            data: None,
        }
    });
    Ok(Some(lenses.collect()))
}
