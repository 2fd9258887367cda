//! Disruptions: events of the patient, of the clinician's console and of the devices, and their times.

mod flip;
mod step;

use std::sync::Arc;
use std::time::Duration;

use pddl::Span;
use pddl::model::Name;

use self::flip::Flipped;
pub use self::flip::Token;
pub(super) use self::flip::by_label;
pub use self::step::Step;
use super::GraphCondition;
use super::names::{self, node};
use super::patient::{By, Reply};
use crate::layers::Layers;
use crate::mission::Mission;
use diagnostics::Finding;
use diagnostics::did_you_mean;
use diagnostics::toml::{Reader, Table};

/// A device that can be disturbed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Device {
    /// Text to speech.
    Speaker,
    /// The touchscreen's display.
    Screen,
    /// Speech recognition.
    Microphone,
    /// The touchscreen's touch input.
    Touch,
    /// The tracker of bodies.
    Tracker,
    /// The clinician's console.
    Console,
}

/// Each device by its name.
const DEVICES: [(&str, Device); 6] = [
    ("speaker", Device::Speaker),
    ("screen", Device::Screen),
    ("microphone", Device::Microphone),
    ("touch", Device::Touch),
    ("tracker", Device::Tracker),
    ("console", Device::Console),
];

/// What a disruption makes of a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Fault {
    /// It fails at once.
    Fail,
    /// It reports success and does nothing.
    Lie,
    /// It neither works nor fails.
    Stall,
    /// It reports everything late.
    Slow,
    /// It rejects every request.
    Refuse,
    /// Its driver panics.
    Panic,
}

/// Each fault by its name.
const FAULTS: [(&str, Fault); 6] = [
    ("fail", Fault::Fail),
    ("lie", Fault::Lie),
    ("stall", Fault::Stall),
    ("slow", Fault::Slow),
    ("refuse", Fault::Refuse),
    ("panic", Fault::Panic),
];

/// When a disruption is due.
#[derive(Clone, Debug)]
pub enum Trigger {
    /// At this time after the start.
    At(Duration),
    /// When a condition becomes true.
    When {
        /// The condition.
        condition: GraphCondition,
        /// Which occurrence, counted from 1.
        occurrence: u32,
    },
    /// After the commit that makes this version of the graph.
    Version(u64),
    /// At the instant that a campaign chooses; only in a library.
    Instant,
    /// When PELEA starts an action.
    Step {
        /// The action.
        step: Step,
        /// Which occurrence, counted from 1.
        occurrence: u32,
    },
}

/// The event of a disruption.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Act {
    /// The person goes out of view.
    LosePerson,
    /// The person comes back.
    ReturnPerson,
    /// Another person comes into view.
    VisitorComes {
        /// The node that stands for them.
        person: Name,
    },
    /// Another person goes out of view.
    VisitorGoes {
        /// The node that stands for them.
        person: Name,
    },
    /// A person asks for something.
    Ask {
        /// The request.
        request: Name,
        /// Who; `None` is the patient.
        person: Option<Name>,
        /// By voice or by touch; `None` is by whatever works.
        by: Option<By>,
    },
    /// The patient answers every question so from now on.
    Answer(Reply),
    /// The clinician pauses the test.
    Pause,
    /// The clinician resumes it.
    Resume,
    /// The clinician aborts it.
    Abort,
    /// A device does not work as it should.
    Disturb {
        /// Which.
        device: Device,
        /// In what way.
        fault: Fault,
        /// For how long; `None` until a `recover`.
        lasts: Option<Duration>,
    },
    /// A device works again.
    Recover(Device),
    /// An agent dies; its supervisor begins it again.
    Kill {
        /// The agent's name.
        agent: Name,
    },
    /// The process stands still, and all its clocks go on.
    Stop {
        /// For how long.
        lasts: Duration,
    },
    /// A token of the graph is removed if it is there, and added if it is not.
    Flip(Token),
    /// One of these tokens, which a campaign chooses; only in a library.
    FlipOneOf(Arc<[Token]>),
}

/// How an event happens again and again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Repeats {
    /// From one time to the next.
    pub every: Duration,
    /// How often in all; `None` until the run ends.
    pub times: Option<u32>,
}

/// One disruption.
#[derive(Clone, Debug)]
pub struct Disruption {
    /// When it is due.
    pub trigger: Trigger,
    /// The delay from the trigger to the event.
    pub after: Duration,
    /// The event of a disruption.
    pub act: Act,
    /// Whether a run in which it never happens is as good as any.
    pub optional: bool,
    /// Whether it happens again.
    pub repeats: Option<Repeats>,
    /// Its place in the scenario.
    pub span: Span,
}

