//! `textDocument/hover`.

use super::{Question, Refusal};
use lsp_types::{Contents, Hover, HoverParams};

pub(crate) fn answer(q: &Question<'_>, params: &HoverParams) -> Result<Option<Hover>, Refusal> {
    let at = q.place(&params.text_document_position_params);
    Ok(at.and_then(|at| ide::hover(q.project(), at)).map(|hover| Hover {
        contents: Contents::MarkupContent(q.markup(hover.markdown)),
        range: Some(q.documents.range(hover.place.source, hover.place.span)),
    }))
}
