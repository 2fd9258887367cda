//! Counted work.
//!
//! Problem: an operation must end soon after its caller cancels, whatever loop it is in, and asking the caller in
//! each round of a loop is too slow. Idea: each loop [spends](Meter::spend) units of work; the meter asks when an
//! interval is used up. Invariant: a meter that has refused once refuses always, so a helper may stop early and
//! leave the error to its caller.

use crate::limits::{Budget, Interrupted};
use std::sync::atomic::{AtomicU8, AtomicU64, Ordering::Relaxed};

/// Units of work between two questions to the caller. With units of about a nanosecond, well under a millisecond.
pub const INTERVAL: usize = 1 << 16;

/// Items of a plain loop that [`Meter::chunks`] hands out at a time.
const CHUNK: usize = 1 << 12;

/// The work of one operation. Only one thread at a time spends; other threads may read.
#[derive(Debug, Default)]
pub struct Meter<'a> {
    budget: Budget<'a>,
    work: AtomicU64,
    /// The meter looks at its budget when `work` reaches this: always, once it has refused.
    next_look: AtomicU64,
    /// Nothing, or the reason for which it refuses, by its place in [`REASONS`].
    refuses: AtomicU8,
}

const REASONS: [Option<Interrupted>; 4] =
    [None, Some(Interrupted::Cancelled), Some(Interrupted::Work), Some(Interrupted::Memory)];

impl<'a> Meter<'a> {
    /// Nothing is spent yet.
    pub fn new(budget: Budget<'a>) -> Self {
        Self { budget, ..Self::default() }
    }

    /// A meter that limits work alone.
    pub fn of_work(units: u64) -> Self {
        Self::new(Budget { work: Some(units), ..Budget::default() })
    }

    /// What it compares with.
    pub fn budget(&self) -> Budget<'a> {
        self.budget
    }

    /// Adds units of work.
    ///
    /// # Errors
    /// The caller cancelled, or the budget has less work left than this.
    #[inline]
    pub fn spend(&self, units: usize) -> Result<(), Interrupted> {
        let work = self.work.load(Relaxed).saturating_add(units as u64);
        self.work.store(work, Relaxed);
        if work < self.next_look.load(Relaxed) { Ok(()) } else { self.look(work) }
    }

    /// Reports how many bytes the operation holds.
    ///
    /// # Errors
    /// The budget allows fewer, or the meter refused before.
    #[inline]
    pub fn hold(&self, bytes: usize) -> Result<(), Interrupted> {
        match self.budget.memory_bytes {
            Some(most) if bytes > most => self.refuse(Interrupted::Memory),
            _ => self.interruption().map_or(Ok(()), Err),
        }
    }

    /// Hands out the items in chunks, and spends the units of each item beforehand.
    pub fn chunks<'s, T>(
        &'s self,
        items: &'s [T],
        units: usize,
    ) -> impl Iterator<Item = Result<&'s [T], Interrupted>> + 's {
        items.chunks(CHUNK).map(move |chunk| self.spend(chunk.len() * units).map(|()| chunk))
    }

    /// Units spent so far.
    #[inline]
    pub fn work(&self) -> u64 {
        self.work.load(Relaxed)
    }

    /// Units that may still be spent.
    pub fn left(&self) -> u64 {
        self.budget.work.map_or(u64::MAX, |most| most.saturating_sub(self.work()))
    }

    /// Why it refuses.
    #[inline]
    pub fn interruption(&self) -> Option<Interrupted> {
        REASONS[usize::from(self.refuses.load(Relaxed))]
    }

    /// Compares with the budget, asks the caller, and decides when to look next.
    #[cold]
    fn look(&self, work: u64) -> Result<(), Interrupted> {
        if let Some(reason) = self.interruption() {
            return Err(reason);
        }
        let most = self.budget.work.unwrap_or(u64::MAX);
        if work > most {
            return self.refuse(Interrupted::Work);
        }
        if (self.budget.interrupted)() {
            return self.refuse(Interrupted::Cancelled);
        }
        let next = work.saturating_add(INTERVAL as u64).min(most.saturating_add(1));
        self.next_look.store(next, Relaxed);
        Ok(())
    }

    #[cold]
    fn refuse(&self, reason: Interrupted) -> Result<(), Interrupted> {
        // The first reason stays.
        let reason = self.interruption().unwrap_or(reason);
        let place = REASONS.iter().position(|&r| r == Some(reason)).expect("each reason is listed");
        self.refuses.store(u8::try_from(place).expect("there are four"), Relaxed);
        self.next_look.store(0, Relaxed);
        Err(reason)
    }
}

impl Clone for Meter<'_> {
    /// A meter that has spent as much, and from here on counts apart.
    fn clone(&self) -> Self {
        Self {
            budget: self.budget,
            work: AtomicU64::new(self.work()),
            next_look: AtomicU64::new(self.next_look.load(Relaxed)),
            refuses: AtomicU8::new(self.refuses.load(Relaxed)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{INTERVAL, Meter};
    use crate::{Budget, Cancellation, Interrupted};
    use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

    #[test]
    fn a_meter_that_refused_once_refuses_always() {
        let cancellation = Cancellation::default();
        let interrupted = || cancellation.is_cancelled();
        let meter = Meter::new(Budget { interrupted: &interrupted, ..Budget::default() });
        assert_eq!(meter.spend(1), Ok(()));
        cancellation.cancel();
        assert_eq!(meter.spend(INTERVAL - 1), Ok(()));
        assert_eq!(meter.spend(1), Err(Interrupted::Cancelled));
        assert_eq!(meter.spend(0), Err(Interrupted::Cancelled));
        assert_eq!(meter.hold(0), Err(Interrupted::Cancelled));
        assert_eq!(meter.clone().spend(0), Err(Interrupted::Cancelled));
    }

    #[test]
    fn a_limit_of_work_is_exact() {
        for most in [0, 1, 5, INTERVAL as u64, 3 * INTERVAL as u64] {
            let meter = Meter::of_work(most);
            let spent = (0..).take_while(|_| meter.spend(1).is_ok()).count();
            assert_eq!(spent as u64, most);
            assert_eq!((meter.left(), meter.interruption()), (0, Some(Interrupted::Work)));
        }
        assert_eq!(Meter::of_work(5).spend(usize::MAX), Err(Interrupted::Work));
        assert_eq!(Meter::default().spend(usize::MAX), Ok(()));
    }

    #[test]
    fn the_first_reason_stays() {
        let meter = Meter::new(Budget { work: Some(3), memory_bytes: Some(10), ..Budget::default() });
        assert_eq!(meter.hold(10), Ok(()));
        assert_eq!(meter.hold(11), Err(Interrupted::Memory));
        assert_eq!(meter.spend(9), Err(Interrupted::Memory));
    }

    #[test]
    fn the_caller_is_asked_at_first_and_once_per_interval() {
        let asked = AtomicUsize::new(0);
        let interrupted = || asked.fetch_add(1, Relaxed) > 99;
        let meter = Meter::new(Budget { interrupted: &interrupted, ..Budget::default() });
        for _ in 0..10 * INTERVAL {
            meter.spend(1).expect("a hundred questions are not reached");
        }
        assert_eq!(asked.load(Relaxed), 10);
    }

    #[test]
    fn chunks_hand_out_each_item_once() {
        let items: Vec<u32> = (0..10_000).collect();
        let meter = Meter::default();
        let seen: Vec<u32> =
            meter.chunks(&items, 2).flat_map(|chunk| chunk.expect("no limit").to_vec()).collect();
        assert_eq!(seen, items);
        assert_eq!(meter.work(), 20_000);
    }
}
