//! What all runs of a campaign share, and one run of it.
//!
//! The mission is read, compiled and grounded once. A run gets its own graph (a copy of the first snapshot), wheel, agents
//! and room, and plays in simulated time on a runtime that its thread keeps. Nothing is written in words but what PELEA
//! decided and what befell the room.

use super::instants::{Instant, Watcher};
use super::library::{self, Disturbance};
use super::record::{Breakage, By, Key, LineId, Lines, Outcome, Run};
use crate::assemble::{Assembly, assemble, load};
use crate::clock::Seconds;
use crate::console::Console;
use crate::disk::show;
use crate::exit::Exit;
use crate::panics;
use crate::run::{Audience, Content, Kept, Latency, Narrator, Performed, Production, latency, perform};
use crate::scenario::{self, Staged};
use agents::Housing;
use executive::{Ending, Narration};
use hal::sim::RoomEvent;
use mission::Mission;
use mission::scenario::Scenario;
use pddl::Source;
use safety::{Broken, Cause};
use std::cell::RefCell;
use std::future::pending;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use tokio::runtime::Runtime;
use toml::{Table, Value};

/// The scenario that is disturbed if none is named.
const PLAIN: &str = "title = \"a person who answers\"\n\n[clinician]\ncomes-after = 20.0\n";
/// How long the robot may take to put a wrong token right, in seconds.
const TO_PUT_RIGHT: f64 = 2.0;
/// Scenarios that are tried to make a failing one smaller.
const TRIES: usize = 60;

/// What all runs share.
pub(super) struct Stock {
    content: Content,
    assembly: Assembly,
    base: Table,
    scenario: Scenario,
    horizon: Duration,
    latency: latency::Range,
}

impl Stock {
    /// Reads a mission and the scenario to disturb.
    pub(super) fn load(
        path: &Path,
        scenario: Option<&str>,
        (horizon, latency): (Seconds, latency::Range),
        console: &mut Console<'_>,
    ) -> Result<Self, Exit> {
        let mission = load(path).map_err(|error| error.show(console))?;
        let (assembly, findings) = assemble(&mission);
        let Some(assembly) = assembly else { return Err(show(&mission.sources, &findings, console)) };
        let scenario = match scenario {
            Some(name) => scenario::read(&mission, name).map_err(|error| error.show(console))?,
            None => {
                let plain = mission.read_scenario(Source::new("plain.toml", PLAIN));
                plain.map_err(|errors| show(&errors.sources, &errors.findings, console))?
            }
        };
        let base = scenario.source.text().parse().unwrap_or_default();
        let language = mission.manifest.language.clone();
        let content = Content { mission: Arc::new(mission), language };
        Ok(Self { content, assembly, base, scenario, horizon: horizon.duration(), latency })
    }

    pub(super) fn mission(&self) -> &Mission {
        &self.content.mission
    }

    /// The mission's name for people.
    pub(super) fn title(&self) -> String {
        self.mission().manifest.title.clone()
    }

    /// The scenario that is disturbed, as a table.
    pub(super) fn base(&self) -> &Table {
        &self.base
    }

    /// A number that differs if anything differs that results depend on.
    pub(super) fn fingerprint(&self, library: &[Disturbance], every: usize) -> u64 {
        let mut hasher = DefaultHasher::new();
        env!("CARGO_PKG_VERSION").hash(&mut hasher);
        self.mission().sources.iter().for_each(|(_, source)| source.text().hash(&mut hasher));
        self.scenario.source.text().hash(&mut hasher);
        library.iter().for_each(|d| (&d.name, d.file.source.text()).hash(&mut hasher));
        (self.horizon, every).hash(&mut hasher);
        format!("{:?}", self.latency).hash(&mut hasher);
        hasher.finish()
    }

