//! Disruptions: events of the patient, of the clinician's console and of the devices, and their times.

mod step;

use std::time::Duration;

use pddl::Span;
use pddl::model::Name;

pub use self::step::Step;
use super::GraphCondition;
use super::names::node;
use crate::layers::Layers;
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
}

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
    /// The person asks for something.
    Ask {
        /// The request.
        request: Name,
    },
    /// The clinician pauses the test.
    Pause,
    /// The clinician resumes it.
    Resume,
    /// The clinician aborts it.
    Abort,
    /// A device fails from now on.
    Fail(Device),
    /// A device reports success and does nothing from now on.
    Lie(Device),
    /// A device works again.
    Recover(Device),
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
    /// Its place in the scenario.
    pub span: Span,
}

const ACTS: [&str; 9] =
    ["lose-person", "return-person", "ask", "pause", "resume", "abort", "fail", "lie", "recover"];

/// Reads a `[[disruption]]`.
pub(super) fn read(reader: &mut Reader<'_>, layers: &Layers, mut table: Table<'_>) -> Option<Disruption> {
    let span = table.span;
    let trigger = read_trigger(reader, layers, &mut table);
    let after = table.seconds(reader, "after").unwrap_or_default();
    let act = read_act(reader, layers, &mut table);
    table.finish(reader);
    Some(Disruption { trigger: trigger?, after, act: act?, span })
}

fn read_trigger(reader: &mut Reader<'_>, layers: &Layers, table: &mut Table<'_>) -> Option<Trigger> {
    let at = table.seconds(reader, "at");
    let when = table.text(reader, "when");
    let step = table.text(reader, "step");
    let occurrence = table.count(reader, "occurrence", 1);
    let given: Vec<&str> = ["at", "when", "step"].into_iter().filter(|k| table.has(k)).collect();
    match given[..] {
        [_] => {}
        [] => {
            reader.error("E0906", table.span, "a disruption needs one of `at`, `when`, `step`");
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
    if let Some((_, span)) = occurrence.filter(|_| table.has("at")) {
        reader.error("E0906", span, "`occurrence` counts a `when` or a `step`; a time occurs once");
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
            Some(Act::Ask { request: layers.graph.model.objects[id].name.clone() })
        }
        "fail" => read_device(reader, table).map(Act::Fail),
        "lie" => read_device(reader, table).map(Act::Lie),
        "recover" => read_device(reader, table).map(Act::Recover),
        unknown => {
            let help = did_you_mean(unknown, ACTS).unwrap_or_else(|| format!("one of: {}", ACTS.join(", ")));
            let message = format!("a scenario cannot do `{unknown}`");
            let finding = Finding::error("E0908", reader.place(act.span), message);
            reader.findings.push(finding.help(help));
            // Do not report the keys that the intended act would have read.
            let _ = (table.text(reader, "request"), table.text(reader, "device"));
            None
        }
    }
}

fn read_device(reader: &mut Reader<'_>, table: &mut Table<'_>) -> Option<Device> {
    let text = table.required_text(reader, "device")?;
    match text.value.as_str() {
        "speaker" => Some(Device::Speaker),
        "screen" => Some(Device::Screen),
        "microphone" => Some(Device::Microphone),
        unknown => {
            let message = format!("there is no device `{unknown}`");
            let finding = Finding::error("E0908", reader.place(text.span), message);
            reader.findings.push(finding.help("one of: speaker, screen, microphone"));
            None
        }
    }
}
