//! From a deviation to a new intention in the graph, on the real clock: the Barthel test, and a person who is lost again
//! and again.
//!
//! The program itself runs, with a journal and with a terminal that nobody reads. The journal has the times: of the commit
//! that loses the person, and of the next one in which PELEA writes. Between them are the deviation, its reason, the plan
//! (repaired and from scratch, validated), the method and the write. Alone, and beside programs of lower priority that
//! plan on every core.
//!
//!     cargo bench -p pelea --bench deviation -- 5

#![allow(clippy::unwrap_used, reason = "a bench stops by panicking")]
#![allow(clippy::print_stdout, reason = "the figures are what it is for")]

use dsr::{Played, Recording};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::available_parallelism;
use std::time::Duration;
use std::{env, fs};
use tempfile::TempDir;

/// How often the person is lost in a run; below the bound at which the mission calls a clinician instead.
const LOSSES: usize = 15;

/// Seconds from one loss to the next.
const APART: f64 = 2.0;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The person answers nothing, is lost, and comes back.
fn scenario() -> String {
    let mut text = "title = \"Lost again and again\"\ndisruption = [\n".to_owned();
    for loss in 0..LOSSES {
        let at = 3.0 + APART * loss as f64;
        let back = at + APART / 2.0;
        writeln!(
            text,
            "  {{ at = {at:.1}, do = \"lose-person\" }}, {{ at = {back:.1}, do = \"return-person\" }},"
        )
        .unwrap();
    }
    text + "]\n"
}

/// One run, and how long each new intention took.
fn run(folder: &TempDir, name: &str) -> Vec<Duration> {
    let (scenario, journal) = (folder.path().join("lost.toml"), folder.path().join(name));
    fs::write(&scenario, self::scenario()).unwrap();
    let mut robot = Command::new(env!("CARGO_BIN_EXE_pelea"))
        .current_dir(root())
        .args(["run", "domains/barthel", "--speed", "1", "--verbose", "--horizon"])
        .arg(format!("{}", 3.0 + APART * LOSSES as f64))
        .arg("--scenario")
        .arg(&scenario)
        .arg("--journal")
        .arg(&journal)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    // Taken, so that waiting does not read it.
    let terminal = robot.stdout.take();
    robot.wait().unwrap();
    drop(terminal);
    times(&journal)
}

/// From each loss of the person to the next write of PELEA.
fn times(journal: &Path) -> Vec<Duration> {
    let recording = Recording::open(journal).unwrap();
    let pelea = recording.vocabulary().agent("pelea").unwrap();
    let mut replay = recording.replay().unwrap();
    let (mut was_there, mut lost) = (false, None);
    let mut times = Vec::new();
    while let Some(played) = replay.next() {
        let Played::Commit(delta) = played.unwrap() else { continue };
        let is_there =
            replay.snapshot().sentences().iter().any(|sentence| sentence == "person is with robot");
        if was_there && !is_there {
            lost = Some(delta.time);
        } else if let Some(lost) = lost.take_if(|_| delta.writer == pelea) {
            times.push(Duration::from_nanos(delta.time.0 - lost.0));
        }
        was_there = is_there;
    }
    times
}

fn report(title: &str, runs: usize, folder: &TempDir) {
    let mut times: Vec<Duration> =
        (0..runs).flat_map(|number| run(folder, &format!("{title} {number}"))).collect();
    assert!(!times.is_empty(), "the person was never lost");
    times.sort_unstable();
    let at = |percent: usize| times[(times.len() - 1) * percent / 100];
    let (half, most, last) = (at(50), at(99), at(100));
    println!(
        "{title}, {} deviations: p50 {half:?}, p90 {:?}, p99 {most:?}, most {last:?}",
        times.len(),
        at(90)
    );
}

/// A program of lower priority that plans for ever, ended on drop.
struct Busy(Child);

impl Busy {
    fn start() -> Self {
        let plans = "while :; do \"$1\" plan domains/barthel/domain.pddl domains/barthel/problem.pddl; done";
        let mut shell = Command::new("nice");
        shell.args(["-n", "10", "sh", "-c", plans, "sh", env!("CARGO_BIN_EXE_pelea")]).current_dir(root());
        Self(shell.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap())
    }
}

impl Drop for Busy {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn main() {
    let runs = env::args().find_map(|argument| argument.parse().ok()).unwrap_or(1);
    let folder = TempDir::new().unwrap();
    report("alone", runs, &folder);
    let cores = available_parallelism().map_or(1, usize::from);
    let _busy: Vec<Busy> = (0..cores).map(|_| Busy::start()).collect();
    report(&format!("beside {cores} planners of lower priority"), runs, &folder);
}
