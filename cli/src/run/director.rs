//! Triggers the scenario's disruptions when they are due.
//!
//! A trigger is a time, a condition on the graph, or a step of the plan. When it occurs, the
//! director waits `after` seconds and applies the disruption to the room. The room does not know
//! the scenario.

use super::room::{Happened, RoomLog};
use super::script;
use crate::scenario::{Cue, Watch};
use dsr::{AgentId, Graph, Time};
use executive::Step;
use futures::future::join_all;
use hal::Device;
use hal::sim::{Behaviour, By, SimRoom};
use mission::scenario::{self, Act, Disruption, Token, Trigger};
use std::collections::{BTreeMap, BTreeSet};
use std::future::pending;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use tokio::sync::{Notify, broadcast};
use tokio::time::{Instant, advance, sleep, sleep_until};

/// The input of the director.
#[derive(Clone)]
pub(super) struct Stage {
    pub(super) graph: Graph,
    pub(super) room: SimRoom,
    pub(super) epoch: Instant,
    pub(super) log: RoomLog,
    /// What happened before a restart.
    pub(super) happened: Arc<Happened>,
    /// The disruptions that have begun since.
    pub(super) begun: Begun,
    /// Whether time waits for what is done.
    pub(super) simulated: bool,
}

impl Stage {
    fn now(&self) -> Time {
        Time(u64::try_from(self.epoch.elapsed().as_nanos()).unwrap_or(u64::MAX))
    }
}

/// The disruptions that have begun, by their numbers.
#[derive(Clone, Default)]
pub(super) struct Begun(Arc<Mutex<BTreeSet<usize>>>);

impl Begun {
    fn note(&self, number: usize) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).insert(number);
    }

    /// The numbers so far.
    pub(super) fn numbers(&self) -> BTreeSet<usize> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

/// Runs until every disruption was applied. Its receivers must exist before the first step starts.
pub(super) async fn direct(cues: Vec<(Cue, broadcast::Receiver<Step>)>, stage: Stage) {
    ask_on(&cues.iter().map(|(cue, _)| cue).collect::<Vec<_>>(), &stage);
    let cues = cues.into_iter().enumerate();
    join_all(cues.map(|(number, (cue, steps))| follow(number, cue, steps, &stage))).await;
}

/// Who asked for something before a restart, and was not heard, goes on asking.
fn ask_on(cues: &[&Cue], stage: &Stage) {
    let begun = stage.happened.begun().filter_map(|number| cues.get(number)).map(|cue| &cue.disruption.act);
    let mut asked: BTreeMap<&str, Vec<&Act>> = BTreeMap::new();
    for act in begun {
        if let Act::Ask { request, .. } = act {
            asked.entry(request).or_default().push(act);
        }
    }
    for (request, acts) in asked {
        acts.into_iter().skip(stage.happened.taken(request)).for_each(|act| carry_out(act, stage));
    }
}

async fn follow(number: usize, cue: Cue, steps: broadcast::Receiver<Step>, stage: &Stage) {
    if let Some((at, over)) = stage.happened.began(number) {
        return match over {
            true => (),
            false => last(number, &cue.disruption, stage.epoch + at, stage).await,
        };
    }
    let begin = move |stage: &Stage, act: &Act| {
        stage.log.began(number, stage.epoch.elapsed());
        stage.begun.note(number);
        carry_out(act, stage);
    };
    match &cue.disruption.trigger {
        Trigger::At(time) => sleep_until(stage.epoch + *time).await,
        Trigger::When { occurrence, .. } => {
            let condition = cue.condition.as_ref().expect("a `when` is compiled");
            appears(condition, *occurrence, &stage.graph).await;
        }
        Trigger::Version(version) if cue.disruption.after.is_zero() => {
            let (act, staged) = (cue.disruption.act.clone(), stage.clone());
            reaches(*version, &stage.graph, move || begin(&staged, &act)).await;
            return last(number, &cue.disruption, Instant::now(), stage).await;
        }
        Trigger::Version(version) => reaches(*version, &stage.graph, || ()).await,
        // A campaign has replaced it.
        Trigger::Instant => {}
        Trigger::Step { step, occurrence } => starts(step, *occurrence, steps).await,
    }
    sleep(cue.disruption.after).await;
    begin(stage, &cue.disruption.act);
    last(number, &cue.disruption, Instant::now(), stage).await;
}

/// Ends a fault that does not last for ever, and repeats what happens more than once.
async fn last(number: usize, disruption: &Disruption, began: Instant, stage: &Stage) {
    let (mut began, mut left) =
        (began, disruption.repeats.map_or(0, |r| r.times.map_or(u32::MAX, |n| n - 1)));
    loop {
        match &disruption.act {
            Act::Disturb { device, lasts: Some(lasts), .. } => {
                sleep_until(began + *lasts).await;
                if left == 0 {
                    stage.log.over(number, stage.epoch.elapsed());
                }
                stage.room.recover(hardware(*device));
            }
            // All timers of that time are due at once. A clock that runs waits for nobody: `kill -STOP` does it there.
            Act::Stop { lasts } if stage.simulated => advance(*lasts).await,
            _ => {}
        }
        let Some(repeats) = disruption.repeats.filter(|_| left > 0) else { return };
        left -= 1;
        began += repeats.every;
        // What was due before a restart is not made up for.
        if began >= Instant::now() {
            sleep_until(began).await;
            carry_out(&disruption.act, stage);
        }
    }
}

