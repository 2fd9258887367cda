//! Lives of agents: begun, watched, ended, and begun again.
//!
//! Problem: an agent's own loop panics, hangs, or is dropped while its robot speaks. Idea: one path for all of them. The
//! supervisor keeps the [`Liveness`](dsr::Liveness) of each agent. Whatever ends a life, the supervisor drops it: in one
//! commit the leases return, the reflexes write what they have to, and the graph says that the agent is absent. What
//! that life still writes is refused. The agent begins again after a pause, 1 s at first and at most 30 s.
//!
//! A loop that hangs is found by asking it to turn ([`TICK`]). Ticks are counted and not measured, so a process that was
//! stopped for a while (SIGSTOP) finds all its agents alive.

use std::convert::Infallible;
use std::future::poll_fn;
use std::sync::Arc;
use std::task::Poll;
use std::time::Duration;

use dsr::{AgentId, Edit, Epoch};
use tokio::time::{Instant, sleep};
use tracing::{Instrument, debug_span, error, info};

use super::Environment;
use super::attentive::Attentive;
use super::drive::drive;
use super::pulse::{Absence, Gone, Pulse};
use super::work::{Caught, Housing, Launcher, MOST_ABANDONED, Threads};
use crate::rules::Agent;

/// How often a loop on a thread of its own is asked to turn.
const TICK: Duration = Duration::from_millis(250);
/// After this many ticks without an answer it hangs.
const MISSED: u32 = 8;
/// The first pause before an agent begins again.
const FIRST: Duration = Duration::from_secs(1);
/// The longest pause. An agent that lived for longer begins again after the first one.
const LONGEST: Duration = Duration::from_secs(30);

/// Runs agents side by side until it is dropped, which stops all devices and expires all agents. Where they work
/// together, they take their turns in the order given.
pub async fn run_all(agents: impl IntoIterator<Item = Arc<Agent>>, environment: Environment) -> Infallible {
    let agents: Vec<_> = agents.into_iter().collect();
    let threads = Arc::new(Threads::default());
    match environment.housing {
        Housing::Together => supervise_all(agents, environment, threads).await,
        Housing::Apart => {
            // The supervisor has a thread of its own too, so that the caller may freeze.
            let _farewell = Farewell(Arc::clone(&threads));
            let ours = Arc::clone(&threads);
            let supervisor = threads.run("supervisor", move || supervise_all(agents, environment, ours));
            if let Some(supervisor) = supervisor
                && let Some(never) = supervisor.await
            {
                match never {}
            }
            error!("there is no supervisor: no agent runs");
            std::future::pending().await
        }
    }
}

/// Waits for the threads to stop when it is dropped.
struct Farewell(Arc<Threads>);

impl Drop for Farewell {
    fn drop(&mut self) {
        self.0.farewell();
    }
}

async fn supervise_all(
    agents: Vec<Arc<Agent>>,
    environment: Environment,
    threads: Arc<Threads>,
) -> Infallible {
    let supervise =
        |agent| Attentive::new(Box::pin(supervise(agent, environment.clone(), Arc::clone(&threads))));
    let mut agents: Vec<_> = agents.into_iter().map(supervise).collect();
    poll_fn(|context| {
        for agent in &mut agents {
            if let Poll::Ready(never) = agent.attend(context) {
                return Poll::Ready(never);
            }
        }
        Poll::Pending
    })
    .await
}

/// One life of an agent after the other.
async fn supervise(agent: Arc<Agent>, environment: Environment, threads: Arc<Threads>) -> Infallible {
    let span = debug_span!("agent", name = %agent.name);
    let mut pause = FIRST;
    loop {
        let began = Instant::now();
        let gone = live(&agent, &environment, &threads).instrument(span.clone()).await;
        error!(agent = %agent.name, "the agent is gone: {gone}");
        if began.elapsed() > LONGEST {
            pause = FIRST;
        }
        sleep(pause).await;
        pause = LONGEST.min(pause * 2);
        while threads.abandoned() >= MOST_ABANDONED {
            sleep(LONGEST).await;
        }
        info!(agent = %agent.name, "the agent begins again");
    }
}

/// One life. The `Liveness` outlives the loop, so the skills are dropped before the agent expires.
async fn live(agent: &Arc<Agent>, environment: &Environment, threads: &Arc<Threads>) -> Gone {
    let mut life = environment.graph.attend(agent.id);
    if let Some(absence) = &environment.absence {
        life.leave_behind(absent(environment, absence, agent.id, true));
        let present = absent(environment, absence, agent.id, false);
        let now = environment.graph.snapshot().time();
        let shown = environment.graph.edit(AgentId::DSR, now, |tx| _ = tx.extend(present));
        if let Err(refusal) = shown {
            error!(%refusal, "the graph cannot say who is present");
        }
    }
    let launcher = Launcher { housing: environment.housing, threads: Arc::clone(threads) };
    match environment.housing {
        Housing::Together => {
            let pulse = Arc::default();
            let loops = drive(Arc::clone(agent), life.epoch(), environment.clone(), launcher, pulse);
            Caught::new(loops).await.unwrap_or(Gone::Panicked)
        }
        Housing::Apart => apart(agent, environment, launcher, life.epoch()).await,
    }
}

/// The edits that say that an agent is absent, or present.
fn absent(environment: &Environment, absence: &Absence, agent: AgentId, is_absent: bool) -> Option<Edit> {
    let name = environment.graph.vocabulary().agent_name(agent)?.clone();
    let (from, label, to) = (name.into(), absence.label, Arc::clone(&absence.state).into());
    Some(if is_absent { Edit::AddEdge { from, label, to } } else { Edit::RemoveEdge { from, label, to } })
}

/// A life on a thread of its own, watched.
async fn apart(agent: &Arc<Agent>, environment: &Environment, launcher: Launcher, epoch: Epoch) -> Gone {
    let pulse = Arc::<Pulse>::default();
    let threads = Arc::clone(&launcher.threads);
    let (theirs, agent, environment) = (Arc::clone(&pulse), Arc::clone(agent), environment.clone());
    let name = agent.name.to_string();
    let life = threads.run(&name, move || drive(agent, epoch, environment, launcher, theirs));
    let Some(mut life) = life else { return Gone::NoThread };
    let mut missed = 0;
    loop {
        tokio::select! {
            biased;
            gone = &mut life => return gone.unwrap_or(Gone::Panicked),
            () = sleep(TICK) => missed = if pulse.ask() { 0 } else { missed + 1 },
        }
        if missed >= MISSED {
            return Gone::Hung;
        }
    }
}
