//! Panics and hangs of skills and of agents: each harms itself alone, and is seen in the graph.
#![allow(clippy::unwrap_used, reason = "a test")]

mod common;

use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use agents::{
    Absence, Agent, Call, Clock, Ended, Environment, Equipment, Housing, Outcome, Reporter, Signature, Skill,
    TokioClock, Words, Work, compile, run_all, skills,
};
use common::{Lab, domain, root};
use dsr::{Graph, Snapshot, Time};
use hal::sim::{ClinicianScript, PatientScript, SimRoom};
use tokio::time::sleep;

struct NoWords;

impl Words for NoWords {
    fn language(&self) -> &str {
        "en"
    }

    fn sentence(&self, _: &str, _: &str) -> Option<String> {
        None
    }

    fn options(&self, _: &str) -> Vec<(String, String)> {
        vec![("hello".into(), "hello".into())]
    }

    fn request_words(&self, _: &str) -> Vec<String> {
        Vec::new()
    }
}

impl Reporter for NoWords {
    fn report(&self, _: &str, _: &Snapshot) -> Option<serde_json::Value> {
        None
    }
}

/// A skill `say` that misbehaves by what is to be said.
struct Rogue {
    release: Mutex<Option<Receiver<()>>>,
}

impl Skill for Rogue {
    fn signature(&self) -> Signature {
        Signature {
            name: "say",
            arguments: &["part", "utterance"],
            results: &[],
            outcomes: &[Outcome::FAILURE],
        }
    }

    fn launch(&self, call: Call, _: &Equipment) -> Work {
        let said = call.argument(1).to_owned();
        assert_ne!(said, "goodbye", "a driver's mistake at once");
        let release = self.release.lock().unwrap().take();
        Box::pin(async move {
            if let Some(release) = release {
                // A driver that blocks its thread.
                let _ = release.recv();
            }
            assert_ne!(said, "hello", "a driver's mistake later");
            Ended::well(Vec::new())
        })
    }
}

/// A clock that makes the loop that asks it panic, or hang until it is released.
struct Faulty {
    inner: TokioClock,
    fault: AtomicU8,
    release: Mutex<Receiver<()>>,
}

const PANIC: u8 = 1;
const HANG: u8 = 2;

impl Clock for Faulty {
    fn now(&self) -> Time {
        match self.fault.swap(0, Ordering::SeqCst) {
            PANIC => panic!("an agent's mistake"),
            HANG => _ = self.release.lock().unwrap().recv(),
            _ => {}
        }
        self.inner.now()
    }
}

struct Stage {
    lab: Lab,
    environment: Environment,
    clock: Arc<Faulty>,
    /// Dropping or using it releases what hangs.
    release: Sender<()>,
}

impl Stage {
    fn new(housing: Housing) -> Self {
        let lab = Lab::new();
        let room = SimRoom::new(PatientScript::default(), ClinicianScript::default());
        let words = Arc::new(NoWords);
        let equipment =
            Equipment { devices: room.devices(), words: words.clone(), reporter: words, run: "run".into() };
        let (release, released) = channel();
        let fault = AtomicU8::new(0);
        let clock = Arc::new(Faulty { inner: TokioClock::start(), fault, release: Mutex::new(released) });
        let label = lab.tokens.label("is_gone").unwrap();
        let absence = Some(Absence { label, state: "absent".into() });
        let graph = lab.graph.clone();
        let environment = Environment { graph, equipment, clock: clock.clone(), housing, absence };
        Self { lab, environment, clock, release }
    }

    /// The talker, with a rogue loudspeaker.
    fn rogue(&self, release: Option<Receiver<()>>) -> Arc<Agent> {
        let rules = domain(&root().join("test_data/ok/talker.pddl"), &[&self.lab.words]);
        let skills = skills::standard().with(Rogue { release: Mutex::new(release) });
        Arc::new(compile(&rules, &self.lab.tokens, &skills).unwrap())
    }

    fn holds(&self, sentence: &str) -> bool {
        self.lab.graph.snapshot().sentences().iter().any(|held| held == sentence)
    }

    /// Runs agents on a clock that runs, while `act` happens on this thread.
    fn play(&self, agents: Vec<Arc<Agent>>, act: impl FnOnce()) {
        let (stop, stopped) = tokio::sync::oneshot::channel::<()>();
        let environment = self.environment.clone();
        let playing = std::thread::spawn(move || {
            let runtime = tokio::runtime::Builder::new_current_thread().enable_time().build().unwrap();
            runtime.block_on(async {
                tokio::select! {
                    never = run_all(agents, environment) => match never {},
                    _ = stopped => {}
                }
            });
        });
        act();
        drop(stop);
        playing.join().unwrap();
    }
}

