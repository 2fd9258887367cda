//! `cargo xtask mutants MISSION [--sample N] [--seed S] [--fresh]`: do check, tests and scenarios notice a wrong token?
//!
//! Each mutant is a copy of the mission and its robot with one token changed (`mutate`). It is caught by `pelea check`
//! (errors or warnings), by `pelea test`, or by a scenario whose outcome changes (`judge`). Each runs in a process of its
//! own, so that a mutant that never ends can be ended. Results are kept in `target/mutants/`, by the contents of the texts;
//! a later call with a larger sample continues there. `--fresh` starts anew, as is needed after a change of the checks.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "the results of a command")]

mod judge;
mod mutate;

use judge::{Baseline, play};
use mutate::{Mutant, Names, mutants};
use pddl::Source;
use std::collections::BTreeMap;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, mpsc};
use std::time::{Duration, Instant};

/// How long one mutant may take. A run of all scenarios takes some seconds.
const PATIENCE: Duration = Duration::from_secs(240);

type Failure = Box<dyn std::error::Error + Send + Sync>;

/// A mission's texts and mutants.
struct Subject {
    /// The folder that contains `domains` and `robots`.
    root: PathBuf,
    mission: PathBuf,
    texts: Vec<Source>,
    mutants: Vec<Mutant>,
}

impl Subject {
    fn read(mission: &Path) -> Result<Self, Failure> {
        let mission = mission.canonicalize()?;
        let robot = robot(&mission)?;
        let root = mission
            .ancestors()
            .find(|folder| robot.starts_with(folder))
            .ok_or("mission and robot have no common folder")?
            .to_owned();
        let mut paths = Vec::new();
        for folder in [mission.clone(), robot.clone(), robot.join("agents")] {
            let entries = fs::read_dir(folder)?.flatten().map(|entry| entry.path());
            paths.extend(entries.filter(|p| p.extension().is_some_and(|e| e == "pddl" || e == "hddl")));
        }
        paths.sort();
        let mut texts = Vec::new();
        for path in paths {
            let name = path.strip_prefix(&root)?.to_string_lossy().into_owned();
            texts.push(Source::new(&*name, fs::read_to_string(path)?));
        }
        let names = Names::of(&texts);
        let found = texts.iter().enumerate().flat_map(|(file, text)| mutants(file, text, &names));
        let mutants = found.collect();
        let mission = mission.strip_prefix(&root)?.to_owned();
        Ok(Self { root, mission, texts, mutants })
    }

    /// `file:line:column: operator: `old` -> `new``
    fn describe(&self, mutant: &Mutant) -> String {
        let text = &self.texts[mutant.file];
        let at = text.line_column(mutant.span.start);
        let one_line = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        let (old, new) = (one_line(text.slice(mutant.span)), one_line(&mutant.new));
        let change = if new.is_empty() { format!("`{old}`") } else { format!("`{old}` -> `{new}`") };
        format!("{}:{}:{}: {}: {change}", text.name(), at.line, at.column, mutant.operator)
    }

    fn fingerprint(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.texts.iter().for_each(|text| text.text().hash(&mut hasher));
        hasher.finish()
    }

    /// Copies the mission and its robot to `to`, with one mutant or none.
    fn copy(&self, to: &Path, mutant: Option<&Mutant>) -> Result<(), Failure> {
        copy(&self.root.join(&self.mission), &to.join(&self.mission))?;
        let robot = robot(&self.root.join(&self.mission))?;
        copy(&robot, &to.join(robot.strip_prefix(&self.root)?))?;
        if let Some(mutant) = mutant {
            let text = &self.texts[mutant.file];
            let mut changed = text.text().to_owned();
            changed.replace_range(mutant.span.range(), &mutant.new);
            fs::write(to.join(text.name()), changed)?;
        }
        Ok(())
    }
}

