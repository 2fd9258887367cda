//! `pelea test --init FOLDER...`: creates an `expected.toml` from the current results.

use super::find;
use crate::clock::Seconds;
use crate::console::Console;
use crate::exit::Exit;
use crate::files;
use crate::memory;
use crate::render;
use pddl::Source;
use planner::Budget;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::Instant;
use suite::draft;

pub(super) fn run(folders: &[PathBuf], timeout: Seconds, console: &mut Console<'_>) -> Exit {
    folders.iter().fold(Exit::Yes, |exit, folder| exit.and(one(folder, timeout, console)))
}

fn one(folder: &Path, timeout: Seconds, console: &mut Console<'_>) -> Exit {
    let path = folder.join(find::EXPECTED);
    let refusal = if path.exists() {
        Some(format!("`{}` is there already", path.display()))
    } else if !folder.is_dir() {
        Some(format!("`{}` is no folder", folder.display()))
    } else {
        None
    };
    if let Some(refusal) = refusal {
        render::error(refusal, console);
        return Exit::Unreadable;
    }
    let found = match find::read_with(folder, &Source::new("", "")) {
        Ok(found) => found,
        Err(error) => {
            render::error(error.to_string(), console);
            return Exit::Unreadable;
        }
    };
    let start = Instant::now();
    let now = move || start.elapsed();
    let budget = Budget { memory_bytes: Some(memory::budget()), ..Budget::default() };
    let text = draft(found, timeout.duration(), &now, &budget);
    if let Err(error) = files::write(&path, &text) {
        render::error(error.to_string(), console);
        return Exit::Unwritable;
    }
    console.result(&format!("{}: written; read it, it says what is so, not what should be", path.display()));
    console.record(&WrittenRecord { kind: "written", file: &path.display().to_string() });
    Exit::Yes
}

#[derive(Serialize)]
struct WrittenRecord<'a> {
    kind: &'static str,
    file: &'a str,
}
