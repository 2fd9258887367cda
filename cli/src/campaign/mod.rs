//! `pelea campaign`: a mission disturbed at every instant, in every way that its library knows.
//!
//! Problem: a scenario tests one disruption at one moment, and what fails lies between the moments that somebody thought
//! of. Idea: play the mission undisturbed once, take each commit that PELEA or an agent saw as an instant, and play it
//! again with each disruption of the library at each of them. What is asked of a run is the same for all: it ends in a
//! named way, and it keeps the invariants. Invariant: the same texts, seeds and program give the same results, whatever
//! the number of cores. Cost: a few milliseconds a run, in this process.
//!
//! From the ground up: `record` (a run's result), `instants`, `store` (the results file) → `stock` (what all runs share,
//! and one run), `library` (the disruptions) → `table`, `junit`, `page`, `compare`, `minimise`, `progress` (what people
//! read).

mod compare;
mod instants;
mod junit;
mod library;
mod minimise;
mod page;
mod progress;
mod record;
mod stock;
mod store;
mod table;

use crate::clock::{Seconds, Stopwatch};
use crate::console::Console;
use crate::exit::Exit;
use crate::panics;
use crate::run::latency;
use crate::{pool, render};
use clap::Args;
use library::Disturbance;
use page::Stories;
use progress::Progress;
use record::{Key, Lines, Run};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Arc;
use stock::Stock;
use store::{Kept, Store};

/// Arguments of `pelea campaign`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The mission's folder.
    mission: PathBuf,
    /// The scenario to disturb, by name, or a scenario file. Without one the person answers everything, and the
    /// clinician comes when called.
    #[arg(long, value_name = "NAME|FILE")]
    scenario: Option<String>,
    /// Only this disruption of the library; may be given several times.
    #[arg(long, value_name = "NAME")]
    only: Vec<String>,
    /// Only each nth instant.
    #[arg(long, value_name = "N", default_value_t = 1)]
    every: usize,
    /// The seeds, each of which gives other delays to the person: `0..4`.
    #[arg(long, value_name = "FROM..TO", default_value = "0..1")]
    seeds: Seeds,
    /// Take the instants of a recorded run, from its journal, as times.
    #[arg(long, value_name = "FOLDER")]
    from_journal: Option<PathBuf>,
    /// Simulated seconds after which a run that goes on is ended.
    #[arg(long, value_name = "SECONDS", default_value = "14400")]
    horizon: Seconds,
    /// How long a decision takes at least, in simulated seconds; of a range, the seed chooses.
    #[arg(long, value_name = "SECONDS|MIN..MAX", default_value = "0.1")]
    planning_latency: latency::Range,
    /// Write results.jsonl, junit.xml, index.html and a scenario per kind of failure into this folder.
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Whose stories the page of `--out` has; without those of good runs it is small.
    #[arg(long, value_name = "WHICH", value_enum, default_value_t = Stories::All, requires = "out")]
    stories: Stories,
    /// Go on with the results in the folder of `--out`.
    #[arg(long, requires = "out")]
    resume: bool,
    /// Compare with the results of an earlier campaign.
    #[arg(long, value_name = "RESULTS.JSONL")]
    compare: Option<PathBuf>,
}

/// A range of seeds.
#[derive(Clone, Debug)]
struct Seeds(Range<u64>);

impl FromStr for Seeds {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || "a range such as `0..4` is expected".to_owned();
        let (from, to) = text.split_once("..").ok_or_else(wrong)?;
        let (from, to) = (from.parse().map_err(|_| wrong())?, to.parse().map_err(|_| wrong())?);
        if from < to { Ok(Self(from..to)) } else { Err(wrong()) }
    }
}

/// The results file, in the folder of `--out`.
const RESULTS: &str = "results.jsonl";

