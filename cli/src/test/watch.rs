//! `pelea test --watch`: a suite runs again when one of its files changes.
//!
//! The watcher only reports which paths changed; a pure function ([`suite::touched`]) decides which suites must run.
//! Editors write a file in several steps, so events that follow each other closely count as one change. Every change
//! searches for suites again: an added suite runs, and a deleted suite is no error.

use super::cases::run_folders;
use super::find;
use crate::console::Console;
use crate::exit::Exit;
use crate::render;
use notify::{Event, EventKind, RecursiveMode, Watcher};
use std::collections::BTreeSet;
use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;
use suite::{Extent, touched};

/// A change is complete when no event has come for this long, because an editor writes a file in
/// several steps.
const SETTLED: Duration = Duration::from_millis(50);

/// Runs suites again until `turn` breaks. `turn` is called when the watcher is ready, without folders, and after each
/// run, with the folders that ran. Returns only if the watcher fails or `turn` breaks.
pub(super) fn watch(
    paths: &[PathBuf],
    filter: &[String],
    console: &mut Console<'_>,
    mut turn: impl FnMut(&[PathBuf]) -> ControlFlow<()>,
) -> Exit {
    let (send, changes) = mpsc::channel();
    let watcher = notify::recommended_watcher(move |event: notify::Result<Event>| {
        // The receiver is gone after the last turn.
        let _ = send.send(event);
    });
    let mut watcher = match watcher {
        Ok(watcher) => watcher,
        Err(error) => return failed(&error, console),
    };
    let folders = suites(paths);
    let extents: Vec<Extent> = folders.iter().map(|folder| extent(folder)).collect();
    let roots = paths.iter().map(|path| absolute(path));
    let others = extents.iter().flat_map(|e| &e.elsewhere).filter_map(|path| path.parent());
    let watched: BTreeSet<(PathBuf, bool)> =
        roots.map(|path| (path, true)).chain(others.map(|path| (path.to_owned(), false))).collect();
    for (path, below) in watched {
        let mode = if below { RecursiveMode::Recursive } else { RecursiveMode::NonRecursive };
        if let Err(error) = watcher.watch(&path, mode) {
            return failed(&error, console);
        }
    }
    console.note("watching; Ctrl-C ends it");
    if turn(&[]).is_break() {
        return Exit::Yes;
    }
    while let Some(changed) = next(&changes) {
        let folders = suites(paths);
        let extents: Vec<Extent> = folders.iter().map(|folder| extent(folder)).collect();
        let concerned: Vec<PathBuf> =
            touched(&extents, &changed).into_iter().map(|index| folders[index].clone()).collect();
        if concerned.is_empty() {
            continue;
        }
        console.note("");
        run_folders(&concerned, &[], filter, console);
        if turn(&concerned).is_break() {
            return Exit::Yes;
        }
    }
    Exit::Yes
}

fn failed(error: &notify::Error, console: &mut Console<'_>) -> Exit {
    render::error(format!("cannot watch: {error}"), console);
    Exit::Unreadable
}

/// The paths of the next change and of those that follow closely; `None` when the watcher is gone.
fn next(changes: &Receiver<notify::Result<Event>>) -> Option<Vec<PathBuf>> {
    let mut paths = paths(changes.recv().ok()?);
    while let Ok(event) = changes.recv_timeout(SETTLED) {
        paths.extend(self::paths(event));
    }
    paths.sort();
    paths.dedup();
    Some(paths)
}

/// The paths that an event changes. Events of reading are ignored: a run itself reads every file.
fn paths(event: notify::Result<Event>) -> Vec<PathBuf> {
    match event {
        Ok(Event { kind: EventKind::Access(_), .. }) | Err(_) => Vec::new(),
        Ok(event) => event.paths,
    }
}

fn suites(paths: &[PathBuf]) -> Vec<PathBuf> {
    let mut folders = Vec::new();
    for path in paths {
        find::folders(path, &mut folders);
    }
    folders.dedup();
    folders
}

fn extent(folder: &Path) -> Extent {
    let read = find::read(folder).map(|found| found.elsewhere).unwrap_or_default();
    let elsewhere = read.iter().map(|source| absolute(Path::new(source.name()))).collect();
    Extent { folder: absolute(folder), elsewhere }
}

/// The path in the form in which the watcher reports it.
fn absolute(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| path.to_owned())
}

#[cfg(test)]
mod tests {
    use super::watch;
    use crate::console::Console;
    use crate::exit::Exit;
    use std::fs;
    use std::ops::ControlFlow;

    const DOMAIN: &str = "(define (domain hall) (:predicates (lit)) (:action switch :effect (lit)))";
    const PROBLEM: &str = "(define (problem dark) (:domain hall) (:init) (:goal (lit)))";

    #[test]
    fn a_change_runs_the_suite_that_it_touches() {
        let folder = tempfile::tempdir().unwrap();
        for suite in ["a", "b"] {
            let path = folder.path().join(suite);
            fs::create_dir_all(path.join("valid")).unwrap();
            fs::write(path.join("domain.pddl"), DOMAIN).unwrap();
            fs::write(path.join("problem.pddl"), PROBLEM).unwrap();
            fs::write(path.join("expected.toml"), "").unwrap();
            fs::write(path.join("valid/problem.plan"), "(switch)").unwrap();
        }
        let (mut out, mut err) = (Vec::new(), Vec::new());
        let mut console = Console::new(&mut out, &mut err);
        let paths = [folder.path().to_owned()];
        let plan = folder.path().join("b/valid/problem.plan");
        let mut run = Vec::new();
        let exit = watch(&paths, &[], &mut console, |folders| {
            run.extend(folders.to_vec());
            match run.len() {
                0 => fs::write(&plan, "").unwrap(),
                _ => return ControlFlow::Break(()),
            }
            ControlFlow::Continue(())
        });
        drop(console);
        assert_eq!((exit, run), (Exit::Yes, vec![folder.path().join("b")]));
        let said = String::from_utf8(out).unwrap();
        assert!(said.contains("FAIL") && said.contains("b/valid/problem.plan::valid"), "{said}");
        assert!(!said.contains("a/valid"), "{said}");
    }
}
