//! `pelea dsr export`: a journal as a file that Foxglove and other tools read (MCAP).

use super::failed::{Failed, unwritable_file};
use super::journal::open;
use crate::console::Console;
use crate::exit::Exit;
use clap::Args;
use formats::McapWriteError;
use std::fs::File;
use std::io::BufWriter;
use std::path::PathBuf;

/// Arguments of `pelea dsr export`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The journal: the folder of `pelea run --journal`, or a file in it
    journal: PathBuf,
    /// Write the MCAP file to this path
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

pub(super) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Result<Exit, Failed> {
    let (recording, exit) = open(&arguments.journal, console)?;
    let path = &arguments.output;
    let file = File::create(path).map_err(|error| unwritable_file(path, &error))?;
    let written = formats::write_mcap(&recording, BufWriter::new(file)).map_err(|error| match error {
        McapWriteError::Recording(error) => error.into(),
        McapWriteError::Mcap(error) => unwritable_file(path, &error),
    })?;
    console.note(&format!("{written} messages written to `{}`", path.display()));
    Ok(exit)
}
