//! `pelea replay`: takes every turn of a recorded run again, and shows what was decided, when, and why.
//!
//! The journal has every version of the graph, and the file beside it every turn of PELEA. The wheel is a pure function,
//! so the same mission gives the same effects; the first that differs is reported.

use crate::assemble::{Assembly, assemble, load};
use crate::console::{Console, Form};
use crate::disk::show;
use crate::dsr::Moment;
use crate::exit::Exit;
use crate::render;
use crate::run::{Content, Terminal};
use crate::scenario;
use crate::turns::{self, Heading, Life, Recorded};
use crate::what_if::{self, Question};
use clap::Args;
use dsr::{Played, Recording, Replay, Snapshot, Time, Version};
use executive::{Decision, Effect, Event, NoPlan, Occurrence, Request, RequestId, Wheel, decide};
use mission::Mission;
use serde::Serialize;
use std::path::PathBuf;
use std::sync::Arc;

/// Arguments of `pelea replay`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The folder of the mission that was run
    mission: PathBuf,
    /// The journal of the run
    journal: PathBuf,
    /// Stop after the turns on this version of the graph, or of this time, and show all that was decided on it
    #[arg(long, value_name = "VERSION|TIMEs")]
    at: Option<Moment>,
    /// Go on from this version, or time, with the edits, and show which decisions would have been others
    #[arg(long, value_name = "VERSION|TIMEs", requires = "edit", conflicts_with = "at")]
    from: Option<Moment>,
    /// A token to add to the graph or to remove from it: `+ person asks help`, `- person is with robot`
    #[arg(long, value_name = "EDIT", requires = "from", allow_hyphen_values = true)]
    edit: Vec<String>,
    /// The scenario that goes on after the edits
    #[arg(long, value_name = "NAME|FILE", requires = "from")]
    scenario: Option<String>,
    /// The seed of the run
    #[arg(long, requires = "from", default_value_t = 0)]
    seed: u64,
    /// The language of the run [default: the mission's language]
    #[arg(long, value_name = "TAG", requires = "from")]
    lang: Option<String>,
    /// Also show how each step was executed
    #[arg(long)]
    verbose: bool,
}

