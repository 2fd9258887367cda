//! The shell: drives agents over the real graph, clock and devices.
//!
//! Idea: one future per agent that is woken by the graph (for the agent's interest alone), by a skill, or by the time.
//! It feeds the pure [`Runtime`] and does what that asks for. `supervisor` begins and ends the lives of agents, and `work`
//! keeps skills apart: together in the caller's task, or each agent and each skill on a thread of its own
//! ([`Housing`]).
//!
//! Invariants: where all work together, the same wakings in the same order give the same commits. News of the graph come
//! before endings of skills, so that a skill which a reflex stopped can no longer end; skills are polled in the order of
//! their launch. Dropping the future drops every skill, which stops every device, and expires every agent.

mod supervisor;
mod work;

use std::collections::BTreeMap;
use std::fmt;
use std::future::poll_fn;
use std::sync::Arc;
use std::task::Poll;
use std::time::Duration;

use dsr::{Epoch, Graph, Time};
use tokio::time::{Instant, sleep};

pub use self::supervisor::{Absence, run_all};
use self::supervisor::{Gone, Pulse};
pub use self::work::Housing;
use self::work::Launcher;
use crate::rules::Agent;
use crate::runtime::{Action, InstanceId, Runtime};
use crate::skill::{Ended, Equipment, Work};

/// The clock that commits are stamped with.
pub trait Clock: Send + Sync {
    /// Now; never less than before.
    fn now(&self) -> Time;
}

/// Tokio's clock, from an instant on; simulated where that is paused.
#[derive(Debug, Clone, Copy)]
pub struct TokioClock {
    started: Instant,
}

impl TokioClock {
    /// Time 0 is now.
    pub fn start() -> Self {
        Self { started: Instant::now() }
    }
}

impl Clock for TokioClock {
    fn now(&self) -> Time {
        Time(u64::try_from(self.started.elapsed().as_nanos()).unwrap_or(u64::MAX))
    }
}

/// Where agents live.
#[derive(Clone)]
pub struct Environment {
    /// The shared graph.
    pub graph: Graph,
    /// What skills work with.
    pub equipment: Equipment,
    /// The time.
    pub clock: Arc<dyn Clock>,
    /// Where agents and skills work.
    pub housing: Housing,
    /// How the graph says that an agent is absent, if the vocabulary has words for it.
    pub absence: Option<Absence>,
}

impl fmt::Debug for Environment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Environment").field("graph", &self.graph).finish_non_exhaustive()
    }
}

/// Runs one life of an agent, until it is fenced or dropped.
async fn drive(
    agent: Arc<Agent>,
    epoch: Epoch,
    environment: Environment,
    launcher: Launcher,
    pulse: Arc<Pulse>,
) -> Gone {
    let Environment { graph, equipment, clock, .. } = environment;
    let mut runtime = Runtime::new(agent).in_epoch(epoch);
    let mut subscription = graph.subscribe_to(runtime.agent().interest());
    let waker = Arc::clone(pulse.wake());
    subscription.on_wake(move || waker.notify_one());
    let mut skills: BTreeMap<InstanceId, Work> = BTreeMap::new();
    loop {
        pulse.beat();
        loop {
            while let Some(news) = subscription.try_recv() {
                runtime.changed(&news);
            }
            let now = clock.now();
            match runtime.next_action(&graph.snapshot(), now) {
                Some(Action::Commit(transaction)) => {
                    let result = graph.commit(&transaction, now);
                    runtime.committed(result.as_ref(), now);
                }
                Some(Action::Launch { instance, skill, call }) => {
                    skills.insert(instance, launcher.launch(skill, call, &equipment));
                }
                Some(Action::Stop(instance)) => drop(skills.remove(&instance)),
                None if runtime.is_fenced() => return Gone::Fenced,
                None => break,
            }
        }
        let left =
            runtime.deadline().map(|deadline| Duration::from_nanos(deadline.0.saturating_sub(clock.now().0)));
        let time_is_up = async {
            match left {
                Some(left) => sleep(left).await,
                None => std::future::pending().await,
            }
        };
        tokio::select! {
            biased;
            () = pulse.wake().notified() => {}
            (instance, ended) = first_ended(&mut skills) => {
                skills.remove(&instance);
                runtime.ended(instance, ended);
            }
            () = time_is_up => {}
        }
    }
}

/// The first skill to end, in the order of their launch.
async fn first_ended(skills: &mut BTreeMap<InstanceId, Work>) -> (InstanceId, Ended) {
    poll_fn(|context| {
        for (&instance, work) in &mut *skills {
            if let Poll::Ready(ended) = work.as_mut().poll(context) {
                return Poll::Ready((instance, ended));
            }
        }
        Poll::Pending
    })
    .await
}
