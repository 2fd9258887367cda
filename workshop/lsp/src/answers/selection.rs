//! `textDocument/selectionRange`.

use super::{Question, Refusal};
use ide::Position;
use lsp_types::{Range, SelectionRange, SelectionRangeParams};

pub(crate) fn answer(
    q: &Question<'_>,
    params: &SelectionRangeParams,
) -> Result<Option<Vec<SelectionRange>>, Refusal> {
    let Some(source) = q.documents.id(&params.text_document.uri) else { return Ok(None) };
    let ranges = params.positions.iter().map(|&position| {
        let at = Position { source, offset: q.documents.offset(source, position) };
        let spans = ide::selection(q.project(), at);
        let outside_in = spans.into_iter().rev().map(|span| q.documents.range(source, span));
        let chain = outside_in
            .fold(None, |parent, range| Some(SelectionRange { range, parent: parent.map(Box::new) }));
        // Each position needs an answer, even an empty one.
        chain.unwrap_or(SelectionRange { range: Range { start: position, end: position }, parent: None })
    });
    Ok(Some(ranges.collect()))
}
