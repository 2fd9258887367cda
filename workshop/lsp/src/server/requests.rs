//! Dispatches the client's requests.

use super::{Phase, Server};
use crate::answers::Refusal;
use crate::answers::{self, Question};
use lsp_server::{ErrorCode, Request, RequestId};
use lsp_types::{
    CodeActionRequest, CodeLensRequest, CompletionRequest, DefinitionRequest, DocumentDiagnosticRequest,
    DocumentFormattingRequest, DocumentHighlightRequest, DocumentRangeFormattingRequest,
    DocumentSymbolRequest, FoldingRangeRequest, HoverRequest, PrepareRenameRequest, ReferencesRequest,
    RenameRequest, SelectionRangeRequest, SemanticTokensRangeRequest, SemanticTokensRequest,
    SignatureHelpRequest, WorkspaceSymbolRequest,
};

impl Server {
    pub(crate) fn request(&mut self, request: Request) {
        let Request { id, method, params } = request;
        match (method.as_str(), self.phase) {
            ("initialize", _) => return self.initialize(id, &params),
            (_, Phase::New) => {
                let text = "the session has not begun".to_owned();
                return self.refuse(id, ErrorCode::ServerNotInitialized, text);
            }
            (_, Phase::ShutDown) => {
                let text = "the session is over".to_owned();
                return self.refuse(id, ErrorCode::InvalidRequest, text);
            }
            ("shutdown", _) => return self.shutdown(id),
            ("workspace/executeCommand", _) => return self.command(id, params),
            (_, Phase::Running) => {}
        }
        let mut table = Table { server: self, waiting: Some(Request { id, method, params }) };
        table
            .answer::<HoverRequest>(answers::hover::answer)
            .answer::<DefinitionRequest>(answers::definition::answer)
            .answer::<ReferencesRequest>(answers::references::answer)
            .answer::<DocumentHighlightRequest>(answers::highlights::answer)
            .answer::<PrepareRenameRequest>(answers::rename::prepare)
            .answer::<RenameRequest>(answers::rename::answer)
            .answer::<CompletionRequest>(answers::completion::answer)
            .answer::<SignatureHelpRequest>(answers::signature::answer)
            .answer::<DocumentSymbolRequest>(answers::symbols::of_document)
            .answer::<WorkspaceSymbolRequest>(answers::symbols::of_workspace)
            .answer::<SemanticTokensRequest>(answers::tokens::full)
            .answer::<SemanticTokensRangeRequest>(answers::tokens::range)
            .answer::<FoldingRangeRequest>(answers::folding::answer)
            .answer::<SelectionRangeRequest>(answers::selection::answer)
            .answer::<DocumentFormattingRequest>(answers::formatting::whole)
            .answer::<DocumentRangeFormattingRequest>(answers::formatting::range)
            .answer::<CodeActionRequest>(answers::actions::answer)
            .answer::<CodeLensRequest>(answers::lenses::answer)
            .answer::<DocumentDiagnosticRequest>(answers::diagnostics::answer);
        if let Some(request) = table.waiting {
            let text = format!("there is no method `{}`", request.method);
            self.refuse(request.id, ErrorCode::MethodNotFound, text);
        }
    }
}

/// A request that is compared with one method after the other.
struct Table<'a> {
    server: &'a Server,
    waiting: Option<Request>,
}

impl Table<'_> {
    /// Answers the request if it has that method.
    fn answer<R: lsp_types::Request>(
        &mut self,
        answer: fn(&Question<'_>, &R::Params) -> Result<R::Result, Refusal>,
    ) -> &mut Self {
        if self.waiting.as_ref().is_none_or(|request| request.method != R::METHOD.as_str()) {
            return self;
        }
        if let Some(request) = self.waiting.take() {
            let server = self.server;
            let question = Question {
                documents: &server.documents,
                client: &server.client,
                options: &server.options,
                diagnostics: &|source| server.diagnostics(source),
            };
            match serde_json::from_value(request.params) {
                Ok(params) => self.server.reply(request.id, answer(&question, &params)),
                Err(reason) => {
                    let text = format!("the parameters cannot be read: {reason}");
                    self.server.refuse(request.id, ErrorCode::InvalidParams, text);
                }
            }
        }
        self
    }
}

impl Server {
    fn reply(&self, id: RequestId, answer: Result<impl serde::Serialize, Refusal>) {
        match answer {
            Ok(result) => self.respond(id, result),
            Err(Refusal(text)) => self.refuse(id, ErrorCode::RequestFailed, text),
        }
    }
}
