//! The executive's shell: carries out the effects of the wheel, on tokio.
//!
//! The wheel decides; the shell subscribes to the part of the graph that the wheel reads, commits, plans in a thread of
//! its own, sets the timer, and passes the story on. On a paused clock, time stands still while the planner's thread
//! works, so a simulated run is the same every time; how long a decision takes there is an argument.
//!
//! Its intentions are guarded: with each write the shell registers the reflex that takes back all that PELEA intends, which
//! fires when PELEA expires, also after the end of the process ([`Graph::expire`], [`dsr::Recording`]). What must outlive
//! the process ([`Lasting`]) is not taken back, and reaches the wheel once it is on disk.
//!
//! Invariant: what was committed before a timer rang is handed in before the timer is, at the time at which the queue was
//! last found empty.

use crate::decision_support::{Decision, Request, RequestId, decide};
use crate::lasting::{Hold, Lasting};
use crate::narration::Narration;
use crate::outcome::{Ending, NoPlan};
use crate::record::{Occurrence, Turn};
use crate::wheel::{Effect, Event, Wheel};
use budget::Cancellation;
use dsr::{
    AgentId, Edit, Graph, Reflex, ReflexId, Subscription, Time, Transaction, TransactionError, Version,
};
use std::collections::VecDeque;
use std::future::pending;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::Notify;
use tokio::task::{JoinHandle, spawn_blocking};
use tokio::time::{Instant, sleep_until};

/// The surroundings of a wheel.
pub struct Shell<Tell, Latency, Record> {
    /// The shared graph.
    pub graph: Graph,
    /// The agent that PELEA writes as.
    pub writer: AgentId,
    /// When the mission started: time zero of every commit.
    pub epoch: Instant,
    /// Receives the story.
    pub tell: Tell,
    /// How long a decision takes at least.
    pub latency: Latency,
    /// Receives every turn.
    pub record: Record,
    /// Whether decisions give way to everything else that works, as on a clock that does not wait for them.
    pub gives_way: bool,
    /// What must outlive the process.
    pub lasting: Lasting,
}

/// Lowers the priority of this thread, and of the threads that a search starts from it.
#[cfg(target_os = "linux")]
fn give_way() {
    // Here priorities are those of threads, and no process means the calling thread.
    if let Err(error) = rustix::process::setpriority_process(None, 10) {
        tracing::warn!(%error, "decisions are made at the priority of the agents");
    }
}

#[cfg(not(target_os = "linux"))]
fn give_way() {}

/// A decision on its way.
struct Planning {
    id: RequestId,
    cancellation: Cancellation,
    answer: JoinHandle<Decision>,
    /// The decision is handed in no earlier.
    not_before: Option<Instant>,
}

