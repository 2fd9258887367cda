//! How fast time passes in a run.
//!
//! Real time is the machine's clock. Any other pace is simulated time: tokio's clock is paused, and either jumps to the
//! next event (`max`) or is moved on by a metronome, a thread that ticks in real time. While that thread is at work, the
//! paused clock does not jump by itself.

use std::fmt;
use std::str::FromStr;
use std::time::Duration;
use tokio::sync::mpsc::{Receiver, channel};

/// The real time between two ticks of the metronome.
const TICK: Duration = Duration::from_millis(5);

/// The longest step of the simulated clock.
const STEP: Duration = Duration::from_millis(50);

/// How fast time passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Speed {
    /// This many seconds of the run in one second on the wall; 1 is the machine's own clock.
    Factor(f64),
    /// As fast as the machine.
    Max,
}

impl Speed {
    /// Whether time is simulated.
    pub(super) fn is_simulated(self) -> bool {
        self != Self::Factor(1.0)
    }

    /// Moves the paused clock on, tick by tick; waits for ever where time passes without it. Call it in the runtime.
    pub(super) async fn pass_time(self) {
        let Self::Factor(factor) = self else { return std::future::pending().await };
        if !self.is_simulated() {
            std::future::pending::<()>().await;
        }
        let mut ticks = metronome();
        while ticks.recv().await.is_some() {
            // In small steps, so that what is due within a tick happens at its time.
            let mut left = TICK.mul_f64(factor);
            while !left.is_zero() {
                let step = left.min(STEP);
                tokio::time::advance(step).await;
                left -= step;
            }
        }
        std::future::pending::<()>().await;
    }
}

/// A tick after each [`TICK`] of real time. A tick that was not taken in time is not repeated.
fn metronome() -> Receiver<()> {
    let (ticker, ticks) = channel(1);
    tokio::task::spawn_blocking(move || {
        // Nothing is ever sent here: the time that the wait takes is what counts.
        let (_never, silence) = std::sync::mpsc::channel::<()>();
        while !ticker.is_closed() {
            let _ = silence.recv_timeout(TICK);
            // Full: the run is busy, and simulated time waits for it.
            let _ = ticker.try_send(());
        }
    });
    ticks
}

impl FromStr for Speed {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "max" {
            return Ok(Self::Max);
        }
        let wrong = || "a positive number such as 1, 0.5 or 20 up to 1000, or `max`".to_owned();
        let factor: f64 = text.parse().map_err(|_| wrong())?;
        if factor.is_finite() && (1e-3..=1e3).contains(&factor) {
            Ok(Self::Factor(factor))
        } else {
            Err(wrong())
        }
    }
}

impl fmt::Display for Speed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Factor(factor) => write!(f, "{factor}"),
            Self::Max => f.write_str("max"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_speed_is_a_factor_or_max() {
        assert_eq!("max".parse(), Ok(Speed::Max));
        assert_eq!("1".parse(), Ok(Speed::Factor(1.0)));
        assert_eq!("0.5".parse(), Ok(Speed::Factor(0.5)));
        for wrong in ["", "fast", "0", "-1", "nan", "inf", "1e9"] {
            assert!(wrong.parse::<Speed>().is_err(), "{wrong}");
        }
    }
}