/// Waits until the graph has this version. `then` is called before the commit that makes it returns, so that no agent has
/// acted on the version yet.
async fn reaches(version: u64, graph: &Graph, then: impl Fn() + Send + Sync + 'static) {
    let reached = Arc::new(Notify::new());
    let (notify, done, seen) = (reached.clone(), AtomicBool::new(false), graph.clone());
    let deltas = graph.subscribe_deltas_with(NonZeroUsize::MIN);
    deltas.on_wake(move || {
        // What `then` commits comes here again.
        if seen.snapshot().version().0 >= version && !done.swap(true, Ordering::SeqCst) {
            then();
            notify.notify_one();
        }
    });
    reached.notified().await;
}

/// Waits until the condition has become true for the nth time.
async fn appears(condition: &Watch, occurrence: u32, graph: &Graph) {
    let news = Arc::new(Notify::new());
    let (interest, alternatives) = condition.interest();
    let mut subscription = graph.subscribe_to(interest);
    let wake = news.clone();
    subscription.on_wake(move || wake.notify_one());
    let mut left = occurrence;
    let mut held = false;
    loop {
        while subscription.try_recv().is_some() {
            let holds = alternatives.iter().any(|&pattern| !subscription.held(pattern).is_empty());
            left -= u32::from(holds && !held);
            held = holds;
            if left == 0 {
                return;
            }
        }
        news.notified().await;
    }
}

/// Waits until PELEA has started the step for the nth time.
async fn starts(wanted: &scenario::Step, occurrence: u32, mut steps: broadcast::Receiver<Step>) {
    let mut left = occurrence;
    while left > 0 {
        match steps.recv().await {
            Ok(step) => {
                left -= u32::from(step.action == wanted.name && step.arguments == wanted.names);
            }
            Err(broadcast::error::RecvError::Lagged(_)) => {}
            Err(broadcast::error::RecvError::Closed) => pending().await,
        }
    }
}

fn carry_out(act: &Act, stage: &Stage) {
    let room = &stage.room;
    match act {
        Act::LosePerson => room.lose_person(),
        Act::ReturnPerson => room.return_person(),
        Act::VisitorComes { person } => room.visitor_comes(person),
        Act::VisitorGoes { person } => room.visitor_goes(person),
        Act::Ask { request, person, by } => {
            // Who asks by both asks by whatever works.
            let by = by.map(script::manner).filter(|by| *by != By::Both);
            room.ask_by(request, person.as_deref().unwrap_or_default(), by);
        }
        Act::Answer(reply) => room.will_answer(script::reply(reply)),
        Act::Pause => room.command("pause"),
        Act::Resume => room.command("resume"),
        Act::Abort => room.command("abort"),
        Act::Disturb { device, fault, .. } => room.behave(hardware(*device), behaviour(*fault)),
        Act::Recover(device) => room.recover(hardware(*device)),
        Act::Kill { agent } => kill(agent, stage),
        // Time passes in `last`.
        Act::Stop { .. } => {}
        Act::Flip(token) => flip(token, stage),
        // A campaign has chosen one.
        Act::FlipOneOf(_) => {}
    }
}

/// Declares an agent dead: what it still writes is refused, and its supervisor begins it again.
fn kill(agent: &str, stage: &Stage) {
    if let Some(agent) = stage.graph.vocabulary().agent(agent) {
        // It is no agent of the graph only if it never lived.
        let _ = stage.graph.expire(agent, stage.now());
    }
}

/// Removes or adds a token, as no agent may: what a confused agent or a bug of ours would do.
fn flip(Token { label, ends: [from, to] }: &Token, stage: &Stage) {
    let snapshot = stage.graph.snapshot();
    let nodes = (snapshot.node(from), snapshot.vocabulary().label(label), snapshot.node(to));
    let (Some(from), Some(label), Some(to)) = nodes else { return };
    // The graph may refuse a token that its limits exclude; then nothing happens.
    let _ = stage.graph.edit(AgentId::DSR, stage.now(), |transaction| {
        if snapshot.has_edge(from, label, to) {
            transaction.remove_edge(from, label, to);
        } else {
            transaction.add_edge(from, label, to);
        }
    });
}

fn hardware(device: scenario::Device) -> Device {
    match device {
        scenario::Device::Speaker => Device::SpeechOut,
        scenario::Device::Screen => Device::Screen,
        scenario::Device::Microphone => Device::SpeechIn,
        scenario::Device::Touch => Device::Buttons,
        scenario::Device::Tracker => Device::Skeleton,
        scenario::Device::Console => Device::Clinic,
    }
}

fn behaviour(fault: scenario::Fault) -> Behaviour {
    match fault {
        scenario::Fault::Fail => Behaviour::Fails,
        scenario::Fault::Lie => Behaviour::Lies,
        scenario::Fault::Stall => Behaviour::Stalls,
        scenario::Fault::Slow => Behaviour::Slow,
        scenario::Fault::Refuse => Behaviour::Refuses,
        scenario::Fault::Panic => Behaviour::Panics,
    }
}