/// Runs a campaign.
pub(crate) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Exit {
    let stock = match Stock::load(
        &arguments.mission,
        arguments.scenario.as_deref(),
        (arguments.horizon, arguments.planning_latency),
        console,
    ) {
        Ok(stock) => stock,
        Err(exit) => return exit,
    };
    let library = match library::read(stock.mission(), stock.base(), &arguments.only, console) {
        Ok(library) => library,
        Err(exit) => return exit,
    };
    let old = match arguments.compare.as_deref().map(store::read).transpose() {
        Ok(old) => old,
        Err(error) => return unreadable(arguments.compare.as_deref(), &error, console),
    };
    let campaign = match Campaign::begin(arguments, stock, library, console) {
        Ok(campaign) => campaign,
        Err(exit) => return exit,
    };
    match panics::without_those_of_runs(|| campaign.play(arguments, old.as_ref(), console)) {
        Ok(exit) => exit,
        Err(error) => {
            let folder = arguments.out.as_deref().unwrap_or(Path::new(".")).display().to_string();
            render::error(format!("cannot write into `{folder}`: {error}"), console);
            Exit::Unwritable
        }
    }
}

fn unreadable(path: Option<&Path>, error: &io::Error, console: &mut Console<'_>) -> Exit {
    let path = path.unwrap_or(Path::new("")).display();
    render::error(format!("cannot read the results in `{path}`: {error}"), console);
    Exit::Unreadable
}

/// A campaign with everything read.
struct Campaign {
    stock: Stock,
    library: Vec<Disturbance>,
    kept: Kept,
    lines: Arc<Lines>,
    undisturbed: Vec<(f64, record::LineId)>,
}

impl Campaign {
    /// Plays the undisturbed run, and takes over what is done already.
    fn begin(
        arguments: &Arguments,
        stock: Stock,
        library: Vec<Disturbance>,
        console: &mut Console<'_>,
    ) -> Result<Self, Exit> {
        let fingerprint = stock.fingerprint(&library, arguments.every);
        let lines = Arc::new(Lines::default());
        let (watched, undisturbed) = stock.undisturbed(&lines);
        let instants = match &arguments.from_journal {
            Some(folder) => instants::recorded(folder).map_err(|error| {
                render::error(error.to_string(), console);
                Exit::Unreadable
            })?,
            None => watched,
        };
        let instants: Vec<_> = instants.into_iter().step_by(arguments.every.max(1)).collect();
        if instants.is_empty() || library.is_empty() {
            let what = if library.is_empty() { "no disruptions" } else { "no instants" };
            render::error(format!("there is nothing to play: {what}"), console);
            return Err(Exit::Unreadable);
        }
        let mut kept = Kept { fingerprint, instants, lines: Vec::new(), runs: Vec::new() };
        if let (true, Some(folder)) = (arguments.resume, &arguments.out) {
            let path = folder.join(RESULTS);
            let before = store::read(&path).map_err(|error| unreadable(Some(&path), &error, console))?;
            if before.fingerprint != kept.fingerprint || before.instants != kept.instants {
                let text =
                    format!("the results in `{}` are of other texts or another program", path.display());
                render::error_with_help(text, Some("leave `--resume` out to begin anew"), console);
                return Err(Exit::Unreadable);
            }
            kept = before;
        }
        let lines = if kept.lines.is_empty() { lines } else { Arc::new(Lines::of(kept.lines.clone())) };
        Ok(Self { stock, library, kept, lines, undisturbed })
    }

    /// Every run that is not done, in order.
    fn open(&self, seeds: &Range<u64>) -> Vec<Key> {
        let done: BTreeSet<&Key> = self.kept.runs.iter().map(|run| &run.key).collect();
        let mut open = Vec::new();
        for disturbance in &self.library {
            for instant in 0..self.kept.instants.len() {
                for seed in seeds.clone() {
                    let key = Key { disruption: disturbance.name.clone(), instant, seed };
                    if !done.contains(&key) {
                        open.push(key);
                    }
                }
            }
        }
        open
    }

