//! From a commit to a silent loudspeaker, on the real clock: the person is lost while the robot speaks.
//!
//! In one run: how long until the device is stopped, and until a bare subscriber in a thread of its own is awake, which
//! the operating system alone decides. Alone, and beside programs of lower priority that plan on every core. That the
//! robot no longer *is speaking* in the graph needs no time: each round checks that the same version says so.
//!
//!     cargo bench -p pelea-agents --bench reaction

#![allow(clippy::unwrap_used, reason = "a bench stops by panicking")]
#![allow(clippy::print_stdout, reason = "the figures are what it is for")]

use agents::{Agent, Environment, Equipment, Housing, Reporter, TokioClock, Words, compile, run_all, skills};
use dsr::{AgentId, Graph, Snapshot, Time, Transaction};
use hal::sim::{ClinicianScript, PatientScript, SimRoom};
use hal::{Evidence, Operation, SpeechOut};
use pddl::{Source, parse_domain, parse_problem};
use std::collections::HashMap;
use std::env;
use std::hint::black_box;
use std::process::{Child, Command};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::{available_parallelism, spawn};
use std::time::{Duration, Instant};
use vocabulary::Tokens;

const ROUNDS: usize = 2_000;

/// The argument that makes this program the load.
const LOAD: &str = "--load";

const WORDS: &str = "(define (domain ward)
  (:requirements :typing :vocabulary)
  (:types symbol agent resource - object  robot person state remark - symbol)
  (:constants speech - agent speaking - state)
  (:predicates (wants ?r - robot ?u - remark) (is ?r - robot ?s - state) (is_with ?p - person ?r - robot))
  (:writes speech (is _ speaking) wants))";

const RULES: &str = "(define (domain speech)
  (:requirements :typing :durative-actions :agent-rules)
  (:import ward)
  (:durative-action say
    :parameters (?r - robot ?p - person ?u - remark)
    :condition (and (over all (wants ?r ?u)) (over all (is_with ?p ?r)))
    :effect (and (at start (is ?r speaking)) (at end (not (is ?r speaking))) (at abort (not (is ?r speaking)))
                 (at failure (not (is ?r speaking))))
    :skill (say ?r ?u)))";

const WORLD: &str = "(define (problem world) (:domain ward)
  (:objects clarc - robot ann - person greeting - remark) (:init (wants clarc greeting)) (:goal (and)))";

/// A loudspeaker that speaks until it is stopped, and reports both.
struct Loudspeaker {
    started: Sender<()>,
    stopped: Sender<Instant>,
}

/// The stop, which the drop of an operation is.
struct Stop(Sender<Instant>);

impl Drop for Stop {
    fn drop(&mut self) {
        let _ = self.0.send(Instant::now());
    }
}

impl SpeechOut for Loudspeaker {
    fn say<'a>(&'a self, _: &'a str, _: &'a str) -> Operation<'a, Evidence> {
        Box::pin(async {
            let _stop = Stop(self.stopped.clone());
            let _ = self.started.send(());
            std::future::pending().await
        })
    }
}

struct OneSentence;

impl Words for OneSentence {
    fn language(&self) -> &str {
        "en"
    }

    fn sentence(&self, _: &str, _: &str) -> Option<String> {
        Some("Good morning.".into())
    }

    fn options(&self, _: &str) -> Vec<(String, String)> {
        Vec::new()
    }

    fn request_words(&self, _: &str) -> Vec<String> {
        Vec::new()
    }
}

impl Reporter for OneSentence {
    fn report(&self, _: &str, _: &Snapshot) -> Option<serde_json::Value> {
        None
    }
}

/// A graph and the agent of its loudspeaker.
fn ward() -> (Graph, Arc<Agent>) {
    let words = parse_domain(&Source::new("ward", WORDS), &[]).model.unwrap();
    let tokens = Tokens::new(&words).unwrap();
    let rules = parse_domain(&Source::new("speech", RULES), &[&words]).model.unwrap();
    let agent = compile(&rules, &tokens, &skills::standard()).unwrap();
    let world = parse_problem(&Source::new("world", WORLD), &words).model.unwrap();
    (tokens.populate(&[&world], Time(0)).unwrap(), agent.into())
}

