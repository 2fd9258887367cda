//! The story as text: dialogue, the state in the paper's sentences, the plan, the reason of each
//! replan.
//!
//! On a terminal, the most important lines (speech, the reasons of a new plan) are wrapped to its
//! width, and the others are truncated to one row. In a pipe every line is complete, so that it can
//! be searched.

use super::story::{Alarm, Commit, Entry, What};
use crate::clock::seconds;
use crate::render::counted;
use executive::{Ending, Figures, Life, Narration, Repair};
use hal::sim::RoomEvent;
use pddl::model::Name;
use planner::Way;

/// Converts entries to lines.
pub(crate) struct Terminal {
    lines: Vec<String>,
    colour: bool,
    /// The number of columns, if the output is a terminal.
    width: Option<usize>,
    /// The robot's last sentence and the page it showed, so that neither is printed twice.
    said: String,
    options: Vec<String>,
    /// The number of steps of the current plan.
    steps: usize,
    /// Whether to show HighToLow's choices, too.
    verbose: bool,
}

/// The style of a line on a terminal with colours.
#[derive(Clone, Copy)]
enum Tone {
    Robot,
    Screen,
    Person,
    Graph,
    Plan,
    Trouble,
    Plain,
}

impl Tone {
    fn code(self) -> &'static str {
        match self {
            Self::Robot | Self::Screen => "36",
            Self::Person => "32",
            Self::Graph => "2",
            Self::Plan => "33",
            Self::Trouble => "1;31",
            Self::Plain => "0",
        }
    }

    /// Whether the whole line must be readable.
    fn matters(self) -> bool {
        matches!(self, Self::Robot | Self::Person | Self::Trouble)
    }
}

impl Terminal {
    pub(crate) fn new(colour: bool, width: Option<usize>, verbose: bool) -> Self {
        let (said, options) = (String::new(), Vec::new());
        Self { lines: Vec::new(), colour, width, said, options, steps: 0, verbose }
    }

    /// The lines of a decision at this time, in nanoseconds since the start.
    pub(crate) fn narrate(&mut self, now: u64, narration: &Narration) -> Vec<String> {
        self.pelea(seconds(std::time::Duration::from_nanos(now)), narration);
        std::mem::take(&mut self.lines)
    }

    /// The lines of an entry.
    pub(super) fn lines(&mut self, entry: &Entry) -> Vec<String> {
        match &entry.what {
            What::Room(event) => self.room(entry.time, event),
            What::Graph(commit) => self.graph(entry.time, commit),
            What::Pelea(narration) => self.pelea(entry.time, narration),
            What::Safety(Alarm::Broken(broken)) => {
                self.line(entry.time, Tone::Trouble, "broken", &broken.to_string());
            }
        }
        std::mem::take(&mut self.lines)
    }

    fn line(&mut self, time: f64, tone: Tone, head: &str, text: &str) {
        let rows = match self.width {
            None => vec![text.to_owned()],
            Some(width) => fit(text, width.saturating_sub(INDENT).max(NARROWEST), tone.matters()),
        };
        for (i, row) in rows.iter().enumerate() {
            let line = match i {
                0 => format!("{time:>8.2}  {head:<8} {row}"),
                _ => format!("{:INDENT$}{row}", ""),
            };
            self.lines.push(if self.colour { format!("\x1b[{}m{line}\x1b[0m", tone.code()) } else { line });
        }
    }

    fn graph(&mut self, time: f64, commit: &Commit) {
        let subject = |sentence: &str| sentence.split(' ').next().unwrap_or_default().to_owned();
        // The token that replaced this one is sufficient.
        let told: Vec<_> = commit.now.iter().map(|s| subject(s)).collect();
        let gone: Vec<_> = commit.no_longer.iter().filter(|s| !told.contains(&subject(s))).collect();
        // A reflex after a loss is important; one after an answer is routine.
        let reflex = commit.reflex && !gone.is_empty();
        let gone = gone.iter().map(|s| format!("no longer: {s}"));
        let parts: Vec<_> = gone.chain(commit.now.iter().cloned()).collect();
        if parts.is_empty() {
            return;
        }
        // A reflex writes in the same commit that it reacts to.
        let (tone, head) = if reflex { (Tone::Trouble, "reflex") } else { (Tone::Graph, "") };
        self.line(time, tone, head, &parts.join(" · "));
    }

