//! `textDocument/codeAction`.

use super::{Question, Refusal, edits};
use diagnostics::SourceId;
use ide::{ActionKind, CodeAction as Offer};
use lsp_types::{Code, CodeAction, CodeActionKind, CodeActionParams, CodeActionResponse};

pub(crate) fn answer(
    q: &Question<'_>,
    params: &CodeActionParams,
) -> Result<Option<Vec<CodeActionResponse>>, Refusal> {
    let Some(source) = q.documents.id(&params.text_document.uri) else { return Ok(None) };
    // A client without code action literals would need commands that apply edits; all maintained clients
    // have literals.
    if !q.client.action_literals {
        return Ok(None);
    }
    let offers = ide::code_actions(q.project(), source, q.documents.span(source, params.range));
    let actions = offers.into_iter().filter_map(|offer| action(q, source, params, offer));
    Ok(Some(actions.map(CodeActionResponse::CodeAction).collect()))
}

/// An action in the protocol's form; `None` if the client asked for other kinds.
fn action(q: &Question<'_>, source: SourceId, params: &CodeActionParams, offer: Offer) -> Option<CodeAction> {
    let kind = match offer.kind {
        ActionKind::Fix => CodeActionKind::QuickFix,
        ActionKind::Refactor => CodeActionKind::RefactorRewrite,
    };
    if !params.context.only.as_ref().is_none_or(|only| only.iter().any(|wanted| is_a(&kind, wanted))) {
        return None;
    }
    let diagnostics = offer.fixes.map(|(code, at)| {
        let range = q.documents.range(source, at);
        let code = Some(Code::String(code.to_owned()));
        let given = params.context.diagnostics.iter();
        given.filter(|given| given.range == range && given.code == code).cloned().collect()
    });
    Some(CodeAction {
        title: offer.title,
        kind: Some(kind),
        diagnostics,
        is_preferred: offer.preferred.then_some(true),
        edit: Some(edits::workspace_edit(q.documents, q.client, &offer.edits)),
        ..CodeAction::default()
    })
}

/// Kinds are words separated by dots; a kind includes those that begin with it.
fn is_a(kind: &CodeActionKind, wanted: &CodeActionKind) -> bool {
    let (kind, wanted) = (kind.to_string(), wanted.to_string());
    wanted.is_empty() || kind == wanted || kind.starts_with(&format!("{wanted}."))
}
