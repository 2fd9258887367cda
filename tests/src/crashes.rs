//! A run whose program ends at a given moment, and goes on.
//!
//! A recorded run is cut after any of its commits, or within the bytes of one, as a crash leaves it; then it goes on, and
//! what a crash must not take is compared: the answers, the calls and deliveries, the invariants over both parts.

use crate::pelea;
use dsr::{Change, LabelId, Played, Recording, Snapshot, Time, Version};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The only segment of a run that was never interrupted.
const SEGMENT: &str = "00000000.dsr";
const TURNS: &str = "turns.jsonl";
const ROOM: &str = "room.jsonl";
/// Bytes of a frame's header; the length of its payload is a number at byte 8.
const HEADER: usize = 28;

/// A run of a scenario, as it was recorded.
#[derive(Debug)]
pub struct Original {
    mission: String,
    scenario: String,
    segment: Vec<u8>,
    turns: Vec<String>,
    room: String,
    ending: String,
    /// Where each commit ends in the segment; the first is the end of the state with which it begins.
    ends: Vec<usize>,
}

/// Where a recording ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cut {
    /// After this many commits.
    After(usize),
    /// In the middle of the commit after these.
    Within(usize),
}

/// What must not be lost, at the moment of a crash.
#[derive(Debug)]
pub struct Held {
    version: Version,
    time: Time,
    /// How much had happened in the room.
    moments: usize,
    answers: BTreeSet<String>,
    answered: BTreeSet<String>,
    /// The identities of calls and deliveries that stand.
    standing: BTreeSet<String>,
}

impl Original {
    /// Plays a scenario, and records it in a folder.
    ///
    /// # Errors
    /// The run fails, or its files cannot be read.
    pub fn record(mission: &Path, scenario: &str, folder: &Path) -> io::Result<Self> {
        let _ = fs::remove_dir_all(folder);
        let mission = mission.display().to_string();
        let at = folder.display().to_string();
        let said =
            pelea(&["run", &mission, "--scenario", scenario, "--speed", "max", "--json", "--journal", &at]);
        let segment = fs::read(folder.join(SEGMENT))?;
        let turns = fs::read_to_string(folder.join(TURNS))?.lines().map(str::to_owned).collect();
        let ending = ending(&said.result());
        let ends = ends(&segment);
        let room = fs::read_to_string(folder.join(ROOM))?;
        Ok(Self { mission, scenario: scenario.to_owned(), segment, turns, room, ending, ends })
    }

    /// How many commits it has.
    pub fn commits(&self) -> usize {
        self.ends.len() - 1
    }

    /// Leaves in a folder what a crash would leave.
    ///
    /// # Errors
    /// The folder cannot be written.
    pub fn crash(&self, cut: Cut, folder: &Path) -> io::Result<Held> {
        let end = match cut {
            Cut::After(commits) => self.ends[commits],
            Cut::Within(commits) => usize::midpoint(self.ends[commits], self.ends[commits + 1]),
        };
        let _ = fs::remove_dir_all(folder);
        fs::create_dir_all(folder)?;
        fs::write(folder.join(SEGMENT), &self.segment[..end])?;
        let (_, time) = Recording::open(folder).map_err(io::Error::other)?.last();
        let happened = self.room.lines().filter(|line| happened(line) <= time.0);
        fs::write(folder.join(ROOM), happened.collect::<Vec<_>>().join("\n"))?;
        let held = Held::read(folder)?;
        let late = |line: &&String| handed(line).is_some_and(|version| version > held.version.0);
        let kept = self.turns.iter().position(|line| late(&line)).unwrap_or(self.turns.len());
        // The last line is torn, as the bytes of the journal are.
        let torn = self.turns.get(kept).map_or("", |line| &line[..line.len() / 2]);
        fs::write(folder.join(TURNS), self.turns[..kept].join("\n") + "\n" + torn)?;
        Ok(held)
    }

    /// Goes on after a crash, to the end of the run. What is wrong then.
    pub fn goes_on(&self, held: &Held, folder: &Path) -> Vec<String> {
        let at = folder.display().to_string();
        let scenario = ["--scenario", &self.scenario];
        let run = ["run", &self.mission, "--speed", "max", "--json", "--resume", &at];
        let said = pelea(&[&run[..], &scenario[..]].concat());
        let mut wrong = Vec::new();
        if said.out.is_empty() {
            return vec![format!("it does not go on: {}", said.err)];
        }
        let result = said.result();
        let ended = ending(&result);
        // A run that its horizon ends does so whatever is under way then.
        let is_open = self.ending.starts_with("still_");
        if !is_open && !["accomplished", "with_human"].contains(&ended.as_str()) {
            wrong.push(format!("it ends {ended}, not {}", self.ending));
        }
        for broken in result["broken"].as_array().into_iter().flatten() {
            wrong.push(format!("broken: {broken}"));
        }
        match held.lost(folder) {
            Ok(lost) => wrong.extend(lost),
            Err(error) => wrong.push(error.to_string()),
        }
        wrong
    }

    /// Whether the decisions of both parts are made again by a replay.
    pub fn replays(&self, folder: &Path) -> Result<(), String> {
        let said = pelea(&["replay", &self.mission, &folder.display().to_string()]);
        if said.exit == cli::Exit::Yes { Ok(()) } else { Err(said.out + &said.err) }
    }
}

