//! Unknown keys of a language, unknown placeholders, ambiguous phrases, and keys that one language has and another lacks.

use std::collections::{BTreeMap, BTreeSet};

use pddl::Span;
use pddl::model::Name;

use super::file::LanguageFile;
use super::grammar::normalise;
use super::said::Said;
use super::words::unknown_placeholders;
use diagnostics::did_you_mean;
use diagnostics::{Finding, Place, Sources};

/// Reports every key that is not the name of a node of the right kind.
pub(crate) fn check(file: &LanguageFile, said: &Said, findings: &mut Vec<Finding>) {
    let known_parts = || said.parts.keys().map(Name::as_str);
    for (part, words) in &file.parts {
        let Some(what) = said.parts.get(part) else {
            let help = did_you_mean(part, known_parts());
            let at = file.place(words.key_span);
            findings.push(Finding::error("E0806", at, format!("there is no part `{part}`")).help_if(help));
            continue;
        };
        for (utterance, sentence) in &words.sentences {
            utterance_exists(file, utterance, sentence.key_span, said, findings);
        }
        for (option, span) in words
            .options
            .iter()
            .map(|(o, s)| (o, s.key_span))
            .chain(words.grammar.iter().map(|(o, p)| (o, p.key_span)))
        {
            if !what.options.contains(option) {
                let help = did_you_mean(option, what.options.iter().map(Name::as_str));
                let at = file.place(span);
                let message = format!("`{part}` does not offer `{option}`");
                findings.push(
                    Finding::error("E0808", at, message).related(what.place, "declared here").help_if(help),
                );
            }
        }
        ambiguous(file, part, &what.options, findings);
    }
    for (utterance, sentence) in &file.say {
        utterance_exists(file, utterance, sentence.key_span, said, findings);
    }
    for (option, phrases) in &file.grammar {
        if !said.options.contains_key(option) {
            let help = did_you_mean(option, said.options.keys().map(Name::as_str));
            let at = file.place(phrases.key_span);
            findings.push(Finding::error("E0808", at, format!("no item offers `{option}`")).help_if(help));
        }
    }
    for (request, phrases) in &file.requests {
        if !said.requests.contains_key(request) {
            let help = did_you_mean(request, said.requests.keys().map(Name::as_str));
            let at = file.place(phrases.key_span);
            findings
                .push(Finding::error("E0809", at, format!("there is no request `{request}`")).help_if(help));
        }
    }
    placeholders(file, findings);
}

fn utterance_exists(
    file: &LanguageFile,
    utterance: &Name,
    span: Span,
    said: &Said,
    findings: &mut Vec<Finding>,
) {
    if !said.utterances.contains_key(utterance) {
        let help = did_you_mean(utterance, said.utterances.keys().map(Name::as_str));
        let message = format!("there is no utterance `{utterance}`");
        findings.push(Finding::error("E0807", file.place(span), message).help_if(help));
    }
}

fn placeholders(file: &LanguageFile, findings: &mut Vec<Finding>) {
    let own = file.parts.values().flat_map(|p| p.sentences.values());
    for sentence in file.say.values().chain(own) {
        for (range, placeholder) in unknown_placeholders(&sentence.text.value) {
            let at = |i: usize| u32::try_from(i).unwrap_or(u32::MAX);
            let span = sentence.text.within(Span::new(at(range.start), at(range.end)));
            findings.push(
                Finding::error("E0810", file.place(span), format!("unknown placeholder `{placeholder}`"))
                    .help("a sentence may use {name} and {option}"),
            );
        }
    }
}

/// Reports phrases that choose two options of one part.
fn ambiguous(file: &LanguageFile, part: &Name, options: &[Name], findings: &mut Vec<Finding>) {
    let mut meaning: BTreeMap<Vec<String>, (&Name, Span)> = BTreeMap::new();
    for option in options {
        let own = file.parts.get(part).and_then(|p| p.grammar.get(option));
        let all = file.grammar.get(option).into_iter().chain(own);
        for phrase in all.flat_map(|p| &p.phrases) {
            let (other, first) = *meaning.entry(normalise(&phrase.value)).or_insert((option, phrase.span));
            if other != option {
                let message =
                    format!("in `{part}`, \"{}\" chooses both `{other}` and `{option}`", phrase.value);
                findings.push(
                    Finding::error("E0811", file.place(phrase.span), message)
                        .related(file.place(first), format!("it chooses `{other}` here")),
                );
            }
        }
    }
}

/// Reports sentences that some languages have and others lack. `lacking` has, for each file, the keys that were reported
/// already. Names, requests and the general grammar are required of every language anyway; the grammar of a single part
/// is idiom.
pub(crate) fn compare(
    files: &[LanguageFile],
    said: &Said,
    lacking: &[BTreeSet<String>],
    findings: &mut Vec<Finding>,
) {
    let keys: Vec<BTreeMap<String, Place>> = files.iter().map(|f| keys_of(f, said)).collect();
    let mut anywhere: BTreeMap<&String, Place> = BTreeMap::new();
    for (key, at) in keys.iter().flatten() {
        anywhere.entry(key).or_insert(*at);
    }
    for ((file, own), reported) in files.iter().zip(&keys).zip(lacking) {
        for (&key, at) in anywhere.iter().filter(|(k, _)| !own.contains_key(**k) && !reported.contains(**k)) {
            let message = format!("`{}` lacks `{key}`, which another language has", file.tag);
            let at_start = Sources::start_of(file.source);
            findings.push(Finding::error("E0812", at_start, message).related(*at, "it is here"));
        }
    }
}

/// Every valid key of a file, dotted, with its place.
fn keys_of(file: &LanguageFile, said: &Said) -> BTreeMap<String, Place> {
    let mut keys = BTreeMap::new();
    let mut add = |key: String, span: Span| {
        keys.insert(key, file.place(span));
    };
    let utterance = |k: &Name| said.utterances.contains_key(k);
    for (key, sentence) in file.say.iter().filter(|(k, _)| utterance(k)) {
        add(format!("say.{key}"), sentence.key_span);
    }
    for (part, words) in &file.parts {
        let Some(what) = said.parts.get(part) else { continue };
        for (key, sentence) in words.sentences.iter().filter(|(k, _)| utterance(k)) {
            add(format!("part.{part}.{key}"), sentence.key_span);
        }
        for (key, sentence) in words.options.iter().filter(|(k, _)| what.options.contains(k)) {
            add(format!("part.{part}.option.{key}"), sentence.key_span);
        }
    }
    keys
}