    fn room(&mut self, time: f64, event: &RoomEvent) {
        use RoomEvent as E;
        let (tone, head, text) = match event {
            E::RobotSays { text } => {
                self.said.clone_from(text);
                (Tone::Robot, "robot:", format!("“{text}”"))
            }
            E::RobotStops { said } if said.is_empty() => return,
            E::RobotStops { said } => (Tone::Trouble, "robot:", format!("stops after “{said}”")),
            E::ScreenShows { page } => (Tone::Screen, "screen:", self.page(page)),
            E::ScreenClears => return,
            E::PersonSays { words } => (Tone::Person, "person:", format!("“{words}”")),
            E::PersonTouches { words, .. } => (Tone::Person, "person:", format!("touches “{words}”")),
            E::PersonAsks { request, person } => {
                let head = person.as_ref().map_or_else(|| "person:".to_owned(), |name| format!("{name}:"));
                return self.line(time, Tone::Person, &head, &format!("asks for {request}"));
            }
            E::VisitorComes { name } => (Tone::Person, "room", format!("{name} comes into view")),
            E::VisitorGoes { name } => (Tone::Person, "room", format!("{name} leaves view")),
            E::PersonLeaves => (Tone::Trouble, "room", "the person leaves view".to_owned()),
            E::PersonLeavesRoom => (Tone::Trouble, "room", "the person leaves the room".to_owned()),
            E::PersonReturns => (Tone::Person, "room", "the person is in view again".to_owned()),
            E::ClinicianCalled { need, urgent, .. } => {
                let urgently = if *urgent { " urgently" } else { "" };
                (Tone::Plan, "room", format!("the clinician is called{urgently}: {need}"))
            }
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
            E::DeviceStalls { device } => {
                (Tone::Trouble, "room", format!("{device} does not answer any more"))
            }
            E::DeviceSlows { device } => {
                (Tone::Trouble, "room", format!("{device} answers late from now on"))
            }
            E::DeviceRefuses { device } => {
                (Tone::Trouble, "room", format!("{device} rejects every request from now on"))
            }
            E::DevicePanics { device } => {
                (Tone::Trouble, "room", format!("the driver of the {device} panics"))
            }
            E::DeviceRecovers { device } => (Tone::Plain, "room", format!("{device} works again")),
        };
        self.line(time, tone, head, &text);
    }

    /// A page without the sentence that was just spoken; its options are included if they are new.
    fn page(&mut self, page: &hal::Page) -> String {
        let text = if page.text == self.said { "" } else { page.text.as_str() };
        let parts = [page.title.as_str(), text];
        let mut parts: Vec<_> = parts.into_iter().filter(|p| !p.is_empty()).map(str::to_owned).collect();
        let options: Vec<_> = page.options.iter().map(|o| o.words.clone()).collect();
        if !options.is_empty() {
            let same = options == self.options && self.width.is_some();
            parts.push(if same {
                "[the same options]".to_owned()
            } else {
                format!("[{}]", options.join(" | "))
            });
        }
        self.options = options;
        parts.join(" · ")
    }

