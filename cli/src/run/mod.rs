//! `pelea run`: a mission on simulated devices, in real time or as fast as the machine.
//!
//! Everything lives in one task on one thread: PELEA, the agents, the scenario's director and whoever reads
//! the story take their turns in a fixed order. With `--speed max` tokio's clock is paused and jumps to the
//! next thing that happens, so the same mission, scenario and seed give the same bytes.

mod content;
mod director;
mod judge;
mod script;
mod story;
mod terminal;

use crate::assemble::{Assembly, assemble, load};
use crate::console::{Console, Form};
use crate::disk::show;
use crate::exit::Exit;
use crate::files;
use crate::render;
use crate::scenario::{self, Staged};
use clap::{Args, ValueEnum};
use content::Content;
use dsr::{AgentId, Graph, Journal};
use executive::{Ending, Narration, Shell, Step, Wheel};
use hal::sim::{ClinicianScript, PatientScript, SimRoom};
use judge::Record;
use mission::scenario::Scenario;
use serde::Serialize;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
use story::{Entry, Story, What, seconds};
use terminal::Terminal;
use tokio::sync::{broadcast, mpsc};
use tokio::time::Instant;

/// Arguments of `pelea run`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The mission's folder.
    mission: PathBuf,
    /// A scenario of the mission, by name, or a scenario file. Without one the simulated person answers
    /// everything.
    #[arg(long, value_name = "NAME|FILE")]
    scenario: Option<String>,
    /// `1`: real time. `max`: simulated time, as fast as the machine.
    #[arg(long, value_enum, default_value_t = Speed::Real)]
    speed: Speed,
    /// Varies how long the simulated person takes to answer; the same seed gives the same bytes.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// The language to speak; the mission's own if not given.
    #[arg(long, value_name = "TAG")]
    lang: Option<String>,
    /// Write the report here as well.
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Write every version of the graph to a journal in this folder, for `pelea dsr`.
    #[arg(long, value_name = "FOLDER")]
    journal: Option<PathBuf>,
    /// Tell how each step is carried out, too.
    #[arg(long)]
    verbose: bool,
}

/// How fast time passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Speed {
    /// As on the wall.
    #[value(name = "1")]
    Real,
    /// As fast as the machine.
    Max,
}

/// The last line of a run in JSON.
#[derive(Serialize)]
#[serde(tag = "kind", rename = "result")]
struct Summary<'a> {
    source: &'static str,
    time: f64,
    #[serde(flatten)]
    ending: &'a Ending,
    replans: u32,
    repairs: judge::Repairs,
    asked_again: Vec<String>,
    violations: Vec<String>,
    report: &'a mission::report::Report,
}

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
        render::error_with_help(text, Some(help), console);
        return Exit::Unreadable;
    }
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_time()
        .start_paused(arguments.speed == Speed::Max)
        .build();
    let Ok(runtime) = runtime else {
        console.complain("error: the system gives no threads or timers\n");
        return Exit::Limit;
    };
    let begun = arguments.journal.as_deref().map(|folder| crate::dsr::begin(folder, &assembly.graph));
    let journal = match begun.transpose() {
        Ok(journal) => journal,
        Err(failed) => return failed.show(console),
    };
    let play = Play {
        content: Content { mission: Arc::new(mission), language },
        staged,
        seed: arguments.seed,
        verbose: arguments.verbose,
    };
    let exit = runtime.block_on(play.play(assembly, arguments.report.as_deref(), console));
    // The planner's thread may still be at work on a plan that nobody wants any more.
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

/// A mission about to be played.
struct Play {
    content: Content,
    staged: Option<Staged>,
    seed: u64,
    verbose: bool,
}

impl Play {
    async fn play(
        mut self,
        assembly: Assembly,
        report_file: Option<&std::path::Path>,
        console: &mut Console<'_>,
    ) -> Exit {
        let Assembly { graph, agents, wheel, .. } = assembly;
        let epoch = Instant::now();
        let room = self.room();
        let (reader, mut entries) = mpsc::unbounded_channel();
        let story = Story::new(graph.subscribe_deltas(), reader);
        let observed = story.clone();
        room.observe(move |moment| observed.tell(seconds(moment.at), What::Room(moment.event.clone())));

        let (steps, _) = broadcast::channel(64);
        // Each disruption has ears for the steps of the plan before the first one starts.
        let cues = self.staged.as_mut().map(|staged| std::mem::take(&mut staged.cues)).unwrap_or_default();
        let cues = cues.into_iter().map(|cue| (cue, steps.subscribe())).collect();
        let stage = director::Stage { graph: graph.clone(), room: room.clone(), epoch };
        let environment = agents::Environment {
            graph: graph.clone(),
            equipment: agents::Equipment {
                devices: room.devices(),
                words: Arc::new(self.content.clone()),
                reporter: Arc::new(self.content.clone()),
            },
            clock: Arc::new(agents::TokioClock::start()),
        };

        let mut teller = Teller::new(&self, console);
        teller.heading(&self);
        let ending = {
            let pelea = pelea(graph.clone(), wheel, story.clone(), steps, epoch);
            let agents = agents::run_all(agents, environment);
            let directed = async {
                director::direct(cues, stage).await;
                std::future::pending::<()>().await;
            };
            let mut pelea = std::pin::pin!(pelea);
            let mut agents = std::pin::pin!(agents);
            let mut directed = std::pin::pin!(directed);
            loop {
                tokio::select! {
                    biased;
                    Some(entry) = entries.recv() => teller.tell(&entry),
                    ending = &mut pelea => break ending,
                    never = &mut agents => match never {},
                    () = &mut directed => {}
                }
            }
        };
        story.catch_up();
        while let Ok(entry) = entries.try_recv() {
            teller.tell(&entry);
        }
        teller.end(&self, &ending, &graph, epoch.elapsed(), report_file)
    }

