//! How soon a rule may begin again for a binding: the end of every loop in which no time passes.
//!
//! Problem: rules are level-triggered, so two of them can undo each other's conditions for ever: a rule takes the mouth
//! as soon as another one speaks, and then has no reason to keep it. Such a loop may run through several rules and agents,
//! and each of them sees only its own part. Idea: every rule watches its own beginnings. An attempt is *fruitless* if
//! - the skill failed, or the graph refused its effects,
//! - the rule ended by itself within an [`INSTANT`],
//! - resources were taken for it and it did not begin,
//! - or it began twice within an instant and was stopped again, or needs no time at all.
//!
//! After a fruitless attempt the rule rests for this binding: for a second, and after each further one twice as long, up
//! to [`LONGEST`]. An ending that took time forgets this, and so does a pause of its own as long as the rest was.
//!
//! Invariant: a rule begins at most twice for a binding within an instant. A rule that another one stopped may begin once
//! more at once, so that of the two it is the one that achieves nothing that rests first.
//!
//! Cost: one entry for each binding that began in this instant or had no success lately; they are looked through only when
//! one of them is due.

use std::collections::BTreeMap;
use std::time::Duration;

use dsr::Time;

use super::instance::Key;
use crate::rules::RuleId;

/// What is shorter took no time. On a real clock a loop of two agents takes some 20 µs, and no device answers sooner.
pub(super) const INSTANT: Duration = Duration::from_millis(10);

/// The first rest.
const FIRST: Duration = Duration::from_secs(1);

/// The longest rest.
const LONGEST: Duration = Duration::from_secs(30);

/// The attempts of rules that had no success lately.
#[derive(Debug, Default)]
pub(super) struct Patience {
    attempts: BTreeMap<Key, Attempts>,
    /// Before this time no rest is over and nothing can be forgotten.
    due: Option<Time>,
}

#[derive(Debug)]
struct Attempts {
    /// When the rule began last.
    began: Option<Time>,
    /// Whether it had begun in the same instant before.
    again: bool,
    fruitless: Option<Fruitless>,
}

/// The fruitless attempts in a row.
#[derive(Debug, Clone, Copy)]
struct Fruitless {
    in_a_row: u32,
    rest: Duration,
    until: Time,
    over: bool,
}

impl Attempts {
    const NONE: Self = Self { began: None, again: false, fruitless: None };

    /// When its rest is over, or else when it can be forgotten.
    fn due(&self) -> Option<Time> {
        let forgotten = |last: Fruitless| if last.over { after(last.until, last.rest) } else { last.until };
        self.fruitless.map(forgotten).or_else(|| self.began.map(|began| after(began, INSTANT)))
    }

    /// Whether an attempt that began then follows on the last one without a pause.
    fn in_a_row(&self, began: Time) -> Option<Fruitless> {
        self.fruitless.filter(|last| began <= after(last.until, last.rest))
    }
}

impl Patience {
    /// Whether the rule rests for this binding.
    pub(super) fn rests(&self, key: &Key) -> bool {
        self.attempts.get(key).and_then(|attempts| attempts.fruitless).is_some_and(|last| !last.over)
    }

    /// The rule begins. Returns whether it did so in the same instant before, or at the first moment after a rest.
    pub(super) fn begins(&mut self, key: &Key, now: Time) -> bool {
        let attempts = self.attempts.entry(key.clone()).or_insert(Attempts::NONE);
        attempts.again = attempts.began.is_some_and(|before| now <= after(before, INSTANT));
        attempts.began = Some(now);
        self.due = earlier(self.due, attempts.due());
        attempts.again || attempts.fruitless.is_some_and(|last| now <= after(last.until, INSTANT))
    }

    /// Another one stopped the rule, which had begun at `began`. Returns the rest that this costs.
    pub(super) fn stopped(&mut self, key: &Key, began: Time, now: Time) -> Option<Duration> {
        let again = self.attempts.get(key).is_some_and(|attempts| attempts.again);
        (again && now <= after(began, INSTANT)).then(|| self.fruitless(key, began, now))
    }

    /// The rule ended by itself. Returns the rest that this costs.
    pub(super) fn ended(&mut self, key: &Key, began: Time, now: Time, failed: bool) -> Option<Duration> {
        if failed || now <= after(began, INSTANT) {
            return Some(self.fruitless(key, began, now));
        }
        self.attempts.remove(key);
        None
    }

    /// An attempt that began then led to nothing. Returns the rest.
    pub(super) fn fruitless(&mut self, key: &Key, began: Time, now: Time) -> Duration {
        let attempts = self.attempts.entry(key.clone()).or_insert(Attempts::NONE);
        let last = attempts.in_a_row(began);
        let rest = last.map_or(FIRST, |last| LONGEST.min(last.rest * 2));
        let in_a_row = last.map_or(1, |last| last.in_a_row.saturating_add(1));
        attempts.fruitless = Some(Fruitless { in_a_row, rest, until: after(now, rest), over: false });
        self.due = earlier(self.due, attempts.due());
        rest
    }

    /// The rules with a rest that is over now. Forgets what no longer matters for bindings that do not run.
    pub(super) fn awake(&mut self, now: Time, runs: impl Fn(&Key) -> bool) -> Vec<RuleId> {
        let mut awake = Vec::new();
        if self.due.is_none_or(|due| now < due) {
            return awake;
        }
        let mut due = None;
        self.attempts.retain(|key, attempts| {
            if let Some(last) = &mut attempts.fruitless
                && !last.over
                && last.until <= now
            {
                last.over = true;
                awake.push(key.0);
            }
            let stays = match attempts.fruitless {
                Some(last) => now <= after(last.until, last.rest) || runs(key),
                None => attempts.began.is_some_and(|began| now <= after(began, INSTANT)),
            };
            if stays {
                due = earlier(due, attempts.due());
            }
            stays
        });
        self.due = due;
        awake
    }

    /// When the next rest is over.
    pub(super) fn next(&self) -> Option<Time> {
        self.resting().map(|(_, _, until)| until).min()
    }

    /// Who rests, after how many fruitless attempts, and until when.
    pub(super) fn resting(&self) -> impl Iterator<Item = (&Key, u32, Time)> {
        let all = self.attempts.iter().filter_map(|(key, attempts)| Some((key, attempts.fruitless?)));
        all.filter(|(_, last)| !last.over).map(|(key, last)| (key, last.in_a_row, last.until))
    }
}

/// A time and a duration after it.
pub(super) fn after(now: Time, duration: Duration) -> Time {
    Time(now.0.saturating_add(u64::try_from(duration.as_nanos()).unwrap_or(u64::MAX)))
}

fn earlier(one: Option<Time>, other: Option<Time>) -> Option<Time> {
    one.into_iter().chain(other).min()
}
