//! `pelea dsr import`: a world of RoboComp's cortex as a journal with one state.

use super::failed::{Failed, unwritable};
use super::journal::begin;
use crate::console::Console;
use crate::exit::Exit;
use crate::files;
use clap::{Args, ValueEnum};
use formats::{CortexUnit, CortexWorld};
use serde::Serialize;
use std::path::PathBuf;

/// Arguments of `pelea dsr import`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// A JSON file with a `DSRModel`
    world: PathBuf,
    /// Create the journal in this folder, which must not have one
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    /// The unit of the translations in the file
    #[arg(long, value_enum, default_value_t = Unit::Mm)]
    unit: Unit,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Unit {
    /// Millimetres
    Mm,
    /// Metres
    M,
}

#[derive(Serialize)]
struct Record<'a> {
    kind: &'static str,
    nodes: usize,
    edges: usize,
    notes: &'a [String],
}

pub(super) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Result<Exit, Failed> {
    let name = arguments.world.display();
    let bytes = files::read_bytes(&arguments.world).map_err(|e| Failed(Exit::Unreadable, e.to_string()))?;
    let world: CortexWorld = serde_json::from_slice(&bytes)
        .map_err(|error| Failed(Exit::Unreadable, format!("`{name}` is no world of cortex: {error}")))?;
    let unit = if arguments.unit == Unit::Mm { CortexUnit::Millimetres } else { CortexUnit::Metres };
    let imported = world
        .import(unit)
        .map_err(|error| Failed(Exit::Unreadable, format!("`{name}` cannot be taken over: {error}")))?;
    let journal = begin(&arguments.output, &imported.graph)?;
    journal.close().map_err(|error| unwritable(&arguments.output, &error))?;
    let snapshot = imported.graph.snapshot();
    imported.notes.iter().for_each(|note| console.note(&format!("note: {note}")));
    let (nodes, edges) = (snapshot.nodes().count(), snapshot.edges().count());
    console.result(&format!("{nodes} nodes and {edges} edges in `{}`", arguments.output.display()));
    console.record(&Record { kind: "import", nodes, edges, notes: &imported.notes });
    Ok(Exit::Yes)
}
