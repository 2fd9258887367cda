//! `textDocument/signatureHelp`.

use super::{Question, Refusal};
use lsp_types::{
    ActiveParameter, ParameterInformation, ParameterInformationLabel, SignatureHelp, SignatureHelpParams,
    SignatureInformation,
};

pub(crate) fn answer(
    q: &Question<'_>,
    params: &SignatureHelpParams,
) -> Result<Option<SignatureHelp>, Refusal> {
    let at = q.place(&params.text_document_position_params);
    let Some(found) = at.and_then(|at| ide::signature_help(q.project(), at)) else { return Ok(None) };
    // Ranges in a label are counted in the same units as positions in a line.
    let encoding = q.documents.encoding;
    let units = |bytes: usize| found.label.get(..bytes).map_or(0, |before| encoding.length(before));
    let parameters = found.parameters.iter().map(|range| ParameterInformation {
        label: ParameterInformationLabel::Tuple((units(range.start), units(range.end))),
        documentation: None,
    });
    // A number beyond the last parameter selects none.
    let active = found.active.unwrap_or(found.parameters.len());
    let active = u32::try_from(active).unwrap_or(u32::MAX);
    let signature = SignatureInformation {
        parameters: Some(parameters.collect()),
        documentation: q.documentation(found.documentation.clone()),
        active_parameter: None,
        label: found.label.clone(),
    };
    Ok(Some(SignatureHelp {
        signatures: vec![signature],
        active_signature: Some(0),
        active_parameter: Some(ActiveParameter::Int(active)),
    }))
}