const ACTS: [&str; 19] = [
    "lose-person",
    "return-person",
    "visitor-comes",
    "visitor-goes",
    "ask",
    "answer",
    "pause",
    "resume",
    "abort",
    "fail",
    "lie",
    "stall",
    "slow",
    "refuse",
    "panic",
    "recover",
    "kill",
    "stop",
    "flip",
];

/// Whether each disruption must have a trigger.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Triggers {
    /// In a scenario.
    Required,
    /// In a library: without a trigger it happens at the campaign's instant.
    OrInstant,
}

/// Reads a `[[disruption]]`.
pub(super) fn read(
    reader: &mut Reader<'_>,
    mission: &Mission,
    mut table: Table<'_>,
    triggers: Triggers,
) -> Option<Disruption> {
    let layers = &mission.layers;
    let span = table.span;
    let trigger = read_trigger(reader, layers, &mut table, triggers);
    let after = table.seconds(reader, "after").unwrap_or_default();
    let optional = table.boolean(reader, "optional").unwrap_or_default();
    let act = read_act(reader, mission, &mut table, triggers);
    let repeats = read_repeats(reader, &mut table, act.as_ref());
    table.finish(reader);
    Some(Disruption { trigger: trigger?, after, act: act?, optional, repeats, span })
}

/// `every = 5.0` and `times = 10`.
fn read_repeats(reader: &mut Reader<'_>, table: &mut Table<'_>, act: Option<&Act>) -> Option<Repeats> {
    let every = table.seconds(reader, "every");
    let times = table.count(reader, "times", 2);
    let Some(every) = every else {
        if let Some((_, span)) = times {
            reader.error("E0906", span, "`times` needs `every`: the time from one to the next");
        }
        return None;
    };
    let lasts = match act {
        Some(Act::Disturb { lasts, .. }) => lasts.unwrap_or(Duration::MAX),
        _ => Duration::ZERO,
    };
    if every <= lasts {
        let place = table.key_span("every");
        reader.error("E0906", place, "a fault must end, by `for`, before it comes `every` so many seconds");
        return None;
    }
    Some(Repeats { every, times: times.map(|(times, _)| times) })
}

fn read_trigger(
    reader: &mut Reader<'_>,
    layers: &Layers,
    table: &mut Table<'_>,
    triggers: Triggers,
) -> Option<Trigger> {
    let at = table.seconds(reader, "at");
    let when = table.text(reader, "when");
    let step = table.text(reader, "step");
    let version = table.count(reader, "version", 1);
    let occurrence = table.count(reader, "occurrence", 1);
    let given: Vec<&str> = ["at", "when", "step", "version"].into_iter().filter(|k| table.has(k)).collect();
    match given[..] {
        [_] => {}
        [] if triggers == Triggers::OrInstant => return Some(Trigger::Instant),
        [] => {
            reader.error("E0906", table.span, "a disruption needs one of `at`, `when`, `step`, `version`");
            return None;
        }
        [first, second, ..] => {
            let place = reader.place(table.key_span(second));
            let other = reader.place(table.key_span(first));
            let message = format!("a disruption has one trigger, and this one has `{first}` and `{second}`");
            let finding = Finding::error("E0906", place, message);
            reader.findings.push(finding.related(other, format!("`{first}` is here")));
            return None;
        }
    }
    if let Some((_, span)) = occurrence.filter(|_| table.has("at") || table.has("version")) {
        reader.error(
            "E0906",
            span,
            "`occurrence` counts a `when` or a `step`; a time or a version occurs once",
        );
    }
    let occurrence = occurrence.map_or(1, |(n, _)| n);
    if let Some(text) = when {
        let condition = super::condition::read(reader, layers, &text)?;
        return Some(Trigger::When { condition, occurrence });
    }
    if let Some(text) = step {
        let step = step::read(reader, layers, &text)?;
        return Some(Trigger::Step { step, occurrence });
    }
    if let Some((version, _)) = version {
        return Some(Trigger::Version(u64::from(version)));
    }
    at.map(Trigger::At)
}

