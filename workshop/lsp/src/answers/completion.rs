//! `textDocument/completion`.

use super::{Question, Refusal};
use diagnostics::SourceId;
use ide::{Completion, CompletionKind};
use lsp_types::{
    CompletionItem, CompletionItemKind, CompletionItemTextEdit, CompletionParams, CompletionResponse,
    InsertTextFormat, TextEdit,
};
use pddl::NameKind;

pub(crate) fn answer(
    q: &Question<'_>,
    params: &CompletionParams,
) -> Result<Option<CompletionResponse>, Refusal> {
    let Some(at) = q.place(&params.text_document_position_params) else { return Ok(None) };
    let found = ide::completions(q.project(), at);
    let items = found.into_iter().map(|completion| item(q, at.source, completion));
    Ok(Some(CompletionResponse::CompletionItemList(items.collect())))
}

fn item(q: &Question<'_>, source: SourceId, completion: Completion) -> CompletionItem {
    let Completion { label, kind, detail, documentation, span, text, snippet, rank } = completion;
    let (new_text, format) = match snippet.filter(|_| q.client.snippets) {
        Some(snippet) => (snippet, InsertTextFormat::Snippet),
        None => (text, InsertTextFormat::PlainText),
    };
    CompletionItem {
        kind: Some(kind_of(kind)),
        detail,
        documentation: q.documentation(documentation),
        // Clients sort by text.
        sort_text: Some(format!("{rank:08}{label}")),
        filter_text: Some(
            q.documents
                .text(source)
                .get(span.range())
                .map_or_else(|| label.clone(), |word| filter(word, &label)),
        ),
        insert_text_format: Some(format),
        text_edit: Some(CompletionItemTextEdit::TextEdit(TextEdit {
            range: q.documents.range(source, span),
            new_text,
        })),
        label,
        ..CompletionItem::default()
    }
}

/// The text that the client matches with the word so far. It includes an opening parenthesis or a question
/// mark that is written already, since a client drops candidates without it.
fn filter(word: &str, label: &str) -> String {
    let mark: String = word.chars().take_while(|c| !c.is_alphanumeric()).collect();
    if label.starts_with(&mark) { label.to_owned() } else { format!("{mark}{label}") }
}

fn kind_of(kind: CompletionKind) -> CompletionItemKind {
    match kind {
        CompletionKind::Keyword => CompletionItemKind::Keyword,
        CompletionKind::Snippet => CompletionItemKind::Snippet,
        CompletionKind::Name(name) => match name {
            NameKind::Domain | NameKind::Problem => CompletionItemKind::Module,
            NameKind::Requirement => CompletionItemKind::Keyword,
            NameKind::Type => CompletionItemKind::Class,
            NameKind::Predicate => CompletionItemKind::Interface,
            NameKind::Function => CompletionItemKind::Function,
            NameKind::Object => CompletionItemKind::Constant,
            NameKind::Variable => CompletionItemKind::Variable,
            NameKind::Action | NameKind::Task | NameKind::Method => CompletionItemKind::Method,
            NameKind::Process | NameKind::Event => CompletionItemKind::Event,
            NameKind::Subtask
            | NameKind::Preference
            | NameKind::Invariant
            | NameKind::Skill
            | NameKind::Agent => CompletionItemKind::Reference,
        },
    }
}
