//! The simulated patient: their answers, with time and manner.

use std::time::Duration;

use pddl::model::{Name, ObjectId};

use super::names::{argument, node};
use crate::errors::counted;
use crate::mission::Mission;
use diagnostics::toml::{Reader, Table};

/// How an answer is given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum By {
    /// Said aloud.
    #[default]
    Voice,
    /// Touched on the screen.
    Touch,
    /// Said aloud, and another option touched at the same time.
    Both,
}

/// The content of a reply.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// An option of the item, by its number, from 1.
    Option(u32),
    /// No answer.
    Silent,
    /// Words, as the recogniser hears them, that are not an option.
    Misheard(String),
}

/// An answer, with its time and manner.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reply {
    /// The answer.
    pub answer: Answer,
    /// The delay after the robot begins to listen.
    pub delay: Duration,
    /// The manner.
    pub by: By,
}

/// An exception to the patient's default.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReplyRule {
    /// For this item.
    pub item: Name,
    /// For this question; `None` for all questions about the item.
    pub question: Option<Name>,
    /// The reply.
    pub reply: Reply,
}

/// The simulated patient.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Patient {
    /// Whether they are in view at the start.
    pub in_view: bool,
    /// The reply without an exception.
    pub default: Reply,
    /// The exceptions.
    pub replies: Vec<ReplyRule>,
}

const DELAY: Duration = Duration::from_secs(2);

impl Patient {
    /// The patient's reply to a question about an item: the exception for both, else the exception for the item, else the
    /// default.
    pub fn reply(&self, item: &str, question: &str) -> &Reply {
        let of_item = || self.replies.iter().filter(|r| &*r.item == item);
        let exact = of_item().find(|r| r.question.as_deref() == Some(question));
        exact.or_else(|| of_item().find(|r| r.question.is_none())).map_or(&self.default, |r| &r.reply)
    }
}

/// Reads `[patient]`.
pub(super) fn read(reader: &mut Reader<'_>, mission: &Mission, table: Option<Table<'_>>) -> Patient {
    let layers = &mission.layers;
    let otherwise = Reply { answer: Answer::Option(1), delay: DELAY, by: By::Voice };
    let mut patient = Patient { in_view: true, default: otherwise, replies: Vec::new() };
    let Some(mut table) = table else { return patient };
    patient.in_view = table.boolean(reader, "in-view").unwrap_or(true);
    let default = table.table(reader, "default");
    let rules = table.tables(reader, "reply");
    table.finish(reader);
    for rule in rules {
        patient.replies.extend(read_rule(reader, mission, rule));
    }
    if let Some(mut default) = default {
        let excepted = |item: ObjectId| {
            patient.replies.iter().any(|r| *r.item == *layers.name(item) && r.question.is_none())
        };
        let items: Vec<ObjectId> = layers.items().into_iter().filter(|&i| !excepted(i)).collect();
        let reply = read_reply(reader, mission, &mut default, &items);
        default.finish(reader);
        patient.default = reply.unwrap_or(patient.default);
    }
    patient
}

fn read_rule(reader: &mut Reader<'_>, mission: &Mission, mut table: Table<'_>) -> Option<ReplyRule> {
    let layers = &mission.layers;
    let tokens = &layers.tokens;
    let item = table.required_text(reader, "item");
    let item = item.and_then(|text| node(reader, layers, &text, tokens.items, "item"));
    let question = table.text(reader, "question");
    let question = question.map(|text| argument(reader, layers, &text, tokens.unanswered, 0, "question"));
    let items: Vec<ObjectId> = item.into_iter().collect();
    let reply = read_reply(reader, mission, &mut table, &items);
    table.finish(reader);
    let name = |id| layers.graph.model.objects[id].name.clone();
    let question = match question {
        None => None,
        Some(found) => Some(name(found?)),
    };
    Some(ReplyRule { item: name(item?), question, reply: reply? })
}

/// Reads exactly one of `option`, `silent`, `misheard`, and `delay` and `by`. Each of `items` must offer the option.
pub(super) fn read_reply(
    reader: &mut Reader<'_>,
    mission: &Mission,
    table: &mut Table<'_>,
    items: &[ObjectId],
) -> Option<Reply> {
    let layers = &mission.layers;
    let option = table.count(reader, "option", 1);
    let silent = table.boolean(reader, "silent");
    let misheard = table.text(reader, "misheard");
    let delay = table.seconds(reader, "delay").unwrap_or(DELAY);
    let by = by(reader, table).unwrap_or_default();
    if ["option", "silent", "misheard"].iter().filter(|k| table.has(k)).count() != 1 {
        let message = "a reply is exactly one of `option`, `silent = true`, `misheard`";
        reader.error("E0904", table.span, message);
        return None;
    }
    if let Some((number, span)) = option {
        let few = items.iter().map(|&item| (item, layers.options(item).len()));
        for (item, offered) in few.filter(|&(_, offered)| (number as usize) > offered) {
            let offered = counted(offered, "option", "options");
            let message = format!("`{}` offers {offered} only", layers.name(item));
            reader.error("E0905", span, message);
        }
        return Some(Reply { answer: Answer::Option(number), delay, by });
    }
    if let Some(text) = misheard {
        for (words, item) in mission.all_words().flat_map(|w| items.iter().map(move |i| (w, *i))) {
            if let Some(option) = words.understand(layers.name(item), &text.value) {
                let (language, item) = (words.tag(), layers.name(item));
                let message =
                    format!("in `{language}` these words are understood: they choose `{option}` of `{item}`");
                reader.error("E0911", text.span, message);
            }
        }
        return Some(Reply { answer: Answer::Misheard(text.value), delay, by });
    }
    if !silent? {
        reader.error("E0904", table.key_span("silent"), "`silent` must be true; leave it out for an answer");
        return None;
    }
    Some(Reply { answer: Answer::Silent, delay, by })
}

/// The manner of `by`; `None` without the key.
pub(super) fn by(reader: &mut Reader<'_>, table: &mut Table<'_>) -> Option<By> {
    let text = table.text(reader, "by")?;
    match text.value.as_str() {
        "voice" => Some(By::Voice),
        "touch" => Some(By::Touch),
        "both" => Some(By::Both),
        _ => {
            reader.error("E0903", text.span, "`by` is \"voice\", \"touch\" or \"both\"");
            None
        }
    }
}
