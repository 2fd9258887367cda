//! One life of an agent: news in, actions out, until it is dropped.

use super::Environment;
use super::attentive::Attentive;
use super::pulse::{Gone, Pulse};
use super::work::Launcher;
use crate::rules::Agent;
use crate::runtime::{Action, InstanceId, Runtime};
use crate::skill::{Ended, Work};
use dsr::Epoch;
use std::collections::BTreeMap;
use std::future::poll_fn;
use std::sync::Arc;
use std::task::Poll;
use std::time::Duration;
use tokio::time::sleep;

/// The skills at work, in the order of their launch.
type Skills = BTreeMap<InstanceId, Attentive<Work>>;

/// Runs one life of an agent, until it is fenced or dropped.
pub(super) async fn drive(
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
    let mut skills = Skills::new();
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
                    let work = launcher.launch(skill, call, &equipment);
                    skills.insert(instance, Attentive::new(work));
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
async fn first_ended(skills: &mut Skills) -> (InstanceId, Ended) {
    poll_fn(|context| {
        for (&instance, work) in &mut *skills {
            if let Poll::Ready(ended) = work.attend(context) {
                return Poll::Ready((instance, ended));
            }
        }
        Poll::Pending
    })
    .await
}
