//! The lab: a small vocabulary, a graph, and agents driven by hand, one action at a time.
#![allow(dead_code, clippy::unwrap_used, reason = "shared by tests, none of which uses all of it")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use agents::{Action, Agent, Call, Ended, InstanceId, Rest, Runtime, Skill, Skills, compile};
use dsr::{Delta, Deltas, Event, Graph, NodeId, Snapshot, Subscription, Time, Transaction};
use pddl::model::Domain;
use pddl::{Source, parse_domain, parse_problem};
use vocabulary::Tokens;

pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

pub(crate) fn source(path: &Path) -> Source {
    let text = fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    Source::new(path.file_name().unwrap().to_str().unwrap(), &text)
}

pub(crate) fn domain(path: &Path, imports: &[&Domain]) -> Domain {
    let source = source(path);
    let parsed = parse_domain(&source, imports);
    parsed.model.unwrap_or_else(|| panic!("{}: {:?}", path.display(), parsed.diagnostics))
}

/// The vocabulary of the lab, and a graph with a robot and a person in view.
pub(crate) struct Lab {
    pub(crate) words: Domain,
    pub(crate) tokens: Tokens,
    pub(crate) graph: Graph,
}

impl Lab {
    pub(crate) fn new() -> Self {
        let data = root().join("test_data");
        let words = domain(&data.join("lab.pddl"), &[]);
        let tokens = Tokens::new(&words).unwrap();
        let world = parse_problem(&source(&data.join("world.pddl")), &words).model.unwrap();
        let graph = tokens.populate(&[&world], Time(0)).unwrap();
        Self { words, tokens, graph }
    }

    pub(crate) fn agent(&self, name: &str) -> Arc<Agent> {
        let rules = domain(&root().join("test_data/ok").join(name).with_extension("pddl"), &[&self.words]);
        let skills: Skills = agents::skills::standard();
        Arc::new(compile(&rules, &self.tokens, &skills).unwrap_or_else(|errors| panic!("{errors:?}")))
    }

    pub(crate) fn name(&self, node: NodeId) -> String {
        self.graph.snapshot().name(node).unwrap().to_owned()
    }

    /// Writes as the director: `+robot shall_say hello`, `-person is_with robot`.
    pub(crate) fn direct(&self, edits: &[&str], seconds: u64) {
        let vocabulary = self.graph.vocabulary();
        let mut transaction = Transaction::new(vocabulary.agent("director").unwrap());
        for edit in edits {
            let (sign, sentence) = edit.split_at(1);
            let words: Vec<&str> = sentence.split(' ').collect();
            let label = vocabulary.label(words[1]).unwrap();
            match sign {
                "+" => transaction.add_edge(words[0], label, words[2]),
                "-" => transaction.remove_edge(words[0], label, words[2]),
                other => panic!("{other}"),
            };
        }
        self.graph.commit(&transaction, at(seconds)).unwrap();
    }
}

pub(crate) fn at(seconds: u64) -> Time {
    Time(seconds * 1_000_000_000)
}

/// Runtimes side by side, without devices: skills are launched and stopped on paper.
pub(crate) struct Bench {
    pub(crate) lab: Lab,
    runtimes: Vec<(Runtime, Subscription)>,
    all: Deltas,
    /// Running skills, by agent and number.
    pub(crate) running: BTreeMap<(usize, InstanceId), (Arc<dyn Skill>, Call)>,
    /// What was seen since it was last asked for.
    log: Vec<String>,
}

impl Bench {
    pub(crate) fn new(agents: &[&str]) -> Self {
        let lab = Lab::new();
        let all = lab.graph.subscribe_deltas();
        let runtime = |name: &&str| {
            let agent = lab.agent(name);
            let subscription = lab.graph.subscribe_to(agent.interest());
            (Runtime::new(agent), subscription)
        };
        let runtimes = agents.iter().map(runtime).collect();
        Self { lab, runtimes, all, running: BTreeMap::new(), log: Vec::new() }
    }

