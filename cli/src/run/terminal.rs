//! The story for people: dialogue, the state in the paper's sentences, the plan, each replan's reason.

use super::story::{Commit, Entry, What};
use executive::{Ending, Narration};
use hal::sim::RoomEvent;

/// Turns entries into lines.
pub(super) struct Terminal {
    lines: Vec<String>,
    colour: bool,
    /// How many steps the current plan has.
    steps: usize,
    /// Show HighToLow's choices too.
    verbose: bool,
}

/// How a line looks on a terminal that shows colours.
#[derive(Clone, Copy)]
enum Tone {
    Robot,
    Person,
    Graph,
    Plan,
    Trouble,
    Plain,
}

impl Tone {
    fn code(self) -> &'static str {
        match self {
            Self::Robot => "36",
            Self::Person => "32",
            Self::Graph => "2",
            Self::Plan => "33",
            Self::Trouble => "1;31",
            Self::Plain => "0",
        }
    }
}

impl Terminal {
    pub(super) fn new(colour: bool, verbose: bool) -> Self {
        Self { lines: Vec::new(), colour, steps: 0, verbose }
    }

    /// What to print of an entry.
    pub(super) fn lines(&mut self, entry: &Entry) -> Vec<String> {
        match &entry.what {
            What::Room(event) => self.room(entry.time, event),
            What::Graph(commit) => self.graph(entry.time, commit),
            What::Pelea(narration) => self.pelea(entry.time, narration),
        }
        std::mem::take(&mut self.lines)
    }

    fn line(&mut self, time: f64, tone: Tone, head: &str, text: &str) {
        let line = format!("{time:>8.2}  {head:<8} {text}");
        self.lines.push(if self.colour { format!("\x1b[{}m{line}\x1b[0m", tone.code()) } else { line });
    }

    fn graph(&mut self, time: f64, commit: &Commit) {
        let subject = |sentence: &str| sentence.split(' ').next().unwrap_or_default().to_owned();
        // What took another's place is told by what is there now.
        let told: Vec<_> = commit.now.iter().map(|s| subject(s)).collect();
        let gone: Vec<_> = commit.no_longer.iter().filter(|s| !told.contains(&subject(s))).collect();
        // A reflex that follows a loss is what one wants to see; one that follows an answer is housekeeping.
        let reflex = commit.reflex && !gone.is_empty();
        let gone = gone.iter().map(|s| format!("no longer: {s}"));
        let parts: Vec<_> = gone.chain(commit.now.iter().cloned()).collect();
        if parts.is_empty() {
            return;
        }
        let tone = if reflex { Tone::Trouble } else { Tone::Graph };
        let reflex = if reflex { "   (a reflex, in the same commit)" } else { "" };
        self.line(time, tone, "", &format!("{}{reflex}", parts.join(" · ")));
    }

    fn room(&mut self, time: f64, event: &RoomEvent) {
        use RoomEvent as E;
        let (tone, head, text) = match event {
            E::RobotSays { text } => (Tone::Robot, "robot:", format!("“{text}”")),
            E::RobotStops { said } if said.is_empty() => return,
            E::RobotStops { said } => (Tone::Trouble, "robot:", format!("stops after “{said}”")),
            E::ScreenShows { page } => (Tone::Robot, "screen:", page_line(page)),
            E::ScreenClears => return,
            E::PersonSays { words } => (Tone::Person, "person:", format!("“{words}”")),
            E::PersonTouches { words, .. } => (Tone::Person, "person:", format!("touches “{words}”")),
            E::PersonAsks { request } => (Tone::Person, "person:", format!("asks for {request}")),
            E::PersonLeaves => (Tone::Trouble, "room", "the person leaves view".to_owned()),
            E::PersonLeavesRoom => (Tone::Trouble, "room", "the person leaves the room".to_owned()),
            E::PersonReturns => (Tone::Person, "room", "the person is in view again".to_owned()),
            E::ClinicianCalled { need } => (Tone::Plan, "room", format!("the clinician is called: {need}")),
            E::CallWithdrawn { need } => (Tone::Plan, "room", format!("the call is withdrawn: {need}")),
            E::ClinicianArrives { .. } => (Tone::Plan, "room", "the clinician comes in".to_owned()),
            E::ClinicianGoes { .. } => (Tone::Plan, "room", "the clinician has seen to it".to_owned()),
            E::ClinicianCommands { command } => {
                (Tone::Trouble, "room", format!("the clinician presses {command}"))
            }
            E::ReportDelivered { .. } => (Tone::Plan, "room", "the report reaches the clinician".to_owned()),
            E::DeviceFails { device } => (Tone::Trouble, "room", format!("{device} fails")),
            E::DeviceLies { device } => {
                (Tone::Trouble, "room", format!("{device} claims success from now on, and does nothing"))
            }
            E::DeviceRecovers { device } => (Tone::Plain, "room", format!("{device} works again")),
        };
        self.line(time, tone, head, &text);
    }

    fn pelea(&mut self, time: f64, narration: &Narration) {
        use Narration as N;
        match narration {
            N::Planned { plan, survives, count, .. } => {
                self.steps = plan.len();
                let head = if *count > 1 { "replan" } else { "plan" };
                let first: Vec<_> = plan.iter().take(3).map(ToString::to_string).collect();
                let more =
                    if plan.len() > 3 { format!(" … {}", plan[plan.len() - 1]) } else { String::new() };
                let runs_on = if *survives { ", its first step runs on" } else { "" };
                let text = format!("{} steps{runs_on}: {}{more}", plan.len(), first.join(" "));
                self.line(time, Tone::Plan, head, &text);
            }
            N::Deviated(deviation) => {
                for literal in &deviation.broken {
                    self.line(time, Tone::Trouble, "because", &literal.to_string());
                }
            }
            N::Started { index, step } => {
                let text = format!("{}/{}: {step}", index + 1, self.steps);
                self.line(time, Tone::Plan, "step", &text);
            }
            N::Achieved { .. } => {}
            N::Skipped { steps } => {
                let steps: Vec<_> = steps.iter().map(ToString::to_string).collect();
                self.line(time, Tone::Plan, "skip", &format!("no longer needed: {}", steps.join(" ")));
            }
            N::Failed { step, why } => self.line(time, Tone::Trouble, "failed", &format!("{step}: {why}")),
            N::Refined { what } if self.verbose => {
                self.line(time, Tone::Graph, "", &format!("pelea: {what}"));
            }
            N::Refined { .. } => {}
            N::FellBack { why } => {
                self.line(time, Tone::Trouble, "no plan", &format!("{why}; falling back"));
            }
            N::Refused { why } => self.line(time, Tone::Trouble, "refused", why),
            N::Ended(Ending::Accomplished) => self.line(time, Tone::Plan, "end", "mission accomplished"),
            N::Ended(Ending::NotAccomplished { why, .. }) => {
                self.line(time, Tone::Trouble, "end", &format!("mission not accomplished: {why}"));
            }
        }
    }
}

fn page_line(page: &hal::Page) -> String {
    let options: Vec<_> = page.options.iter().map(|o| o.words.as_str()).collect();
    let parts = [page.title.as_str(), page.text.as_str()];
    let mut text: Vec<_> = parts.into_iter().filter(|part| !part.is_empty()).map(str::to_owned).collect();
    if !options.is_empty() {
        text.push(format!("[{}]", options.join(" | ")));
    }
    text.join(" · ")
}
