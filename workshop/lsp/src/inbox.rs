//! The queue before the loop: first in, first out, except that a cancellation overtakes the request that it
//! cancels.
//!
//! Problem: while the server answers a slow request, the client may send twenty more and cancel nineteen of
//! them. Idea: take in all events that have arrived before the next one is handled. A `$/cancelRequest` then
//! finds its request still in the queue and turns it into [`Event::Withdrawn`]. Invariant: at most
//! [`WAITING`] events wait here; more stay in the channel, whose reader then waits, and so does the client.
//! `lsp_server::ReqQueue` matches ids of requests that were taken; it does not see those that still wait.

use crate::event::Event;
use lsp_server::{Message, RequestId};
use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::Duration;

/// Most events that are searched for cancelled requests.
const WAITING: usize = 4096;

/// The queue.
pub(crate) struct Inbox {
    events: Receiver<Event>,
    waiting: VecDeque<Event>,
}

impl Inbox {
    pub(crate) fn new(events: Receiver<Event>) -> Self {
        Self { events, waiting: VecDeque::new() }
    }

    /// The next event; [`Event::Quiet`] if none comes for `patience`.
    pub(crate) fn next(&mut self, patience: Option<Duration>) -> Event {
        while self.waiting.len() < WAITING
            && let Ok(event) = self.events.try_recv()
        {
            self.take_in(event);
        }
        if let Some(event) = self.waiting.pop_front() {
            return event;
        }
        let received = match patience {
            Some(patience) => self.events.recv_timeout(patience),
            None => self.events.recv().map_err(|_| RecvTimeoutError::Disconnected),
        };
        match received {
            Ok(event) => event,
            Err(RecvTimeoutError::Timeout) => Event::Quiet,
            Err(RecvTimeoutError::Disconnected) => Event::InputEnded,
        }
    }

    /// Whether no event waits.
    pub(crate) fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    fn take_in(&mut self, event: Event) {
        if let Some(id) = withdrawn(&event)
            && let Some(found) = self.waiting.iter_mut().find(|event| is_request(event, &id))
        {
            *found = Event::Withdrawn(id);
            return;
        }
        self.waiting.push_back(event);
    }
}

/// The id in a `$/cancelRequest`.
fn withdrawn(event: &Event) -> Option<RequestId> {
    match event {
        Event::Message(Message::Notification(n)) if n.method == "$/cancelRequest" => cancelled_id(&n.params),
        _ => None,
    }
}

/// The id in the parameters of a `$/cancelRequest`.
pub(crate) fn cancelled_id(params: &serde_json::Value) -> Option<RequestId> {
    serde_json::from_value(params.get("id")?.clone()).ok()
}

fn is_request(event: &Event, id: &RequestId) -> bool {
    matches!(event, Event::Message(Message::Request(request)) if request.id == *id)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsp_server::{Notification, Request};
    use serde_json::json;
    use std::sync::mpsc::channel;

    #[test]
    fn a_cancellation_overtakes() {
        let (sender, receiver) = channel();
        let request = |id: i32| Event::Message(Request::new(id.into(), "m".into(), ()).into());
        let cancel =
            |id: i32| Event::Message(Notification::new("$/cancelRequest".into(), json!({"id": id})).into());
        for event in [request(1), request(2), cancel(2), cancel(9)] {
            sender.send(event).expect("the receiver is there");
        }
        let mut inbox = Inbox::new(receiver);
        assert!(is_request(&inbox.next(None), &1.into()));
        assert!(matches!(inbox.next(None), Event::Withdrawn(id) if id == 2.into()));
        assert_eq!(withdrawn(&inbox.next(None)), Some(9.into()), "it may concern a running job");
        assert!(matches!(inbox.next(Some(Duration::ZERO)), Event::Quiet));
        drop(sender);
        assert!(matches!(inbox.next(None), Event::InputEnded));
    }
}