    /// The director writes, and everybody reacts.
    pub(crate) fn direct(&mut self, seconds: u64, edits: &[&str]) {
        self.lab.direct(edits, seconds);
        self.settle(seconds);
    }

    /// The first running skill of that name ends.
    pub(crate) fn end(&mut self, seconds: u64, skill: &str, ended: Ended) {
        let mut running = self.running.iter();
        let (&key, _) = running.find(|(_, (work, _))| work.signature().name == skill).expect("it runs");
        self.running.remove(&key);
        self.runtimes[key.0].0.ended(key.1, ended);
        self.settle(seconds);
    }

    /// The director writes, and the agents only learn that they have missed something.
    pub(crate) fn miss(&mut self, seconds: u64, edits: &[&str]) {
        self.lab.direct(edits, seconds);
        for (runtime, subscription) in &mut self.runtimes {
            *subscription = self.lab.graph.subscribe_to(runtime.agent().interest());
        }
        self.settle(seconds);
    }

    /// Agents take turns until none has anything to do.
    pub(crate) fn settle(&mut self, seconds: u64) {
        let now = at(seconds);
        let mut turns = 0;
        let mut idle = false;
        while !idle {
            idle = true;
            for agent in 0..self.runtimes.len() {
                while self.turn(agent, now) {
                    idle = false;
                    turns += 1;
                    assert!(turns < 1_000, "agents that never rest: {:#?}", &self.log[self.log.len() - 8..]);
                }
            }
        }
        self.hear();
    }

    fn turn(&mut self, agent: usize, now: Time) -> bool {
        let (runtime, subscription) = &mut self.runtimes[agent];
        while let Some(news) = subscription.try_recv() {
            runtime.changed(&news);
        }
        let Some(action) = runtime.next_action(&self.lab.graph.snapshot(), now) else { return false };
        match action {
            Action::Commit(transaction) => {
                let result = self.lab.graph.commit(&transaction, now);
                runtime.committed(result.as_ref(), now);
            }
            Action::Launch { instance, skill, call } => {
                self.hear();
                let line = format!(
                    "{}: launch {} {}",
                    runtime_name(&self.runtimes[agent].0),
                    skill.signature().name,
                    call.arguments.join(" ")
                );
                self.log.push(line.trim_end().to_owned());
                self.running.insert((agent, instance), (skill, call));
            }
            Action::Stop(instance) => {
                self.hear();
                if let Some((skill, call)) = self.running.remove(&(agent, instance)) {
                    let line = format!(
                        "{}: stop {} {}",
                        runtime_name(&self.runtimes[agent].0),
                        skill.signature().name,
                        call.arguments.join(" ")
                    );
                    self.log.push(line.trim_end().to_owned());
                }
            }
        }
        true
    }

    /// The rules that rest, of all agents.
    pub(crate) fn resting(&self) -> Vec<Rest> {
        self.runtimes.iter().flat_map(|(runtime, _)| runtime.resting()).collect()
    }

    /// Writes the commits since the last look into the log.
    fn hear(&mut self) {
        while let Some(event) = self.all.try_recv() {
            let Event::Committed(committed) = event else { panic!("lagged") };
            self.log.push(told(&committed.delta, &committed.snapshot));
        }
    }

    /// What happened since this was last asked.
    pub(crate) fn log(&mut self) -> String {
        self.hear();
        self.log.drain(..).map(|line| line + "\n").collect()
    }
}

fn runtime_name(runtime: &Runtime) -> String {
    runtime.agent().name.to_string()
}

/// A commit as one line; leases are left out.
pub(crate) fn told(delta: &Delta, after: &Snapshot) -> String {
    let lines: Vec<String> =
        delta.sentences(after).into_iter().filter(|line| !line.contains(" holds ")).collect();
    let writer = after.vocabulary().agent_name(delta.writer).unwrap().to_string();
    format!("v{} {writer}: {}", delta.version.0, lines.join(", "))
}
