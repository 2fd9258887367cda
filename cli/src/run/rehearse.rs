//! A scenario played for its verdict alone, as `pelea test` does.

use super::latency::{self, Latency};
use super::perform::Kept;
use super::play::Play;
use super::speed::Speed;
use super::teller::Verdict;
use super::{Content, HORIZON};
use crate::assemble::Assembly;
use crate::console::Console;
use crate::scenario::Staged;
use std::io;

/// Plays a scenario in simulated time, as `pelea run --speed max` does, and says nothing; `None` if the system gives no
/// timers.
pub(crate) fn rehearse(content: Content, assembly: Assembly, staged: Staged) -> Option<Verdict> {
    let runtime =
        tokio::runtime::Builder::new_current_thread().enable_time().start_paused(true).build().ok()?;
    let play = Play {
        horizon: Some(staged.scenario.horizon.unwrap_or(HORIZON)),
        turns: None,
        past: None,
        kept: Kept::default(),
        latency: Latency::new(latency::Range::default(), 0).simulated(),
        speed: Speed::Max,
        pulse: None,
        interruptible: false,
        content,
        staged: Some(staged),
        seed: 0,
        verbose: false,
    };
    let (mut out, mut err) = (io::sink(), io::sink());
    let mut console = Console::new(&mut out, &mut err);
    let verdict = runtime.block_on(play.play(assembly, None, &mut console));
    // The planner's thread may still work on a plan that is no longer needed.
    runtime.shutdown_background();
    Some(verdict)
}
