//! Events as lines of text without their time, for stories that are kept and not shown at once.

use super::story::{Entry, What};
use super::terminal::Terminal;
use executive::Narration;
use hal::sim::RoomEvent;

/// Columns of the time in front of a line.
const TIME: usize = 10;

/// Writes the lines that a terminal would show.
pub(crate) struct Narrator(Terminal);

impl Default for Narrator {
    fn default() -> Self {
        Self(Terminal::new(false, None, false))
    }
}

impl Narrator {
    /// An event in the room.
    pub(crate) fn room(&mut self, event: &RoomEvent) -> Vec<String> {
        self.lines(What::Room(event.clone()))
    }

    /// A decision of PELEA.
    pub(crate) fn pelea(&mut self, narration: Narration) -> Vec<String> {
        self.lines(What::Pelea(narration))
    }

    fn lines(&mut self, what: What) -> Vec<String> {
        let lines = self.0.lines(&Entry { time: 0.0, version: 0, what });
        lines.into_iter().map(|line| line.get(TIME..).unwrap_or_default().to_owned()).collect()
    }
}
