//! The wheel's own time: the clock's, without the time during which the wheel stood still.
//!
//! Problem: a process that was stopped (SIGSTOP, a suspended laptop, a starved core) finds every deadline behind it,
//! although the devices had no chance to meet them. Idea: the wheel knows when it asked to be woken. If that time is
//! long past, it has stood still since its last turn, and that span counts for nothing: every deadline moves by it. A
//! *pulse* bounds the span between two turns, so that a stop is noticed before the next deadline as well. Invariant: the
//! wheel's time never runs backwards and never runs ahead of the clock.
//!
//! Deviation: a wheel that had nothing to do between its last turn and the stop gives that time back too, at most one
//! pulse of it.

use super::backoff::after;
use dsr::Time;
use std::time::Duration;

/// How late a timer may ring on a busy machine.
const LATE: Duration = Duration::from_millis(250);
/// The finest tick of a timer.
const TICK: Duration = Duration::from_millis(1);

#[derive(Debug, Default)]
pub(super) struct Clock {
    /// How long the wheel has stood still in all, in nanoseconds.
    still: u64,
    /// The last turn, on the clock.
    last: Time,
    /// When the wheel asked to be woken, on the clock.
    alarm: Option<Time>,
    /// The last time that it stood still: since this turn, until that one.
    stop: Option<(Time, Time)>,
    /// The longest span between two turns; `None` where time cannot pass without the wheel.
    pub(super) pulse: Option<Duration>,
}

impl Clock {
    /// A turn at `now`, on the clock. How long the wheel has stood still before it.
    pub(super) fn turn(&mut self, now: Time) -> Option<Duration> {
        let late = self.alarm.is_some_and(|alarm| now > after(alarm, LATE));
        let since = self.last;
        self.last = now.max(since);
        if self.alarm.is_some_and(|alarm| now >= alarm) {
            self.alarm = None;
        }
        if !late {
            return None;
        }
        let span = now.0.saturating_sub(since.0);
        self.still += span;
        self.stop = Some((since, now));
        Some(Duration::from_nanos(span))
    }

    /// A time on the clock as the wheel's own.
    pub(super) fn own(&self, clock: Time) -> Time {
        let still = match self.stop {
            // Before the last stop, or inside it: then the wheel's time stands where it stood.
            Some((since, until)) if clock < until => {
                let before = self.still - (until.0 - since.0);
                return Time(clock.min(since).0.saturating_sub(before));
            }
            _ => self.still,
        };
        Time(clock.0.saturating_sub(still))
    }

    /// When to be woken, on the clock, for the earliest of the wheel's own times; `None` if that was asked for before.
    pub(super) fn set(&mut self, own: Option<Time>) -> Option<Time> {
        let soonest = after(self.last, TICK);
        let at = Time(own?.0.saturating_add(self.still));
        let at = self.pulse.map_or(at, |pulse| at.min(after(self.last, pulse))).max(soonest);
        (self.alarm != Some(at)).then(|| *self.alarm.insert(at))
    }

    /// A time on the clock as the wheel's own, to be waited for.
    pub(super) fn horizon(&self, clock: Time) -> Time {
        Time(clock.0.saturating_sub(self.still))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: u64 = 1_000_000_000;

    fn at(seconds: u64) -> Time {
        Time(seconds * SECOND)
    }

    #[test]
    fn time_during_which_the_wheel_stood_still_does_not_count() {
        let mut clock = Clock { pulse: Some(Duration::from_secs(1)), ..Clock::default() };
        assert_eq!(clock.turn(at(1)), None);
        assert_eq!(clock.set(Some(at(8))), Some(at(2)), "the pulse comes first");
        assert_eq!(clock.turn(at(10)), Some(Duration::from_secs(9)));
        assert_eq!(clock.own(at(10)), at(1));
        assert_eq!(clock.own(at(5)), at(1), "a version that was committed meanwhile");
        assert_eq!(clock.own(Time(SECOND / 2)), Time(SECOND / 2), "one from before");
        assert_eq!(clock.turn(at(11)), None);
        assert_eq!(clock.own(at(11)), at(2));
    }

    #[test]
    fn a_timer_that_rings_a_little_late_is_no_stop() {
        let mut clock = Clock::default();
        clock.set(Some(at(5)));
        assert_eq!(clock.turn(Time(5 * SECOND + 200_000_000)), None);
    }

    #[test]
    fn nothing_is_asked_for_twice() {
        let mut clock = Clock::default();
        assert_eq!(clock.set(Some(at(5))), Some(at(5)));
        assert_eq!(clock.set(Some(at(5))), None);
        assert_eq!(clock.set(Some(at(4))), Some(at(4)));
    }
}