/// The robot's folder.
fn robot(mission: &Path) -> Result<PathBuf, Failure> {
    let manifest = fs::read_to_string(mission.join("mission.toml"))?;
    let line = manifest.lines().find_map(|line| line.strip_prefix("robot"));
    let path = line.and_then(|line| line.split('"').nth(1)).ok_or("the mission names no robot")?;
    Ok(mission.join(path).canonicalize()?)
}

fn copy(from: &Path, to: &Path) -> Result<(), Failure> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let path = entry?.path();
        let target = to.join(path.file_name().ok_or("a file has a name")?);
        if path.is_dir() { copy(&path, &target)? } else { fs::copy(&path, &target).map(drop)? }
    }
    Ok(())
}

/// The scenarios with their outcomes, the quickest first.
fn baseline(mission: &Path) -> Result<Baseline, Failure> {
    let mut timed = Vec::new();
    for entry in fs::read_dir(mission.join("scenarios"))? {
        let path = entry?.path();
        let Some(name) = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()) else { continue };
        let since = Instant::now();
        let ended = play(&mission.to_string_lossy(), &name);
        timed.push((since.elapsed(), name, ended));
    }
    timed.sort_by_key(|(time, ..)| *time);
    Ok(Baseline(timed.into_iter().map(|(_, name, ended)| (name, ended)).collect()))
}

/// Judges one mutant: the work of a process of its own.
fn one(subject: &Subject, id: usize, folder: &Path, expected: &Path) -> Result<(), Failure> {
    let baseline = Baseline::read(&fs::read_to_string(expected)?).ok_or("the outcomes are unreadable")?;
    subject.copy(folder, Some(subject.mutants.get(id).ok_or("no such mutant")?))?;
    let (by, same) = judge::judge(&folder.join(&subject.mission), &baseline);
    match by {
        Some(by) => println!("{by}"),
        None if same => println!("{SURVIVES}, and no run differs"),
        None => println!("{SURVIVES}"),
    }
    Ok(())
}

/// What is printed of a mutant that nothing notices.
const SURVIVES: &str = "survives";

/// Judges a mutant in another process, and ends it when it takes too long.
fn judge_apart(mission: &Path, id: usize, folder: &Path, expected: &Path) -> Result<String, Failure> {
    if folder.exists() {
        fs::remove_dir_all(folder)?;
    }
    let mut child = Command::new(std::env::current_exe()?)
        .arg(mission)
        .args(["--one", &id.to_string(), "--folder"])
        .arg(folder)
        .arg("--expected")
        .arg(expected)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()?;
    let mut pipe = child.stdout.take().ok_or("the process has no output")?;
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || {
        let mut text = String::new();
        let read = pipe.read_to_string(&mut text);
        // The receiver is gone if the mutant took too long.
        let _ = sender.send(read.map(|_| text));
    });
    let Ok(said) = receiver.recv_timeout(PATIENCE) else {
        child.kill()?;
        child.wait()?;
        return Ok("never ends".to_owned());
    };
    let (said, status) = (said?.trim().to_owned(), child.wait()?);
    Ok(if status.success() && !said.is_empty() { said } else { "panics".to_owned() })
}