/// Why a replay cannot go on.
#[derive(Debug, thiserror::Error)]
enum ReplayError {
    #[error(transparent)]
    Turns(#[from] turns::TurnsError),
    #[error(transparent)]
    Recording(#[from] dsr::RecordingError),
    #[error("the journal has no version {0}, on which PELEA decided")]
    NoVersion(u64),
    #[error("PELEA was refused a write ({0}); what follows cannot be replayed")]
    Refused(String),
    #[error("PELEA was given an answer to request {0}, which the replay has not made")]
    NoRequest(u64),
}

/// The last line in JSON.
#[derive(Serialize)]
#[serde(tag = "kind", rename = "replay")]
struct Summary {
    turns: usize,
    version: u64,
    equal: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    recorded: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    replayed: Option<String>,
}

/// Replays a run.
pub(crate) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Exit {
    let mission = match load(&arguments.mission) {
        Ok(mission) => mission,
        Err(error) => return error.show(console),
    };
    let (assembly, findings) = assemble(&mission);
    let Some(assembly) = assembly else { return show(&mission.sources, &findings, console) };
    if let Some(from) = arguments.from {
        return what_if(from, arguments, &mission, &assembly, console);
    }
    let replayed = again(arguments, &mission, &assembly, console);
    match replayed {
        Ok(exit) => exit,
        Err(error) => {
            render::error(error.to_string(), console);
            Exit::Unreadable
        }
    }
}

/// Goes on from a version with edits.
fn what_if(
    from: Moment,
    arguments: &Arguments,
    mission: &Mission,
    assembly: &Assembly,
    console: &mut Console<'_>,
) -> Exit {
    let stage = |name: &str| scenario::stage(scenario::read(mission, name)?, mission, &assembly.vocabulary);
    if let Some(Err(error)) = arguments.scenario.as_deref().map(stage) {
        return error.show(console);
    }
    let staged = || arguments.scenario.as_deref().and_then(|name| stage(name).ok());
    let language = arguments.lang.clone().unwrap_or_else(|| mission.manifest.language.clone());
    let question =
        Question { journal: &arguments.journal, from, edits: &arguments.edit, seed: arguments.seed };
    let content = Content { mission: Arc::new(mission.clone()), language };
    match what_if::answer(&question, &content, staged, assembly, console) {
        Ok(exit) => exit,
        Err(error) => {
            render::error(error.to_string(), console);
            Exit::Unreadable
        }
    }
}

fn again(
    arguments: &Arguments,
    mission: &Mission,
    assembly: &Assembly,
    console: &mut Console<'_>,
) -> Result<Exit, ReplayError> {
    let mut lives = turns::read(&arguments.journal)?;
    let recording = Recording::open(&arguments.journal)?;
    if let Some(life) = lives.last_mut() {
        if !life.whole {
            console.note("the record has no end: the run was cut off, or still goes on");
        }
        let lost = life.end_at(recording.last().0);
        if lost > 0 {
            console.note(&format!("{lost} turns were on versions that the journal has not"));
        }
        let changed = Heading::new(mission, None, None).changed(&life.heading);
        if !changed.is_empty() {
            console.note(&format!("the texts of the mission have changed since: {}", changed.join(", ")));
        }
    }
    let at = arguments.at.map(|at| stop(at, &recording, &lives, console)).transpose()?;
    let mut again = Again { replay: recording.replay()?, wheel: assembly.wheel(), requests: Vec::new() };
    again.all(&lives, assembly, (at, arguments.verbose), console)
}

/// The version on which a replay is to stop: one that PELEA was handed.
fn stop(
    at: Moment,
    recording: &Recording,
    lives: &[Life],
    console: &mut Console<'_>,
) -> Result<Version, ReplayError> {
    let asked = at.of(recording)?.version();
    let handed = lives.iter().flat_map(|life| &life.turns).filter_map(|turn| turn.event.version());
    let found = handed.clone().filter(|version| *version <= asked).max();
    let found = found.or(handed.min()).ok_or(turns::TurnsError::Empty)?;
    if found != asked {
        console.note(&format!("PELEA was not handed version {}; this is version {}", asked.0, found.0));
    }
    Ok(found)
}

/// The wheel, turning again.
struct Again<'r> {
    wheel: Wheel,
    replay: Replay<'r>,
    /// Requests that were made and not yet answered.
    requests: Vec<Request>,
}

impl Again<'_> {
    /// The next life begins: with another wheel, and nothing that the one before had asked.
    fn begin(&mut self, life: &Life, assembly: &Assembly) {
        let Heading { horizon, pulse, .. } = &life.heading;
        let wheel = horizon.iter().fold(assembly.wheel(), |wheel, horizon| {
            wheel.until(Time(u64::try_from(horizon.as_nanos()).unwrap_or(u64::MAX)))
        });
        self.wheel = pulse.iter().fold(wheel, |wheel, pulse| wheel.with_pulse(*pulse));
        self.requests.clear();
    }

    fn all(
        &mut self,
        lives: &[Life],
        assembly: &Assembly,
        (at, verbose): (Option<Version>, bool),
        console: &mut Console<'_>,
    ) -> Result<Exit, ReplayError> {
        let mut terminal = Terminal::new(console.result_colour(), console.result_width(), verbose);
        let turns: Vec<_> = lives
            .iter()
            .flat_map(|life| life.turns.iter().enumerate().map(move |turn| (life, turn)))
            .collect();
        for (count, &(life, (number, turn))) in turns.iter().enumerate() {
            if number == 0 {
                self.begin(life, assembly);
                if let (Some(from), Form::Text) = (life.heading.from, console.form()) {
                    console.result(&format!("goes on from version {from}, after a restart"));
                }
            }
            let event = self.event(&turn.event)?;
            let effects = self.wheel.step(event, Time(turn.now));
            let version = self.replay.version();
            let next = turns.get(count + 1).map(|(_, (_, turn))| turn.event.version());
            // The turns on a version last until PELEA is handed a later one.
            let over = at.is_some_and(|at| next.flatten().is_some_and(|next| next > at));
            let replayed = serde_json::to_string(&effects).unwrap_or_default();
            tell(&effects, turn.now, console, &mut terminal);
            if at == Some(version) || (at.is_none() && console.form() == Form::Json) {
                shown(turn, &effects, version, console);
            }
            let equal = replayed == turn.effects.get();
            if !equal || over || next.is_none() {
                let text = |text: &str| (!equal).then(|| text.to_owned());
                let summary = Summary {
                    turns: count + 1,
                    version: version.0,
                    equal,
                    recorded: text(turn.effects.get()),
                    replayed: text(&replayed),
                };
                return Ok(conclude(&summary, console));
            }
            for effect in effects {
                if let Effect::Plan(request) = effect {
                    self.requests.push(request);
                }
            }
        }
        Err(turns::TurnsError::Empty.into())
    }

