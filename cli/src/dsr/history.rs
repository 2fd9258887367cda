//! `pelea dsr log`, `diff` and `query`: what happened, what differs, and where a pattern matches.

use super::{Failed, Moment, open, seconds, state};
use crate::console::Console;
use crate::exit::Exit;
use clap::Args;
use dsr::{Binding, Change, Delta, Mentions, Pattern, Played, Snapshot};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// Arguments of `pelea dsr log`.
#[derive(Debug, Args)]
pub(crate) struct LogArguments {
    /// A journal: the folder of `pelea run --journal`, or a file in it.
    journal: PathBuf,
    /// Only commits whose sentences hold this text.
    #[arg(long, value_name = "TEXT")]
    about: Option<String>,
    /// Only commits of this agent.
    #[arg(long, value_name = "AGENT")]
    by: Option<String>,
}

/// Arguments of `pelea dsr diff`.
#[derive(Debug, Args)]
pub(crate) struct DiffArguments {
    /// A journal: the folder of `pelea run --journal`, or a file in it.
    journal: PathBuf,
    /// A version such as `12`, or a time such as `3.5s`.
    from: Moment,
    /// The same.
    to: Moment,
}

/// Arguments of `pelea dsr query`.
#[derive(Debug, Args)]
pub(crate) struct QueryArguments {
    /// A journal: the folder of `pelea run --journal`, or a file in it.
    journal: PathBuf,
    /// Such as `(and (is_with ?who ?robot) (not (is ?robot speaking)))`.
    pattern: String,
    /// A version such as `12`, or a time such as `3.5s`; the last version if not given.
    #[arg(long, value_name = "VERSION|TIME", conflicts_with = "history")]
    at: Option<Moment>,
    /// When matches appeared and disappeared, over the whole journal.
    #[arg(long)]
    history: bool,
}

#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum Record<'a> {
    Commit { version: u64, time: f64, writer: &'a str, sentences: &'a [String], changes: &'a [Change] },
    Jump { from: u64, to: u64 },
    Difference { from: u64, to: u64, sentences: &'a [String], changes: &'a [Change] },
    Match { version: u64, time: f64, holds: bool, bindings: BTreeMap<&'a str, &'a str> },
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
        let snapshot = replay.snapshot();
        let writer = recording.dictionary().agent_name(delta.writer).map_or("", |name| name);
        let sentences = delta.sentences(&snapshot);
        let wanted = |text: &String| sentences.iter().any(|sentence| sentence.contains(text.as_str()));
        if !arguments.about.as_ref().is_none_or(wanted)
            || arguments.by.as_ref().is_some_and(|by| by != writer)
        {
            continue;
        }
        let (version, time) = (delta.version.0, seconds(delta.time));
        console.result(&format!("{version:>6} {time:>10.3} s  {writer}: {}", sentences.join("; ")));
        console.record(&Record::Commit {
            version,
            time,
            writer,
            sentences: &sentences,
            changes: &delta.changes,
        });
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
    let pattern = Pattern::parse(recording.dictionary(), &arguments.pattern)
        .map_err(|error| Failed(Exit::Unreadable, format!("the pattern cannot be read: {error}")))?;
    let mut any = false;
    if !arguments.history {
        let snapshot = state(&recording, arguments.at)?;
        for binding in pattern.matches(&snapshot) {
            any = true;
            tell(&pattern, &binding, &snapshot, true, "", console);
        }
    } else {
        let mut replay = recording.replay()?;
        let mut before = replay.snapshot();
        let mut held: BTreeSet<Binding> = BTreeSet::new();
        let mut first = true;
        loop {
            let snapshot = replay.snapshot();
            let now: BTreeSet<_> = pattern.matches(&snapshot).into_iter().collect();
            any |= !now.is_empty();
            let when = format!("{:>6} {:>10.3} s  ", snapshot.version().0, seconds(snapshot.time()));
            for gone in held.difference(&now) {
                // A node that went has its name in the state before.
                tell(&pattern, gone, &before, false, &format!("{when}no longer: "), console);
            }
            for new in now.difference(&held) {
                tell(
                    &pattern,
                    new,
                    &snapshot,
                    true,
                    &format!("{when}{}", if first { "already: " } else { "" }),
                    console,
                );
            }
            (held, before, first) = (now, snapshot, false);
            // What does not touch the pattern's tokens changes no match.
            let touched = loop {
                match replay.next().transpose()? {
                    None => break false,
                    Some(Played::Jump { .. }) => break true,
                    Some(Played::Commit(delta)) if Mentions::of(&delta).intersects(pattern.mentions()) => {
                        break true;
                    }
                    Some(Played::Commit(_)) => before = replay.snapshot(),
                }
            };
            if !touched {
                break;
            }
        }
    }
    Ok(exit.and(if any { Exit::Yes } else { Exit::No }))
}

fn tell(
    pattern: &Pattern,
    binding: &Binding,
    snapshot: &Snapshot,
    holds: bool,
    before: &str,
    console: &mut Console<'_>,
) {
    let names = pattern.variables().zip(binding.iter());
    let bindings: BTreeMap<_, _> =
        names.map(|((variable, _), id)| (variable, snapshot.name(*id).unwrap_or("?"))).collect();
    let said: Vec<_> = bindings.iter().map(|(variable, name)| format!("?{variable} = {name}")).collect();
    console.result(&format!("{before}{}", if said.is_empty() { "yes".to_owned() } else { said.join(", ") }));
    let (version, time) = (snapshot.version().0, seconds(snapshot.time()));
    console.record(&Record::Match { version, time, holds, bindings });
}
