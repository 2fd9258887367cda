//! Progress of jobs, for clients that can show it.

use super::Server;
use crate::news::JobId;
use crate::outbox::Asked;
use lsp_types::{
    ProgressNotification, ProgressParams, ProgressToken, WorkDoneProgressCreateParams,
    WorkDoneProgressCreateRequest,
};
use serde_json::{Value, json};

impl Server {
    /// Begins to show progress: under the client's token, if it gave one, or else under a token of the
    /// server.
    pub(crate) fn begin_progress(
        &mut self,
        title: &str,
        given: Option<ProgressToken>,
    ) -> Option<ProgressToken> {
        let ours = given.is_none();
        let token = match given {
            Some(token) => token,
            None if self.client.shows_progress => {
                self.tokens += 1;
                let token = ProgressToken::String(format!("pelea-{}", self.tokens));
                let params = WorkDoneProgressCreateParams { token: token.clone() };
                self.outbox.ask::<WorkDoneProgressCreateRequest>(params, Asked::Courtesy);
                token
            }
            None => return None,
        };
        // `window/workDoneProgress/cancel` can stop only progress with the server's own token.
        let begin = json!({"kind": "begin", "title": title, "cancellable": ours});
        self.progress(token.clone(), begin);
        Some(token)
    }

    pub(crate) fn report_progress(&mut self, id: JobId, words: &str) {
        if let Some(token) = self.jobs.get(id).and_then(|job| job.token.clone()) {
            self.progress(token, json!({"kind": "report", "message": words}));
        }
    }

    pub(crate) fn end_progress(&mut self, id: JobId) {
        if let Some(token) = self.jobs.get(id).and_then(|job| job.token.take()) {
            self.progress(token, json!({"kind": "end"}));
        }
    }

    /// Handles the user's cancellation of a token.
    pub(crate) fn stop_by_token(&mut self, token: &ProgressToken) {
        for job in self.jobs.iter().filter(|job| job.token.as_ref() == Some(token)) {
            job.cancel.cancel();
        }
    }

    fn progress(&self, token: ProgressToken, value: Value) {
        self.outbox.notify::<ProgressNotification>(ProgressParams { token, value });
    }
}
