//! The executive's shell: carries out the effects of the wheel, on tokio.
//!
//! The wheel decides; the shell subscribes to the part of the graph that the wheel reads, commits, plans in a thread of
//! its own, sets the timer, and passes the story on. On a paused clock, time stands still while the planner's thread
//! works, so a simulated run is the same every time.

use crate::decision_support::{Decision, RequestId, decide};
use crate::narration::Narration;
use crate::outcome::{Ending, NoPlan};
use crate::wheel::{Effect, Event, Wheel};
use dsr::{AgentId, Graph, Subscription, Time, Transaction};
use std::collections::VecDeque;
use std::future::pending;
use std::sync::Arc;
use tokio::sync::Notify;
use tokio::task::{JoinHandle, spawn_blocking};
use tokio::time::{Instant, sleep_until};

/// The surroundings of a wheel.
pub struct Shell<Tell> {
    /// The shared graph.
    pub graph: Graph,
    /// The agent that PELEA writes as.
    pub writer: AgentId,
    /// When the mission started: time zero of every commit.
    pub epoch: Instant,
    /// Receives the story.
    pub tell: Tell,
}

impl<Tell: FnMut(Time, Narration)> Shell<Tell> {
    /// Turns the wheel until the mission is over.
    pub async fn run(mut self, mut wheel: Wheel) -> Ending {
        let news = Arc::new(Notify::new());
        let wake = news.clone();
        let mut graph = self.graph.subscribe_to(wheel.interest(self.writer));
        graph.on_wake(move || wake.notify_one());
        let mut events = VecDeque::new();
        take_in(&mut graph, &mut events);
        let mut alarm: Option<Instant> = None;
        let mut planning: Option<(RequestId, JoinHandle<Decision>)> = None;
        loop {
            while let Some(event) = events.pop_front() {
                for effect in wheel.step(event, self.now()) {
                    match effect {
                        Effect::Write(edits) => {
                            let answer = self.write(edits);
                            take_in(&mut graph, &mut events);
                            events.push_back(answer);
                        }
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
            take_in(&mut graph, &mut events);
        }
    }

    fn write(&self, edits: Vec<dsr::Edit>) -> Event {
        let mut transaction = Transaction::new(self.writer);
        transaction.extend(edits);
        match self.graph.commit(&transaction, self.now()) {
            Ok(_) => Event::Written,
            Err(error) => {
                tracing::warn!(%error, "the graph refused a write of the executive");
                Event::Refused(error)
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

/// What the graph has become, in order.
fn take_in(graph: &mut Subscription, events: &mut VecDeque<Event>) {
    while let Some(news) = graph.try_recv() {
        events.push_back(match news.deltas.into_iter().next() {
            Some(delta) => Event::Changed { snapshot: news.snapshot, delta },
            None => Event::Seen(news.snapshot),
        });
    }
}

async fn join(planning: &mut Option<(RequestId, JoinHandle<Decision>)>) -> Event {
    match planning {
        Some((id, handle)) => {
            // A panic in the planner is a bug of ours; the mission must not hang on it.
            let stopped = |_| Decision::NoPlan(NoPlan::Stopped);
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
