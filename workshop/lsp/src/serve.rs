//! The threads around the loop: one reads, one writes, and the loop handles one event after the other.

use crate::event::Event;
use crate::frame::{Frame, Frames};
use crate::host::Host;
use crate::inbox::Inbox;
use crate::message::{self, Malformed};
use crate::outbox::Outbox;
use crate::server::{Ended, Server};
use lsp_server::{ErrorCode, Message};
use std::io::{BufReader, Read, Write};
use std::ops::ControlFlow;
use std::sync::mpsc::{SyncSender, sync_channel};
use std::thread::spawn;

/// Most events in the channel; a faster reader waits.
const UNDER_WAY: usize = 256;

/// Serves one client until it leaves.
///
/// Input and output are `'static`, since a thread that waits for input cannot be stopped: if the output
/// fails, that thread stays until the input has data or ends.
pub fn serve(input: impl Read + Send + 'static, output: impl Write + Send + 'static, host: Host) -> Ended {
    let (events, received) = sync_channel(UNDER_WAY);
    let (outbox, writer) = Outbox::over(output, events.clone());
    let reader = events.clone();
    spawn(move || read(input, &reader));
    let ended = turn(Server::new(host, outbox, events), Inbox::new(received));
    // The server and its outbox are dropped: the writer sends the remaining messages and ends.
    let _ = writer.join();
    ended
}

fn turn(mut server: Server, mut inbox: Inbox) -> Ended {
    loop {
        if inbox.is_empty() {
            server.settle();
        }
        let event = inbox.next(server.patience());
        if let ControlFlow::Break(ended) = server.handle(event) {
            return ended;
        }
    }
}

fn read(input: impl Read, events: &SyncSender<Event>) {
    let mut frames = Frames::new(BufReader::new(input));
    loop {
        let event = match frames.next() {
            Ok(Some(Frame::Body(body))) => match message::parse(&body) {
                Ok(message) => Event::Message(message),
                Err(malformed) => Event::Malformed(malformed),
            },
            Ok(Some(Frame::Broken(broken))) => Event::Malformed(Malformed {
                id: None,
                code: ErrorCode::ParseError,
                reason: broken.to_string(),
            }),
            Ok(None) | Err(_) => Event::InputEnded,
        };
        let last = matches!(&event, Event::InputEnded)
            || matches!(&event, Event::Message(Message::Notification(n)) if n.method == "exit");
        if events.send(event).is_err() || last {
            return;
        }
    }
}
