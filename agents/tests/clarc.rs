//! The real rules: they compile against the real vocabulary, and carry a person through the moments of a test,
//! on the nodes of every domain, whatever they are called there.
#![allow(clippy::unwrap_used, reason = "a test")]

mod common;

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use agents::{Agent, Clock, Environment, Equipment, Housing, Reporter, TokioClock, Words, compile, run_all};
use common::{domain, root, source};
use dsr::{Graph, NodeId, Snapshot, Time, Transaction};
use hal::Device;
use hal::sim::{ClinicianScript, PatientScript, RoomEvent, SimRoom};
use pddl::parse_problem;
use tokio::time::sleep;
use vocabulary::{FunctionToken, Tokens};

fn folder(path: &str) -> Vec<PathBuf> {
    let mut paths: Vec<_> =
        fs::read_dir(root().join("..").join(path)).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

#[test]
fn every_agent_of_every_robot_compiles() {
    let mut count = 0;
    for robot in folder("robots") {
        let words = domain(&robot.join("vocabulary.pddl"), &[]);
        let tokens = Tokens::new(&words).unwrap();
        for file in fs::read_dir(robot.join("agents")).unwrap().map(|file| file.unwrap().path()) {
            let rules = domain(&file, &[&words]);
            let agent = compile(&rules, &tokens, &agents::skills::standard())
                .unwrap_or_else(|errors| panic!("{}: {errors:#?}", file.display()));
            assert!(agent.rule_names().count() > 0);
            count += 1;
        }
    }
    assert!(count > 0, "no agent was found");
}

/// CLARC with a test's nodes, and a hand that writes what PELEA would.
struct Session {
    tokens: Tokens,
    graph: Graph,
    agents: Vec<Arc<Agent>>,
    room: SimRoom,
    clock: TokioClock,
}

struct AnyWords(Snapshot);

impl Words for AnyWords {
    fn language(&self) -> &str {
        "en"
    }

    fn sentence(&self, _: &str, utterance: &str) -> Option<String> {
        Some(format!("this is {utterance} in five words"))
    }

    fn options(&self, part: &str) -> Vec<(String, String)> {
        let (Some(part), Some(offers)) = (self.0.node(part), self.0.vocabulary().label("offers")) else {
            return Vec::new();
        };
        let edges = self.0.get(part).unwrap().edges().filter(|edge| edge.key.label == offers);
        edges
            .map(|edge| self.0.name(edge.key.to).unwrap().to_owned())
            .map(|name| (name.clone(), name))
            .collect()
    }

    fn request_words(&self, request: &str) -> Vec<String> {
        vec![request.to_owned()]
    }
}

impl Reporter for AnyWords {
    fn report(&self, document: &str, _: &Snapshot) -> Option<serde_json::Value> {
        Some(document.into())
    }
}

impl Session {
    fn new(graph: &PathBuf, patient: PatientScript) -> Self {
        let robot = root().join("../robots/clarc");
        let words = domain(&robot.join("vocabulary.pddl"), &[]);
        let tokens = Tokens::new(&words).unwrap();
        let problems = [&robot.join("world.pddl"), graph]
            .map(|path| parse_problem(&source(path), &words).model.unwrap());
        let graph = tokens.populate(&problems.each_ref(), Time(0)).unwrap();
        let agents = folder("robots/clarc/agents")
            .iter()
            .map(|file| {
                let rules = domain(file, &[&words]);
                Arc::new(compile(&rules, &tokens, &agents::skills::standard()).unwrap())
            })
            .collect();
        let room = SimRoom::new(patient, ClinicianScript::default());
        Self { tokens, graph, agents, room, clock: TokioClock::start() }
    }

    /// Runs the agents while `director` acts.
    async fn play(&self, director: impl Future<Output = ()>) {
        let words = Arc::new(AnyWords(self.graph.snapshot()));
        let equipment = Equipment {
            devices: self.room.devices(),
            words: words.clone(),
            reporter: words,
            run: "run".into(),
        };
        let environment = Environment {
            graph: self.graph.clone(),
            equipment,
            clock: Arc::new(self.clock),
            housing: Housing::default(),
            absence: None,
        };
        tokio::select! {
            biased;
            never = run_all(self.agents.iter().cloned(), environment) => match never {},
            () = director => {}
        }
    }

    /// The first node of a type, none of its subtypes.
    fn node(&self, node_type: &str) -> NodeId {
        let snapshot = self.graph.snapshot();
        let wanted = self.tokens.vocabulary().node_type(node_type).unwrap();
        snapshot.nodes_of(wanted).find(|&id| snapshot.get(id).unwrap().node_type() == wanted).unwrap()
    }

    fn name(&self, node_type: &str) -> String {
        self.graph.snapshot().name(self.node(node_type)).unwrap().to_owned()
    }

    fn pelea(&self, write: impl FnOnce(&mut Transaction)) {
        let pelea = self.tokens.vocabulary().agent("pelea").unwrap();
        self.graph.edit(pelea, self.clock.now(), write).unwrap();
    }

    /// `(assign (FUNCTION test part) value)`.
    fn assign(&self, function: &str, part: NodeId, value: NodeId) {
        let Some(FunctionToken::Edge { label, attribute }) = self.tokens.function(function) else { panic!() };
        let test = self.node("test");
        self.pelea(|tx| {
            tx.add_edge(test, label, part);
            tx.set_attribute(dsr::HolderRef::edge(test, label, part), attribute, value);
        });
    }

    /// Adds an edge, or removes it.
    fn edge(&self, add: bool, from: NodeId, label: &str, to: NodeId) {
        let label = self.tokens.label(label).unwrap();
        self.pelea(|tx| {
            if add {
                tx.add_edge(from, label, to);
            } else {
                tx.remove_edge(from, label, to);
            }
        });
    }

    /// Makes the first item the part where the test is.
    fn enter_item(&self) -> NodeId {
        let (test, item) = (self.node("test"), self.node("item"));
        let snapshot = self.graph.snapshot();
        let is_in = self.tokens.label("is_in").unwrap();
        let old = snapshot.get(test).unwrap().edges().find(|edge| edge.key.label == is_in);
        if let Some(old) = old {
            self.edge(false, test, "is_in", old.key.to);
        }
        self.edge(true, test, "is_in", item);
        item
    }

    fn sentences(&self) -> Vec<String> {
        self.graph.snapshot().sentences()
    }

    #[track_caller]
    fn holds(&self, sentence: &str) {
        let sentence = sentence.replace(['_', '-'], " ");
        let all = self.sentences();
        assert!(
            all.iter().any(|told| told.replace(['_', '-'], " ") == sentence),
            "not '{sentence}' in {all:#?}"
        );
    }

    #[track_caller]
    fn holds_not(&self, sentence: &str) {
        assert!(!self.sentences().iter().any(|told| told == sentence), "'{sentence}'");
    }
}

fn graphs() -> Vec<PathBuf> {
    let graphs: Vec<_> = folder("domains")
        .into_iter()
        .map(|test| test.join("graph.pddl"))
        .filter(|file| file.exists())
        .collect();
    assert!(!graphs.is_empty(), "no test was found");
    graphs
}

async fn seconds(seconds: f64) {
    sleep(Duration::from_secs_f64(seconds)).await;
}

#[tokio::test(start_paused = true)]
async fn a_sentence_is_said_and_shown_a_question_asked_and_answered() {
    for graph in graphs() {
        for touch in [false, true] {
            let patient = if touch { "touch" } else { "voice" };
            let patient = serde_json::json!({ "otherwise": { "answer": { "option": 1, "by": patient } } });
            let session = Session::new(&graph, serde_json::from_value(patient).unwrap());
            let s = &session;
            s.play(async {
                let (person, answer) = (s.node("person"), s.node("answer"));
                seconds(1.0).await;
                s.holds("person is with robot");
                let item = s.enter_item();
                s.assign("label", item, s.node("question"));
                s.assign("view", item, s.node("question"));
                seconds(0.1).await;
                s.holds("robot is speaking");
                s.holds("robot is showing");
                seconds(4.0).await;
                s.holds("robot finish speaking");
                s.holds("robot finish showing");
                s.holds(&format!("{} was said in {}", s.name("question"), s.name("item")));
                s.holds(&format!("{} was shown in {}", s.name("question"), s.name("item")));
                s.assign("question", item, s.node("question"));
                s.edge(true, person, "can", answer);
                seconds(1.0).await;
                s.holds("person waiting answer");
                seconds(4.0).await;
                s.holds("person got answer");
                s.holds_not("person waiting answer");
                let chosen = AnyWords(s.graph.snapshot()).options(&s.name("item"))[1].0.clone();
                s.holds(&format!("{chosen} was chosen in {}", s.name("item")));
            })
            .await;
            let touched =
                session.room.moments().iter().any(|m| matches!(m.event, RoomEvent::PersonTouches { .. }));
            assert_eq!(touched, touch);
        }
    }
}

#[tokio::test(start_paused = true)]
async fn the_person_is_lost_called_and_found_again() {
    for graph in graphs() {
        let session = Session::new(&graph, PatientScript::default());
        let s = &session;
        let mut deltas = s.graph.subscribe_deltas();
        s.play(async {
            seconds(1.0).await;
            let item = s.enter_item();
            s.assign("label", item, s.node("remark"));
            seconds(1.0).await;
            s.room.lose_person();
            seconds(1.0).await;
            s.holds("robot is not speaking");
            s.assign("label", item, s.node("summons"));
            seconds(1.0).await;
            s.holds("robot is speaking");
            seconds(4.0).await;
            s.holds(&format!("{} was said in {}", s.name("summons"), s.name("item")));
            s.holds_not(&format!("{} was said in {}", s.name("remark"), s.name("item")));
            s.room.return_person();
            seconds(1.0).await;
            s.holds("person is with robot");
            s.room.leave_room();
            seconds(50.0).await;
            s.holds("person has left room");
            s.room.return_person();
            seconds(1.0).await;
            s.holds("person is with robot");
            s.holds_not("person has left room");
        })
        .await;
        // The reflex: one version takes the person and the speaking away.
        let reflex = std::iter::from_fn(|| deltas_next(&mut deltas))
            .find(|lines| lines.contains(&"no longer: person is with robot".to_owned()));
        let reflex = reflex.unwrap();
        assert!(reflex.contains(&"no longer: robot is speaking".to_owned()), "{reflex:?}");
        assert!(reflex.contains(&"robot is not speaking".to_owned()), "{reflex:?}");
    }
}

fn deltas_next(deltas: &mut dsr::Deltas) -> Option<Vec<String>> {
    match deltas.try_recv()? {
        dsr::Event::Committed(committed) => Some(committed.delta.sentences(&committed.snapshot)),
        dsr::Event::Lagged { .. } => panic!("lagged"),
    }
}

#[tokio::test(start_paused = true)]
async fn silence_help_commands_calls_and_the_report() {
    for graph in graphs() {
        let patient = serde_json::json!({ "otherwise": "silent" });
        let session = Session::new(&graph, serde_json::from_value(patient).unwrap());
        let s = &session;
        s.play(async {
            let (person, test, clinician) = (s.node("person"), s.node("test"), s.node("clinician"));
            seconds(1.0).await;
            let item = s.enter_item();
            s.assign("question", item, s.node("question"));
            s.edge(true, person, "can", s.node("answer"));
            seconds(16.0).await;
            s.holds(&format!("{} was unanswered in {}", s.name("question"), s.name("item")));
            s.holds_not("person waiting answer");

            s.room.ask(&s.name("request"));
            seconds(1.0).await;
            s.holds(&format!("person asks {}", s.name("request")));
            let need = s.node("need");
            s.edge(true, clinician, "is_wanted_for", need);
            seconds(30.0).await;
            s.holds(&format!("clinician attended {}", s.name("need")));
            s.holds_not(&format!("person asks {}", s.name("request")));

            let test_name = s.graph.snapshot().name(test).unwrap().to_owned();
            for (command, holds) in [("pause", true), ("resume", false)] {
                s.room.command(command);
                seconds(1.0).await;
                assert_eq!(s.sentences().contains(&format!("{test_name} is paused")), holds);
            }
            s.room.command("abort");
            seconds(1.0).await;
            s.holds(&format!("{test_name} is aborted"));

            let report = s.node("document");
            s.edge(true, report, "is_due_to", clinician);
            seconds(1.0).await;
            s.holds("report was delivered to clinician");
        })
        .await;
        let delivered =
            session.room.moments().into_iter().any(|m| matches!(m.event, RoomEvent::ReportDelivered { .. }));
        assert!(delivered);
    }
}

#[tokio::test(start_paused = true)]
async fn a_device_that_fails_is_broken_one_that_lies_is_doubted_and_both_heal() {
    for graph in graphs() {
        let session = Session::new(&graph, PatientScript::default());
        let s = &session;
        s.play(async {
            seconds(1.0).await;
            let item = s.enter_item();
            s.room.fail(Device::SpeechOut);
            s.room.lie(Device::Screen);
            s.assign("label", item, s.node("remark"));
            s.assign("view", item, s.node("remark"));
            seconds(5.0).await;
            s.holds("speaker is broken");
            s.holds("robot is not speaking");
            s.holds("screen is doubted");
            s.holds("robot is not showing");
            s.holds_not(&format!("{} was shown in {}", s.name("remark"), s.name("item")));
            s.room.recover(Device::SpeechOut);
            s.room.recover(Device::Screen);
            seconds(10.0).await;
            s.holds_not("speaker is broken");
            s.holds_not("screen is doubted");
        })
        .await;
    }
}