impl<Tell, Latency, Record> Shell<Tell, Latency, Record>
where
    Tell: FnMut(Time, Narration),
    Latency: FnMut(RequestId) -> Duration,
    Record: FnMut(&Turn<'_>),
{
    /// Turns the wheel until the mission is over.
    pub async fn run(mut self, mut wheel: Wheel) -> Ending {
        let news = Arc::new(Notify::new());
        let wake = news.clone();
        let mut graph = self.graph.subscribe_to(wheel.interest(self.writer));
        graph.on_wake(move || wake.notify_one());
        let mut events = VecDeque::new();
        take_in(&mut graph, &mut events);
        let mut alarm: Option<Instant> = None;
        let mut planning: Option<Planning> = None;
        let mut now = self.now();
        let mut guard = None;
        let mut hold = None;
        let mut durable = Version::default();
        let mut ending = None;
        loop {
            while let Some(event) = events.pop_front() {
                if let Some(version) = self.lasting.awaits(&event).filter(|version| *version > durable) {
                    events.push_front(event);
                    hold = Some(self.lasting.hold(version));
                    durable = version;
                    break;
                }
                let occurrence = Occurrence::from(&event);
                let effects = wheel.step(event, now);
                (self.record)(&Turn::new(now, occurrence, &effects));
                ending = ending.filter(|_| wheel.has_ended());
                for effect in effects {
                    match effect {
                        Effect::Write(edits) => {
                            let answer = self.write(edits, &wheel, &mut guard);
                            now = self.now();
                            take_in(&mut graph, &mut events);
                            events.push_back(answer);
                        }
                        Effect::Plan(request) => planning = Some(self.plan(&wheel, request)),
                        Effect::Cancel(id) => {
                            if let Some(moot) = planning.take_if(|planning| planning.id == id) {
                                moot.cancellation.cancel();
                            }
                        }
                        Effect::WakeAt(time) => alarm = Some(self.instant(time)),
                        // Told when it is certain.
                        Effect::Tell(Narration::Ended(_)) => {}
                        Effect::Tell(narration) => (self.tell)(now, narration),
                        Effect::End(end) => {
                            ending = Some(end);
                            take_in(&mut graph, &mut events);
                        }
                    }
                }
            }
            // Everything that was committed until now has been seen.
            if hold.is_none()
                && let Some(ending) = ending.take()
            {
                (self.tell)(now, Narration::Ended(ending.clone()));
                return ending;
            }
            let event = tokio::select! {
                biased;
                () = news.notified() => None,
                () = held(&mut hold) => None,
                decided = join(&mut planning), if hold.is_none() => {
                    planning = None;
                    Some(decided)
                }
                () = ring(alarm), if hold.is_none() => {
                    alarm = None;
                    Some(Event::Woke)
                }
            };
            // The queue is emptied after the clock is read: every version up to that time comes before the event.
            now = self.now();
            take_in(&mut graph, &mut events);
            events.extend(event);
        }
    }

    fn plan(&mut self, wheel: &Wheel, request: Request) -> Planning {
        let (id, model, cancellation) = (request.id, wheel.model().clone(), Cancellation::default());
        tracing::debug!(request = id.0, barred = request.barred.len(), "planning");
        let latency = Some((self.latency)(id)).filter(|latency| !latency.is_zero());
        let not_before = latency.map(|latency| Instant::now() + latency);
        let cancelled = cancellation.clone();
        let gives_way = self.gives_way;
        let answer = spawn_blocking(move || {
            if gives_way {
                give_way();
            }
            decide(&model, &request, &cancelled)
        });
        Planning { id, cancellation, answer, not_before }
    }

    /// Commits a write with the reflex that guards it, which replaces the last one.
    fn write(&self, edits: Vec<Edit>, wheel: &Wheel, guard: &mut Option<ReflexId>) -> Event {
        let mut transaction = Transaction::new(self.writer);
        transaction.extend(edits);
        let unguarded = transaction.clone();
        guard.iter().for_each(|before| _ = transaction.dismiss(*before));
        let on_break: Vec<_> =
            wheel.withdrawal().into_iter().filter(|edit| !self.lasting.is_about(edit)).collect();
        if !on_break.is_empty() {
            let owner = self.writer;
            transaction.guard(Reflex { owner, keep: Vec::new(), on_break, leases: Vec::new() });
        }
        let committed = match self.graph.commit(&transaction, self.now()) {
            // Somebody declared PELEA dead, or it may not take back what it may write: the mission goes on all the same.
            Err(TransactionError::ReflexGone { .. } | TransactionError::ReflexRefused { .. }) => {
                tracing::warn!("the intentions of the executive are not guarded");
                self.graph.commit(&unguarded, self.now())
            }
            committed => committed,
        };
        match committed {
            Ok(commit) => {
                *guard = commit.guards.first().copied();
                Event::Written
            }
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
        self.epoch + Duration::from_nanos(time.0)
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

async fn join(planning: &mut Option<Planning>) -> Event {
    let Some(Planning { id, answer, not_before, .. }) = planning else { return pending().await };
    // The sleep comes first: the caller may drop this future and join again, and an answer can be taken only once.
    if let Some(instant) = *not_before {
        sleep_until(instant).await;
    }
    // A panic in the planner is a bug of ours; the mission must not hang on it.
    let decision = answer.await.unwrap_or(Decision::NoPlan(NoPlan::Stopped));
    Event::Decided(*id, decision)
}

/// Until what was waited for is on disk.
async fn held(hold: &mut Option<Hold>) {
    match hold {
        Some(waiting) => waiting.await,
        None => pending().await,
    }
    *hold = None;
}

async fn ring(alarm: Option<Instant>) {
    match alarm {
        Some(instant) => sleep_until(instant).await,
        None => pending().await,
    }
}
