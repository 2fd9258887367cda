//! `pelea test PATH...`: tests for domains as text.
//!
//! Every folder with an `expected.toml`, at a path or below it, is a suite (`suite`); docs/testing.md documents its
//! format. Every scenario of a mission there is a case, too (`scenarios`). The cases of all suites run in parallel; each is shown on a line, in the order of suites and cases. The failed
//! cases are explained at the end. As JSON a case is
//!
//! ```json
//! {"kind": "case", "suite": "domains/tea", "name": "domains/tea/plans/valid/a.plan::valid", "outcome": "pass",
//!  "time_ms": 0.4}
//! ```
//!
//! `suite` is the folder of the suite or of the mission. `outcome` is `pass` or `fail`; the diagnostics of a failed case come before it. The last line is
//!
//! ```json
//! {"kind": "tests", "suites": 2, "unreadable": 0, "passed": 30, "failed": 1, "left_out": 0, "time_ms": 20.1}
//! ```

mod cases;
mod find;
mod init;
mod report;
mod scenarios;
mod watch;

use crate::clock::Seconds;
use crate::console::Console;
use crate::exit::Exit;
use crate::render;
use cases::run_folders;
use clap::Args;
use std::ops::ControlFlow;
use std::path::PathBuf;

/// The arguments of `pelea test`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Folders; every folder with an `expected.toml` at or below them is a suite, and every scenario of a mission there is
    /// a test
    #[arg(default_value = ".")]
    paths: Vec<PathBuf>,
    /// Run only the cases whose names contain this text; may be repeated
    #[arg(long, value_name = "TEXT")]
    filter: Vec<String>,
    /// Watch the files, and run a suite again when one of its files changes
    #[arg(long, conflicts_with = "init")]
    watch: bool,
    /// Create an expected.toml in each folder from the current results
    #[arg(long)]
    init: bool,
    /// With --init: search this many seconds for the cheapest plan of each problem
    #[arg(long, value_name = "S", requires = "init", default_value = "10")]
    timeout: Seconds,
}

pub(crate) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Exit {
    if arguments.init {
        return init::run(&arguments.paths, arguments.timeout, console);
    }
    let exit = once(&arguments.paths, &arguments.filter, console);
    if !arguments.watch {
        return exit;
    }
    watch::watch(&arguments.paths, &arguments.filter, console, |_| ControlFlow::Continue(()))
}

/// Runs every suite at these paths.
fn once(paths: &[PathBuf], filter: &[String], console: &mut Console<'_>) -> Exit {
    let (mut folders, mut missions) = (Vec::new(), Vec::new());
    for path in paths {
        if !path.is_dir() {
            let name = path.display();
            let why = if path.exists() { "it is no folder" } else { "there is no such folder" };
            render::error(format!("cannot test `{name}`: {why}"), console);
            return Exit::Unreadable;
        }
        find::folders(path, &mut folders);
        find::missions(path, &mut missions);
    }
    folders.dedup();
    missions.dedup();
    if folders.is_empty() && missions.is_empty() {
        let help = "`pelea test --init FOLDER` writes a first one";
        let text = "there is no suite here: no folder has an `expected.toml` or a `mission.toml`";
        render::error_with_help(text, Some(help), console);
        return Exit::Unreadable;
    }
    run_folders(&folders, &missions, filter, console)
}
