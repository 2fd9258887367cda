//! The story of a run: one linear stream of the events in the room, in the graph and in PELEA.
//!
//! Reporters (terminal, JSON) only read it. An entry is added after all earlier commits, so the
//! order is that of the versions. The story includes edges, and the values of functions of two
//! nodes; it omits other commits.

use super::perform::Audience;
use crate::clock::seconds;
use dsr::{
    Change, Graph, Holder, HolderType, Interest, Kind, LabelId, Mentions, Snapshot, Subscription, Value,
};
use executive::Narration;
use hal::sim::RoomEvent;
use safety::Broken;
use serde::Serialize;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use tokio::sync::Notify;
use tokio::sync::mpsc::UnboundedSender;

/// An entry: its time, its version, its event.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "kind", rename = "event")]
pub(super) struct Entry {
    /// Seconds since the mission started, to the millisecond.
    pub(super) time: f64,
    /// The graph's version at that time.
    pub(super) version: u64,
    #[serde(flatten)]
    pub(super) what: What,
}

/// An event.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "source", rename_all = "snake_case")]
pub(super) enum What {
    /// Something that can be heard or seen in the room.
    Room(RoomEvent),
    /// A commit, as sentences.
    Graph(Commit),
    /// A decision of PELEA.
    Pelea(Narration),
    /// A finding of the monitor.
    Safety(Alarm),
}

/// A finding of the monitor.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "event", rename_all = "snake_case")]
pub(super) enum Alarm {
    /// An invariant does not hold.
    Broken(Broken),
}

/// The changes of a commit, in the paper's sentences.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Commit {
    /// The agent that wrote it.
    pub(super) writer: String,
    /// Tokens that were added to the graph.
    pub(super) now: Vec<String>,
    /// Tokens that were removed from the graph.
    pub(super) no_longer: Vec<String>,
    /// Whether a reflex wrote in the same commit.
    pub(super) reflex: bool,
    /// The added tokens by name: from, label, to.
    #[serde(skip)]
    pub(super) edges: Vec<(String, String, String)>,
}

/// A shared writer. A clone writes to the same story.
#[derive(Clone)]
pub(super) struct Story {
    telling: Arc<Mutex<Telling>>,
    news: Arc<Notify>,
}

struct Telling {
    graph: Graph,
    subscription: Subscription,
    /// Sends entries to the reader; entries are lost once the reader has gone.
    reader: UnboundedSender<Entry>,
}

impl Story {
    /// A story of a graph from now on.
    pub(super) fn new(graph: &Graph, reader: UnboundedSender<Entry>) -> Self {
        let (news, subscription) = (Arc::new(Notify::new()), graph.subscribe_to(interest(graph)));
        let wake = Arc::clone(&news);
        subscription.on_wake(move || wake.notify_one());
        let telling = Telling { graph: graph.clone(), subscription, reader };
        Self { telling: Arc::new(Mutex::new(telling)), news }
    }

    /// Waits for commits, so that no more of them pile up than the graph keeps.
    pub(super) async fn alerted(&self) {
        self.news.notified().await;
    }

    /// Adds an entry, after the graph's earlier commits.
    pub(super) fn tell(&self, time: f64, what: What) {
        let mut telling = self.telling.lock().unwrap_or_else(PoisonError::into_inner);
        telling.catch_up();
        let version = telling.graph.snapshot().version().0;
        let _ = telling.reader.send(Entry { time, version, what });
    }

    /// Adds a broken invariant, with the version and the time that broke it.
    fn broken(&self, broken: Broken) {
        let mut telling = self.telling.lock().unwrap_or_else(PoisonError::into_inner);
        telling.catch_up();
        let (time, version) = (seconds(Duration::from_nanos(broken.time.0)), broken.version.0);
        let _ = telling.reader.send(Entry { time, version, what: What::Safety(Alarm::Broken(broken)) });
    }

    /// Adds the graph's commits so far.
    pub(super) fn catch_up(&self) {
        self.telling.lock().unwrap_or_else(PoisonError::into_inner).catch_up();
    }
}

impl Audience for Story {
    fn room(&self, at: Duration, event: &RoomEvent) {
        self.tell(seconds(at), What::Room(event.clone()));
    }

    fn pelea(&self, at: Duration, narration: Narration) {
        self.tell(seconds(at), What::Pelea(narration));
    }

    fn alarm(&self, broken: Broken) {
        self.broken(broken);
    }

    fn ended(&self) {
        self.catch_up();
    }
}

impl Telling {
    fn catch_up(&mut self) {
        while let Some(news) = self.subscription.try_recv() {
            for delta in &news.deltas {
                let commit = commit(delta, &news.snapshot);
                if commit.now.is_empty() && commit.no_longer.is_empty() {
                    continue;
                }
                let time = seconds(Duration::from_nanos(delta.time.0));
                let version = delta.version.0;
                let _ = self.reader.send(Entry { time, version, what: What::Graph(commit) });
            }
        }
    }
}

/// Every label except those of leases, and every function of two nodes whose value is a node.
fn interest(graph: &Graph) -> Interest {
    let vocabulary = graph.vocabulary();
    let mut tokens = Mentions::default();
    vocabulary.labels().filter(|&label| label != LabelId::HOLDS).for_each(|label| tokens.add_label(label));
    for attribute in vocabulary.attributes() {
        let (holder, kind) = (vocabulary.holder(attribute), vocabulary.kind(attribute));
        if matches!((holder, kind), (Some(HolderType::Edge { .. }), Some(Kind::Node(_)))) {
            tokens.add_attribute(attribute);
        }
    }
    let mut interest = Interest::default();
    interest.add_tokens(&tokens);
    interest
}

fn commit(delta: &dsr::Delta, after: &Snapshot) -> Commit {
    let (mut now, mut no_longer, mut edges) = (Vec::new(), Vec::new(), Vec::new());
    let vocabulary = after.vocabulary();
    let node = |id| after.name(id).unwrap_or_default().to_owned();
    let label = |id| vocabulary.label_name(id).map_or_else(String::new, ToString::to_string);
    // A function of two nodes is an edge with a value: it is reported with its value, or not at
    // all.
    let carries_value = |id| id == LabelId::HOLDS || vocabulary.attribute(&label(id)).is_some();
    for (change, sentence) in delta.changes.iter().zip(delta.sentences(after)) {
        match change {
            Change::EdgeAdded { edge } => {
                edges.push((node(edge.from), label(edge.label), node(edge.to)));
                if !carries_value(edge.label) {
                    now.push(sentence);
                }
            }
            Change::EdgeRemoved { edge } if !carries_value(edge.label) => {
                let gone = sentence.strip_prefix("no longer: ").unwrap_or(&sentence);
                no_longer.push(gone.to_owned());
            }
            Change::AttributeAdded { holder: Holder::Edge(edge), new: Value::Node(value), .. }
            | Change::AttributeChanged { holder: Holder::Edge(edge), new: Value::Node(value), .. } => {
                edges.push((node(*value), label(edge.label), node(edge.to)));
                now.push(format!(
                    "{} {} of {} is {}",
                    node(edge.from),
                    label(edge.label),
                    node(edge.to),
                    node(*value)
                ));
            }
            _ => {}
        }
    }
    let writer = vocabulary.agent_name(delta.writer).map_or_else(String::new, ToString::to_string);
    Commit { writer, now, no_longer, reflex: !delta.reflexes.is_empty(), edges }
}
