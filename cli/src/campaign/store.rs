//! The results file: what a campaign can be resumed from, compared with and drawn from.
//!
//! One JSON object a line, appended while the campaign runs, so that what is done survives an interruption; a last line
//! that was cut short is ignored. The first line has the fingerprint of all texts: a results file of other texts is not
//! resumed.

use super::instants::Instant;
use super::record::{Lines, Run};
use serde::{Deserialize, Serialize};
use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, BufWriter, Write};
use std::path::Path;

/// Runs that an interruption may lose.
const FLUSH: usize = 200;

/// The lines of a results file.
#[derive(Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum Line {
    Campaign {
        mission: String,
        fingerprint: u64,
        instants: Vec<Instant>,
    },
    /// The next line of stories.
    Story {
        text: String,
    },
    Run(Run),
}

/// A results file, read.
#[derive(Default)]
pub(super) struct Kept {
    pub(super) fingerprint: u64,
    pub(super) instants: Vec<Instant>,
    pub(super) lines: Vec<String>,
    pub(super) runs: Vec<Run>,
}

/// Reads a results file.
pub(super) fn read(path: &Path) -> io::Result<Kept> {
    let mut kept = Kept::default();
    for line in BufReader::new(File::open(path)?).lines() {
        let line = line?;
        let Ok(line) = serde_json::from_str(&line) else { break };
        match line {
            Line::Campaign { fingerprint, instants, .. } => {
                (kept.fingerprint, kept.instants) = (fingerprint, instants);
            }
            Line::Story { text } => kept.lines.push(text),
            Line::Run(run) => kept.runs.push(run),
        }
    }
    if kept.instants.is_empty() {
        return Err(io::Error::new(
            io::ErrorKind::InvalidData,
            "it does not begin like the results of a campaign",
        ));
    }
    Ok(kept)
}

/// A results file that is being written.
pub(super) struct Store {
    file: BufWriter<File>,
    /// How many lines of stories it has.
    lines: usize,
    /// Runs since the file was last written to.
    unwritten: usize,
}

impl Store {
    /// Begins a file, with what was kept of an earlier campaign.
    pub(super) fn begin(path: &Path, mission: &str, kept: &Kept) -> io::Result<Self> {
        let file = OpenOptions::new().create(true).write(true).truncate(true).open(path)?;
        let mut store = Self { file: BufWriter::new(file), lines: 0, unwritten: 0 };
        let (fingerprint, instants) = (kept.fingerprint, kept.instants.clone());
        store.put(&Line::Campaign { mission: mission.to_owned(), fingerprint, instants })?;
        for text in &kept.lines {
            store.put(&Line::Story { text: text.clone() })?;
        }
        store.lines = kept.lines.len();
        for run in &kept.runs {
            store.put(&Line::Run(run.clone()))?;
        }
        Ok(store)
    }

    /// Adds a run, and the lines of its story that are new.
    pub(super) fn add(&mut self, run: &Run, lines: &Lines) -> io::Result<()> {
        for text in lines.since(self.lines) {
            self.put(&Line::Story { text })?;
            self.lines += 1;
        }
        self.put(&Line::Run(run.clone()))?;
        self.unwritten += 1;
        if self.unwritten == FLUSH {
            self.unwritten = 0;
            self.file.flush()?;
        }
        Ok(())
    }

    pub(super) fn finish(mut self) -> io::Result<()> {
        self.file.flush()
    }

    fn put(&mut self, line: &Line) -> io::Result<()> {
        serde_json::to_writer(&mut self.file, line)?;
        self.file.write_all(b"\n")
    }
}