    /// The undisturbed run: its instants and its story.
    pub(super) fn undisturbed(&self, lines: &Arc<Lines>) -> (Vec<Instant>, Vec<(f64, LineId)>) {
        let assembly = self.assembly.again();
        let watcher = Watcher::new(&assembly.graph, assembly.interests());
        let diary = Diary::new(lines);
        let staged = self.staged(self.scenario.clone());
        let _ = staged.map(|staged| self.perform(assembly, staged, 0, diary.clone()));
        (watcher.instants(), diary.close().story)
    }

    /// One run, with a disruption at an instant.
    pub(super) fn play(
        &self,
        disturbance: &Disturbance,
        instant: &Instant,
        key: &Key,
        lines: &Arc<Lines>,
    ) -> Run {
        let scenario = disturbance.file.within(&self.scenario, &instant.trigger(), key.draw());
        let mut run = self.run(scenario, key, lines);
        run.token = disturbance.file.token(key.draw()).map(ToString::to_string);
        if run.token.is_some() {
            // What the flip itself wrote is not the robot's doing: its commit is the one after the instant's. And what
            // was flipped just before the end nobody can put right.
            let late = run.seconds - instant.time < TO_PUT_RIGHT;
            run.broken.retain(|broken| match broken.by {
                By::Version(version) => version != instant.version + 1,
                By::End => !late,
                By::Time => true,
            });
        }
        // What was before is the story of the undisturbed run.
        run.story.retain(|(time, _)| *time >= instant.time);
        run
    }

    /// One run of a scenario, whatever happens in it.
    fn run(&self, scenario: Scenario, key: &Key, lines: &Arc<Lines>) -> Run {
        let diary = Diary::new(lines);
        let played = panics::survive(|| {
            let staged = self.staged(scenario).ok()?;
            Some(self.perform(self.assembly.again(), staged, key.seed, diary.clone()))
        });
        let Diaries { story, replans, broken, .. } = diary.close();
        let (outcome, seconds) = match played {
            Some(Some(performed)) => (outcome(&performed.ending), performed.elapsed.as_secs_f64()),
            Some(None) | None => (Outcome::Panicked, 0.0),
        };
        // To the millisecond: short in JSON.
        let seconds = (seconds * 1e3).round() / 1e3;
        Run { key: key.clone(), token: None, outcome, seconds, replans, broken, story }
    }

    fn staged(&self, scenario: Scenario) -> Result<Staged, scenario::ScenarioError> {
        scenario::stage(scenario, self.mission(), &self.assembly.vocabulary)
    }

    fn perform(&self, assembly: Assembly, staged: Staged, seed: u64, diary: Diary) -> Performed {
        let Staged { scenario, cues, .. } = staged;
        let production = Production {
            kept: Kept { run: "campaign".to_owned(), ..Kept::default() },
            past: None,
            content: self.content.clone(),
            scenario: Some(&scenario),
            cues,
            seed,
            horizon: Some(self.horizon),
            latency: Latency::new(self.latency, seed).simulated(),
            pulse: None,
            turns: None,
            housing: Housing::Together,
        };
        on_this_thread(perform(production, assembly, diary, pending(), pending()))
    }

    /// The smallest scenario that still fails like a run did, as the text of a file.
    pub(super) fn smallest(
        &self,
        disturbance: &Disturbance,
        instant: &Instant,
        key: &Key,
        what: &str,
    ) -> String {
        let at = match instant.version {
            0 => Value::Float(instant.time),
            version => Value::Integer(i64::try_from(version).unwrap_or(i64::MAX)),
        };
        let token = disturbance.file.token(key.draw()).map(ToString::to_string).unwrap_or_default();
        let whole = library::scenario(&self.base, &disturbance.file, &at, &token);
        let lines = Arc::new(Lines::default());
        let fails = |table: &Table, seed: u64| {
            let source = Source::new("smaller.toml", table.to_string());
            let Ok(scenario) = self.mission().read_scenario(source) else { return false };
            let key = Key { disruption: disturbance.name.clone(), instant: 0, seed };
            let run = self.run(scenario, &key, &lines);
            run.outcome.name() == what || run.broken.iter().any(|broken| broken.invariant == what)
        };
        let seed = if fails(&whole, 0) { 0 } else { key.seed };
        let smallest = super::minimise::minimise(whole, TRIES, |table| fails(table, seed));
        format!("# {what}: pelea run MISSION --scenario THIS --speed max --seed {seed}\n{smallest}")
    }
}