impl Held {
    /// What a recording holds at its end.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn read(folder: &Path) -> io::Result<Self> {
        let recording = Recording::open(folder).map_err(io::Error::other)?;
        let (version, time) = recording.last();
        let snapshot = recording.at(version).map_err(io::Error::other)?;
        let answers: BTreeSet<_> = tokens(&snapshot, "was_chosen_in").into_iter().collect();
        let answered = answers.iter().filter_map(|a| a.split_once(' ')).map(|(_, item)| item.to_owned());
        let room = fs::read_to_string(folder.join(ROOM)).unwrap_or_default();
        let made: BTreeSet<_> = moments(&room).iter().map(id).collect();
        // What stands, by the version since which it does; only what was made can be made again.
        let stands = |about: &str, since: Version| {
            let end = format!(":{about}:{}", since.0);
            made.iter().find(|id| id.ends_with(&end)).cloned()
        };
        let name = |node| snapshot.name(node).unwrap_or_default();
        let of = |label: &str| snapshot.vocabulary().label(label);
        let standing = snapshot.edges().filter_map(|edge| match Some(edge.key.label) {
            label if label == of("is_called_for") => stands(name(edge.key.to), edge.since()),
            label if label == of("is_due_to") => stands(name(edge.key.from), edge.since()),
            _ => None,
        });
        let standing = standing.collect();
        let moments = moments(&room).len();
        Ok(Self { version, time, moments, answered: answered.collect(), answers, standing })
    }

    /// What of it is lost when the run has ended, and what of it was done again that must not be.
    ///
    /// # Errors
    /// The recording cannot be read.
    pub fn lost(&self, folder: &Path) -> io::Result<Vec<String>> {
        let recording = Recording::open(folder).map_err(io::Error::other)?;
        let last = recording.at(recording.last().0).map_err(io::Error::other)?;
        let answers: BTreeSet<_> = tokens(&last, "was_chosen_in").into_iter().collect();
        let mut wrong: Vec<_> =
            self.answers.difference(&answers).map(|answer| format!("lost: {answer}")).collect();
        let replay = recording.replay_from(self.version).map_err(io::Error::other)?;
        let asks = last.vocabulary().label("question");
        for played in replay {
            let Played::Commit(delta) = played.map_err(io::Error::other)? else { continue };
            for change in &delta.changes {
                if let Change::EdgeAdded { edge } = change
                    && Some(edge.label) == asks
                    && last.name(edge.to).is_some_and(|item| self.answered.contains(item))
                {
                    wrong.push(format!("asked again: {}", last.name(edge.to).unwrap_or_default()));
                }
            }
        }
        let room = fs::read_to_string(folder.join(ROOM))?;
        let later = moments(&room).into_iter().skip(self.moments);
        let again: BTreeSet<_> = later.map(|moment| id(&moment)).collect();
        // A run that was over is so at once, before anybody acts.
        let was_over = last.time() == self.time;
        let standing = self.standing.difference(&again).filter(|_| !was_over);
        wrong.extend(standing.map(|id| format!("not made again: {id}")));
        Ok(wrong)
    }
}

fn ending(result: &Value) -> String {
    result["ending"].as_str().unwrap_or_default().to_owned()
}

/// The tokens with this label, as the names of their ends.
fn tokens(snapshot: &Snapshot, label: &str) -> Vec<String> {
    let Some(label) = snapshot.vocabulary().label(label) else { return Vec::new() };
    let name = |node| snapshot.name(node).unwrap_or_default().to_owned();
    let of = |label: LabelId| {
        snapshot.edges().map(|edge| edge.key).filter(move |key| key.label == label).collect::<Vec<_>>()
    };
    of(label).into_iter().map(|key| format!("{} {}", name(key.from), name(key.to))).collect()
}

/// The version that PELEA was handed in a turn.
fn handed(line: &str) -> Option<u64> {
    let turn: Value = serde_json::from_str(line).ok()?;
    let event = turn.get("event")?;
    event.get("changed").or_else(|| event.get("seen"))?.as_u64()
}

fn moments(room: &str) -> Vec<Value> {
    let lines = room.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    lines.filter_map(|line| line.get("moment").cloned()).collect()
}

/// When a line of the room's file was written, in nanoseconds.
fn happened(line: &str) -> u64 {
    let line: Value = serde_json::from_str(line).unwrap_or_default();
    let at = ["began", "over"].into_iter().find_map(|key| line[key].get(1)).unwrap_or(&line["moment"]["at"]);
    let part = |key: &str| at[key].as_u64().unwrap_or_default();
    part("secs") * 1_000_000_000 + part("nanos")
}

fn id(moment: &Value) -> String {
    moment["id"].as_str().unwrap_or_default().to_owned()
}

/// Where the frames of a segment end, from that of its state on.
fn ends(segment: &[u8]) -> Vec<usize> {
    let mut ends = Vec::new();
    let mut at = 0;
    while let Some(header) = segment.get(at..at + HEADER) {
        let number = |from: usize| u32::from_le_bytes([0, 1, 2, 3].map(|i| header[from + i]));
        at += HEADER + number(8) as usize;
        // Kinds 0 and 1 are the vocabulary and the parts of the state.
        if number(4) <= 1 {
            ends.clear();
        }
        ends.push(at);
    }
    ends
}

/// A folder of this name for the files of crashes.
pub fn folder(base: &Path, name: &str) -> PathBuf {
    base.join("crashes").join(name)
}
