//! Disruptions: events of the patient, of the clinician's console and of the devices, and their times.

mod step;

use std::time::Duration;

use pddl::Span;
use pddl::model::Name;

pub use self::step::Step;
use super::GraphCondition;
use super::names::{self, node};
use super::patient::By;
use crate::layers::Layers;
use crate::manifest::{Mention, symbols};
use diagnostics::Finding;
use diagnostics::did_you_mean;
use diagnostics::toml::{Reader, Table, Text};

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
    /// A token of the graph is removed if it is there, and added if it is not.
    Flip {
        /// The label.
        label: Name,
        /// The nodes from which and to which it goes.
        ends: [Name; 2],
    },
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
    /// Its place in the scenario.
    pub span: Span,
}

const ACTS: [&str; 16] = [
    "lose-person",
    "return-person",
    "visitor-comes",
    "visitor-goes",
    "ask",
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
    layers: &Layers,
    mut table: Table<'_>,
    triggers: Triggers,
) -> Option<Disruption> {
    let span = table.span;
    let trigger = read_trigger(reader, layers, &mut table, triggers);
    let after = table.seconds(reader, "after").unwrap_or_default();
    let optional = table.boolean(reader, "optional").unwrap_or_default();
    let act = read_act(reader, layers, &mut table);
    table.finish(reader);
    Some(Disruption { trigger: trigger?, after, act: act?, optional, span })
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

fn read_act(reader: &mut Reader<'_>, layers: &Layers, table: &mut Table<'_>) -> Option<Act> {
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
        "visitor-comes" => required_person(reader, layers, table).map(|person| Act::VisitorComes { person }),
        "visitor-goes" => required_person(reader, layers, table).map(|person| Act::VisitorGoes { person }),
        "recover" => read_device(reader, table).map(Act::Recover),
        "flip" => read_flip(reader, layers, table),
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
            for key in ["request", "device", "person", "by", "for", "token"] {
                table.ignore(key);
            }
            None
        }
    }
}

/// `token = "(is_with person robot)"`: a predicate of the vocabulary with two nodes of the initial graph.
fn read_flip(reader: &mut Reader<'_>, layers: &Layers, table: &mut Table<'_>) -> Option<Act> {
    let text = table.required_text(reader, "token")?;
    let mentions = symbols(&text);
    let [label, from, to] = mentions.as_slice() else {
        reader.error(
            "E0908",
            text.span,
            "a token is a predicate with two nodes, as in \"(is_with person robot)\"",
        );
        return None;
    };
    let Some(predicate) = layers.nodes.predicate(&label.name) else {
        let known = layers.nodes.predicates.enumerate().map(|(_, p)| p.name.as_str());
        let message = format!("there is no token `{}`", label.name);
        let finding = Finding::error("E0908", reader.place(label.span), message);
        reader.findings.push(finding.help_if(did_you_mean(&label.name, known)));
        return None;
    };
    let mut end = |mention: &Mention, position| {
        let text = Text::new(&mention.name, mention.span, "");
        names::argument(reader, layers, &text, predicate, position, "node for this token")
    };
    let ends = [end(from, 0)?, end(to, 1)?].map(|id| layers.graph.model.objects[id].name.clone());
    Some(Act::Flip { label: label.name.clone(), ends })
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