fn outcome(ending: &Ending) -> Outcome {
    match ending {
        Ending::Accomplished => Outcome::Accomplished,
        Ending::GivenUp { .. } => Outcome::GivenUp,
        Ending::WithHuman { .. } => Outcome::WithHuman,
        Ending::StillCalling { .. } => Outcome::StillCalling,
        Ending::StillGoing | Ending::Interrupted => Outcome::StillGoing,
    }
}

thread_local! {
    /// The runtime of a thread: its planner's thread lives on from run to run.
    static RUNTIME: RefCell<Option<Runtime>> = const { RefCell::new(None) };
}

/// Plays to the end in simulated time.
fn on_this_thread<T>(work: impl Future<Output = T>) -> T {
    RUNTIME.with(|runtime| {
        // A panic leaves it where it was, so it is taken out and put back.
        let own = runtime.borrow_mut().take().unwrap_or_else(|| {
            let built =
                tokio::runtime::Builder::new_current_thread().enable_time().start_paused(true).build();
            built.expect("the system gives threads and timers")
        });
        let result = own.block_on(work);
        *runtime.borrow_mut() = Some(own);
        result
    })
}

/// Writes down what a campaign keeps of a run.
#[derive(Clone)]
struct Diary {
    lines: Arc<Lines>,
    pages: Arc<Mutex<Diaries>>,
}

/// What was written down.
#[derive(Default)]
struct Diaries {
    narrator: Narrator,
    story: Vec<(f64, LineId)>,
    replans: u32,
    broken: Vec<Breakage>,
}

impl Diary {
    fn new(lines: &Arc<Lines>) -> Self {
        Self { lines: lines.clone(), pages: Arc::default() }
    }

    fn note(&self, at: Duration, note: impl FnOnce(&mut Diaries) -> Vec<String>) {
        let mut pages = self.pages.lock().unwrap_or_else(PoisonError::into_inner);
        let time = (at.as_secs_f64() * 1e3).round() / 1e3;
        let texts = note(&mut pages);
        pages.story.extend(texts.into_iter().map(|text| (time, self.lines.number(&text))));
    }

    fn close(self) -> Diaries {
        std::mem::take(&mut *self.pages.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Audience for Diary {
    fn room(&self, at: Duration, event: &RoomEvent) {
        use RoomEvent as E;
        // What is said and shown makes the story long, not clear.
        if !matches!(
            event,
            E::RobotSays { .. }
                | E::RobotStops { .. }
                | E::ScreenShows { .. }
                | E::ScreenClears
                | E::PersonSays { .. }
                | E::PersonTouches { .. }
        ) {
            self.note(at, |pages| pages.narrator.room(event));
        }
    }

    fn pelea(&self, at: Duration, narration: Narration) {
        let replan = matches!(narration, Narration::Planned { count, .. } if count > 1);
        self.note(at, |pages| {
            pages.replans += u32::from(replan);
            pages.narrator.pelea(narration)
        });
    }

    fn alarm(&self, broken: Broken) {
        let text = broken.to_string();
        let by = match broken.by {
            Cause::Change => By::Version(broken.version.0),
            Cause::Time => By::Time,
            Cause::End => By::End,
        };
        let breakage = Breakage { invariant: broken.invariant.to_string(), text: text.clone(), by };
        let at = Duration::from_nanos(broken.time.0);
        self.note(at, |pages| {
            pages.broken.push(breakage);
            vec![format!("broken   {text}")]
        });
    }
}
