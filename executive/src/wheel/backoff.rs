//! Waits that double, and times a span later.

use dsr::Time;
use std::time::Duration;

/// A wait that doubles with each failure, up to a longest one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Backoff {
    first: Duration,
    longest: Duration,
}

impl Backoff {
    pub(super) const fn new(first: Duration, longest: Duration) -> Self {
        Self { first, longest }
    }

    /// The wait after so many failures; none without a failure.
    pub(super) fn wait(self, failures: u32) -> Duration {
        match failures.checked_sub(1) {
            None => Duration::ZERO,
            Some(doublings) => self.first.saturating_mul(1 << doublings.min(20)).min(self.longest),
        }
    }
}

/// A time later than `time`, or the last one that a `Time` can name.
pub(super) fn after(time: Time, wait: Duration) -> Time {
    Time(time.0.saturating_add(u64::try_from(wait.as_nanos()).unwrap_or(u64::MAX)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wait_doubles_up_to_the_longest() {
        let backoff = Backoff::new(Duration::from_secs(2), Duration::from_secs(60));
        let waits: Vec<u64> = [0, 1, 2, 3, 4, 5, 6, 7, u32::MAX].map(|n| backoff.wait(n).as_secs()).into();
        assert_eq!(waits, [0, 2, 4, 8, 16, 32, 60, 60, 60]);
    }
}
