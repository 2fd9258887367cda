//! What notices a mutant: the check, the suite, the scenarios, the cheapest first.

use cli::{Console, Exit};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::Write;
use std::path::Path;

/// How a scenario ended, as far as it is compared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Ended {
    /// Exit, ending and the number of violations: what a test would notice.
    outcome: String,
    /// Of everything that was printed.
    hash: u64,
}

/// The outcome of each scenario of the original.
#[derive(Debug, Default)]
pub(crate) struct Baseline(pub(crate) Vec<(String, Ended)>);

impl Baseline {
    /// A line a scenario.
    pub(crate) fn write(&self) -> String {
        let line = |(name, ended): &(String, Ended)| format!("{name}\t{}\t{}\n", ended.outcome, ended.hash);
        self.0.iter().map(line).collect()
    }

    /// Reads what [`Self::write`] wrote.
    pub(crate) fn read(text: &str) -> Option<Self> {
        let line = |line: &str| {
            let mut words = line.split('\t').map(str::to_owned);
            let (name, outcome, hash) = (words.next()?, words.next()?, words.next()?);
            Some((name, Ended { outcome, hash: hash.parse().ok()? }))
        };
        Some(Self(text.lines().map(line).collect::<Option<_>>()?))
    }
}

/// What one run may print, in bytes; a longer one does not end.
const MOST: usize = 64 << 20;

/// Keeps what is written, and ends the process if it is too much.
struct Page(Vec<u8>);

impl Write for Page {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.extend_from_slice(bytes);
        if self.0.len() > MOST {
            println!("floods");
            std::process::exit(0);
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// Runs `pelea` in this process: the exit and what it printed.
fn run(arguments: &[&str]) -> (Exit, String) {
    let (mut out, mut err) = (Page(Vec::new()), std::io::sink());
    let mut console = Console::new(&mut out, &mut err);
    let exit = cli::run(std::iter::once("pelea").chain(arguments.iter().copied()), &mut console);
    drop(console);
    (exit, String::from_utf8_lossy(&out.0).into_owned())
}

/// The last line as JSON.
fn last(text: &str) -> serde_json::Value {
    text.lines().last().and_then(|line| serde_json::from_str(line).ok()).unwrap_or_default()
}

/// The outcome of the scenario `name` of the mission.
pub(crate) fn play(mission: &str, name: &str) -> Ended {
    let (exit, text) = run(&["run", mission, "--scenario", name, "--speed", "max", "--json"]);
    let last = last(&text);
    let violations = last["violations"].as_array().map_or(0, Vec::len);
    let outcome = format!("{exit:?} {violations} {}", last["ending"].as_str().unwrap_or(""));
    let mut hasher = DefaultHasher::new();
    text.replace(mission, "").hash(&mut hasher);
    Ended { outcome, hash: hasher.finish() }
}

/// What notices the mutant in `mission`; `None` if nothing does, and whether no run differs at all.
pub(crate) fn judge(mission: &Path, baseline: &Baseline) -> (Option<String>, bool) {
    let mission = mission.to_string_lossy();
    let (exit, text) = run(&["check", &mission, "--json"]);
    if exit != Exit::Yes {
        return (Some("check".to_owned()), false);
    }
    if last(&text)["warnings"].as_u64() != Some(0) {
        return (Some("check (warning)".to_owned()), false);
    }
    if run(&["test", &mission]).0 != Exit::Yes {
        return (Some("test".to_owned()), false);
    }
    let mut same = true;
    for (name, expected) in &baseline.0 {
        let ended = play(&mission, name);
        if ended.outcome != expected.outcome {
            return (Some(format!("scenario {name}")), false);
        }
        same &= ended.hash == expected.hash;
    }
    (None, same)
}