/// Waits until a state of the graph is as wanted.
#[track_caller]
fn until(graph: &Graph, wanted: impl Fn(&[String]) -> bool) {
    let (wake, woken) = channel();
    let deltas = graph.subscribe_deltas();
    deltas.on_wake(move || _ = wake.send(()));
    let holds = || wanted(&graph.snapshot().sentences());
    while !holds() {
        let waited = woken.recv_timeout(Duration::from_secs(30));
        assert!(waited.is_ok() || holds(), "never: {:#?}", graph.snapshot().sentences());
        while deltas.try_recv().is_some() {}
    }
}

fn has(sentence: &str) -> impl Fn(&[String]) -> bool {
    move |held| held.iter().any(|held| held == sentence)
}

fn lacks(sentence: &str) -> impl Fn(&[String]) -> bool {
    move |held| !held.iter().any(|held| held == sentence)
}

#[tokio::test(start_paused = true)]
async fn a_skill_that_panics_fails_and_harms_no_other() {
    let stage = Stage::new(Housing::Together);
    let agents = [stage.rogue(None), stage.lab.agent("watcher")];
    tokio::select! {
        biased;
        never = run_all(agents, stage.environment.clone()) => match never {},
        () = async {
            stage.lab.direct(&["+robot shall_ask person"], 0);
            sleep(Duration::from_millis(100)).await;
            for said in ["hello", "goodbye"] {
                stage.lab.direct(&[&format!("+robot shall_say {said}")], 0);
                sleep(Duration::from_millis(100)).await;
                assert!(stage.holds("robot shall say hello"));
                assert!(!stage.holds("robot is speaking"));
                assert!(stage.holds("robot waits for person"), "the other skill still runs");
                assert!(!stage.holds("talker is gone absent"), "and so does the agent");
            }
        } => {}
    }
}

#[test]
fn a_driver_that_blocks_its_thread_holds_up_neither_agent_nor_end() {
    let stage = Stage::new(Housing::Apart);
    let (release, released) = channel();
    stage.play(vec![stage.rogue(Some(released))], || {
        stage.lab.direct(&["+robot shall_say fire"], 0);
        until(&stage.lab.graph, has("robot is speaking"));
        // The reflex stops it, although the driver does not listen; and the agent goes on.
        stage.lab.direct(&["-person is_with robot", "-robot shall_say fire"], 0);
        until(&stage.lab.graph, lacks("robot is speaking"));
        stage.lab.direct(&["+robot shall_ask person"], 0);
        until(&stage.lab.graph, has("robot waits for person"));
        release.send(()).unwrap();
    });
}

#[tokio::test(start_paused = true)]
async fn an_agent_that_panics_is_absent_and_begins_again() {
    let stage = Stage::new(Housing::Together);
    tokio::select! {
        biased;
        never = run_all([stage.lab.agent("watcher"), stage.lab.agent("talker")], stage.environment.clone()) => match never {},
        () = async {
            stage.lab.direct(&["+robot shall_ask person"], 0);
            sleep(Duration::from_millis(100)).await;
            assert!(stage.holds("robot waits for person"));
            stage.clock.fault.store(PANIC, Ordering::SeqCst);
            // Concerns the talker alone.
            stage.lab.direct(&["+robot shall_say hello"], 0);
            sleep(Duration::from_millis(100)).await;
            assert!(stage.holds("talker is gone absent"));
            assert!(!stage.holds("robot waits for person"), "its reflexes have fired");
            stage.lab.direct(&["+robot shall_ask person"], 1);
            sleep(Duration::from_secs(1)).await;
            assert!(!stage.holds("talker is gone absent"));
            assert!(stage.holds("robot waits for person"), "it begins again where the graph is");
        } => {}
    }
    assert!(stage.holds("talker is gone absent"), "dropping is the same path");
    assert!(!stage.holds("robot waits for person"));
}

#[test]
fn an_agent_that_hangs_is_declared_dead_and_can_no_longer_write() {
    let stage = Stage::new(Housing::Apart);
    stage.play(vec![stage.lab.agent("talker")], || {
        let graph = &stage.lab.graph;
        stage.lab.direct(&["+robot shall_ask person"], 0);
        until(graph, has("robot waits for person"));
        stage.clock.fault.store(HANG, Ordering::SeqCst);
        stage.lab.direct(&["+robot shall_say hello"], 0);
        until(graph, has("talker is gone absent"));
        assert!(!stage.holds("robot waits for person"));
        // Its successor begins; then the old loop goes on, and writes nothing.
        until(graph, lacks("talker is gone absent"));
        stage.lab.direct(&["+robot shall_ask person"], 1);
        until(graph, has("robot waits for person"));
        stage.release.send(()).unwrap();
    });
    assert!(stage.holds("talker is gone absent"));
}
