//! Edits in the protocol's form, with versions where the client can check them.

use crate::client::Client;
use crate::documents::Documents;
use crate::uri::uri_of;
use diagnostics::SourceId;
use ide::Edits;
use lsp_types::{
    CreateFile, CreateFileOptions, DocumentChange, Edit, OptionalVersionedTextDocumentIdentifier, Position,
    Range, TextDocumentEdit, TextDocumentIdentifier, TextEdit, Uri, WorkspaceEdit,
};

/// Changes of several documents.
pub(crate) fn workspace_edit(documents: &Documents, client: &Client, edits: &Edits) -> WorkspaceEdit {
    let by_document = edits.files.iter().map(|(&source, edits)| {
        (source, edits.iter().map(|edit| documents.edit(source, edit)).collect::<Vec<_>>())
    });
    let mut result = WorkspaceEdit::default();
    if client.versioned_edits {
        let changes = by_document.map(|(source, edits)| {
            DocumentChange::TextDocumentEdit(of_document(
                documents.uri(source),
                version(documents, source),
                edits,
            ))
        });
        result.document_changes = Some(changes.collect());
    } else {
        result.changes = Some(by_document.map(|(source, edits)| (documents.uri(source), edits)).collect());
    }
    result
}

/// A new text for the document at `path`, which need not exist.
pub(crate) fn replacing(documents: &Documents, client: &Client, path: &str, text: &str) -> WorkspaceEdit {
    let known = documents.project().id(path);
    let uri = uri_of_path(documents, path);
    let nothing = Range { start: Position::default(), end: Position::default() };
    let range = known.map_or(nothing, |source| documents.whole(source));
    let edit = TextEdit { range, new_text: text.to_owned() };
    if !client.versioned_edits {
        return WorkspaceEdit { changes: Some([(uri, vec![edit])].into()), ..WorkspaceEdit::default() };
    }
    let mut changes = Vec::new();
    if known.is_none() && client.creates_files {
        let options = CreateFileOptions { overwrite: None, ignore_if_exists: Some(true) };
        changes.push(DocumentChange::CreateFile(CreateFile {
            uri: uri.clone(),
            options: Some(options),
            annotation_id: None,
        }));
    }
    let version = known.and_then(|source| version(documents, source));
    changes.push(DocumentChange::TextDocumentEdit(of_document(uri, version, vec![edit])));
    WorkspaceEdit { document_changes: Some(changes), ..WorkspaceEdit::default() }
}

/// The client's URI of the document at `path`.
pub(crate) fn uri_of_path(documents: &Documents, path: &str) -> Uri {
    documents.project().id(path).map_or_else(|| Uri(uri_of(path)), |source| documents.uri(source))
}

fn version(documents: &Documents, source: SourceId) -> Option<i32> {
    documents.open(source).map(|open| open.version)
}

fn of_document(uri: Uri, version: Option<i32>, edits: Vec<TextEdit>) -> TextDocumentEdit {
    let text_document = OptionalVersionedTextDocumentIdentifier {
        version,
        text_document_identifier: TextDocumentIdentifier { uri },
    };
    TextDocumentEdit { text_document, edits: edits.into_iter().map(Edit::TextEdit).collect() }
}
