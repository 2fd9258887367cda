//! The state of a session, and the one function that changes it.
//!
//! Problem: twenty kinds of messages, five kinds of jobs and their cancellations, in any order. Idea: each
//! of them is an [`Event`]. [`Server::handle`] takes one event after the other; slow work runs on a thread
//! of [`Jobs`] and returns as an event. Invariant: every request is answered exactly once; a job's result
//! about texts that have changed since is discarded.

mod board;
mod commands;
mod diagnosing;
mod lifecycle;
mod notifications;
mod progress;
mod requests;
mod scanning;

use crate::client::Client;
use crate::documents::Documents;
use crate::event::Event;
use crate::host::Host;
use crate::job::{Jobs, Purpose, words_of};
use crate::news::{JobId, JobNews};
use crate::options::Options;
use crate::outbox::{Asked, Outbox};
use board::Board;
use lsp_server::{ErrorCode, Message, RequestId, Response};
use lsp_types::{LogMessageNotification, LogMessageParams, MessageType};
use lsp_types::{ShowDocumentParams, ShowDocumentRequest, ShowMessageNotification, ShowMessageParams};
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::SyncSender;
use std::time::Duration;

/// How a session ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// As the protocol requires: `shutdown`, then `exit`.
    Properly,
    /// By `exit` alone, or because input or output ended.
    Abruptly,
}

/// The phase of a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    /// Before `initialize`.
    New,
    /// Between `initialize` and `shutdown`.
    Running,
    /// After `shutdown`.
    ShutDown,
}

/// A session.
pub(crate) struct Server {
    phase: Phase,
    host: Host,
    outbox: Outbox,
    jobs: Jobs,
    client: Client,
    options: Options,
    documents: Documents,
    /// The paths of the folders that the client has open.
    folders: Vec<String>,
    board: Board,
    /// The number of progress tokens that the server has made.
    tokens: u32,
}

impl Server {
    /// A session that has not begun.
    pub(crate) fn new(host: Host, outbox: Outbox, events: SyncSender<Event>) -> Self {
        Self {
            phase: Phase::New,
            host,
            outbox,
            jobs: Jobs::new(events),
            client: Client::default(),
            options: Options::default(),
            documents: Documents::default(),
            folders: Vec::new(),
            board: Board::default(),
            tokens: 0,
        }
    }

    /// Handles one event. The only function that changes the state.
    pub(crate) fn handle(&mut self, event: Event) -> ControlFlow<Ended> {
        match event {
            Event::Message(Message::Request(request)) => {
                let id = request.id.clone();
                if let Err(panic) = catch_unwind(AssertUnwindSafe(|| self.request(request))) {
                    let what = words_of(&*panic);
                    self.bug(&what);
                    let text = format!("a bug in pelea: {what}");
                    self.refuse(id, ErrorCode::InternalError, text);
                }
            }
            Event::Message(Message::Notification(notification)) => {
                if notification.method == "exit" {
                    return ControlFlow::Break(match self.phase {
                        Phase::ShutDown => Ended::Properly,
                        Phase::New | Phase::Running => Ended::Abruptly,
                    });
                }
                // A text is replaced in one step or not at all, so a panic leaves a consistent state.
                if let Err(panic) = catch_unwind(AssertUnwindSafe(|| self.notification(notification))) {
                    self.bug(&words_of(&*panic));
                }
            }
            Event::Message(Message::Response(response)) => self.answered(response),
            Event::Malformed(malformed) => {
                self.log(MessageType::Warning, &malformed.reason);
                self.outbox.refuse(&malformed);
            }
            Event::Withdrawn(id) => self.withdrawn(id),
            Event::Quiet => self.lint(),
            Event::Job(id, news) => self.news(id, news),
            Event::InputEnded | Event::OutputBroken => return ControlFlow::Break(Ended::Abruptly),
        }
        ControlFlow::Continue(())
    }

    /// Starts the work that waits for an empty queue.
    pub(crate) fn settle(&mut self) {
        if self.phase == Phase::Running {
            self.check();
        }
    }

    /// How long the queue must be empty before a quiet period begins.
    pub(crate) fn patience(&self) -> Option<Duration> {
        (self.phase == Phase::Running && self.wants_lints()).then_some(self.options.lint_delay)
    }

    /// Handles the client's answer to a request of the server.
    fn answered(&mut self, response: Response) {
        let asked = self.outbox.answered(response.id);
        if let Some(Asked::ApplyEdit { what, show }) = asked {
            let applied = response
                .response_result
                .is_ok_and(|result| result.get("applied").and_then(serde_json::Value::as_bool) == Some(true));
            if !applied {
                self.show(MessageType::Warning, &format!("the editor did not apply the edit: {what}"));
            } else if self.client.shows_documents {
                let params = ShowDocumentParams {
                    uri: show,
                    external: None,
                    take_focus: Some(false),
                    selection: None,
                };
                self.outbox.ask::<ShowDocumentRequest>(params, Asked::Courtesy);
            }
        }
    }

    fn withdrawn(&mut self, id: RequestId) {
        self.refuse(id, ErrorCode::RequestCanceled, "withdrawn by the client".to_owned());
    }

    fn news(&mut self, id: JobId, news: JobNews) {
        let Some(job) = self.jobs.get(id) else { return };
        let purpose = job.purpose.clone();
        match news {
            JobNews::Progress(words) => self.report_progress(id, &words),
            JobNews::Found(files) => self.found(files),
            JobNews::Trouble(words) => self.show(MessageType::Warning, &words),
            JobNews::Checked(source) => self.checked(&purpose, source),
            JobNews::Linted(source, said) => self.linted(&purpose, source, said),
            JobNews::Planned(planned) => self.planned(id, planned),
            JobNews::Judged(judged) => self.judged(id, judged),
            JobNews::Panicked(what) => self.bug(&what),
            JobNews::Ended => self.job_ended(id),
        }
    }

    fn job_ended(&mut self, id: JobId) {
        self.end_progress(id);
        let Some(job) = self.jobs.end(id) else { return };
        if let Some(request) = job.answers {
            // The job ended without a result: it was cancelled, or it panicked.
            let (code, text) = if job.cancel.is_cancelled() {
                (ErrorCode::RequestCanceled, "withdrawn by the client")
            } else {
                (ErrorCode::InternalError, "a bug in pelea: the log says more")
            };
            self.refuse(request, code, text.to_owned());
        }
        if job.purpose == Purpose::Scan {
            self.changed();
        }
    }

    fn respond(&self, id: RequestId, result: impl serde::Serialize) {
        self.outbox.respond(Response::new_ok(id, result));
    }

    fn refuse(&self, id: RequestId, code: ErrorCode, message: String) {
        self.outbox.respond(Response::new_err(id, code as i32, message));
    }

    /// Writes to the editor's log.
    fn log(&self, kind: MessageType, message: &str) {
        tracing::debug!(message);
        self.outbox.notify::<LogMessageNotification>(LogMessageParams { kind, message: message.to_owned() });
    }

    /// Shows a message to the user.
    fn show(&self, kind: MessageType, message: &str) {
        self.outbox
            .notify::<ShowMessageNotification>(ShowMessageParams { kind, message: message.to_owned() });
    }

    fn bug(&self, what: &str) {
        tracing::error!(what, "caught a panic");
        self.log(MessageType::Error, &format!("a bug in pelea: {what}"));
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.jobs.cancel_all();
    }
}
