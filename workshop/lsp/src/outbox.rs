//! What goes to the client: in order, by a thread of its own, so that a client that reads slowly never stops us.
//!
//! Invariant: every request of the client is answered exactly once, since answering consumes its id; requests of
//! ours are remembered until they are answered.

use crate::event::Event;
use crate::frame::framed;
use crate::message::Malformed;
use lsp_server::{Message, Outgoing, ReqQueue, RequestId, Response};
use lsp_types::{Notification, Request, Uri};
use serde_json::{Value, json};
use std::io::Write;
use std::sync::mpsc::{Receiver, Sender, SyncSender, channel};
use std::thread::{JoinHandle, spawn};

/// Why we asked the client something.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Asked {
    /// To say later whether the edit of a command was applied.
    ApplyEdit {
        /// What the edit was for, if it has to be said that it was not.
        what: String,
        /// The document to show when it was.
        show: Uri,
    },
    /// To show progress, to watch files, to ask anew: an answer changes nothing.
    Courtesy,
}

/// The way out.
pub(crate) struct Outbox {
    bodies: Sender<Vec<u8>>,
    asked: ReqQueue<(), Asked>,
}

impl Outbox {
    /// A thread that writes to `output`; it ends when the outbox is dropped, or the output fails.
    pub(crate) fn over(
        output: impl Write + Send + 'static,
        events: SyncSender<Event>,
    ) -> (Self, JoinHandle<()>) {
        let (bodies, queue) = channel();
        let writer = spawn(move || {
            if write_all(output, &queue).is_err() {
                // The loop may have ended already, and then nobody needs to know.
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
        // If the writer is gone, `Event::OutputBroken` is on its way and ends the loop.
        let _ = self.bodies.send(body);
    }

    /// Answers a request.
    pub(crate) fn respond(&self, response: Response) {
        self.send(response.into());
    }

    /// Answers what was no message.
    pub(crate) fn refuse(&self, malformed: &Malformed) {
        let error = json!({"code": malformed.code as i32, "message": malformed.reason});
        let id = serde_json::to_value(&malformed.id).unwrap_or(Value::Null);
        let body = json!({"jsonrpc": "2.0", "id": id, "error": error});
        self.send_body(body.to_string().into_bytes());
    }

    /// Tells the client something.
    pub(crate) fn notify<N: Notification>(&self, params: N::Params) {
        self.send(lsp_server::Notification::new(N::METHOD.to_string(), params).into());
    }

    /// Asks the client something.
    pub(crate) fn ask<R: Request>(&mut self, params: R::Params, why: Asked) {
        let request = self.outgoing().register(R::METHOD.to_string(), params, why);
        self.send(request.into());
    }

    /// Why we asked what is answered now; nothing if we did not.
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
