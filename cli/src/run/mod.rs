//! `pelea run`: a mission on simulated devices, in real time or as fast as the machine.
//!
//! Everything runs in one task on one thread (`play`): PELEA, the agents, the scenario's director
//! and the reader of the story take turns in a fixed order. With `--speed max` tokio's clock is
//! paused and jumps to the next event, so the same mission, scenario and seed give the same bytes.
//!
//! From the ground up: `script`, `director` (the disruptions in the room), `story` (all events as one stream), `content`
//! (the mission's words), `latency` (how long a decision takes), `guard` (the invariants) → `judge`, `terminal`, `teller` (reports of the story) →
//! `play` → `rehearse` (a scenario played for its verdict).

mod content;
mod director;
mod guard;
mod journal;
mod judge;
pub(crate) mod latency;
mod narrate;
mod past;
mod perform;
mod play;
mod rehearse;
mod room;
mod script;
mod speed;
mod story;
mod teller;
mod terminal;

use crate::assemble::{assemble, load};
use crate::clock::Seconds;
use crate::console::Console;
use crate::disk::show;
use crate::exit::Exit;
use crate::render;
use crate::scenario;
use crate::turns::Heading;
use clap::Args;
pub(crate) use content::Content;
use dsr::Journal;
use journal::Opened;
pub(crate) use latency::Latency;
pub(crate) use narrate::Narrator;
pub(crate) use past::{Past, expire_all};
pub(crate) use perform::{Audience, Kept, Performed, Production, perform};
use play::Play;
pub(crate) use rehearse::rehearse;
pub(crate) use room::Happened;
use speed::Speed;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
pub(crate) use teller::Verdict;
pub(crate) use terminal::Terminal;

/// Arguments of `pelea run`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The folder of the mission
    mission: PathBuf,
    /// A scenario of the mission by name, or a scenario file; without one, the simulated person
    /// answers every question
    #[arg(long, value_name = "NAME|FILE")]
    scenario: Option<String>,
    /// How many seconds pass in the run in one second: `1` is real time, `max` as fast as the machine
    #[arg(long, value_name = "FACTOR|max", default_value_t = Speed::Factor(1.0))]
    speed: Speed,
    /// Vary the delays of the simulated person's answers; the same seed gives the same output
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// The language of the robot [default: the mission's language]
    #[arg(long, value_name = "TAG")]
    lang: Option<String>,
    /// Also write the report to this file
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Write every version of the graph to a journal in this folder, for `pelea dsr`
    #[arg(long, value_name = "FOLDER")]
    journal: Option<PathBuf>,
    /// Go on with the run in this folder, which was interrupted, and with its journal
    #[arg(long, value_name = "FOLDER", conflicts_with = "journal")]
    resume: Option<PathBuf>,
    /// Go on although texts of the mission have changed since
    #[arg(long, requires = "resume")]
    changed_texts: bool,
    /// End the run after this time, whatever happens; four hours in simulated time, and never in real time, by default
    #[arg(long, value_name = "SECONDS")]
    horizon: Option<Seconds>,
    /// The time that a decision takes at least; of a range, the seed chooses
    #[arg(long, value_name = "SECONDS|MIN..MAX")]
    planning_latency: Option<latency::Range>,
    /// Also show how each step is executed
    #[arg(long)]
    verbose: bool,
}

/// The name of a run, by which the other side of a device tells its calls and reports from those of other runs. A
/// simulation has the same one each time.
fn name(mission: &mission::Mission, arguments: &Arguments, simulated: bool) -> String {
    let started = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap_or_default();
    let distinct = if simulated { u128::from(arguments.seed) } else { started.as_nanos() };
    format!("{}-{distinct}", mission.manifest.name)
}

/// The end of a simulated run in which nobody ever comes.
const HORIZON: Duration = Duration::from_secs(4 * 3_600);
/// The longest span between two turns of PELEA in real time; after a much longer one the process was stopped.
const PULSE: Duration = Duration::from_secs(1);

/// Runs a mission.
pub(crate) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Exit {
    let mission = match load(&arguments.mission) {
        Ok(mission) => mission,
        Err(error) => return error.show(console),
    };
    let (assembly, findings) = assemble(&mission);
    let Some(assembly) = assembly else { return show(&mission.sources, &findings, console) };
    let staged = arguments.scenario.as_deref().map(|name| {
        let scenario = scenario::read(&mission, name)?;
        scenario::stage(scenario, &mission, &assembly.vocabulary)
    });
    let staged = match staged.transpose() {
        Ok(staged) => staged,
        Err(error) => return error.show(console),
    };
    let language = arguments.lang.clone().unwrap_or_else(|| mission.manifest.language.clone());
    if mission.words(&language).is_none() {
        let text = format!("`{}` has no words in `{language}`", arguments.mission.display());
        let known: Vec<_> = mission.languages().collect();
        let help = format!("its languages are: {}", known.join(", "));
        render::error_with_help(text, Some(&help), console);
        return Exit::Unreadable;
    }
    let simulated = arguments.speed.is_simulated();
    if arguments.speed != Speed::Max {
        console.never_wait();
    }
    let runtime = tokio::runtime::Builder::new_current_thread().enable_time().start_paused(simulated).build();
    let Ok(runtime) = runtime else {
        console.complain("error: the system gives no threads or timers\n");
        return Exit::Limit;
    };
    let horizon = arguments.horizon.map(Seconds::duration);
    let of_scenario = staged.as_ref().and_then(|staged| staged.scenario.horizon);
    let horizon = horizon.or(of_scenario).or_else(|| simulated.then_some(HORIZON));
    let pulse = (!simulated).then_some(PULSE);
    let heading = Heading::new(&mission, horizon, pulse).of(name(&mission, arguments, simulated));
    let opened = match (&arguments.journal, &arguments.resume) {
        (Some(folder), _) => journal::begin(folder, assembly, &heading),
        (None, Some(folder)) => journal::go_on(folder, assembly, heading, arguments.changed_texts, console),
        (None, None) => Ok(Opened::nowhere(assembly, heading.run)),
    };
    let Opened { assembly, journal, turns, past, kept } = match opened {
        Ok(opened) => opened,
        Err(failed) => return failed.show(console),
    };
    let latency = Latency::new(arguments.planning_latency.unwrap_or_default(), arguments.seed);
    let play = Play {
        horizon,
        turns,
        past,
        kept,
        latency: if simulated { latency.simulated() } else { latency },
        speed: arguments.speed,
        pulse,
        interruptible: true,
        content: Content { mission: Arc::new(mission), language },
        staged,
        seed: arguments.seed,
        verbose: arguments.verbose,
    };
    let exit = runtime.block_on(play.play(assembly, arguments.report.as_deref(), console)).exit;
    // The planner's thread may still work on a plan that is no longer needed.
    runtime.shutdown_background();
    match journal.map(Journal::close) {
        Some(Err(error)) => {
            render::error(error.to_string(), console);
            exit.and(Exit::Unwritable)
        }
        Some(Ok(progress)) if progress.gaps > 0 => {
            console
                .note(&format!("the journal lacks versions: its disk was too slow {} times", progress.gaps));
            exit
        }
        _ => exit,
    }
}
