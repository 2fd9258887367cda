//! What happened in the simulated room, beside a journal, for a run that goes on after a restart.
//!
//! People and devices outlive the robot's program. In a simulation they are part of it, so a file keeps what they did: a
//! line for each moment in the room, and for each disruption that began or was over.

use crate::outlet::Outlet;
use hal::sim::{Moment, RoomEvent};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Write};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// The file's name in the folder of a journal.
const NAME: &str = "room.jsonl";

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Line {
    Moment(Moment),
    /// A disruption of the scenario, by its number, began at this time.
    Began(usize, Duration),
    /// The fault that it caused is over.
    Over(usize, Duration),
}

/// The writing end; without a file nothing is written. Clones write to the same file.
#[derive(Clone, Default)]
pub(crate) struct RoomLog(Option<Arc<Mutex<Outlet>>>);

impl RoomLog {
    /// Begins the file in the folder of a journal, or goes on with it.
    pub(crate) fn open(folder: &Path) -> io::Result<Self> {
        let mut file = File::options().create(true).append(true).open(folder.join(NAME))?;
        // Ends a line that a crash has cut short.
        file.write_all(b"\n")?;
        Ok(Self(Some(Arc::new(Mutex::new(Outlet::new(file, |_| String::new()))))))
    }

    pub(super) fn moment(&self, moment: &Moment) {
        self.line(&Line::Moment(moment.clone()));
    }

    pub(super) fn began(&self, cue: usize, at: Duration) {
        self.line(&Line::Began(cue, at));
    }

    pub(super) fn over(&self, cue: usize, at: Duration) {
        self.line(&Line::Over(cue, at));
    }

    fn line(&self, line: &Line) {
        if let (Some(out), Ok(text)) = (&self.0, serde_json::to_string(line)) {
            let _ = writeln!(out.lock().unwrap_or_else(PoisonError::into_inner), "{text}");
        }
    }
}

/// What had happened when the program ended.
#[derive(Debug, Default)]
pub(crate) struct Happened {
    pub(super) moments: Vec<Moment>,
    /// The disruptions that had begun: when, and whether their faults are over.
    began: BTreeMap<usize, (Duration, bool)>,
}

impl Happened {
    /// Reads the file, if there is one, up to this time; what comes later is part of no version that outlived the program.
    pub(crate) fn read(folder: &Path, until: Duration) -> io::Result<Self> {
        let mut happened = Self::default();
        let text = match std::fs::read_to_string(folder.join(NAME)) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(happened),
            text => text?,
        };
        // A line that a crash has cut short is none.
        for line in text.lines().filter_map(|line| serde_json::from_str(line).ok()) {
            match line {
                Line::Moment(moment) if moment.at <= until => happened.moments.push(moment),
                Line::Began(cue, at) if at <= until => _ = happened.began.insert(cue, (at, false)),
                Line::Over(cue, at) if at <= until => {
                    happened.began.get_mut(&cue).into_iter().for_each(|(_, over)| *over = true);
                }
                Line::Moment(_) | Line::Began(..) | Line::Over(..) => {}
            }
        }
        Ok(happened)
    }

    /// When this disruption began, and whether its fault is over; `None` if it did not.
    pub(super) fn began(&self, cue: usize) -> Option<(Duration, bool)> {
        self.began.get(&cue).copied()
    }

    /// The disruptions that began, in the order of the scenario.
    pub(super) fn begun(&self) -> impl Iterator<Item = usize> + '_ {
        self.began.keys().copied()
    }

    /// How many requests of this name the robot has taken.
    pub(super) fn taken(&self, wanted: &str) -> usize {
        let asks = |moment: &&Moment| matches!(&moment.event, RoomEvent::PersonAsks { request, .. } if request == wanted);
        self.moments.iter().filter(asks).count()
    }
}
