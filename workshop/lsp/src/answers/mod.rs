//! One file for each question: reads the client's parameters, calls `ide`, and writes the protocol's answer.
//! Answers change no state.

pub(crate) mod actions;
pub(crate) mod capabilities;
pub(crate) mod completion;
pub(crate) mod definition;
pub(crate) mod diagnostics;
pub(crate) mod edits;
pub(crate) mod folding;
pub(crate) mod formatting;
pub(crate) mod highlights;
pub(crate) mod hover;
pub(crate) mod lenses;
pub(crate) mod references;
pub(crate) mod rename;
pub(crate) mod selection;
pub(crate) mod signature;
pub(crate) mod symbols;
pub(crate) mod tokens;

use crate::client::Client;
use crate::documents::Documents;
use crate::options::Options;
use ::diagnostics::SourceId;
use ide::Position;
use lsp_types::{Documentation, MarkupContent, MarkupKind, TextDocumentPositionParams};
use project::Project;

/// The state that an answer may read.
pub(crate) struct Question<'a> {
    pub(crate) documents: &'a Documents,
    pub(crate) client: &'a Client,
    pub(crate) options: &'a Options,
    /// All findings in a document.
    pub(crate) diagnostics: &'a dyn Fn(SourceId) -> Vec<lsp_types::Diagnostic>,
}

/// The reason for a missing answer, as a sentence for the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Refusal(pub(crate) String);

impl<'a> Question<'a> {
    pub(crate) fn project(&self) -> &'a Project {
        self.documents.project()
    }

    /// The position in the client's question; `None` for an unknown document.
    pub(crate) fn place(&self, at: &TextDocumentPositionParams) -> Option<Position> {
        let source = self.documents.id(&at.text_document.uri)?;
        Some(Position { source, offset: self.documents.offset(source, at.position) })
    }

    /// Markdown, or plain text for a client without Markdown.
    pub(crate) fn markup(&self, markdown: String) -> MarkupContent {
        let kind = if self.client.markdown { MarkupKind::Markdown } else { MarkupKind::PlainText };
        MarkupContent { kind, value: markdown }
    }

    pub(crate) fn documentation(&self, markdown: Option<String>) -> Option<Documentation> {
        markdown.map(|markdown| Documentation::MarkupContent(self.markup(markdown)))
    }
}
