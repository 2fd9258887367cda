//! The words of one language of a mission, with all templates filled in.
//!
//! The sentence of an utterance in a part is the part's own, or else the general one. Both are templates: `{name}` is the
//! part's name, `{option}` the text of the part's option that has the name of the utterance. Templates are filled in when
//! the mission is loaded, so that a look-up is two steps in a map.

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
    /// Its text, without its number.
    pub text: String,
    /// The phrases that choose it; the first is the plainest.
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

    /// The name of the language, in the language.
    pub fn language(&self) -> &str {
        &self.language
    }

    /// Headings and marks of the report.
    pub fn labels(&self) -> &ReportLabels {
        &self.labels
    }

    /// The name of a part.
    pub fn name(&self, part: &str) -> Option<&str> {
        self.parts.get(part).map(|p| p.name.as_str())
    }

    /// The sentence to say or show for an utterance in a part. `None` only for a pair that no method says.
    pub fn sentence(&self, part: &str, utterance: &str) -> Option<&str> {
        self.parts.get(part)?.sentences.get(utterance).map(String::as_str)
    }

    /// The options of an item, in the order in which `graph.pddl` declares them; empty for other parts.
    pub fn options(&self, part: &str) -> &[OptionWords] {
        self.parts.get(part).map_or(&[], |p| &p.options)
    }

    /// The option of the part that the patient's words choose. All the words together must be one of the option's phrases:
    /// "the blue one" is not "one".
    pub fn understand(&self, part: &str, heard: &str) -> Option<&Name> {
        let heard = normalise(heard);
        let options = self.options(part).iter();
        options.filter(|o| o.phrases.iter().any(|p| p.is(&heard))).map(|o| &o.option).next()
    }

    /// The first request with a phrase among the heard words.
    pub fn spot(&self, heard: &str) -> Option<&Name> {
        let heard = normalise(heard);
        self.requests.iter().find(|(_, _, phrases)| phrases.iter().any(|p| p.is_within(&heard))).map(|r| &r.0)
    }

    /// The phrases of a request; the first is the plainest.
    pub fn request(&self, request: &str) -> &[String] {
        self.requests.iter().find(|r| &*r.0 == request).map_or(&[], |r| &r.1)
    }

    /// Fills in all templates. Entries that the checks have reported are left out.
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
