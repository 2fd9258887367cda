//! The only place that reads the clock.

use std::fmt;
use std::time::{Duration, Instant};

/// A point in time after which work stops.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Deadline(Option<Instant>);

impl Deadline {
    /// The deadline in `seconds` from now; without a limit, or beyond the range of the clock, it never comes.
    pub(crate) fn after(seconds: Option<Seconds>) -> Self {
        Self(seconds.and_then(|s| Instant::now().checked_add(s.0)))
    }

    pub(crate) fn is_over(&self) -> bool {
        self.0.is_some_and(|end| Instant::now() >= end)
    }
}

/// A span of time as written on the command line: `30`, `0.5`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seconds(Duration);

impl Seconds {
    pub(crate) fn duration(self) -> Duration {
        self.0
    }
}

impl From<Duration> for Seconds {
    fn from(time: Duration) -> Self {
        Self(time)
    }
}

impl std::str::FromStr for Seconds {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let seconds: f64 = text.parse().map_err(|_| "not a number of seconds".to_owned())?;
        Duration::try_from_secs_f64(seconds).map(Self).map_err(|error| error.to_string())
    }
}

impl fmt::Display for Seconds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} s", self.0.as_secs_f64())
    }
}

/// Measures one piece of work.
pub(crate) struct Stopwatch(Instant);

impl Stopwatch {
    pub(crate) fn start() -> Self {
        Self(Instant::now())
    }

    /// Milliseconds since the start.
    pub(crate) fn milliseconds(&self) -> f64 {
        (self.0.elapsed().as_secs_f64() * 1e6).round() / 1e3
    }
}

/// Seconds, rounded to milliseconds: precise enough for people, and short in JSON.
pub(crate) fn seconds(time: Duration) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "2^53 ms are longer than any mission")]
    let millis = time.as_millis() as f64;
    millis / 1000.0
}
