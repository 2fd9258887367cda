//! How far a campaign is, as one line on standard error that is written over.
//!
//! `indicatif` would bring a second library for terminals into the program for this line.

use crate::clock::Stopwatch;
use std::io::{self, IsTerminal, Write};

/// Columns of the bar.
const BAR: usize = 24;
/// Milliseconds between two updates.
const EVERY: f64 = 200.0;

/// The line; nothing if standard error is no terminal.
pub(super) struct Progress {
    shown: bool,
    total: usize,
    clock: Stopwatch,
    last: f64,
}

impl Progress {
    pub(super) fn new(total: usize) -> Self {
        Self { shown: io::stderr().is_terminal(), total, clock: Stopwatch::start(), last: 0.0 }
    }

    /// So many runs are done, so many of them not good.
    pub(super) fn update(&mut self, done: usize, bad: usize) {
        let now = self.clock.milliseconds();
        if self.shown && (now - self.last >= EVERY || done == self.total) {
            self.last = now;
            let line = line(done, self.total, bad, now / 1e3);
            // A terminal that has gone away is no reason to stop.
            let _ = write!(io::stderr(), "\r{line}\x1b[K");
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if self.shown {
            let _ = write!(io::stderr(), "\r\x1b[K");
        }
    }
}

fn line(done: usize, total: usize, bad: usize, seconds: f64) -> String {
    let full = (done * BAR).checked_div(total).unwrap_or(BAR).min(BAR);
    #[expect(clippy::cast_precision_loss, reason = "an estimate for people")]
    let (rate, left) = {
        let rate = done as f64 / seconds.max(1e-3);
        (rate, (total - done.min(total)) as f64 / rate.max(1e-3))
    };
    let bar = format!("{}{}", "█".repeat(full), "░".repeat(BAR - full));
    let trouble = if bad > 0 { format!(", {bad} not good") } else { String::new() };
    format!("{bar} {done}/{total} runs{trouble} · {rate:.0}/s · {left:.0} s left")
}

#[cfg(test)]
mod tests {
    use super::line;

    #[test]
    fn a_line_counts() {
        assert_eq!(line(5, 10, 0, 1.0), "████████████░░░░░░░░░░░░ 5/10 runs · 5/s · 1 s left");
        assert_eq!(line(10, 10, 2, 1.0), "████████████████████████ 10/10 runs, 2 not good · 10/s · 0 s left");
    }
}
