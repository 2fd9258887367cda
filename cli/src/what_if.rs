//! `pelea replay --from … --edit …`: the rest of a recorded run, had the graph been another at that moment.
//!
//! The run goes on from the version as it does after a restart, twice: as it was, and with the edits. Both begin with
//! everybody expired, so what differs between them is due to the edits alone. What is sensed wins over an edit: a person
//! who is in view is seen again.

use crate::assemble::Assembly;
use crate::clock::seconds;
use crate::console::{Console, Form};
use crate::dsr::Moment;
use crate::exit::Exit;
use crate::run::{
    Audience, Content, Happened, Kept, Latency, Narrator, Past, Production, expire_all, perform,
};
use crate::scenario::Staged;
use agents::Housing;
use diagnostics::did_you_mean;
use dsr::{
    AgentId, Edit, Graph, LabelId, NodeRef, Recording, RecordingError, Snapshot, TransactionError, Version,
};
use executive::Narration;
use hal::sim::RoomEvent;
use safety::Broken;
use serde::Serialize;
use std::future::pending;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// The end of both runs in which nobody ever comes.
const HORIZON: Duration = Duration::from_secs(4 * 3_600);

/// What to change, and when.
pub(crate) struct Question<'a> {
    pub(crate) journal: &'a Path,
    pub(crate) from: Moment,
    pub(crate) edits: &'a [String],
    pub(crate) seed: u64,
}

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
pub(crate) enum WhatIfError {
    #[error(transparent)]
    Recording(#[from] RecordingError),
    #[error("`{0}` is no edit; one is `+ person asks help` or `- person is with robot`")]
    NoEdit(String),
    #[error("the graph has no {kind} `{name}`{}", .help.as_deref().map(|h| format!(": {h}")).unwrap_or_default())]
    Unknown { kind: &'static str, name: String, help: Option<String> },
    #[error("the graph refuses the edit: {0}")]
    Refused(#[from] TransactionError),
    #[error("cannot read what happened in the room: {0}")]
    Room(std::io::Error),
    #[error("the system gives no threads or timers: {0}")]
    System(std::io::Error),
}

/// A decision with its time in seconds.
#[derive(Clone, Debug, Serialize)]
struct Told {
    time: f64,
    text: String,
}

/// The answer in JSON.
#[derive(Serialize)]
#[serde(tag = "kind", rename = "what_if")]
struct Answer<'a> {
    version: u64,
    time: f64,
    edits: &'a [String],
    /// How many decisions both runs begin with.
    same: usize,
    without: &'a [Told],
    with: &'a [Told],
}

/// Answers: 0 if the edits change no decision, 1 if they do.
pub(crate) fn answer(
    question: &Question<'_>,
    content: &Content,
    staged: impl Fn() -> Option<Staged>,
    assembly: &Assembly,
    console: &mut Console<'_>,
) -> Result<Exit, WhatIfError> {
    let recording = Recording::open(question.journal)?;
    let at = question.from.of(&recording)?;
    let run =
        |edits: &[String]| goes_on(question, &recording, at.version(), edits, content, staged(), assembly);
    let (without, with) = (run(&[])?, run(question.edits)?);
    let same = without.iter().zip(&with).take_while(|(one, other)| one.text == other.text).count();
    let time = seconds(Duration::from_nanos(at.time().0));
    let (version, edits) = (at.version().0, question.edits);
    let (without, with) = (&without[same..], &with[same..]);
    if console.form() == Form::Json {
        console.record(&Answer { version, time, edits, same, without, with });
    } else {
        console.result(&format!("what if, from version {version}, {time:.2} s: {}", edits.join(", ")));
        console.result(&format!("the first {same} decisions are the same"));
        for (heading, told) in [("as it was:", without), ("with the edit:", with)] {
            if !told.is_empty() {
                console.result(heading);
            }
            told.iter().for_each(|told| console.result(&format!("{:8.2}  {}", told.time, told.text)));
        }
    }
    Ok(if without.is_empty() && with.is_empty() { Exit::Yes } else { Exit::No })
}

/// The decisions of the run that goes on from a version with these edits.
fn goes_on(
    question: &Question<'_>,
    recording: &Recording,
    version: Version,
    edits: &[String],
    content: &Content,
    staged: Option<Staged>,
    assembly: &Assembly,
) -> Result<Vec<Told>, WhatIfError> {
    let (past, assembly) = Past::relive(recording, version, assembly.again())?;
    let happened = Happened::read(question.journal, past.elapsed()).map_err(WhatIfError::Room)?;
    expire_all(&assembly.graph)?;
    apply(edits, &assembly.graph)?;
    let (scenario, cues) = staged.map(|staged| (staged.scenario, staged.cues)).unzip();
    let production = Production {
        content: content.clone(),
        scenario: scenario.as_ref(),
        cues: cues.unwrap_or_default(),
        seed: question.seed,
        horizon: Some(HORIZON),
        latency: Latency::new(crate::run::latency::Range::default(), question.seed).simulated(),
        pulse: None,
        turns: None,
        housing: Housing::Together,
        kept: Kept::default(),
        past: Some(past.with(happened)),
    };
    let diary = Diary::default();
    let runtime = tokio::runtime::Builder::new_current_thread().enable_time().start_paused(true).build();
    let runtime = runtime.map_err(WhatIfError::System)?;
    runtime.block_on(perform(production, assembly, diary.clone(), pending(), pending()));
    runtime.shutdown_background();
    let told = std::mem::take(&mut *diary.0.lock().unwrap_or_else(PoisonError::into_inner)).1;
    Ok(told)
}

/// Writes the edits as the graph itself, which may write everything.
fn apply(edits: &[String], graph: &Graph) -> Result<(), WhatIfError> {
    let snapshot = graph.snapshot();
    let edits = edits.iter().map(|text| edit(text, &snapshot)).collect::<Result<Vec<_>, _>>()?;
    graph.edit(AgentId::DSR, snapshot.time(), |transaction| _ = transaction.extend(edits))?;
    Ok(())
}

/// `+ FROM LABEL TO` adds a token, `-` removes one; the words of a label are those of its sentence.
fn edit(text: &str, snapshot: &Snapshot) -> Result<Edit, WhatIfError> {
    let wrong = || WhatIfError::NoEdit(text.to_owned());
    let mut words = text.split_whitespace();
    let sign = words.next().ok_or_else(wrong)?;
    let words: Vec<_> = words.collect();
    let [from, label @ .., to] = words.as_slice() else { return Err(wrong()) };
    let (from, to) = (node(from, snapshot)?, node(to, snapshot)?);
    let label = label_of(&label.join("_"), snapshot)?;
    match sign {
        "+" => Ok(Edit::AddEdge { from, label, to }),
        "-" => Ok(Edit::RemoveEdge { from, label, to }),
        _ => Err(wrong()),
    }
}

fn node(name: &str, snapshot: &Snapshot) -> Result<NodeRef, WhatIfError> {
    let known = || snapshot.nodes().map(|node| node.name().to_owned()).collect::<Vec<_>>();
    let help = || did_you_mean(name, known().iter().map(String::as_str));
    let unknown = || WhatIfError::Unknown { kind: "node", name: name.to_owned(), help: help() };
    snapshot.node(name).map(NodeRef::Id).ok_or_else(unknown)
}

fn label_of(name: &str, snapshot: &Snapshot) -> Result<LabelId, WhatIfError> {
    let vocabulary = snapshot.vocabulary();
    let known =
        || vocabulary.labels().filter_map(|label| vocabulary.label_name(label)).map(ToString::to_string);
    let help = || did_you_mean(name, known().collect::<Vec<_>>().iter().map(String::as_str));
    let unknown = || WhatIfError::Unknown { kind: "label", name: name.to_owned(), help: help() };
    vocabulary.label(name).ok_or_else(unknown)
}

/// Writes down what PELEA decides.
#[derive(Clone, Default)]
struct Diary(Arc<Mutex<(Narrator, Vec<Told>)>>);

impl Audience for Diary {
    fn room(&self, _: Duration, _: &RoomEvent) {}

    fn pelea(&self, at: Duration, narration: Narration) {
        let mut diary = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let (narrator, told) = &mut *diary;
        let time = seconds(at);
        told.extend(narrator.pelea(narration).into_iter().map(|text| Told { time, text }));
    }

    fn alarm(&self, broken: Broken) {
        let mut diary = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let time = seconds(Duration::from_nanos(broken.time.0));
        diary.1.push(Told { time, text: format!("broken: {broken}") });
    }
}
