//! `pelea dsr`: the graph of a past run, at any version.
//!
//! The commands read a journal: the folder that `pelea run --journal` wrote, or one file of it. An
//! incomplete end is reported and left out. Damage is an error with the position of the byte; the
//! undamaged part is shown nevertheless. With `--json`, `show` writes one record of the kind
//! `graph` (the export), `log` a record `commit` per commit, `diff` one record `difference`, and
//! `query` a record `match` per match.

mod export;
mod failed;
mod history;
mod journal;
mod show;
mod world;

pub(crate) use failed::Failed;
pub(crate) use journal::{Moment, begin, open};

use crate::console::Console;
use crate::exit::Exit;
use clap::Subcommand;

/// The subcommands of `pelea dsr`.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Show a state as sentences, a picture or data
    Show(show::Arguments),
    /// Show every commit: version, time, writer and changes
    Log(history::LogArguments),
    /// Show the differences between two versions
    Diff(history::DiffArguments),
    /// Find the matches of a pattern
    Query(history::QueryArguments),
    /// Export the history as MCAP, for Foxglove and other tools
    Export(export::Arguments),
    /// Import a world of RoboComp's cortex
    Import(world::Arguments),
}

pub(crate) fn run(command: &Command, console: &mut Console<'_>) -> Exit {
    let done = match command {
        Command::Show(arguments) => show::run(arguments, console),
        Command::Log(arguments) => history::log(arguments, console),
        Command::Diff(arguments) => history::diff(arguments, console),
        Command::Query(arguments) => history::query(arguments, console),
        Command::Export(arguments) => export::run(arguments, console),
        Command::Import(arguments) => world::run(arguments, console),
    };
    done.unwrap_or_else(|failed| failed.show(console))
}
