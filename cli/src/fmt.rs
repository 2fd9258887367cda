//! `pelea fmt PATH...`: formats files.
//!
//! A folder stands for all `.pddl` and `.hddl` files below it, and `-` for standard input, which is
//! formatted to standard output. Only files that change are written, each completely or not at all,
//! in their original encoding. A file with unbalanced parentheses is reported and not changed. With
//! `--json`, one line per file:
//!
//! ```json
//! {"kind": "formatted", "file": "p.pddl", "changed": true, "written": true}
//! ```
//!
//! With `--stdout`, and for standard input, the record also has the field `text`.

use crate::console::{Console, Form};
use crate::exit::Exit;
use crate::files::{self, FileError};
use crate::nearby::{entries, is_source};
use crate::render::{error, show_all};
use clap::Args;
use diagnostics::Sources;
use pddl::Source;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// The arguments of `pelea fmt`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Files and folders; `-` is standard input
    #[arg(required = true)]
    paths: Vec<PathBuf>,
    /// Write no file; list the files that would change, and exit with 1 if there are any
    #[arg(long)]
    check: bool,
    /// Write to standard output instead of the files
    #[arg(long, conflicts_with = "check")]
    stdout: bool,
}

pub(crate) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Exit {
    let mut paths: Vec<PathBuf> = Vec::new();
    for given in &arguments.paths {
        let mut found = Vec::new();
        if given.is_dir() {
            sources_below(given, &mut found);
        } else {
            found.push(given.clone());
        }
        found.retain(|path| !paths.contains(path));
        paths.extend(found);
    }
    paths.iter().fold(Exit::Yes, |exit, path| exit.and(file(path, arguments, console)))
}

/// All source files in a folder and below it, in order.
fn sources_below(folder: &Path, found: &mut Vec<PathBuf>) {
    for path in entries(folder) {
        if path.is_dir() && !path.is_symlink() {
            sources_below(&path, found);
        } else if path.is_file() && is_source(&path) {
            found.push(path);
        }
    }
}

/// Formats a file.
fn file(path: &Path, arguments: &Arguments, console: &mut Console<'_>) -> Exit {
    let before = match files::read_bytes(path) {
        Ok(bytes) => bytes,
        Err(error) => return failed(&error, Exit::Unreadable, console),
    };
    let source = match files::source(path, before.clone()) {
        Ok(source) => source,
        Err(error) => return failed(&error, Exit::Unreadable, console),
    };
    let text = match pddl::format(&source) {
        Ok(text) => text,
        Err(diagnostics) => {
            let (sources, id) = Sources::of(source);
            let findings: Vec<_> = diagnostics.iter().map(|d| d.finding(id)).collect();
            show_all(&sources, &findings, console);
            console.note(&format!("{} is left as it is", sources[id].name()));
            return Exit::Unreadable;
        }
    };
    let after = encode(&before, &text);
    let changed = before != after;
    let to_stdout = arguments.stdout || (path == Path::new("-") && !arguments.check);
    let written = changed && !to_stdout && !arguments.check;
    if written && let Err(error) = files::write_bytes(path, &after) {
        return failed(&error, Exit::Unwritable, console);
    }
    if to_stdout && console.form() == Form::Text {
        console.print(&text);
    } else if changed {
        console.result(&said(&source, written));
    }
    let text = to_stdout.then_some(&*text);
    console.record(&FormattedRecord { kind: "formatted", file: source.name(), changed, written, text });
    if arguments.check && changed { Exit::No } else { Exit::Yes }
}

fn said(source: &Source, written: bool) -> String {
    let done = if written { "formatted" } else { "would change" };
    format!("{}: {done}", source.name())
}

fn failed(why: &FileError, exit: Exit, console: &mut Console<'_>) -> Exit {
    error(why.to_string(), console);
    exit
}

/// Encodes a text like its file: a file that is not UTF-8 was read as Latin-1.
fn encode(before: &[u8], text: &str) -> Vec<u8> {
    if std::str::from_utf8(before).is_ok() {
        return text.as_bytes().to_vec();
    }
    let latin_1: Result<Vec<u8>, _> = text.chars().map(u8::try_from).collect();
    latin_1.unwrap_or_else(|_| text.as_bytes().to_vec())
}

#[derive(Serialize)]
struct FormattedRecord<'a> {
    kind: &'static str,
    file: &'a str,
    changed: bool,
    written: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    text: Option<&'a str>,
}
