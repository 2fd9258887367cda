//! The executive's shell: carries out what the wheel wants, on tokio.
//!
//! The wheel decides; the shell commits, plans in a thread of its own, sets the timer, and passes the
//! story on. On a paused clock, time stands still while the planner's thread works, so a simulated run is
//! the same every time.

use crate::decision_support::{Decision, RequestId, decide};
use crate::narration::Narration;
use crate::wheel::{Effect, Ending, Event, Wheel};
use dsr::{AgentId, Committed, Graph, Time, Transaction};
use std::collections::VecDeque;
use std::future::pending;
use std::sync::Arc;
use tokio::sync::Notify;
use tokio::task::{JoinHandle, spawn_blocking};
use tokio::time::{Instant, sleep_until};

/// Where the executive meets the world.
pub struct Shell<Tell> {
    /// The shared graph.
    pub graph: Graph,
    /// As whom PELEA writes.
    pub writer: AgentId,
    /// When the mission started: time zero of every commit.
    pub epoch: Instant,
    /// Who hears the story.
    pub tell: Tell,
}

impl<Tell: FnMut(Time, Narration)> Shell<Tell> {
    /// Turns the wheel until the mission is over.
    pub async fn run(mut self, mut wheel: Wheel) -> Ending {
        let news = Arc::new(Notify::new());
        let wake = news.clone();
        let deltas = self.graph.subscribe_deltas();
        deltas.on_wake(move || wake.notify_one());
        let mut events = VecDeque::from_iter(deltas.start().map(Event::Seen));
        let mut alarm: Option<Instant> = None;
        let mut planning: Option<(RequestId, JoinHandle<Decision>)> = None;
        loop {
            while let Some(event) = events.pop_front() {
                for effect in wheel.step(event, self.now()) {
                    match effect {
                        Effect::Write(edits) => events.push_back(self.write(edits)),
                        Effect::Plan(request) => {
                            let model = wheel.model().clone();
                            let id = request.id;
                            tracing::debug!(request = id.0, barred = request.barred.len(), "planning");
                            planning = Some((id, spawn_blocking(move || decide(&model, &request))));
                        }
                        Effect::WakeAt(time) => alarm = Some(self.instant(time)),
                        Effect::Tell(narration) => {
                            let now = self.now();
                            (self.tell)(now, narration);
                        }
                        Effect::End(ending) => return ending,
                    }
                }
            }
            tokio::select! {
                biased;
                () = news.notified() => {}
                decided = join(&mut planning) => {
                    planning = None;
                    events.push_back(decided);
                }
                () = ring(alarm) => {
                    alarm = None;
                    events.push_back(Event::Woke);
                }
            }
            while let Some(event) = deltas.try_recv() {
                events.push_back(match event {
                    dsr::Event::Committed(Committed { delta, snapshot }) => {
                        Event::Changed { snapshot, delta }
                    }
                    dsr::Event::Lagged { snapshot, .. } => Event::Seen(snapshot),
                });
            }
        }
    }

    fn write(&self, edits: Vec<dsr::Edit>) -> Event {
        let mut transaction = Transaction::new(self.writer);
        transaction.extend(edits);
        match self.graph.commit(&transaction, self.now()) {
            Ok(commit) => Event::Written(commit.version),
            Err(error) => {
                tracing::warn!(%error, "the graph refused a write of the executive");
                Event::Refused(error.to_string())
            }
        }
    }

    fn now(&self) -> Time {
        Time(u64::try_from(self.epoch.elapsed().as_nanos()).unwrap_or(u64::MAX))
    }

    fn instant(&self, time: Time) -> Instant {
        self.epoch + std::time::Duration::from_nanos(time.0)
    }
}

async fn join(planning: &mut Option<(RequestId, JoinHandle<Decision>)>) -> Event {
    match planning {
        Some((id, handle)) => {
            // A panic in the planner is a bug of ours; the mission must not hang on it.
            let stopped = |_| Decision::Rejected("the planner stopped".to_owned());
            Event::Decided(*id, handle.await.unwrap_or_else(stopped))
        }
        None => pending().await,
    }
}

async fn ring(alarm: Option<Instant>) {
    match alarm {
        Some(instant) => sleep_until(instant).await,
        None => pending().await,
    }
}
