//! `textDocument/references`.

use super::{Question, Refusal};
use ide::Declarations;
use lsp_types::{Location, ReferenceParams};

pub(crate) fn answer(q: &Question<'_>, params: &ReferenceParams) -> Result<Option<Vec<Location>>, Refusal> {
    let declarations = match params.context.include_declaration {
        true => Declarations::Included,
        false => Declarations::Excluded,
    };
    let at = q.place(&params.text_document_position_params);
    let found = at.and_then(|at| ide::references(q.project(), at, declarations));
    Ok(found.map(|found| found.iter().map(|reference| q.documents.location(reference.place)).collect()))
}
