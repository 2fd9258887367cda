//! `textDocument/definition`.

use super::{Question, Refusal};
use lsp_types::{Definition, DefinitionParams, DefinitionResponse};

pub(crate) fn answer(
    q: &Question<'_>,
    params: &DefinitionParams,
) -> Result<Option<DefinitionResponse>, Refusal> {
    let at = q.place(&params.text_document_position_params);
    let found = at.and_then(|at| ide::definition(q.project(), at));
    Ok(found.map(|found| {
        let places = found.targets.iter().map(|target| q.documents.location(target.name));
        DefinitionResponse::Definition(Definition::LocationList(places.collect()))
    }))
}
