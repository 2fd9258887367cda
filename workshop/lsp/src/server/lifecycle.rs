//! Beginning and end: `initialize`, `initialized`, `shutdown`.

use super::{Phase, Server};
use crate::answers::capabilities;
use crate::client::Client;
use crate::outbox::Asked;
use crate::uri;
use lsp_server::{ErrorCode, RequestId};
use lsp_types::{MessageType, Registration, RegistrationParams, RegistrationRequest};
use serde_json::{Value, json};

impl Server {
    pub(crate) fn initialize(&mut self, id: RequestId, params: &Value) {
        if self.phase != Phase::New {
            let text = "the session has begun already".to_owned();
            return self.refuse(id, ErrorCode::InvalidRequest, text);
        }
        self.phase = Phase::Running;
        self.client = Client::of(params);
        self.documents.encoding = self.client.encoding;
        self.set_options(params.get("initializationOptions").unwrap_or(&Value::Null));
        self.folders = Client::folders(params).iter().map(|uri| uri::path(uri)).collect();
        self.respond(id, capabilities::all(&self.client, &self.options));
    }

    /// Applies the valid options, and reports the others.
    pub(crate) fn set_options(&mut self, given: &Value) {
        let (options, complaints) = self.options.clone().with(given);
        self.options = options;
        for complaint in complaints {
            self.show(MessageType::Warning, &format!("pelea: {complaint}"));
        }
    }

    pub(crate) fn initialized(&mut self) {
        if self.client.watches {
            let watchers: Vec<Value> =
                capabilities::WATCHED.iter().map(|glob| json!({"globPattern": glob})).collect();
            let registration = Registration {
                id: "files".to_owned(),
                method: "workspace/didChangeWatchedFiles".to_owned(),
                register_options: Some(json!({"watchers": watchers})),
            };
            let params = RegistrationParams { registrations: vec![registration] };
            self.outbox.ask::<RegistrationRequest>(params, Asked::Courtesy);
        }
        self.scan(self.folders.clone());
    }

    pub(crate) fn shutdown(&mut self, id: RequestId) {
        self.phase = Phase::ShutDown;
        self.jobs.cancel_all();
        self.respond(id, ());
    }
}
