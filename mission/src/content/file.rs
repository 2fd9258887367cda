//! `content/LANG.toml` as written: keys, sentences, places.

use indexmap::IndexMap;
use pddl::Span;
use pddl::model::Name;

use super::labels::{self, ReportLabels};
use diagnostics::toml::{Reader, Table, Text};
use diagnostics::{Place, SourceId};

/// A key with its sentence.
#[derive(Clone, Debug)]
pub(crate) struct Sentence {
    pub(crate) text: Text,
    pub(crate) key_span: Span,
}

/// A key with its phrases.
#[derive(Clone, Debug)]
pub(crate) struct Phrases {
    pub(crate) phrases: Vec<Text>,
    pub(crate) key_span: Span,
}

/// `[part.X]`.
#[derive(Clone, Debug)]
pub(crate) struct PartFile {
    pub(crate) name: Option<Text>,
    pub(crate) sentences: IndexMap<Name, Sentence>,
    pub(crate) options: IndexMap<Name, Sentence>,
    pub(crate) grammar: IndexMap<Name, Phrases>,
    pub(crate) key_span: Span,
}

/// One language.
#[derive(Clone, Debug)]
pub(crate) struct LanguageFile {
    /// The file's name without extension: `en`.
    pub(crate) tag: String,
    pub(crate) source: SourceId,
    /// The name of the language, in the language.
    pub(crate) language: Option<Text>,
    pub(crate) say: IndexMap<Name, Sentence>,
    pub(crate) requests: IndexMap<Name, Phrases>,
    pub(crate) grammar: IndexMap<Name, Phrases>,
    pub(crate) labels: ReportLabels,
    pub(crate) parts: IndexMap<Name, PartFile>,
}

impl LanguageFile {
    /// A place in this file.
    pub(super) fn place(&self, span: Span) -> Place {
        Place { source: self.source, span }
    }

    /// The sentence of a part for an utterance: the part's own, or the general one.
    pub(super) fn template(&self, part: &str, utterance: &str) -> Option<&str> {
        let own = self.parts.get(part).and_then(|p| p.sentences.get(utterance));
        own.or_else(|| self.say.get(utterance)).map(|s| s.text.value.as_str())
    }
}

/// Reads a language.
pub(crate) fn read(reader: &mut Reader<'_>, mut root: Table<'_>, tag: &str) -> LanguageFile {
    let language = root.required_text(reader, "language");
    let say = sentences_at(reader, &mut root, "say");
    let requests = phrases_at(reader, &mut root, "request");
    let grammar = phrases_at(reader, &mut root, "grammar");
    let labels = labels::read(reader, &mut root);
    let mut parts = IndexMap::new();
    if let Some(mut table) = root.table(reader, "part") {
        for (key, key_span) in table.rest() {
            if let Some(part) = table.table(reader, &key) {
                parts.insert(Name::new(&key), read_part(reader, part, key_span));
            }
        }
    }
    root.finish(reader);
    LanguageFile {
        tag: tag.to_owned(),
        source: reader.source,
        language,
        say,
        requests,
        grammar,
        labels,
        parts,
    }
}

fn read_part(reader: &mut Reader<'_>, mut table: Table<'_>, key_span: Span) -> PartFile {
    let name = table.text(reader, "name");
    let options = sentences_at(reader, &mut table, "option");
    let grammar = phrases_at(reader, &mut table, "grammar");
    let sentences = sentences(reader, table);
    PartFile { name, sentences, options, grammar, key_span }
}

fn sentences_at(reader: &mut Reader<'_>, table: &mut Table<'_>, key: &str) -> IndexMap<Name, Sentence> {
    let inner = table.table(reader, key);
    inner.map(|t| sentences(reader, t)).unwrap_or_default()
}

/// Every remaining key of the table, as a sentence.
fn sentences(reader: &mut Reader<'_>, mut table: Table<'_>) -> IndexMap<Name, Sentence> {
    let mut sentences = IndexMap::new();
    for (key, key_span) in table.rest() {
        if let Some(text) = table.text(reader, &key) {
            if text.value.trim().is_empty() {
                reader.error("E0805", text.span, format!("the sentence of `{key}` is empty"));
            }
            sentences.insert(Name::new(&key), Sentence { text, key_span });
        }
    }
    sentences
}

fn phrases_at(reader: &mut Reader<'_>, table: &mut Table<'_>, key: &str) -> IndexMap<Name, Phrases> {
    let mut all = IndexMap::new();
    let Some(mut table) = table.table(reader, key) else { return all };
    for (key, key_span) in table.rest() {
        if let Some(phrases) = table.texts(reader, &key) {
            if phrases.is_empty() {
                reader.error("E0805", key_span, format!("`{key}` has no phrase"));
            }
            all.insert(Name::new(&key), Phrases { phrases, key_span });
        }
    }
    all
}
