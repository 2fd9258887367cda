//! The report: the answer and the score of each item, and the sum.
//!
//! Problem: the report belongs to the test, and Rust must not know the test. Idea: `mission.toml` names five tokens (the
//! items, their options, the answers, the unanswered questions, the scores) and perhaps a sixth (what a sensor noticed), and the report is a query over one snapshot
//! of the graph. Invariant: the same snapshot and language give the same bytes; an item without an answer has no score.

mod table;

use std::fmt;
use std::time::Duration;

use dsr::{EdgeKey, NodeId, Snapshot};
use pddl::model::Name;
use serde::{Serialize, Serializer};

use crate::content::{ReportLabels, Words};
use crate::mission::Mission;

/// A score or a sum of scores. Whole numbers are printed without decimals.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Score(pub f64);

impl Score {
    /// Whether it equals a whole number.
    pub fn is(self, number: u32) -> bool {
        (self.0 - f64::from(number)).abs() < 1e-9
    }
}

impl fmt::Display for Score {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // `{}` of an integral f64 has no decimals.
        write!(f, "{}", self.0)
    }
}

impl Serialize for Score {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        if self.0.fract() == 0.0 && self.0.abs() < 1e15 {
            #[expect(clippy::cast_possible_truncation, reason = "integral, and far below 2^63")]
            return to.serialize_i64(self.0 as i64);
        }
        to.serialize_f64(self.0)
    }
}

impl std::iter::Sum for Score {
    fn sum<I: Iterator<Item = Self>>(scores: I) -> Self {
        // The sum of an empty `f64` iterator is -0.
        Self(scores.fold(0.0, |sum, s| sum + s.0))
    }
}

/// The state of an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// It has an answer.
    Answered,
    /// It was asked and has no answer.
    Unanswered,
    /// It was asked and has no answer, and no sensor noticed that a question was said or shown: a failure of the robot,
    /// not a silence of the person.
    NotPerceived,
    /// It was asked, and something came between: the question has neither an answer nor a silence.
    Interrupted,
    /// It was not asked.
    NotReached,
}

/// One item of the report.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ItemReport {
    /// Its node.
    pub item: Name,
    /// Its name in the report's language.
    pub name: String,
    /// Its state.
    pub status: Status,
    /// The chosen option.
    pub option: Option<Name>,
    /// The text of that option.
    pub answer: Option<String>,
    /// Its score.
    pub score: Option<Score>,
    /// The most that the item can score.
    pub maximum: Score,
}

/// When the test began and ended, counted from the start of the run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Times {
    /// The first commit of the mission.
    #[serde(rename = "started_s", serialize_with = "seconds")]
    pub started: Duration,
    /// The commit of the report.
    #[serde(rename = "finished_s", serialize_with = "seconds")]
    pub finished: Duration,
}

fn seconds<S: Serializer>(duration: &Duration, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_f64(duration.as_secs_f64())
}

/// The result of a test.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The mission's short name.
    pub mission: String,
    /// Its name for people.
    pub title: String,
    /// The tag of the language.
    pub language: String,
    /// When the test began and ended.
    #[serde(flatten)]
    pub times: Times,
    /// All items, in the order of the test.
    pub items: Vec<ItemReport>,
    /// The sum over the answered items.
    pub total: Score,
    /// The most that the test can score.
    pub maximum: Score,
    /// Whether every item is answered.
    pub complete: bool,
    #[serde(skip)]
    labels: ReportLabels,
}

impl Report {
    /// The report over a snapshot of the graph.
    pub fn new(mission: &Mission, words: &Words, snapshot: &Snapshot, times: Times) -> Self {
        let graph = Graph::new(mission, snapshot);
        let layers = &mission.layers;
        let items: Vec<ItemReport> = layers
            .items()
            .into_iter()
            .map(|item| {
                let name = layers.graph.model.objects[item].name.clone();
                let offered = layers.options(item);
                let score = |option: &str| graph.score(&name, option);
                let maximum = offered.iter().filter_map(|&o| score(layers.name(o))).fold(0.0, f64::max);
                let option = graph.answer(&name);
                let status = match option {
                    Some(_) => Status::Answered,
                    None => graph.silence(&name),
                };
                let spoken = |o: &Name| words.options(&name).iter().find(|w| w.option == *o);
                ItemReport {
                    name: words.name(&name).unwrap_or(&name).to_owned(),
                    status,
                    answer: option.as_ref().and_then(spoken).map(|w| w.text.clone()),
                    score: option.as_ref().map(|o| Score(score(o).unwrap_or(0.0))),
                    maximum: Score(maximum),
                    item: name,
                    option,
                }
            })
            .collect();
        Self {
            mission: mission.manifest.name.clone(),
            title: mission.manifest.title.clone(),
            language: words.tag().to_owned(),
            times,
            total: items.iter().filter_map(|i| i.score).sum(),
            maximum: items.iter().map(|i| i.maximum).sum(),
            complete: items.iter().all(|i| i.status == Status::Answered),
            items,
            labels: words.labels().clone(),
        }
    }

