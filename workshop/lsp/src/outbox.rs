//! Sends messages to the client, in order, on a thread of its own, so that a slow client never blocks the
//! loop.
//!
//! Invariant: every request of the client is answered exactly once, since answering consumes its id.
//! Requests of the server are remembered until the client answers.

use crate::event::Event;
use crate::frame::framed;
use crate::message::Malformed;
use lsp_server::{Message, Outgoing, ReqQueue, RequestId, Response};
use lsp_types::{Notification, Request, Uri};
use serde_json::{Value, json};
use std::io::Write;
use std::sync::mpsc::{Receiver, Sender, SyncSender, channel};
use std::thread::{JoinHandle, spawn};

/// The purpose of a request of the server.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Asked {
    /// To apply a command's edit, and to report if the client did not.
    ApplyEdit {
        /// The purpose of the edit, for that report.
        what: String,
        /// The document to show after the edit.
        show: Uri,
    },
    /// To show progress, watch files, or refresh: the answer changes nothing.
    Courtesy,
}

/// The queue of outgoing messages.
pub(crate) struct Outbox {
    bodies: Sender<Vec<u8>>,
    asked: ReqQueue<(), Asked>,
}

impl Outbox {
    /// Starts the thread that writes to `output`; it ends when the outbox is dropped or the output fails.
    pub(crate) fn over(
        output: impl Write + Send + 'static,
        events: SyncSender<Event>,
    ) -> (Self, JoinHandle<()>) {
        let (bodies, queue) = channel();
        let writer = spawn(move || {
            if write_all(output, &queue).is_err() {
                // The loop may have ended already; then the event is not needed.
                let _ = events.send(Event::OutputBroken);
            }
        });
        (Self { bodies, asked: ReqQueue::default() }, writer)
    }

    fn send(&self, message: Message) {
        #[derive(serde::Serialize)]
        struct Versioned {
            jsonrpc: &'static str,
            #[serde(flatten)]
            message: Message,
        }
        let message = Versioned { jsonrpc: "2.0", message };
        self.send_body(serde_json::to_vec(&message).expect("messages are made of strings and values"));
    }

    fn send_body(&self, body: Vec<u8>) {
        // If the writer has ended, `Event::OutputBroken` is in the queue and ends the loop.
        let _ = self.bodies.send(body);
    }

    /// Answers a request.
    pub(crate) fn respond(&self, response: Response) {
        self.send(response.into());
    }

    /// Answers a malformed message.
    pub(crate) fn refuse(&self, malformed: &Malformed) {
        let error = json!({"code": malformed.code as i32, "message": malformed.reason});
        let id = serde_json::to_value(&malformed.id).unwrap_or(Value::Null);
        let body = json!({"jsonrpc": "2.0", "id": id, "error": error});
        self.send_body(body.to_string().into_bytes());
    }

    /// Sends a notification.
    pub(crate) fn notify<N: Notification>(&self, params: N::Params) {
        self.send(lsp_server::Notification::new(N::METHOD.to_string(), params).into());
    }

    /// Sends a request.
    pub(crate) fn ask<R: Request>(&mut self, params: R::Params, why: Asked) {
        let request = self.outgoing().register(R::METHOD.to_string(), params, why);
        self.send(request.into());
    }

    /// The purpose of the request with that id; `None` for an unknown id.
    pub(crate) fn answered(&mut self, id: RequestId) -> Option<Asked> {
        self.outgoing().complete(id)
    }

    fn outgoing(&mut self) -> &mut Outgoing<Asked> {
        &mut self.asked.outgoing
    }
}

fn write_all(mut output: impl Write, bodies: &Receiver<Vec<u8>>) -> std::io::Result<()> {
    for body in bodies {
        output.write_all(&framed(&body))?;
        output.flush()?;
    }
    Ok(())
}
