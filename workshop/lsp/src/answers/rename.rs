//! `textDocument/prepareRename` and `textDocument/rename`.

use super::{Question, Refusal, edits};
use ide::RenameError;
use lsp_types::{
    PrepareRenameParams, PrepareRenamePlaceholder, PrepareRenameResult, RenameParams, WorkspaceEdit,
};

pub(crate) fn prepare(
    q: &Question<'_>,
    params: &PrepareRenameParams,
) -> Result<Option<PrepareRenameResult>, Refusal> {
    let Some(at) = q.place(&params.text_document_position_params) else { return Ok(None) };
    match ide::prepare_rename(q.project(), at) {
        Ok(found) => Ok(Some(PrepareRenameResult::PrepareRenamePlaceholder(PrepareRenamePlaceholder {
            range: q.documents.range(found.place.source, found.place.span),
            placeholder: found.name,
        }))),
        Err(RenameError::NoName) => Ok(None),
        Err(error) => Err(refusal(q, &error)),
    }
}

pub(crate) fn answer(q: &Question<'_>, params: &RenameParams) -> Result<Option<WorkspaceEdit>, Refusal> {
    let Some(at) = q.place(&params.text_document_position_params) else { return Ok(None) };
    let found = ide::rename(q.project(), at, &params.new_name).map_err(|error| refusal(q, &error))?;
    Ok(Some(edits::workspace_edit(q.documents, q.client, &found)))
}

/// The reason, with a place if it has one.
fn refusal(q: &Question<'_>, error: &RenameError) -> Refusal {
    let place = match error {
        RenameError::Clash { place, .. } | RenameError::Broken { place, .. } => Some(*place),
        _ => None,
    };
    Refusal(match place {
        Some(place) => format!("{error} ({})", q.project().sources().place(place)),
        None => error.to_string(),
    })
}
