//! Runs a mission on simulated devices, in one task.

use super::content::Content;
use super::latency::Latency;
use super::past::Past;
use super::perform::{Kept, Production, perform};
use super::speed::Speed;
use super::story::Story;
use super::teller::{Teller, Verdict};
use crate::assemble::Assembly;
use crate::console::Console;
use crate::interrupt;
use crate::scenario::Staged;
use crate::turns::Turns;
use agents::Housing;
use executive::Ending;
use std::path::Path;
use std::time::Duration;
use tokio::sync::mpsc;

/// A mission that is ready to run.
pub(super) struct Play {
    pub(super) content: Content,
    pub(super) staged: Option<Staged>,
    pub(super) seed: u64,
    pub(super) verbose: bool,
    /// When the run ends whatever happens, if ever.
    pub(super) horizon: Option<Duration>,
    /// How long a decision takes at least.
    pub(super) latency: Latency,
    /// Where every turn of PELEA is recorded, if anywhere.
    pub(super) turns: Option<Turns>,
    /// What was before a restart.
    pub(super) past: Option<Past>,
    /// What is kept on disk.
    pub(super) kept: Kept,
    /// How fast time passes.
    pub(super) speed: Speed,
    /// How often PELEA must turn on a clock that does not wait for it.
    pub(super) pulse: Option<Duration>,
    /// Whether Ctrl-C ends this run in order, and not the process at once.
    pub(super) interruptible: bool,
}

impl Play {
    /// Runs the mission to its end.
    pub(super) async fn play(
        mut self,
        assembly: Assembly,
        report_file: Option<&Path>,
        console: &mut Console<'_>,
    ) -> Verdict {
        let (reader, mut entries) = mpsc::unbounded_channel();
        let story = Story::new(&assembly.graph, reader);
        let cues = self.staged.as_mut().map(|staged| std::mem::take(&mut staged.cues)).unwrap_or_default();
        let past = self.past.take();
        let goes_on = past.as_ref().map(Past::elapsed);
        let production = Production {
            content: self.content.clone(),
            scenario: self.staged.as_ref().map(|staged| &staged.scenario),
            cues,
            seed: self.seed,
            horizon: self.horizon,
            latency: self.latency.clone(),
            pulse: self.pulse,
            turns: self.turns.take(),
            kept: std::mem::take(&mut self.kept),
            past,
            // Simulated time passes in this task alone: everything takes its turn here, and gives the same bytes.
            housing: if self.speed.is_simulated() { Housing::Together } else { Housing::Apart },
        };
        let mut teller = Teller::new(&self.content, self.staged.as_ref(), self.verbose, console);
        teller.heading();
        if let Some(elapsed) = goes_on {
            teller.goes_on(elapsed, assembly.graph.snapshot().version());
        }
        let speed = self.speed;
        let performed = {
            let tell = async {
                loop {
                    tokio::select! {
                        biased;
                        Some(entry) = entries.recv() => teller.tell(&entry),
                        () = story.alerted() => story.catch_up(),
                    }
                }
            };
            let interrupted = async {
                tokio::select! {
                    biased;
                    () = interrupt::first(), if self.interruptible => Ending::Interrupted,
                    () = speed.pass_time() => std::future::pending().await,
                }
            };
            perform(production, assembly, story.clone(), tell, interrupted).await
        };
        while let Ok(entry) = entries.try_recv() {
            teller.tell(&entry);
        }
        teller.end(&performed, report_file)
    }
}