    fn play(
        mut self,
        arguments: &Arguments,
        old: Option<&Kept>,
        console: &mut Console<'_>,
    ) -> io::Result<Exit> {
        let mut store = match &arguments.out {
            Some(folder) => {
                fs::create_dir_all(folder)?;
                Some(Store::begin(&folder.join(RESULTS), &self.stock.title(), &self.kept)?)
            }
            None => None,
        };
        let open = self.open(&arguments.seeds.0);
        let clock = Stopwatch::start();
        let mut progress = Progress::new(open.len());
        let (mut done, mut bad, mut written) = (0, 0, Ok(()));
        let library: BTreeMap<&str, &Disturbance> =
            self.library.iter().map(|d| (d.name.as_str(), d)).collect();
        let answer = |key: &Key| {
            let instant = &self.kept.instants[key.instant];
            self.stock.play(library[key.disruption.as_str()], instant, key, &self.lines)
        };
        let mut runs = Vec::with_capacity(open.len());
        pool::in_order(&open, answer, |_, run: Run| {
            (done, bad) = (done + 1, bad + usize::from(!run.is_good()));
            if let (Some(store), Ok(())) = (&mut store, &written) {
                written = store.add(&run, &self.lines);
            }
            progress.update(done, bad);
            runs.push(run);
        });
        drop(progress);
        written?;
        let seconds = clock.milliseconds() / 1e3;
        self.kept.runs.extend(runs);
        self.kept.runs.sort_by(|a, b| a.key.cmp(&b.key));
        self.kept.lines = self.lines.since(0);
        if let Some(store) = store {
            store.finish()?;
        }
        table::show(&self.library, &self.kept.runs, console);
        self.failures(arguments.out.as_deref(), console)?;
        if let Some(folder) = &arguments.out {
            self.write(folder, arguments)?;
        }
        let worse = old.is_some_and(|old| compare::show(old, &self.kept, console));
        Ok(self.sum_up(open.len(), seconds, worse, console))
    }

    /// One line, and the exit code.
    fn sum_up(&self, played: usize, seconds: f64, worse: bool, console: &mut Console<'_>) -> Exit {
        let bad = self.kept.runs.iter().filter(|run| !run.is_good()).count();
        #[expect(clippy::cast_precision_loss, reason = "a rate for people")]
        let rate = played as f64 / seconds.max(1e-3);
        let all = self.kept.runs.len();
        console.note(&format!(
            "{all} runs, {bad} not good; {played} played in {seconds:.1} s, {rate:.0} a second"
        ));
        console.record(&Summary { kind: "campaign", runs: all, bad, played, seconds });
        if bad == 0 && !worse { Exit::Yes } else { Exit::No }
    }

    /// The kinds of failure, each with the smallest scenario that shows it.
    fn failures(&self, out: Option<&Path>, console: &mut Console<'_>) -> io::Result<()> {
        let mut kinds: BTreeMap<(String, &str), (usize, &Run)> = BTreeMap::new();
        for run in self.kept.runs.iter().filter(|run| !run.is_good()) {
            let mut what: BTreeSet<String> = run.broken.iter().map(|b| b.invariant.clone()).collect();
            if !run.outcome.is_accounted_for() {
                what.insert(run.outcome.name().to_owned());
            }
            for what in what {
                kinds.entry((what, &run.key.disruption)).or_insert((0, run)).0 += 1;
            }
        }
        for ((what, disruption), (count, run)) in &kinds {
            let instant = &self.kept.instants[run.key.instant];
            console.note(&format!("{what}: {count} runs of {disruption}, first {instant}"));
            let Some(folder) = out else { continue };
            let Some(disturbance) = self.library.iter().find(|d| d.name == *disruption) else { continue };
            let text = self.stock.smallest(disturbance, instant, &run.key, what);
            let folder = folder.join("failures");
            fs::create_dir_all(&folder)?;
            let name = format!("{}-{disruption}.toml", what.replace(' ', "-"));
            fs::write(folder.join(name), text)?;
        }
        Ok(())
    }

    fn write(&self, folder: &Path, arguments: &Arguments) -> io::Result<()> {
        let (mission, title) = (arguments.mission.to_string_lossy(), self.stock.title());
        let Kept { instants, lines, runs, .. } = &self.kept;
        fs::write(folder.join("junit.xml"), junit::write(&title, &self.library, instants, runs))?;
        let (undisturbed, stories) = (&self.undisturbed, arguments.stories);
        let (mission, title, library) = (mission.as_ref(), title.as_str(), self.library.as_slice());
        let input = page::Input { mission, title, library, instants, runs, lines, undisturbed, stories };
        fs::write(folder.join("index.html"), page::write(&input))
    }
}

/// The last record with `--json`.
#[derive(Serialize)]
struct Summary {
    kind: &'static str,
    runs: usize,
    bad: usize,
    played: usize,
    seconds: f64,
}