/// Agents as they live on a robot, until the sender goes.
fn live(graph: &Graph, agent: Arc<Agent>, loudspeaker: Loudspeaker) -> tokio::sync::oneshot::Sender<()> {
    let room = SimRoom::new(PatientScript::default(), ClinicianScript::default());
    let mut devices = room.devices();
    devices.speech_out = Arc::new(loudspeaker);
    let words = Arc::new(OneSentence);
    let equipment = Equipment { devices, words: words.clone(), reporter: words, run: "run".into() };
    let graph = graph.clone();
    let (stop, stopped) = tokio::sync::oneshot::channel::<()>();
    spawn(move || {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_time().build().unwrap();
        runtime.block_on(async {
            let clock = Arc::new(TokioClock::start());
            let environment = Environment { graph, equipment, clock, housing: Housing::Apart, absence: None };
            tokio::select! {
                never = run_all(vec![agent], environment) => match never {},
                _ = stopped => {}
            }
        });
    });
    stop
}

/// A thread that only wakes up.
fn sleeper(graph: &Graph) -> Receiver<Instant> {
    let subscription = graph.subscribe_deltas();
    let (wake, woken) = channel();
    subscription.on_wake(move || _ = wake.send(()));
    let (sender, receiver) = channel();
    spawn(move || {
        while woken.recv().is_ok() {
            let now = Instant::now();
            while subscription.try_recv().is_some() {}
            if sender.send(now).is_err() {
                return;
            }
        }
    });
    receiver
}

/// How long the device and the bare subscriber took, round by round.
fn measure() -> [Vec<Duration>; 2] {
    let (graph, agent) = ward();
    let (started, speaking) = channel();
    let (stopped, silent) = channel();
    let awake = sleeper(&graph);
    let _living = live(&graph, agent, Loudspeaker { started, stopped });
    let (with, is) = (graph.vocabulary().label("is_with").unwrap(), graph.vocabulary().label("is").unwrap());
    let (robot, state) =
        (graph.snapshot().node("clarc").unwrap(), graph.snapshot().node("speaking").unwrap());
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..ROUNDS {
        let mut comes = Transaction::new(AgentId::DSR);
        comes.add_edge("ann", with, "clarc");
        graph.commit(&comes, Time(0)).unwrap();
        speaking.recv().unwrap();
        while awake.try_recv().is_ok() {}
        let mut goes = Transaction::new(AgentId::DSR);
        goes.remove_edge("ann", with, "clarc");
        let begin = Instant::now();
        graph.commit(&goes, Time(0)).unwrap();
        let snapshot = graph.snapshot();
        assert!(!snapshot.has_edge(robot, is, state), "the commit that loses the person ends the speech");
        times[0].push(silent.recv().unwrap() - begin);
        times[1].push(awake.recv().unwrap().saturating_duration_since(begin));
    }
    times
}

fn print(what: &str, mut times: Vec<Duration>) {
    times.sort_unstable();
    let at = |percent: usize| times[(times.len() - 1) * percent / 100];
    println!("  {what}: p50 {:?}, p90 {:?}, p99 {:?}, most {:?}", at(50), at(90), at(99), at(100));
}

fn report(title: &str) {
    println!("{title}");
    let [device, bare] = measure();
    print("device stopped    ", device);
    print("bare subscriber   ", bare);
}

/// Work as a planner does it: hashing, allocating, reading memory at random.
fn load() -> ! {
    let mut table: HashMap<u64, Vec<u64>> = HashMap::new();
    for round in 0_u64.. {
        let key = round.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 44;
        table.entry(key).or_default().push(round);
        if table.len() > 500_000 {
            black_box(std::mem::take(&mut table));
        }
    }
    unreachable!("the numbers do not end")
}

/// A program of lower priority, ended on drop.
struct Busy(Child);

impl Busy {
    fn start() -> Self {
        Self(
            Command::new("nice")
                .args(["-n", "10"])
                .arg(env::current_exe().unwrap())
                .arg(LOAD)
                .spawn()
                .unwrap(),
        )
    }
}

impl Drop for Busy {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn main() {
    if env::args().any(|argument| argument == LOAD) {
        load();
    }
    report(&format!("alone, {ROUNDS} rounds"));
    let cores = available_parallelism().map_or(1, usize::from);
    let _busy: Vec<Busy> = (0..cores).map(|_| Busy::start()).collect();
    report(&format!("beside {cores} busy programs of lower priority, {ROUNDS} rounds"));
}
