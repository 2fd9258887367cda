//! `textDocument/formatting` and `textDocument/rangeFormatting`. The client's indent width is ignored: files
//! look as `pelea fmt` lays them out.

use super::{Question, Refusal};
use diagnostics::SourceId;
use lsp_types::{DocumentFormattingParams, DocumentRangeFormattingParams, TextEdit};

pub(crate) fn whole(
    q: &Question<'_>,
    params: &DocumentFormattingParams,
) -> Result<Option<Vec<TextEdit>>, Refusal> {
    let Some(source) = q.documents.id(&params.text_document.uri) else { return Ok(None) };
    edits(q, source, ide::format(q.project(), source))
}

pub(crate) fn range(
    q: &Question<'_>,
    params: &DocumentRangeFormattingParams,
) -> Result<Option<Vec<TextEdit>>, Refusal> {
    let Some(source) = q.documents.id(&params.text_document.uri) else { return Ok(None) };
    let span = q.documents.span(source, params.range);
    edits(q, source, ide::format_range(q.project(), source, span))
}

fn edits(
    q: &Question<'_>,
    source: SourceId,
    found: Option<Vec<ide::TextEdit>>,
) -> Result<Option<Vec<TextEdit>>, Refusal> {
    let found = found.ok_or_else(|| Refusal("its parentheses do not match".to_owned()))?;
    Ok(Some(found.iter().map(|edit| q.documents.edit(source, edit)).collect()))
}
