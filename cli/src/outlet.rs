//! Output that never makes the robot wait for its reader.
//!
//! Problem: a terminal that is not read (a stopped pager, Ctrl-S, a full pipe) blocks whoever writes to it, and with it
//! the reflexes that stop the robot. Idea: a thread writes; the robot puts bytes in a queue. The queue is bounded: what
//! does not fit is lost for the reader, line by line, and counted. Nothing else is lost with it: what the robot did
//! stands in the graph and its journal.
//!
//! Invariant: [`Outlet::write`] takes time for a copy, whatever the reader does. Dropping an outlet waits until all that
//! is queued is written, or its reader has gone.

use std::collections::VecDeque;
use std::io::{self, Write};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

/// How many bytes wait for the reader at most.
const MOST: usize = 16 << 20;

/// The writing end.
pub(crate) struct Outlet {
    shared: Arc<Shared>,
    writer: Option<JoinHandle<()>>,
    /// Bytes of a line that is not complete.
    line: Vec<u8>,
    room: Room,
}

/// How much may wait, and what to write in the place of what did not fit.
#[derive(Clone, Copy)]
struct Room {
    most: usize,
    note: fn(usize) -> String,
}

#[derive(Default)]
struct Shared {
    queue: Mutex<Queue>,
    changed: Condvar,
}

#[derive(Default)]
struct Queue {
    lines: VecDeque<Vec<u8>>,
    bytes: usize,
    /// Lines that did not fit since the last one that did.
    lost: usize,
    closed: bool,
    /// The reader has gone: everything further is dropped.
    broken: bool,
}

impl Outlet {
    /// Writes to `out` from a thread of its own; nothing if the system gives no thread. `note` is the line that stands
    /// for so many lost ones.
    pub(crate) fn new(out: impl Write + Send + 'static, note: fn(usize) -> String) -> Self {
        Self::with_room(out, Room { most: MOST, note })
    }

    fn with_room(out: impl Write + Send + 'static, room: Room) -> Self {
        let shared = Arc::new(Shared::default());
        let its = Arc::clone(&shared);
        let writer = std::thread::Builder::new().name("output".into()).spawn(move || its.drain(out)).ok();
        if writer.is_none() {
            shared.lock().broken = true;
        }
        Self { shared, writer, line: Vec::new(), room }
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn drain(&self, mut out: impl Write) {
        loop {
            let mut queue = self.lock();
            while queue.lines.is_empty() && !queue.closed {
                queue = self.changed.wait(queue).unwrap_or_else(PoisonError::into_inner);
            }
            let lines = std::mem::take(&mut queue.lines);
            queue.bytes = 0;
            let closed = queue.closed;
            drop(queue);
            let written = lines.iter().try_for_each(|line| out.write_all(line)).and_then(|()| out.flush());
            let mut queue = self.lock();
            queue.broken |= written.is_err();
            if queue.broken || (closed && queue.lines.is_empty()) {
                return;
            }
        }
    }
}

impl Queue {
    fn push(&mut self, line: Vec<u8>, room: Room) {
        if self.broken {
            return;
        }
        if self.bytes + line.len() > room.most {
            self.lost += 1;
            return;
        }
        if self.lost > 0 {
            let lost = std::mem::take(&mut self.lost);
            let note = format!("{}\n", (room.note)(lost)).into_bytes();
            self.bytes += note.len();
            self.lines.push_back(note);
        }
        self.bytes += line.len();
        self.lines.push_back(line);
    }
}

impl Write for Outlet {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let Some(end) = bytes.iter().rposition(|&byte| byte == b'\n') else {
            self.line.extend_from_slice(bytes);
            return Ok(bytes.len());
        };
        let mut lines = std::mem::take(&mut self.line);
        lines.extend_from_slice(&bytes[..=end]);
        self.line.extend_from_slice(&bytes[end + 1..]);
        self.shared.lock().push(lines, self.room);
        self.shared.changed.notify_one();
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Drop for Outlet {
    fn drop(&mut self) {
        {
            let mut queue = self.shared.lock();
            let rest = std::mem::take(&mut self.line);
            if !rest.is_empty() {
                queue.push(rest, self.room);
            }
            queue.closed = true;
        }
        self.shared.changed.notify_one();
        if let Some(writer) = self.writer.take() {
            // A panic of the writer has lost output, and nothing else.
            let _ = writer.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::{Receiver, Sender, channel};

    /// A reader that takes nothing before it is let.
    struct Gate(Receiver<()>, Sender<Vec<u8>>);

    impl Write for Gate {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.0.recv().map_err(|_| io::ErrorKind::BrokenPipe)?;
            self.1.send(bytes.to_vec()).map_err(|_| io::ErrorKind::BrokenPipe)?;
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    fn note(lost: usize) -> String {
        format!("{lost} lost")
    }

    #[test]
    fn a_reader_that_does_not_read_stops_nobody_and_what_it_missed_is_counted() {
        let (open, gate) = channel();
        let (taken, read) = channel();
        let mut outlet = Outlet::with_room(Gate(gate, taken), Room { most: 64, note });
        // The gate is shut: each of these would block a direct writer.
        for number in 0..1_000 {
            writeln!(outlet, "line {number}").unwrap();
        }
        for _ in 0..2_000 {
            open.send(()).unwrap();
        }
        drop(outlet);
        let text = String::from_utf8(read.try_iter().flatten().collect()).unwrap();
        assert!(text.starts_with("line 0\n"), "{text}");
        assert!(text.lines().count() < 100, "{text}");
    }

    #[test]
    fn everything_is_written_in_order_if_it_is_read() {
        let (taken, read) = channel();
        let (open, gate) = channel();
        (0..10).for_each(|_| open.send(()).unwrap());
        let mut outlet = Outlet::new(Gate(gate, taken), note);
        write!(outlet, "a").unwrap();
        write!(outlet, "b\nc").unwrap();
        drop(outlet);
        assert_eq!(read.try_iter().flatten().collect::<Vec<u8>>(), b"ab\nc");
    }

    #[test]
    fn a_reader_that_has_gone_is_no_error() {
        let (_, gate) = channel();
        let (taken, _) = channel();
        let mut outlet = Outlet::new(Gate(gate, taken), note);
        for _ in 0..100 {
            writeln!(outlet, "nobody reads this").unwrap();
        }
    }
}
