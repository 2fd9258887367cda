//! `pelea check PATH...`: every error of every file and mission given, at its place.
//!
//! A folder stands for all `.pddl` and `.hddl` files below it. A folder with a `mission.toml` is a mission and is
//! checked as a whole (`mission`). All other files form one project (`project`). A domain is looked up by its name:
//! among the given files, then beside the file that needs it, then in the folders of the robots (`robots/*/` in a
//! folder above). The problem of a plan is looked up in the plan's folder. With `--json`, the diagnostics are followed
//! by a line per file:
//!
//! ```json
//! {"kind": "checked", "file": "p.pddl", "errors": 0, "warnings": 1, "unsupported": 0,
//!  "checked": true}
//! ```

mod candidates;
mod findings;
mod mission;
mod summary;
mod tally;

use crate::console::Console;
use crate::exit::Exit;
use crate::nearby::MANIFEST;
use crate::task::read_source;
use candidates::{Candidate, find_needs, sources_below};
use clap::Args;
use findings::{Checked, File, wanted};
use lints::Level;
use project::Project;
use serde::Serialize;
use std::path::PathBuf;
use tally::Tally;

/// The arguments of `pelea check`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Mission folders, other folders, and files
    #[arg(required = true)]
    paths: Vec<PathBuf>,
    /// Report only whether each file can be parsed, then the totals; for collections of tasks
    #[arg(long)]
    summary: bool,
    /// Also show warnings that are often intended
    #[arg(long)]
    pedantic: bool,
}

pub(crate) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Exit {
    if arguments.summary {
        return summary::run(&arguments.paths, console);
    }
    let mut exit = Exit::Yes;
    let (mut paths, mut missions) = (Vec::new(), Vec::new());
    for path in &arguments.paths {
        if path.is_dir() {
            sources_below(path, &mut paths, &mut missions);
        } else if path.file_name().is_some_and(|name| name == MANIFEST) {
            missions.push(path.clone());
        } else {
            paths.push(path.clone());
        }
    }
    let level = if arguments.pedantic { Level::Pedantic } else { Level::Default };
    for mission in missions {
        exit = exit.and(mission::check(&mission, level, console));
    }
    let mut files: Vec<Candidate> = Vec::new();
    for path in paths {
        if files.iter().all(|file| file.path != path) {
            match read_source(&path, console) {
                Ok(source) => files.push(Candidate::new(path, source, true)),
                Err(unreadable) => exit = exit.and(unreadable),
            }
        }
    }
    find_needs(&mut files);
    let mut project = Project::without_names();
    project.set_lint_level(level);
    let given: Vec<bool> = files.iter().map(|file| file.given).collect();
    let ids = project.set_all(files.into_iter().map(|file| file.source));
    let files: Vec<File> = ids.into_iter().zip(given).map(|(id, given)| File { id, given }).collect();
    let wanted = wanted(&project, &files);
    let files: Vec<File> = files.into_iter().filter(|file| wanted.contains(&file.id)).collect();
    let tallies = Checked::new(&project, &files).run(console);
    for (file, tally) in files.iter().zip(&tallies).filter(|(file, _)| file.given) {
        exit = exit.and(if tally.errors == 0 { Exit::Yes } else { Exit::No });
        let path = project.path(file.id);
        console.result(&tally.line(path));
        console.record(&CheckedRecord { kind: "checked", file: path, tally: *tally });
    }
    exit
}

#[derive(Serialize)]
struct CheckedRecord<'a> {
    kind: &'static str,
    file: &'a str,
    #[serde(flatten)]
    tally: Tally,
}
