//! How long a decision takes on the simulated clock.
//!
//! Problem: on a clock that waits for the planner every plan is there at once, so no run can show what happens while
//! PELEA decides. Idea: a decision takes at least a given time, or a time between two, drawn from the run's seed.
//!
//! Invariant: on a simulated clock a decision takes at least a tick. Everything else that happens in the instant of the
//! question then comes before the answer, however fast the planner's thread is, and a run is the same every time.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use std::str::FromStr;
use std::time::Duration;

/// The finest tick of tokio's clock.
const TICK: Duration = Duration::from_millis(1);

/// The shortest and the longest time of a decision, as on the command line: `0.5`, `0.1..3`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Range {
    least: Duration,
    most: Duration,
}

impl FromStr for Range {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let seconds = |text: &str| {
            let number: f64 = text.parse().map_err(|_| "not a number of seconds".to_owned())?;
            let longest = Duration::from_secs(24 * 60 * 60);
            let seconds = Duration::try_from_secs_f64(number).map_err(|error| error.to_string())?;
            if seconds <= longest { Ok(seconds) } else { Err("more than a day".to_owned()) }
        };
        let (least, most) = text.split_once("..").unwrap_or((text, text));
        let range = Self { least: seconds(least)?, most: seconds(most)? };
        if range.least <= range.most { Ok(range) } else { Err("the first number is the greater".to_owned()) }
    }
}

/// The times of a run's decisions, one after the other.
#[derive(Clone, Debug)]
pub(crate) struct Latency {
    range: Range,
    random: Pcg64Mcg,
}

impl Latency {
    pub(crate) fn new(range: Range, seed: u64) -> Self {
        Self { range, random: Pcg64Mcg::seed_from_u64(seed) }
    }

    /// The same on a simulated clock.
    pub(crate) fn simulated(mut self) -> Self {
        let Range { least, most } = &mut self.range;
        (*least, *most) = ((*least).max(TICK), (*most).max(TICK));
        self
    }

    /// The time of the next decision, to the millisecond.
    pub(crate) fn next(&mut self) -> Duration {
        let Range { least, most } = self.range;
        let millis = u64::try_from((most - least).as_millis()).unwrap_or(u64::MAX - 1);
        if millis == 0 { least } else { least + Duration::from_millis(self.random.next_u64() % (millis + 1)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(text: &str) -> Range {
        text.parse().expect("a range")
    }

    #[test]
    fn a_seed_gives_the_same_times_within_the_range() {
        let times = |seed| {
            let mut latency = Latency::new(range("0.1..3"), seed);
            (0..100).map(|_| latency.next()).collect::<Vec<_>>()
        };
        assert_eq!(times(1), times(1));
        assert_ne!(times(1), times(2));
        assert!(times(1).iter().all(|t| (0.1..=3.0).contains(&t.as_secs_f64())));
    }

    #[test]
    fn one_number_is_every_time() {
        assert_eq!(Latency::new(range("0.5"), 3).next(), Duration::from_millis(500));
        assert_eq!(Latency::new(range("0.5"), 3).simulated().next(), Duration::from_millis(500));
        assert_eq!(Latency::new(Range::default(), 3).simulated().next(), TICK);
        assert_eq!("3..1".parse::<Range>(), Err("the first number is the greater".to_owned()));
    }
}
