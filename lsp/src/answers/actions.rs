//! `textDocument/codeAction`: what `ide` offers, and what lints do.

use super::{Question, Refusal, edits};
use ide::{ActionKind, CodeAction as Offer, Edits, TextEdit};
use lsp_types::{Code, CodeAction, CodeActionKind, CodeActionParams, CodeActionResponse};
use pddl::Span;
use project::{Linted, SourceId};

pub(crate) fn answer(
    q: &Question<'_>,
    params: &CodeActionParams,
) -> Result<Option<Vec<CodeActionResponse>>, Refusal> {
    let Some(source) = q.documents.id(&params.text_document.uri) else { return Ok(None) };
    // A client that takes commands only would need one to apply edits; all that are alive take actions.
    if !q.client.action_literals {
        return Ok(None);
    }
    let span = q.documents.span(source, params.range);
    let mut offers = ide::code_actions(q.project(), source, span);
    for linted in (q.warnings)(source).iter().filter(|linted| touch(linted.finding.place.span, span)) {
        offers.extend(mended(linted));
        offers.push(allowed(q, source, linted));
    }
    let actions = offers.into_iter().filter_map(|offer| action(q, source, params, offer));
    Ok(Some(actions.map(CodeActionResponse::CodeAction).collect()))
}

fn touch(one: Span, other: Span) -> bool {
    one.start <= other.end && other.start <= one.end
}

/// What a lint offers to mend.
fn mended(linted: &Linted) -> Option<Offer> {
    let fix = linted.fix.as_ref()?;
    let mut edits = Edits::default();
    for (place, text) in &fix.edits {
        let edit = TextEdit { span: place.span, text: text.clone() };
        edits.files.entry(place.source).or_default().push(edit);
    }
    edits.files.values_mut().for_each(|edits| edits.sort());
    Some(Offer { title: fix.title.clone(), preferred: true, ..offer(linted, edits) })
}

/// The comment that silences a lint, on a line of its own before the one that it speaks of.
fn allowed(q: &Question<'_>, source: SourceId, linted: &Linted) -> Offer {
    let text = q.documents.text(source);
    let at = linted.finding.place.span.start as usize;
    let before = text.get(..at).unwrap_or_default();
    let line = before.rfind('\n').map_or(0, |end| end + 1);
    let indent: String = text[line..].chars().take_while(|c| matches!(c, ' ' | '\t')).collect();
    let start = u32::try_from(line).unwrap_or(u32::MAX);
    let edit =
        TextEdit { span: Span::new(start, start), text: format!("{indent}; allow({})\n", linted.lint) };
    let mut edits = Edits::default();
    edits.files.insert(source, vec![edit]);
    offer(linted, edits)
}

fn offer(linted: &Linted, edits: Edits) -> Offer {
    Offer {
        title: format!("allow `{}` here", linted.lint),
        kind: ActionKind::Fix,
        fixes: Some((linted.finding.code, linted.finding.place.span)),
        preferred: false,
        edits,
    }
}

/// An offer as the client wants it; nothing if it asked for other kinds.
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

/// Kinds are words between dots; a kind is all those that it begins with.
fn is_a(kind: &CodeActionKind, wanted: &CodeActionKind) -> bool {
    let (kind, wanted) = (kind.to_string(), wanted.to_string());
    wanted.is_empty() || kind == wanted || kind.starts_with(&format!("{wanted}."))
}
