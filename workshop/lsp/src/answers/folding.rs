//! `textDocument/foldingRange`.

use super::{Question, Refusal};
use ide::FoldKind;
use lsp_types::{FoldingRange, FoldingRangeKind, FoldingRangeParams};

pub(crate) fn answer(
    q: &Question<'_>,
    params: &FoldingRangeParams,
) -> Result<Option<Vec<FoldingRange>>, Refusal> {
    let Some(source) = q.documents.id(&params.text_document.uri) else { return Ok(None) };
    let characters = !q.client.folds_lines_only;
    let folds = ide::folding(q.project(), source).into_iter().filter_map(|fold| {
        let range = q.documents.range(source, fold.span);
        (range.end.line > range.start.line).then(|| FoldingRange {
            start_line: range.start.line,
            start_character: characters.then_some(range.start.character),
            end_line: range.end.line,
            end_character: characters.then_some(range.end.character),
            kind: match fold.kind {
                FoldKind::Comment => Some(FoldingRangeKind::Comment),
                FoldKind::List => None,
            },
            collapsed_text: None,
        })
    });
    Ok(Some(folds.collect()))
}
