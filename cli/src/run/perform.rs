//! One run of a mission on simulated devices: everything that takes turns, in one task, without a console.
//!
//! `pelea run` and `pelea campaign` perform the same run; they differ in who listens. An audience gets what PELEA decides,
//! what happens in the room, and which invariants are broken. Whoever wants the graph as well subscribes to it.

use super::content::Content;
use super::guard::Guard;
use super::latency::Latency;
use super::past::Past;
use super::room::RoomLog;
use super::{director, script};
use crate::assemble::Assembly;
use crate::scenario::Cue;
use crate::turns::Turns;
use agents::Housing;
use dsr::{AgentId, Graph, Snapshot, TypeId, Version};
use executive::{Ending, Lasting, Narration, Shell, Step, Turn, Wheel};
use hal::sim::{ClinicianScript, PatientScript, RoomEvent, SimRoom};
use mission::scenario::Scenario;
use safety::Broken;
use std::collections::BTreeSet;
use std::future::pending;
use std::pin::pin;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::broadcast;
use tokio::time::Instant;

/// Receives what happens, in order.
pub(crate) trait Audience: Clone + Send + Sync + 'static {
    /// An event in the room, at a time after the start.
    fn room(&self, at: Duration, event: &RoomEvent);
    /// A decision of PELEA, at a time after the start.
    fn pelea(&self, at: Duration, narration: Narration);
    /// A broken invariant.
    fn alarm(&self, broken: Broken);
    /// The run is over; what the agents write now is no part of it.
    fn ended(&self) {}
}

/// What is performed.
pub(crate) struct Production<'a> {
    /// The mission and its language.
    pub(crate) content: Content,
    /// The patient and the clinician; without one they are the room's own.
    pub(crate) scenario: Option<&'a Scenario>,
    /// The disruptions.
    pub(crate) cues: Vec<Cue>,
    /// Varies the person's delays.
    pub(crate) seed: u64,
    /// When the run ends whatever happens, if ever.
    pub(crate) horizon: Option<Duration>,
    /// How long a decision takes at least.
    pub(crate) latency: Latency,
    /// How often PELEA must turn on a clock that does not wait for it.
    pub(crate) pulse: Option<Duration>,
    /// Where every turn of PELEA is recorded, if anywhere.
    pub(crate) turns: Option<Turns>,
    /// Where the agents live.
    pub(crate) housing: Housing,
    /// What is kept on disk.
    pub(crate) kept: Kept,
    /// What was before a restart.
    pub(crate) past: Option<Past>,
}

/// What a run keeps on disk beside its turns.
#[derive(Default)]
pub(crate) struct Kept {
    /// Waits until a version of the graph is on disk; `None` without a journal.
    pub(crate) disk: Option<Arc<dyn Fn(Version) + Send + Sync>>,
    /// What happens in the room.
    pub(crate) room: RoomLog,
    /// The name of the run.
    pub(crate) run: String,
}

/// What came of it.
pub(crate) struct Performed {
    /// How it ended.
    pub(crate) ending: Ending,
    /// The graph in the end.
    pub(crate) snapshot: Snapshot,
    /// How long it took.
    pub(crate) elapsed: Duration,
    /// The disruptions that happened, by their numbers.
    pub(crate) begun: BTreeSet<usize>,
}