/// Judges a sample of all mutants and prints the figures.
fn campaign(subject: &Subject, sample: usize, seed: u64, fresh: bool) -> Result<(), Failure> {
    let folder = Path::new("target/mutants").join(format!("{:016x}", subject.fingerprint()));
    fs::create_dir_all(&folder)?;
    let folder = folder.canonicalize()?;
    let results = folder.join("results.tsv");
    if fresh && results.exists() {
        fs::remove_file(&results)?;
    }
    let known: BTreeMap<usize, String> = fs::read_to_string(&results)
        .unwrap_or_default()
        .lines()
        .filter_map(|line| line.split_once('\t'))
        .filter_map(|(id, by)| Some((id.parse().ok()?, by.to_owned())))
        .collect();
    // The mission may be edited meanwhile, which would renumber its mutants.
    let copied = folder.join("original");
    subject.copy(&copied, None)?;
    let original = copied.join(&subject.mission);
    let expected = folder.join("expected.tsv");
    fs::write(&expected, baseline(&original)?.write())?;

    let chosen = chosen(subject.mutants.len(), sample, seed);
    let open: Vec<usize> = chosen.iter().copied().filter(|id| !known.contains_key(id)).collect();
    let file = Mutex::new(fs::OpenOptions::new().create(true).append(true).open(&results)?);
    let (next, verdicts) = (AtomicUsize::new(0), Mutex::new(known));
    let work = |worker: usize| -> Result<(), Failure> {
        let slot = folder.join(format!("slot-{worker}"));
        while let Some(&id) = open.get(next.fetch_add(1, Ordering::Relaxed)) {
            let by = judge_apart(&original, id, &slot, &expected)?;
            let mut file = file.lock().map_err(|_| "another worker panicked")?;
            writeln!(file, "{id}\t{by}")?;
            verdicts.lock().map_err(|_| "another worker panicked")?.insert(id, by);
        }
        Ok(())
    };
    std::thread::scope(|scope| {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let workers: Vec<_> = (0..cores).map(|worker| scope.spawn(move || work(worker))).collect();
        workers.into_iter().try_for_each(|worker| worker.join().map_err(|_| "a worker panicked")?)
    })?;
    let verdicts = verdicts.into_inner().map_err(|_| "a worker panicked")?;
    report(subject, &chosen, &verdicts);
    Ok(())
}

/// A sample of the mutants, the same for the same seed; a larger one contains the smaller.
fn chosen(count: usize, sample: usize, seed: u64) -> Vec<usize> {
    let mut ids: Vec<usize> = (0..count).collect();
    ids.sort_by_key(|id| {
        let mut hasher = DefaultHasher::new();
        (seed, id).hash(&mut hasher);
        hasher.finish()
    });
    ids.truncate(sample);
    ids
}

fn report(subject: &Subject, chosen: &[usize], verdicts: &BTreeMap<usize, String>) {
    let mut chosen = chosen.to_vec();
    chosen.sort_unstable();
    let mut figures: BTreeMap<&str, usize> = BTreeMap::new();
    let mut survivors = Vec::new();
    for id in &chosen {
        let Some(by) = verdicts.get(id) else { continue };
        let kind = if by.starts_with("scenario") { "scenario" } else { by.as_str() };
        *figures.entry(kind).or_default() += 1;
        if by.starts_with(SURVIVES) {
            let same = if by == SURVIVES { "" } else { " (no run differs)" };
            survivors.push(format!("{}{same}", subject.describe(&subject.mutants[*id])));
        }
    }
    survivors.iter().for_each(|survivor| println!("{survivor}"));
    println!("\n{} of {} mutants", chosen.len(), subject.mutants.len());
    let share = |n: usize| 100.0 * n as f64 / chosen.len().max(1) as f64;
    for (by, count) in figures {
        println!("{count:6}  {:5.1} %  {by}", share(count));
    }
}

fn main() -> ExitCode {
    match start() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("mutants: {failure}");
            ExitCode::FAILURE
        }
    }
}

fn start() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let value = |key: &str| {
        let at = arguments.iter().position(|a| a == key)?;
        arguments.get(at + 1).cloned()
    };
    let mission = arguments.first().filter(|a| !a.starts_with("--")).ok_or("which mission?")?;
    let subject = Subject::read(Path::new(mission))?;
    if let Some(id) = value("--one") {
        let folder = value("--folder").ok_or("--one needs --folder")?;
        let expected = value("--expected").ok_or("--one needs --expected")?;
        return one(&subject, id.parse()?, Path::new(&folder), Path::new(&expected));
    }
    if arguments.iter().any(|a| a == "--list") {
        subject.mutants.iter().for_each(|mutant| println!("{}", subject.describe(mutant)));
        return Ok(());
    }
    let sample = value("--sample").map_or(Ok(usize::MAX), |n| n.parse())?;
    let seed: u64 = value("--seed").map_or(Ok(1), |n| n.parse())?;
    campaign(&subject, sample, seed, arguments.iter().any(|a| a == "--fresh"))
}
