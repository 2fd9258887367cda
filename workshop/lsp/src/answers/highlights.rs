//! `textDocument/documentHighlight`.

use super::{Question, Refusal};
use lsp_types::{DocumentHighlight, DocumentHighlightKind, DocumentHighlightParams};
use pddl::Role;

pub(crate) fn answer(
    q: &Question<'_>,
    params: &DocumentHighlightParams,
) -> Result<Option<Vec<DocumentHighlight>>, Refusal> {
    let at = q.place(&params.text_document_position_params);
    let found = at.map(|at| ide::highlights(q.project(), at)).unwrap_or_default();
    let highlights = found.iter().map(|found| DocumentHighlight {
        range: q.documents.range(found.place.source, found.place.span),
        kind: Some(match found.role {
            Role::Declaration => DocumentHighlightKind::Write,
            _ => DocumentHighlightKind::Read,
        }),
    });
    Ok(Some(highlights.collect()))
}