fn read_act(
    reader: &mut Reader<'_>,
    mission: &Mission,
    table: &mut Table<'_>,
    triggers: Triggers,
) -> Option<Act> {
    let layers = &mission.layers;
    let act = table.required_text(reader, "do")?;
    match act.value.as_str() {
        "lose-person" => Some(Act::LosePerson),
        "return-person" => Some(Act::ReturnPerson),
        "pause" => Some(Act::Pause),
        "resume" => Some(Act::Resume),
        "abort" => Some(Act::Abort),
        "ask" => {
            let text = table.required_text(reader, "request")?;
            let id = node(reader, layers, &text, layers.tokens.requests, "request")?;
            let request = layers.graph.model.objects[id].name.clone();
            let (by, person) = (super::patient::by(reader, table), person(reader, layers, table));
            Some(Act::Ask { request, person, by })
        }
        "answer" => {
            let items = layers.items();
            super::patient::read_reply(reader, mission, table, &items).map(Act::Answer)
        }
        "visitor-comes" => required_person(reader, layers, table).map(|person| Act::VisitorComes { person }),
        "visitor-goes" => required_person(reader, layers, table).map(|person| Act::VisitorGoes { person }),
        "recover" => read_device(reader, table).map(Act::Recover),
        "kill" => read_agent(reader, layers, table).map(|agent| Act::Kill { agent }),
        "stop" => {
            table.require(reader, "for");
            table.seconds(reader, "for").map(|lasts| Act::Stop { lasts })
        }
        "flip" => match flip::read(reader, layers, table)? {
            Flipped::This(token) => Some(Act::Flip(token)),
            Flipped::OneOf(tokens, _) if triggers == Triggers::OrInstant => {
                Some(Act::FlipOneOf(tokens.into()))
            }
            Flipped::OneOf(_, span) => {
                reader.error("E0908", span, "which token? Only a campaign chooses one that fits");
                None
            }
        },
        name if FAULTS.iter().any(|(known, _)| *known == name) => {
            let fault = FAULTS.into_iter().find(|(known, _)| *known == name)?.1;
            let lasts = table.seconds(reader, "for");
            read_device(reader, table).map(|device| Act::Disturb { device, fault, lasts })
        }
        unknown => {
            let help = did_you_mean(unknown, ACTS).unwrap_or_else(|| format!("one of: {}", ACTS.join(", ")));
            let message = format!("a scenario cannot do `{unknown}`");
            let finding = Finding::error("E0908", reader.place(act.span), message);
            reader.findings.push(finding.help(help));
            // Do not report the keys that the intended act would have read.
            for key in ["request", "device", "person", "by", "for", "token", "agent", "except"] {
                table.ignore(key);
            }
            None
        }
    }
}

/// The person of `person`, a node of the graph; `None` without the key.
fn person(reader: &mut Reader<'_>, layers: &Layers, table: &mut Table<'_>) -> Option<Name> {
    let text = table.text(reader, "person")?;
    let id = names::any(reader, layers, &text, "person")?;
    Some(layers.graph.model.objects[id].name.clone())
}

fn required_person(reader: &mut Reader<'_>, layers: &Layers, table: &mut Table<'_>) -> Option<Name> {
    table.require(reader, "person");
    person(reader, layers, table)
}

/// The agent of `agent`, by the name of its rules.
fn read_agent(reader: &mut Reader<'_>, layers: &Layers, table: &mut Table<'_>) -> Option<Name> {
    let text = table.required_text(reader, "agent")?;
    let names = || layers.agents.iter().map(|agent| &agent.model.name);
    let found = names().find(|name| ***name == *text.value);
    if found.is_none() {
        let known: Vec<&str> = names().map(|name| &**name).collect();
        let message = format!("there is no agent `{}`", text.value);
        let finding = Finding::error("E0908", reader.place(text.span), message);
        let help = did_you_mean(&text.value, known.iter().copied());
        reader.findings.push(finding.help(help.unwrap_or_else(|| format!("one of: {}", known.join(", ")))));
    }
    found.cloned()
}

fn read_device(reader: &mut Reader<'_>, table: &mut Table<'_>) -> Option<Device> {
    let text = table.required_text(reader, "device")?;
    let found = DEVICES.into_iter().find(|(name, _)| *name == text.value).map(|(_, device)| device);
    if found.is_none() {
        let message = format!("there is no device `{}`", text.value);
        let finding = Finding::error("E0908", reader.place(text.span), message);
        let names: Vec<_> = DEVICES.iter().map(|(name, _)| *name).collect();
        let help = did_you_mean(&text.value, names.iter().copied());
        reader.findings.push(finding.help(help.unwrap_or_else(|| format!("one of: {}", names.join(", ")))));
    }
    found
}
