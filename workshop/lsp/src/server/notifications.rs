//! Handles the client's notifications. They have no answer, so a malformed one is logged.

use super::{Phase, Server};
use crate::documents::Refused;
use crate::inbox::cancelled_id;
use diagnostics::SourceId;
use lsp_server::Notification;
use lsp_types::{
    DidChangeTextDocumentParams, DidCloseTextDocumentParams, DidOpenTextDocumentParams, MessageType,
    WorkDoneProgressCancelParams,
};
use serde_json::Value;

impl Server {
    pub(crate) fn notification(&mut self, notification: Notification) {
        let Notification { method, params } = notification;
        if self.phase != Phase::Running {
            return;
        }
        let understood = match method.as_str() {
            "initialized" => {
                self.initialized();
                Ok(())
            }
            "$/cancelRequest" => {
                self.cancel(&params);
                Ok(())
            }
            "textDocument/didOpen" => serde_json::from_value(params).map(|params| self.did_open(params)),
            "textDocument/didChange" => serde_json::from_value(params).map(|params| self.did_change(params)),
            "textDocument/didClose" => serde_json::from_value(params).map(|params| self.did_close(&params)),
            "workspace/didChangeWatchedFiles" => {
                serde_json::from_value(params).map(|params| self.files_changed(params))
            }
            "workspace/didChangeWorkspaceFolders" => {
                serde_json::from_value(params).map(|params| self.folders_changed(&params))
            }
            "workspace/didChangeConfiguration" => {
                self.configuration_changed(&params);
                Ok(())
            }
            "window/workDoneProgress/cancel" => serde_json::from_value(params)
                .map(|params: WorkDoneProgressCancelParams| self.stop_by_token(&params.token)),
            // Methods that begin with `$/` may be ignored, and so may notifications that the server did not
            // register for.
            _ => Ok(()),
        };
        if let Err(reason) = understood {
            self.log(MessageType::Warning, &format!("{method} cannot be read: {reason}"));
        }
    }

    fn did_open(&mut self, params: DidOpenTextDocumentParams) {
        let document = params.text_document;
        let uri = document.uri.0;
        let taken = self.documents.open_text(&uri, document.version, document.text);
        self.taken(&uri, taken);
    }

    fn did_change(&mut self, params: DidChangeTextDocumentParams) {
        let uri = params.text_document.text_document_identifier.uri.0;
        let taken = self.documents.change(&uri, params.text_document.version, params.content_changes);
        if let Ok((source, replaced)) = &taken
            && let Some(warnings) = self.board.lints.get_mut(source)
        {
            replaced.iter().for_each(|change| warnings.shift(*source, change));
        }
        self.taken(&uri, taken.map(|(source, _)| source));
    }

    fn taken(&mut self, uri: &str, taken: Result<SourceId, Refused>) {
        match taken {
            Ok(source) => {
                self.board.latest = Some(source);
                self.changed();
            }
            Err(refused) => self.log(MessageType::Error, &format!("{uri}: {refused}")),
        }
    }

    fn did_close(&mut self, params: &DidCloseTextDocumentParams) {
        // Must come before the document loses the URI under which the client opened it.
        if let Some(source) = self.documents.id(&params.text_document.uri) {
            self.withdraw(source);
        }
        if self.documents.close(params.text_document.uri.as_ref()).is_some() {
            self.changed();
        }
    }

    fn configuration_changed(&mut self, params: &Value) {
        // Clients that expect a `workspace/configuration` request send null; others send all settings, or
        // our section only.
        let settings = params.get("settings").unwrap_or(&Value::Null);
        self.set_options(settings.get("pelea").unwrap_or(settings));
        self.changed();
    }

    /// Cancels a request that has left the queue.
    fn cancel(&mut self, params: &Value) {
        let id = cancelled_id(params);
        for job in self.jobs.iter().filter(|job| id.is_some() && job.answers == id) {
            job.cancel.cancel();
        }
    }
}