    /// The room, as the scenario has it.
    fn room(&self) -> SimRoom {
        let mission = &self.content.mission;
        match &self.staged {
            Some(Staged { scenario, .. }) => SimRoom::new(
                script::patient(mission, &scenario.patient, self.seed),
                script::clinician(&scenario.clinician),
            ),
            None => SimRoom::new(PatientScript::default(), ClinicianScript::default()),
        }
    }
}

/// PELEA on the real graph.
async fn pelea(
    graph: Graph,
    wheel: Wheel,
    story: Story,
    steps: broadcast::Sender<Step>,
    epoch: Instant,
) -> Ending {
    let writer = graph.vocabulary().agent("pelea").unwrap_or(AgentId::DSR);
    let tell = move |time: dsr::Time, narration: Narration| {
        if let Narration::Started { step, .. } = &narration {
            // Nobody listens where no disruption waits for a step.
            let _ = steps.send(step.clone());
        }
        story.tell(seconds(Duration::from_nanos(time.0)), What::Pelea(narration));
    };
    Shell { graph, writer, epoch, tell }.run(wheel).await
}

/// Reads the story out, and sums it up.
struct Teller<'m, 'c, 'o> {
    console: &'c mut Console<'o>,
    terminal: Terminal,
    record: Record<'m>,
}

impl<'m, 'c, 'o> Teller<'m, 'c, 'o> {
    fn new(play: &'m Play, console: &'c mut Console<'o>) -> Self {
        let terminal = Terminal::new(console.result_colour(), console.result_width(), play.verbose);
        Self { console, terminal, record: Record::new(&play.content.mission) }
    }

    fn heading(&mut self, play: &Play) {
        let title = &play.content.mission.manifest.title;
        let scenario = play.staged.as_ref().map_or("a person who answers", |s| &s.scenario.title);
        self.console.result(&format!("{title} · {scenario}"));
    }

    fn tell(&mut self, entry: &Entry) {
        self.record.note(entry);
        match self.console.form() {
            Form::Json => self.console.record(entry),
            Form::Text => {
                for line in self.terminal.lines(entry) {
                    self.console.result(&line);
                }
            }
        }
        self.console.flush();
    }

    fn end(
        self,
        play: &Play,
        ending: &Ending,
        graph: &Graph,
        elapsed: Duration,
        report_file: Option<&std::path::Path>,
    ) -> Exit {
        let snapshot = graph.snapshot();
        let report = play.content.report(&snapshot);
        let accomplished = *ending == Ending::Accomplished;
        let violations = play.staged.as_ref().map_or_else(Vec::new, |staged| {
            let judged = self.record.judge(staged, accomplished, &play.content, &snapshot);
            judged.iter().map(|v| format!("{}: {v}", place(&staged.scenario, v.span()))).collect()
        });
        self.console.result("");
        let width = self.console.result_width().unwrap_or(usize::MAX);
        for line in report.to_string().lines() {
            // A rule that is wider than the terminal would be two.
            let rule = line.starts_with('─');
            let line: String = line.chars().take(if rule { width } else { usize::MAX }).collect();
            self.console.result(&line);
        }
        let (replans, repairs) = (self.record.replans(), self.record.repairs());
        let time = seconds(elapsed);
        let word = if accomplished { "accomplished" } else { "not accomplished" };
        self.console
            .result(&format!("\nmission {word} after {time:.1} s, {}", counted(replans, repairs.reuse)));
        let asked_again = self.record.asked_again().iter().map(ToString::to_string).collect();
        for violation in &violations {
            self.console.note(&format!("expectation not met: {violation}"));
        }
        let failed = !violations.is_empty();
        let source = "result";
        self.console.record(&Summary {
            source,
            time,
            ending,
            replans,
            repairs,
            asked_again,
            violations,
            report: &report,
        });
        if let Some(path) = report_file {
            let json = serde_json::to_string_pretty(&report).unwrap_or_default();
            if let Err(error) = files::write(path, &format!("{json}\n")) {
                self.console.complain(&format!("error: {error}\n"));
                return Exit::Unwritable;
            }
        }
        if accomplished && !failed { Exit::Yes } else { Exit::No }
    }
}

fn counted(replans: u32, repaired: u32) -> String {
    match (replans, repaired) {
        (0, _) => "no replans".to_owned(),
        (1, 0) => "1 replan".to_owned(),
        (1, _) => "1 replan, a repair".to_owned(),
        (more, 0) => format!("{more} replans"),
        (more, some) => format!("{more} replans, {some} of them repairs"),
    }
}

/// `file:line:column` in a scenario.
fn place(scenario: &Scenario, span: pddl::Span) -> String {
    let at = scenario.source.line_column(span.start);
    format!("{}:{}:{}", scenario.source.name(), at.line, at.column)
}
