//! The invariants, held during a run.
//!
//! A subscriber like any other: it reads the graph, writes nothing, and reports what was broken.

use dsr::{Graph, Subscription, Time};
use safety::{Broken, Invariants, Monitor};
use std::future::pending;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::Notify;
use tokio::time::{Instant, sleep_until};

/// A deadline is broken after it, not at it.
const AFTER: Duration = Duration::from_millis(1);

/// The monitor of one run.
pub(super) struct Guard {
    monitor: Monitor,
    subscription: Subscription,
    news: Arc<Notify>,
    epoch: Instant,
}

impl Guard {
    /// Guards the graph from now on; the time of its commits is counted from `epoch`.
    pub(super) fn new(invariants: &Arc<Invariants>, graph: &Graph, epoch: Instant) -> Self {
        let monitor = Monitor::new(Arc::clone(invariants));
        let subscription = graph.subscribe_to(monitor.interest(&graph.snapshot()));
        let news = Arc::new(Notify::new());
        let wake = Arc::clone(&news);
        subscription.on_wake(move || wake.notify_one());
        Self { monitor, subscription, news, epoch }
    }

    /// The same monitor, for a graph that goes on: the time of its commits is counted from another instant.
    pub(super) fn since(self, epoch: Instant) -> Self {
        Self { epoch, ..self }
    }

    /// Takes in a version of the past. Returns what it broke.
    pub(super) fn follow(&mut self) -> Vec<Broken> {
        let mut broken = Vec::new();
        while let Some(news) = self.subscription.try_recv() {
            broken.extend(self.monitor.changed(&news));
        }
        broken
    }

    /// Waits until there may be something to [look](Self::look) at.
    pub(super) async fn alerted(&self) {
        let late = async {
            match self.monitor.deadline() {
                Some(Time(deadline)) => {
                    sleep_until(self.epoch + Duration::from_nanos(deadline) + AFTER).await;
                }
                None => pending().await,
            }
        };
        tokio::select! {
            biased;
            () = self.news.notified() => {}
            () = late => {}
        }
    }

    /// What was broken since the last look.
    pub(super) fn look(&mut self) -> Vec<Broken> {
        let mut broken = self.follow();
        broken.extend(self.monitor.passed(self.now()));
        broken
    }

    /// What was broken since the last look, and by the end of the run. A run that goes on was cut short.
    pub(super) fn end(mut self, goes_on: bool) -> Vec<Broken> {
        let mut broken = self.look();
        let now = self.now();
        broken.extend(if goes_on { self.monitor.cut(now) } else { self.monitor.ended(now) });
        broken
    }

    fn now(&self) -> Time {
        Time(u64::try_from(self.epoch.elapsed().as_nanos()).unwrap_or(u64::MAX))
    }
}
