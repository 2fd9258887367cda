//! The folder of a run: the journal of the graph, PELEA's turns, and what happened in the simulated room.
//!
//! One folder is one run, however often its program was started again: the next life adds a segment to the journal and a
//! part to the turns. A run goes on only with the texts that it began with: the graph was made from some of them, and the
//! others would give it a different meaning. The words of `content` are no part of the graph, and may change; other texts
//! only if the caller says so.

use super::past::{Past, expire_all};
use super::perform::Kept;
use super::room::{Happened, RoomLog};
use crate::assemble::Assembly;
use crate::console::Console;
use crate::dsr::{Failed, open};
use crate::exit::Exit;
use crate::turns::{self, Heading, Turns};
use dsr::{Folder, Graph, Journal, Settings};
use std::fmt::Display;
use std::path::Path;
use std::sync::Arc;

/// A mission, and where its run is recorded.
pub(super) struct Opened {
    pub(super) assembly: Assembly,
    pub(super) journal: Option<Journal>,
    pub(super) turns: Option<Turns>,
    pub(super) past: Option<Past>,
    pub(super) kept: Kept,
}

impl Opened {
    /// A run that is recorded nowhere.
    pub(super) fn nowhere(assembly: Assembly, run: String) -> Self {
        Self { assembly, journal: None, turns: None, past: None, kept: Kept { run, ..Kept::default() } }
    }
}

/// Begins a run in a folder without one.
pub(super) fn begin(folder: &Path, assembly: Assembly, heading: &Heading) -> Result<Opened, Failed> {
    let journal = crate::dsr::begin(folder, &assembly.graph)?;
    let turns = Turns::begin(folder, heading).map_err(|error| unwritable(folder, &error))?;
    recorded(folder, assembly, journal, turns, heading.run.clone())
}

/// Goes on with the run in a folder.
pub(super) fn go_on(
    folder: &Path,
    assembly: Assembly,
    heading: Heading,
    changed_texts: bool,
    console: &mut Console<'_>,
) -> Result<Opened, Failed> {
    let unreadable = |error: &dyn Display| Failed::new(Exit::Unreadable, error.to_string());
    let lives = turns::read(folder).map_err(|error| unreadable(&error))?;
    let before = &lives.last().ok_or_else(|| unreadable(&turns::TurnsError::Empty))?.heading;
    texts(&heading.changed(before), changed_texts, console)?;
    let (recording, exit) = open(folder, console)?;
    if exit != Exit::Yes {
        return Err(unreadable(&"the journal is damaged, and is left as it is"));
    }
    let (last, _) = recording.last();
    let (past, assembly) = Past::relive(&recording, last, assembly).map_err(|error| unreadable(&error))?;
    let happened = Happened::read(folder, past.elapsed()).map_err(|error| unreadable(&error))?;
    let heading = heading.of(before.run.clone()).from(last);
    // The segment begins with the very state in which the last one ended; what follows from the crash comes after it.
    let journal = attach(folder, &assembly.graph)?;
    expire_all(&assembly.graph).map_err(|error| unreadable(&error))?;
    let turns = Turns::go_on(folder, &heading).map_err(|error| unwritable(folder, &error))?;
    let opened = recorded(folder, assembly, journal, turns, heading.run)?;
    Ok(Opened { past: Some(past.with(happened)), ..opened })
}

fn attach(folder: &Path, graph: &Graph) -> Result<Journal, Failed> {
    let store = Folder::new(folder).map_err(|error| unwritable(folder, &error))?;
    graph.journal(store, Settings::default()).map_err(|error| unwritable(folder, &error))
}

fn recorded(
    folder: &Path,
    assembly: Assembly,
    journal: Journal,
    turns: Turns,
    run: String,
) -> Result<Opened, Failed> {
    let room = RoomLog::open(folder).map_err(|error| unwritable(folder, &error))?;
    let kept = Kept { disk: Some(Arc::new(journal.waiter())), room, run };
    Ok(Opened { assembly, journal: Some(journal), turns: Some(turns), past: None, kept })
}

/// Whether the run may go on with these texts changed.
fn texts(changed: &[String], accepted: bool, console: &mut Console<'_>) -> Result<(), Failed> {
    let are_words = |name: &&String| name.starts_with("content/");
    let makes_the_graph = |name: &&String| {
        ["graph.pddl", "world.pddl", "vocabulary.pddl"].iter().any(|file| name.ends_with(file))
    };
    let list =
        |names: Vec<&String>| names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    let others: Vec<_> = changed.iter().filter(|name| !are_words(name)).collect();
    let graph: Vec<_> = changed.iter().filter(makes_the_graph).collect();
    if !graph.is_empty() {
        let message = format!("the graph of the run was made from another {}: begin a new run", list(graph));
        return Err(Failed::new(Exit::Unreadable, message));
    }
    if !others.is_empty() && !accepted {
        let message = format!(
            "the mission has changed since the run began: {}; `--changed-texts` goes on all the same",
            list(others)
        );
        return Err(Failed::new(Exit::Unreadable, message));
    }
    if !changed.is_empty() {
        console.note(&format!(
            "the mission has changed since the run began: {}",
            list(changed.iter().collect())
        ));
    }
    Ok(())
}

fn unwritable(folder: &Path, why: &dyn Display) -> Failed {
    Failed::new(Exit::Unwritable, format!("cannot record the run in `{}`: {why}", folder.display()))
}