/// Performs a run. `first` takes its turn before all others, whether it ends or not; `last` after them, and its end is that
/// of the run.
pub(crate) async fn perform(
    production: Production<'_>,
    assembly: Assembly,
    audience: impl Audience,
    first: impl Future<Output = ()>,
    last: impl Future<Output = Ending>,
) -> Performed {
    let Production { content, scenario, cues, seed, horizon, latency, pulse, turns, housing, kept, past } =
        production;
    let wheel = assembly.wheel();
    let Assembly { graph, agents, writer, invariants, lasting, .. } = assembly;
    let wheel = horizon.iter().fold(wheel, |wheel, horizon| wheel.until(time(*horizon)));
    let wheel = pulse.iter().fold(wheel, |wheel, pulse| wheel.with_pulse(*pulse));
    let Past { elapsed, guard, broken, happened } = past.unwrap_or_default();
    // A clock that began less than that long ago cannot name its own past; then the run's time begins anew.
    let epoch = Instant::now().checked_sub(elapsed).unwrap_or_else(Instant::now);
    let room = room(&content, scenario, seed, epoch);
    room.go_on_after(&happened.moments);
    let mut guard = match guard {
        Some(guard) => guard.since(epoch),
        None => Guard::new(&invariants, &graph, epoch),
    };
    broken.into_iter().for_each(|broken| audience.alarm(broken));
    let (observer, log) = (audience.clone(), kept.room.clone());
    room.observe(move |moment| {
        log.moment(moment);
        observer.room(moment.at, &moment.event);
    });

    let (steps, _) = broadcast::channel(64);
    // Each disruption must receive the steps of the plan before the first one starts.
    let cues = cues.into_iter().map(|cue| (cue, steps.subscribe())).collect();
    let begun = director::Begun::default();
    let simulated = housing == Housing::Together;
    let stage = director::Stage {
        graph: graph.clone(),
        room: room.clone(),
        epoch,
        log: kept.room,
        happened: Arc::new(happened),
        begun: begun.clone(),
        simulated,
    };
    let content = Arc::new(content);
    let environment = agents::Environment {
        graph: graph.clone(),
        equipment: agents::Equipment {
            devices: room.devices(),
            words: content.clone(),
            reporter: content.clone(),
            run: kept.run.into(),
        },
        clock: Arc::new(agents::TokioClock::since(epoch)),
        housing,
        absence: absence(&graph),
    };
    // The end of the run is the graph as it is then; that the agents go afterwards is no part of it.
    let (ending, snapshot) = {
        let lasting = Lasting { labels: lasting, disk: kept.disk };
        let seat =
            Seat { graph: graph.clone(), writer, epoch, gives_way: housing == Housing::Apart, lasting };
        let pelea = pelea(seat, wheel, audience.clone(), steps, (latency, turns));
        let agents = agents::run_all(agents, environment);
        let directed = forever(director::direct(cues, stage));
        let (mut first, mut last) = (pin!(forever(first)), pin!(last));
        let mut pelea = pin!(pelea);
        let (mut agents, mut directed) = (pin!(agents), pin!(directed));
        let ending = loop {
            tokio::select! {
                biased;
                () = &mut first => {}
                () = guard.alerted() => guard.look().into_iter().for_each(|broken| audience.alarm(broken)),
                ending = &mut pelea => break ending,
                never = &mut agents => match never {},
                () = &mut directed => {}
                ending = &mut last => break ending,
            }
        };
        let goes_on = !matches!(ending, Ending::Accomplished | Ending::WithHuman { .. });
        guard.end(goes_on).into_iter().for_each(|broken| audience.alarm(broken));
        audience.ended();
        (ending, graph.snapshot())
    };
    Performed { ending, snapshot, elapsed: epoch.elapsed(), begun: begun.numbers() }
}

async fn forever(work: impl Future<Output = ()>) {
    work.await;
    pending::<()>().await;
}

/// The simulated room of the scenario.
fn room(content: &Content, scenario: Option<&Scenario>, seed: u64, started: Instant) -> SimRoom {
    match scenario {
        Some(scenario) => SimRoom::since(
            started,
            script::patient(&content.mission, &scenario.patient, seed),
            script::clinician(&scenario.clinician),
        ),
        None => SimRoom::since(started, PatientScript::default(), ClinicianScript::default()),
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
    gives_way: bool,
    lasting: Lasting,
}

/// PELEA on the real graph.
async fn pelea(
    Seat { graph, writer, epoch, gives_way, lasting }: Seat,
    wheel: Wheel,
    audience: impl Audience,
    steps: broadcast::Sender<Step>,
    (mut latency, mut turns): (Latency, Option<Turns>),
) -> Ending {
    let tell = move |time: dsr::Time, narration: Narration| {
        if let Narration::Started { step, .. } = &narration {
            // Without a disruption that waits for a step there is no receiver.
            let _ = steps.send(step.clone());
        }
        audience.pelea(Duration::from_nanos(time.0), narration);
    };
    let latency = move |_| latency.next();
    let record = move |turn: &Turn<'_>| {
        if let Some(turns) = &mut turns {
            turns.note(turn);
        }
    };
    Shell { graph, writer, epoch, tell, latency, record, gives_way, lasting }.run(wheel).await
}

fn time(after: Duration) -> dsr::Time {
    dsr::Time(u64::try_from(after.as_nanos()).unwrap_or(u64::MAX))
}
