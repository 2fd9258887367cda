//! One language of one mission, ready to be said.
//!
//! Look-up order: the sentence that the part has for the utterance, then the general one. Both are
//! templates: `{name}` is the part's name, `{option}` the text of the part's option of the utterance's
//! name. All of it is filled in when the mission is loaded, so a look-up is two steps in a map.

use std::collections::BTreeMap;

use indexmap::IndexMap;
use pddl::model::Name;

use super::file::{LanguageFile, Phrases};
use super::grammar::{Phrase, normalise};
use super::labels::ReportLabels;
use super::said::Said;

/// An option of an item.
#[derive(Clone, Debug)]
pub struct OptionWords {
    /// Its node.
    pub option: Name,
    /// What it says, without its number.
    pub text: String,
    /// How it may be answered; the first form is the plainest.
    pub spoken: Vec<String>,
    phrases: Vec<Phrase>,
}

#[derive(Clone, Debug)]
struct PartWords {
    name: String,
    sentences: BTreeMap<Name, String>,
    options: Vec<OptionWords>,
}

/// Everything the robot can say, show and understand in one language.
#[derive(Clone, Debug)]
pub struct Words {
    tag: String,
    language: String,
    labels: ReportLabels,
    parts: IndexMap<Name, PartWords>,
    requests: Vec<(Name, Vec<String>, Vec<Phrase>)>,
}

impl Words {
    /// The language's tag, `en`.
    pub fn tag(&self) -> &str {
        &self.tag
    }

    /// What the language calls itself.
    pub fn language(&self) -> &str {
        &self.language
    }

    /// Headings and marks of the report.
    pub fn labels(&self) -> &ReportLabels {
        &self.labels
    }

    /// What a part is called.
    pub fn name(&self, part: &str) -> Option<&str> {
        self.parts.get(part).map(|p| p.name.as_str())
    }

    /// What to say (or show) for an utterance in a part. `None` only for a pair that no method says.
    pub fn sentence(&self, part: &str, utterance: &str) -> Option<&str> {
        self.parts.get(part)?.sentences.get(utterance).map(String::as_str)
    }

    /// The options of an item, in the order in which `graph.pddl` declares them; empty for other parts.
    pub fn options(&self, part: &str) -> &[OptionWords] {
        self.parts.get(part).map_or(&[], |p| &p.options)
    }

    /// Which option of the part an utterance of the patient means. The whole utterance must be one of
    /// the option's forms: "the blue one" is not "one".
    pub fn understand(&self, part: &str, heard: &str) -> Option<&Name> {
        let heard = normalise(heard);
        let options = self.options(part).iter();
        options.filter(|o| o.phrases.iter().any(|p| p.is(&heard))).map(|o| &o.option).next()
    }

    /// Which request can be spotted within what was heard.
    pub fn spot(&self, heard: &str) -> Option<&Name> {
        let heard = normalise(heard);
        self.requests.iter().find(|(_, _, phrases)| phrases.iter().any(|p| p.is_within(&heard))).map(|r| &r.0)
    }

    /// How a request may be spoken; the first form is the plainest.
    pub fn request(&self, request: &str) -> &[String] {
        self.requests.iter().find(|r| &*r.0 == request).map_or(&[], |r| &r.1)
    }

    /// Fills in all templates. What the checks of the mission have reported is left out here.
    pub(crate) fn new(file: &LanguageFile, said: &Said) -> Self {
        let texts =
            |phrases: &Phrases| -> Vec<String> { phrases.phrases.iter().map(|t| t.value.clone()).collect() };
        let compiled = |texts: &[String]| texts.iter().map(|t| Phrase::new(t)).collect();
        let parts = said
            .parts
            .iter()
            .map(|(part, what)| {
                let own = file.parts.get(part);
                let name = own.and_then(|p| p.name.as_ref()).map_or_else(String::new, |t| t.value.clone());
                let sentences = what.utterances.iter().filter_map(|utterance| {
                    let template = file.template(part, utterance)?;
                    let option = own.and_then(|p| p.options.get(utterance)).map(|s| s.text.value.as_str());
                    Some((utterance.clone(), fill(template, &name, option.unwrap_or_default())))
                });
                let options = what.options.iter().filter_map(|option| {
                    let text = own?.options.get(option)?.text.value.clone();
                    let general = file.grammar.get(option).map(texts).unwrap_or_default();
                    let special = own.and_then(|p| p.grammar.get(option)).map(texts).unwrap_or_default();
                    let spoken: Vec<String> = general.into_iter().chain(special).collect();
                    let phrases = compiled(&spoken);
                    Some(OptionWords { option: option.clone(), text, spoken, phrases })
                });
                let words = PartWords { sentences: sentences.collect(), options: options.collect(), name };
                (part.clone(), words)
            })
            .collect();
        let requests = file
            .requests
            .iter()
            .map(|(request, phrases)| {
                let spoken = texts(phrases);
                let phrases = compiled(&spoken);
                (request.clone(), spoken, phrases)
            })
            .collect();
        Self {
            tag: file.tag.clone(),
            language: file.language.as_ref().map_or_else(String::new, |t| t.value.clone()),
            labels: file.labels.clone(),
            parts,
            requests,
        }
    }
}

fn fill(template: &str, name: &str, option: &str) -> String {
    template.replace("{option}", option).replace("{name}", name)
}

/// The placeholders of a template that [`fill`] does not know, with their byte ranges.
pub(super) fn unknown_placeholders(template: &str) -> Vec<(std::ops::Range<usize>, &str)> {
    let mut unknown = Vec::new();
    let mut from = 0;
    while let Some(open) = template[from..].find('{').map(|i| from + i) {
        let close = template[open..].find('}').map_or(template.len(), |i| open + i + 1);
        let placeholder = &template[open..close];
        if placeholder != "{name}" && placeholder != "{option}" {
            unknown.push((open..close, placeholder));
        }
        from = close;
    }
    unknown
}