    fn pelea(&mut self, time: f64, narration: &Narration) {
        use Narration as N;
        match narration {
            N::Objects { come, gone } => {
                let name = |what: &str, names: &[Name]| {
                    names.iter().map(|name| format!("{what} {name}")).collect::<Vec<_>>()
                };
                let text = [name("there is", come), name("gone is", gone)].concat().join(", ");
                self.line(time, Tone::Plan, "objects", &text);
            }
            N::Goal(change) => {
                let tone = match change.life {
                    Life::GivenUp | Life::Suspended => Tone::Trouble,
                    _ => Tone::Plan,
                };
                let text =
                    format!("{} {}: {}", change.goal, change.life.to_string().replace('_', " "), change.why);
                self.line(time, tone, "goal", text.trim_end_matches([':', ' ']));
            }
            N::Planned { plan, survives, repair, count, goals, .. } => {
                self.steps = plan.len();
                let head = if *count > 1 { "replan" } else { "plan" };
                let first: Vec<_> = plan.iter().take(3).map(ToString::to_string).collect();
                let more =
                    if plan.len() > 3 { format!(" … {}", plan[plan.len() - 1]) } else { String::new() };
                let runs_on = if *survives { ", its first step runs on" } else { "" };
                let together = |names: &Vec<Name>| {
                    names.iter().map(ToString::to_string).collect::<Vec<_>>().join(" and ")
                };
                let names: Vec<_> = goals.iter().map(together).collect();
                let serves =
                    if names.is_empty() { String::new() } else { format!(" for {}", names.join(", then ")) };
                let steps = counted(plan.len(), "step", "steps");
                let text = format!("{steps}{serves}{runs_on}: {}{more}", first.join(" "));
                self.line(time, Tone::Plan, head, &text);
                if let Some(repair) = repair {
                    self.line(time, Tone::Plan, "repair", &repaired(repair));
                }
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
            N::Resting { steps, seconds } => {
                let steps: Vec<_> = steps.iter().map(ToString::to_string).collect();
                self.line(time, Tone::Plan, "rest", &format!("{} again in {seconds} s", steps.join(" ")));
            }
            N::AskedAgain { times } => {
                let text = format!("the world has moved on; asking for a plan again ({times})");
                self.line(time, Tone::Plan, "ask", &text);
            }
            N::FitsAgain => self.line(time, Tone::Plan, "plan", "fits again, and goes on"),
            N::Meanwhile { task } => self.line(time, Tone::Plan, "wait", &format!("meanwhile {task}")),
            N::Escalated { why, task } => {
                self.line(time, Tone::Trouble, "stuck", &format!("{why}; {task}"));
            }
            N::Retried { task, why, seconds } => {
                self.line(time, Tone::Trouble, "failed", &format!("{task}: {why}; again in {seconds} s"));
            }
            N::Displaced { task } => {
                self.line(time, Tone::Plan, "resume", &format!("there is a plan again; {task} ends"));
            }
            N::StoodStill { seconds } => {
                let text = format!("PELEA stood still for {seconds:.1} s; deadlines do not count that time");
                self.line(time, Tone::Trouble, "late", &text);
            }
            N::Refused { why } => self.line(time, Tone::Trouble, "refused", &why.to_string()),
            N::Ended(ending) => {
                let tone = if *ending == Ending::Accomplished { Tone::Plan } else { Tone::Trouble };
                self.line(time, tone, "end", &ending.to_string());
            }
        }
    }
}

/// Which of the two plans was chosen, and the figures of both.
fn repaired(repair: &Repair) -> String {
    let figures = |way: Option<Figures>| {
        way.map_or_else(
            || "no plan".to_owned(),
            |f| {
                let moved = if f.moved > 0 { format!(" {} moved", f.moved) } else { String::new() };
                let states = if f.expanded == 1 { "state" } else { "states" };
                format!("+{} -{}{moved}, {} {states}", f.added, f.removed, f.expanded)
            },
        )
    };
    let (reused, scratch) = (figures(repair.reused), figures(repair.scratch));
    match repair.by {
        Way::Reuse => format!("the plan goes on ({reused}); from scratch {scratch}"),
        Way::Scratch => format!("a new plan ({scratch}); repaired {reused}"),
    }
}

/// The column at which the text of a line starts.
const INDENT: usize = 19;
/// The smallest width of a row, even on narrower terminals.
const NARROWEST: usize = 20;

/// The text in rows of a width: wrapped between words, or truncated to one row.
fn fit(text: &str, width: usize, wrap: bool) -> Vec<String> {
    if text.chars().count() <= width {
        return vec![text.to_owned()];
    }
    if !wrap {
        let kept: String = text.chars().take(width - 1).collect();
        return vec![format!("{}…", kept.trim_end())];
    }
    let mut rows = vec![String::new()];
    let mut used = 0;
    for word in text.split(' ') {
        let length = word.chars().count();
        let row = rows.last_mut().expect("there is a first row");
        if used > 0 && used + 1 + length > width {
            rows.push(word.to_owned());
            used = length;
        } else {
            if used > 0 {
                row.push(' ');
                used += 1;
            }
            row.push_str(word);
            used += length;
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::fit;

    #[test]
    fn rows_are_wrapped_or_cut() {
        assert_eq!(fit("one two", 7, true), ["one two"]);
        assert_eq!(fit("one two", 7, false), ["one two"]);
        assert_eq!(fit("one two three", 8, true), ["one two", "three"]);
        assert_eq!(fit("one two three", 9, false), ["one two…"]);
        assert_eq!(fit("ñandúes todos", 8, true), ["ñandúes", "todos"]);
        assert_eq!(fit("incomprehensible", 8, true), ["incomprehensible"]);
    }
}
