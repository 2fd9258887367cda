//! `cargo xtask crashes MISSION [--scenarios NAMES] [--kills N] [--seed S] [--every N]`: does a run survive the end of its
//! program, whenever that comes?
//!
//! Each scenario is recorded once; then it is cut after every commit and within every commit, and goes on, in this
//! process. Then real processes are killed at random moments, and go on, and are killed again. What must hold after each
//! is in `pelea_tests::crashes`.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "the results of a command")]

mod kill;

use pelea_tests::crashes::{Cut, Original, folder};
use pelea_tests::{missions, root};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

type Failure = Box<dyn std::error::Error + Send + Sync>;

/// What is asked for.
struct Arguments {
    mission: PathBuf,
    scenarios: Vec<String>,
    kills: usize,
    seed: u64,
    /// Every how many commits a run is cut.
    every: usize,
}

fn main() -> ExitCode {
    // Drivers that panic are part of some scenarios; everybody else's panic is reported.
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        let text = info.payload().downcast_ref::<String>();
        if !text.is_some_and(|text| text.starts_with("the driver of")) {
            report(info);
        }
    }));
    match run() {
        Ok(0) => ExitCode::SUCCESS,
        Ok(failed) => {
            eprintln!("crashes: {failed} runs did not survive");
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("crashes: {error}");
            ExitCode::from(2)
        }
    }
}

fn arguments() -> Result<Arguments, Failure> {
    let mut given = std::env::args().skip(1);
    let mut mission = None;
    let (mut scenarios, mut kills, mut seed, mut every) = (Vec::new(), 20, 0, 1);
    while let Some(argument) = given.next() {
        let mut value = || given.next().ok_or_else(|| format!("`{argument}` needs a value"));
        match argument.as_str() {
            "--scenarios" => scenarios = value()?.split(',').map(str::to_owned).collect(),
            "--kills" => kills = value()?.parse()?,
            "--seed" => seed = value()?.parse()?,
            "--every" => every = value()?.parse::<usize>()?.max(1),
            path => mission = Some(PathBuf::from(path)),
        }
    }
    let mission = mission.unwrap_or_else(|| root().join("domains/barthel"));
    if scenarios.is_empty() {
        let known = missions().into_iter().find(|(folder, _)| folder.file_name() == mission.file_name());
        scenarios = known.map(|(_, scenarios)| scenarios).unwrap_or_default();
    }
    Ok(Arguments { mission, scenarios, kills, seed, every })
}

fn run() -> Result<usize, Failure> {
    let arguments = arguments()?;
    let base = root().join("target");
    let (began, mut points, mut failed) = (Instant::now(), 0, 0);
    for scenario in &arguments.scenarios {
        let original = Original::record(&arguments.mission, scenario, &folder(&base, scenario))?;
        let cuts = cuts(&original, arguments.every);
        let wrong = all(&original, &cuts, scenario, &base);
        println!("{scenario}: {} points, {} failed", cuts.len(), wrong.len());
        wrong.iter().take(5).for_each(|line| println!("  {line}"));
        points += cuts.len();
        failed += wrong.len();
    }
    println!("{points} points in {:.0} s, {failed} failed", began.elapsed().as_secs_f64());
    if arguments.kills > 0 {
        failed +=
            kill::all(&arguments.mission, &arguments.scenarios, arguments.kills, arguments.seed, &base)?;
    }
    Ok(failed)
}

fn cuts(original: &Original, every: usize) -> Vec<Cut> {
    let after = (0..=original.commits()).step_by(every).map(Cut::After);
    let within = (0..original.commits()).step_by(every).map(Cut::Within);
    after.chain(within).collect()
}

/// Plays every cut, on all cores. What is wrong, by point.
fn all(original: &Original, cuts: &[Cut], scenario: &str, base: &Path) -> Vec<String> {
    let (next, wrong) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for worker in 0..workers {
            let (next, wrong) = (&next, &wrong);
            scope.spawn(move || {
                let at = folder(base, &format!("{scenario}-{worker}"));
                while let Some(&cut) = cuts.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let found = match original.crash(cut, &at) {
                        Ok(held) => {
                            let mut found = original.goes_on(&held, &at);
                            found.extend(original.replays(&at).err());
                            found
                        }
                        Err(error) => vec![error.to_string()],
                    };
                    if !found.is_empty() {
                        wrong
                            .lock()
                            .expect("no worker panics")
                            .push(format!("{cut:?}: {}", found.join("; ")));
                    }
                }
            });
        }
    });
    wrong.into_inner().expect("no worker panics")
}