    /// The event that was recorded.
    fn event(&mut self, occurrence: &Occurrence) -> Result<Event, ReplayError> {
        Ok(match occurrence {
            Occurrence::Changed(version) => {
                let (snapshot, delta) = self.until(*version)?;
                match delta {
                    Some(delta) => Event::Changed { snapshot, delta },
                    None => Event::Seen(snapshot),
                }
            }
            Occurrence::Seen(version) => Event::Seen(self.until(*version)?.0),
            Occurrence::Woke => Event::Woke,
            Occurrence::Written => Event::Written,
            Occurrence::Refused(why) => return Err(ReplayError::Refused(why.clone())),
            Occurrence::Stopped(id) => Event::Decided(RequestId(*id), Decision::NoPlan(NoPlan::Stopped)),
            Occurrence::Decided(id) => {
                let at = self.requests.iter().position(|request| request.id == RequestId(*id));
                let request = self.requests.remove(at.ok_or(ReplayError::NoRequest(*id))?);
                let model = Arc::clone(self.wheel.model());
                let decision = decide(&model, &request, &budget::Cancellation::default());
                Event::Decided(request.id, decision)
            }
        })
    }

    /// This version, with the delta that led to it.
    fn until(&mut self, version: u64) -> Result<(Snapshot, Option<Arc<dsr::Delta>>), ReplayError> {
        let mut last = None;
        while self.replay.version() < Version(version) {
            last = match self.replay.next() {
                Some(Ok(Played::Commit(delta))) => Some(Arc::new(delta)),
                Some(Ok(Played::Jump { .. })) => None,
                Some(Err(error)) => return Err(error.into()),
                None => return Err(ReplayError::NoVersion(version)),
            };
        }
        if self.replay.version() != Version(version) {
            return Err(ReplayError::NoVersion(version));
        }
        Ok((self.replay.snapshot(), last))
    }
}

fn tell(effects: &[Effect], now: u64, console: &mut Console<'_>, terminal: &mut Terminal) {
    if console.form() == Form::Json {
        return;
    }
    for effect in effects {
        if let Effect::Tell(narration) = effect {
            terminal.narrate(now, narration).iter().for_each(|line| console.result(line));
        }
    }
}

/// A turn in JSON.
#[derive(Serialize)]
#[serde(tag = "kind", rename = "turn")]
struct Shown<'a> {
    time: f64,
    version: u64,
    handed: &'a Occurrence,
    effects: &'a [Effect],
}

/// A turn in full.
fn shown(turn: &Recorded, effects: &[Effect], version: Version, console: &mut Console<'_>) {
    let time = std::time::Duration::from_nanos(turn.now).as_secs_f64();
    let handed = serde_json::to_string(&turn.event).unwrap_or_default();
    console.record(&Shown { time, version: version.0, handed: &turn.event, effects });
    console.result(&format!("{time:8.2}  turn     on version {}, handed {handed}", version.0));
    for effect in effects {
        console.result(&format!("          {}", serde_json::to_string(effect).unwrap_or_default()));
    }
}

fn conclude(summary: &Summary, console: &mut Console<'_>) -> Exit {
    let Summary { turns, version, .. } = summary;
    if summary.equal {
        console.result(&format!("{turns} turns up to version {version}: every decision as it was recorded"));
    } else {
        console.result(&format!("turn {turns}, on version {version}, differs"));
        console.result(&format!("  recorded: {}", summary.recorded.as_deref().unwrap_or_default()));
        console.result(&format!("  replayed: {}", summary.replayed.as_deref().unwrap_or_default()));
    }
    console.record(summary);
    if summary.equal { Exit::Yes } else { Exit::No }
}