    /// How many items are answered.
    pub fn answered(&self) -> usize {
        self.items.iter().filter(|i| i.status == Status::Answered).count()
    }

    /// The items that were asked and not answered.
    pub fn unanswered(&self) -> impl Iterator<Item = &Name> {
        self.items.iter().filter(|i| i.status == Status::Unanswered).map(|i| &i.item)
    }
}

/// Look-ups of the tokens in one snapshot.
struct Graph<'a> {
    mission: &'a Mission,
    snapshot: &'a Snapshot,
}

impl<'a> Graph<'a> {
    fn new(mission: &'a Mission, snapshot: &'a Snapshot) -> Self {
        Self { mission, snapshot }
    }

    fn incoming(&self, item: &str, label: &str) -> Vec<EdgeKey> {
        let node = self.snapshot.node(item).and_then(|id| self.snapshot.get(id));
        let label = self.snapshot.vocabulary().label(label);
        node.into_iter().flat_map(|n| n.incoming()).filter(|e| Some(e.label) == label).collect()
    }

    /// The option that was chosen last.
    fn answer(&self, item: &str) -> Option<Name> {
        let edges = self.incoming(item, &self.mission.manifest.report.answer.name);
        let since = |e: &EdgeKey| self.snapshot.edge(e.from, e.label, e.to).map(|view| view.since());
        edges.iter().max_by_key(|e| since(e)).and_then(|e| self.snapshot.name(e.from)).map(Name::new)
    }

    /// The state of an item without an answer.
    fn silence(&self, item: &str) -> Status {
        let tokens = &self.mission.manifest.report;
        let silent = self.incoming(item, &tokens.unanswered.name);
        let Some(sensed) = &tokens.sensed else {
            return if silent.is_empty() { self.untold(item) } else { Status::Unanswered };
        };
        let sensed = self.incoming(item, &sensed.name);
        if silent.is_empty() {
            self.untold(item)
        } else if silent.iter().any(|question| sensed.iter().any(|noticed| noticed.from == question.from)) {
            Status::Unanswered
        } else {
            Status::NotPerceived
        }
    }

    /// The state of an item without an answer or a silence: whether a question led to it. Whatever is written of a question
    /// and the item, that it was said, shown or noticed, was written because it was asked.
    fn untold(&self, item: &str) -> Status {
        let layers = &self.mission.layers;
        let unanswered = &layers.nodes.predicates[layers.tokens.unanswered];
        let question = unanswered.variables.parameters().first();
        let is_question = |name: &str| {
            let node = layers.graph.model.object(name);
            let types = |id| &layers.graph.model.objects[id];
            node.zip(question).is_some_and(|(id, of)| types(id).is_of(&of.types, &layers.nodes.types))
        };
        let node = self.snapshot.node(item).and_then(|id| self.snapshot.get(id));
        let mut edges = node.into_iter().flat_map(|node| node.incoming());
        if edges.any(|edge| self.snapshot.name(edge.from).is_some_and(is_question)) {
            Status::Interrupted
        } else {
            Status::NotReached
        }
    }

    /// The score of an option: a binary function is a label whose edges carry the attribute of the same name.
    fn score(&self, item: &str, option: &str) -> Option<f64> {
        let name = &self.mission.manifest.report.score.name;
        let vocabulary = self.snapshot.vocabulary();
        let (label, attribute) = (vocabulary.label(name)?, vocabulary.attribute(name)?);
        let node = |name: &str| -> Option<NodeId> { self.snapshot.node(name) };
        let edge = EdgeKey { from: node(item)?, label, to: node(option)? };
        self.snapshot.attribute(edge, attribute)?.as_number()
    }
}
