//! Runs a mission on simulated devices, in one task.

use super::content::Content;
use super::guard::Guard;
use super::latency::Latency;
use super::speed::Speed;
use super::story::{Story, What, seconds};
use super::teller::Teller;
use super::{director, script};
use crate::assemble::Assembly;
use crate::console::Console;
use crate::exit::Exit;
use crate::interrupt;
use crate::scenario::Staged;
use crate::turns::Turns;
use agents::Housing;
use dsr::{AgentId, Graph, TypeId};
use executive::{Ending, Narration, Shell, Step, Turn, Wheel};
use hal::sim::{ClinicianScript, PatientScript, SimRoom};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::{broadcast, mpsc};
use tokio::time::Instant;

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
    /// How fast time passes.
    pub(super) speed: Speed,
    /// How often PELEA must turn on a clock that does not wait for it.
    pub(super) pulse: Option<Duration>,
}

impl Play {
    /// Runs the mission to its end.
    pub(super) async fn play(
        mut self,
        assembly: Assembly,
        report_file: Option<&Path>,
        console: &mut Console<'_>,
    ) -> Exit {
        let Assembly { graph, agents, wheel, writer, invariants, .. } = assembly;
        let wheel = self.horizon.iter().fold(wheel, |wheel, horizon| wheel.until(time(*horizon)));
        let wheel = self.pulse.iter().fold(wheel, |wheel, pulse| wheel.with_pulse(*pulse));
        let epoch = Instant::now();
        let room = self.room();
        let (reader, mut entries) = mpsc::unbounded_channel();
        let story = Story::new(&graph, reader);
        let mut guard = Guard::new(&invariants, &graph, epoch);
        let observed = story.clone();
        room.observe(move |moment| observed.tell(seconds(moment.at), What::Room(moment.event.clone())));

        let (steps, _) = broadcast::channel(64);
        // Each disruption must receive the steps of the plan before the first one starts.
        let cues = self.staged.as_mut().map(|staged| std::mem::take(&mut staged.cues)).unwrap_or_default();
        let cues = cues.into_iter().map(|cue| (cue, steps.subscribe())).collect();
        let stage = director::Stage { graph: graph.clone(), room: room.clone(), epoch };
        let environment = agents::Environment {
            graph: graph.clone(),
            equipment: agents::Equipment {
                devices: room.devices(),
                words: Arc::new(self.content.clone()),
                reporter: Arc::new(self.content.clone()),
            },
            clock: Arc::new(agents::TokioClock::start()),
            // Simulated time passes in this task alone: everything takes its turn here, and gives the same bytes.
            housing: if self.speed.is_simulated() { Housing::Together } else { Housing::Apart },
            absence: absence(&graph),
        };

        let mut teller = Teller::new(&self.content, self.staged.as_ref(), self.verbose, console);
        teller.heading();
        // The end of the mission is the graph as it is then; that the agents go afterwards is no part of it.
        let (ending, end) = {
            let (latency, turns) = (self.latency.clone(), self.turns.take());
            let pelea = pelea(
                Seat { graph: graph.clone(), writer, epoch },
                wheel,
                story.clone(),
                steps,
                latency,
                turns,
            );
            let agents = agents::run_all(agents, environment);
            let directed = async {
                director::direct(cues, stage).await;
                std::future::pending::<()>().await;
            };
            let mut pelea = std::pin::pin!(pelea);
            let mut agents = std::pin::pin!(agents);
            let mut directed = std::pin::pin!(directed);
            let mut time = std::pin::pin!(self.speed.pass_time());
            let mut interrupted = std::pin::pin!(interrupt::first());
            let ending = loop {
                tokio::select! {
                    biased;
                    Some(entry) = entries.recv() => teller.tell(&entry),
                    () = guard.alerted() => guard.look().into_iter().for_each(|b| story.alarm(b)),
                    () = story.alerted() => story.catch_up(),
                    ending = &mut pelea => break ending,
                    never = &mut agents => match never {},
                    () = &mut directed => {}
                    () = &mut interrupted => break Ending::Interrupted,
                    () = &mut time => {}
                }
            };
            story.catch_up();
            guard.end().into_iter().for_each(|broken| story.alarm(broken));
            (ending, graph.snapshot())
        };
        while let Ok(entry) = entries.try_recv() {
            teller.tell(&entry);
        }
        teller.end(&ending, &end, epoch.elapsed(), report_file)
    }

    /// The simulated room of the scenario.
    fn room(&self) -> SimRoom {
        let mission = &self.content.mission;
        match &self.staged {
            Some(Staged { scenario, .. }) => SimRoom::new(
                script::patient(mission, &scenario.patient, self.seed),
                script::clinician(&scenario.clinician),
            ),
            None => SimRoom::new(PatientScript::default(), ClinicianScript::default()),
        }
    }
}

/// The words for an agent that is gone, if the vocabulary has them: `(is ?agent absent)`.
fn absence(graph: &Graph) -> Option<agents::Absence> {
    let (vocabulary, state) = (graph.vocabulary(), "absent");
    let label = vocabulary.label("is")?;
    let for_agents = vocabulary.signatures(label).iter().any(|s| vocabulary.is_a(TypeId::AGENT, s.from));
    (for_agents && graph.snapshot().node(state).is_some())
        .then(|| agents::Absence { label, state: state.into() })
}

/// Where PELEA works.
struct Seat {
    graph: Graph,
    writer: AgentId,
    epoch: Instant,
}

/// PELEA on the real graph.
async fn pelea(
    Seat { graph, writer, epoch }: Seat,
    wheel: Wheel,
    story: Story,
    steps: broadcast::Sender<Step>,
    mut latency: Latency,
    mut turns: Option<Turns>,
) -> Ending {
    let tell = move |time: dsr::Time, narration: Narration| {
        if let Narration::Started { step, .. } = &narration {
            // Without a disruption that waits for a step there is no receiver.
            let _ = steps.send(step.clone());
        }
        story.tell(seconds(Duration::from_nanos(time.0)), What::Pelea(narration));
    };
    let latency = move |_| latency.next();
    let record = move |turn: &Turn<'_>| {
        if let Some(turns) = &mut turns {
            turns.note(turn);
        }
    };
    Shell { graph, writer, epoch, tell, latency, record }.run(wheel).await
}

fn time(after: Duration) -> dsr::Time {
    dsr::Time(u64::try_from(after.as_nanos()).unwrap_or(u64::MAX))
}
