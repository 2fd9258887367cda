//! `pelea dsr log`, `diff` and `query`: the commits, the difference of two versions, and the matches of a pattern.

use super::failed::Failed;
use super::journal::{Moment, open, state};
use crate::console::Console;
use crate::exit::Exit;
use clap::Args;
use dsr::{Binding, Change, Delta, Mentions, Pattern, Played, Recording, Snapshot};
use formats::{CommitRecord, seconds};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// Arguments of `pelea dsr log`.
#[derive(Debug, Args)]
pub(crate) struct LogArguments {
    /// The journal: the folder of `pelea run --journal`, or a file in it
    journal: PathBuf,
    /// Show only commits whose sentences contain this text
    #[arg(long, value_name = "TEXT")]
    about: Option<String>,
    /// Show only commits of this agent
    #[arg(long, value_name = "AGENT")]
    by: Option<String>,
}

/// Arguments of `pelea dsr diff`.
#[derive(Debug, Args)]
pub(crate) struct DiffArguments {
    /// The journal: the folder of `pelea run --journal`, or a file in it
    journal: PathBuf,
    /// The old state: a version such as `12`, or a time such as `3.5s`
    from: Moment,
    /// The new state: a version or a time
    to: Moment,
}

/// Arguments of `pelea dsr query`.
#[derive(Debug, Args)]
pub(crate) struct QueryArguments {
    /// The journal: the folder of `pelea run --journal`, or a file in it
    journal: PathBuf,
    /// The pattern, such as `(and (is_with ?who ?robot) (not (is ?robot speaking)))`
    pattern: String,
    /// The state: a version such as `12`, or a time such as `3.5s` [default: the last version]
    #[arg(long, value_name = "VERSION|TIME", conflicts_with = "history")]
    at: Option<Moment>,
    /// Show when matches appeared and disappeared, over the whole journal
    #[arg(long)]
    history: bool,
}

#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum Record<'a> {
    Commit(&'a CommitRecord<'a>),
    Jump { from: u64, to: u64 },
    Difference { from: u64, to: u64, sentences: &'a [String], changes: &'a [Change] },
    Match { version: u64, time: f64, holds: bool, bindings: &'a Names<'a> },
}

pub(super) fn log(arguments: &LogArguments, console: &mut Console<'_>) -> Result<Exit, Failed> {
    let (recording, exit) = open(&arguments.journal, console)?;
    let mut replay = recording.replay()?;
    while let Some(played) = replay.next() {
        let delta = match played? {
            Played::Commit(delta) => delta,
            Played::Jump { from, to } => {
                console.result(&format!("versions {} to {} were not recorded", from.0 + 1, to.0));
                console.record(&Record::Jump { from: from.0, to: to.0 });
                continue;
            }
        };
        let record = CommitRecord::new(&recording, &delta, &replay.snapshot());
        let CommitRecord { version, time, writer, ref sentences, .. } = record;
        let wanted = |text: &String| sentences.iter().any(|sentence| sentence.contains(text.as_str()));
        if arguments.by.as_ref().is_some_and(|by| by != writer)
            || !arguments.about.as_ref().is_none_or(wanted)
        {
            continue;
        }
        console.result(&format!("{version:>6} {time:>10.3} s  {writer}: {}", sentences.join("; ")));
        console.record(&Record::Commit(&record));
    }
    Ok(exit)
}

pub(super) fn diff(arguments: &DiffArguments, console: &mut Console<'_>) -> Result<Exit, Failed> {
    let (recording, exit) = open(&arguments.journal, console)?;
    let (before, after) = (arguments.from.of(&recording)?, arguments.to.of(&recording)?);
    let changes = before.diff(&after);
    let writer = dsr::AgentId::DSR;
    let delta = Delta { version: after.version(), time: after.time(), writer, changes, reflexes: Vec::new() };
    let sentences = delta.sentences(&after);
    sentences.iter().for_each(|line| console.result(line));
    let (from, to) = (before.version().0, after.version().0);
    console.record(&Record::Difference { from, to, sentences: &sentences, changes: &delta.changes });
    Ok(exit)
}

pub(super) fn query(arguments: &QueryArguments, console: &mut Console<'_>) -> Result<Exit, Failed> {
    let (recording, exit) = open(&arguments.journal, console)?;
    let pattern = Pattern::parse(recording.vocabulary(), &arguments.pattern)
        .map_err(|error| Failed(Exit::Unreadable, format!("the pattern cannot be read: {error}")))?;
    let any = if arguments.history {
        history(&recording, &pattern, console)?
    } else {
        let snapshot = state(&recording, arguments.at)?;
        let matches = pattern.matches(&snapshot);
        for binding in &matches {
            tell(&snapshot, &named(&pattern, binding, &snapshot), true, "", console);
        }
        !matches.is_empty()
    };
    Ok(exit.and(if any { Exit::Yes } else { Exit::No }))
}

/// Reports the versions in which each match appeared and disappeared. Returns whether there was a
/// match.
///
/// No snapshot is kept while the replay advances: the replay would have to copy the state.
fn history(recording: &Recording, pattern: &Pattern, console: &mut Console<'_>) -> Result<bool, Failed> {
    let mut replay = recording.replay()?;
    // The names are kept because a deleted node no longer has one.
    let mut held: BTreeMap<Binding, Names<'_>> = BTreeMap::new();
    let (mut any, mut first) = (false, true);
    loop {
        {
            let snapshot = replay.snapshot();
            let now: BTreeSet<Binding> = pattern.matches(&snapshot).into_iter().collect();
            any |= !now.is_empty();
            let when = format!("{:>6} {:>10.3} s  ", snapshot.version().0, seconds(snapshot.time()));
            held.retain(|binding, names| {
                let stays = now.contains(binding);
                if !stays {
                    tell(&snapshot, names, false, &format!("{when}no longer: "), console);
                }
                stays
            });
            for new in now {
                held.entry(new).or_insert_with_key(|new| {
                    let names = named(pattern, new, &snapshot);
                    let before = format!("{when}{}", if first { "already: " } else { "" });
                    tell(&snapshot, &names, true, &before, console);
                    names
                });
            }
            first = false;
        }
        // A commit that does not touch the pattern's tokens changes no match.
        loop {
            match replay.next().transpose()? {
                None => return Ok(any),
                Some(Played::Jump { .. }) => break,
                Some(Played::Commit(delta)) if Mentions::of(&delta).intersects(pattern.mentions()) => break,
                Some(Played::Commit(_)) => {}
            }
        }
    }
}

/// The nodes of a match by their variables.
type Names<'p> = BTreeMap<&'p str, String>;

fn named<'p>(pattern: &'p Pattern, binding: &Binding, snapshot: &Snapshot) -> Names<'p> {
    let nodes = pattern.variables().zip(binding.iter());
    nodes.map(|((variable, _), id)| (variable, snapshot.name(*id).unwrap_or("?").to_owned())).collect()
}

/// Reports a match that begins or ceases to hold at `at`.
fn tell(at: &Snapshot, bindings: &Names<'_>, holds: bool, before: &str, console: &mut Console<'_>) {
    let said: Vec<_> = bindings.iter().map(|(variable, name)| format!("?{variable} = {name}")).collect();
    console.result(&format!("{before}{}", if said.is_empty() { "yes".to_owned() } else { said.join(", ") }));
    let (version, time) = (at.version().0, seconds(at.time()));
    console.record(&Record::Match { version, time, holds, bindings });
}
