//! The sentences and phrases that a language lacks.
//!
//! A sentence is required for every (part, utterance) that a method says. An offered option requires
//! its text, its sentence and the ways to answer it. An utterance that no method names (only the
//! variable of an intention could reach it) must be in `[say]`, or in every item.

use std::collections::BTreeSet;

use pddl::model::Name;

use super::file::LanguageFile;
use super::said::{PartSaid, Said};
use diagnostics::{Finding, Sources};

/// Reports everything that `file` lacks. Returns the dotted keys that would repair it.
pub(crate) fn check(file: &LanguageFile, said: &Said, findings: &mut Vec<Finding>) -> BTreeSet<String> {
    let mut lacks = BTreeSet::new();
    for (part, what) in &said.parts {
        let own = file.parts.get(part);
        let at = own.map_or(Sources::start_of(file.source), |p| file.place(p.key_span));
        let lacking = |code, message: String| {
            Finding::error(code, at, message).related(what.place, format!("`{part}` is declared here"))
        };
        if own.is_none_or(|p| p.name.is_none()) {
            lacks.insert(format!("part.{part}.name"));
            let message = format!("the part `{part}` has no name");
            findings.push(lacking("E0803", message).help(format!("add `name = \"…\"` to [part.{part}]")));
        }
        for option in &what.options {
            if own.is_none_or(|p| !p.options.contains_key(option)) {
                lacks.insert(format!("part.{part}.option.{option}"));
                let message = format!("`{part}` has no text for its `{option}`");
                let help = format!("add `{option} = \"…\"` to [part.{part}.option]");
                findings.push(lacking("E0802", message).help(help));
            }
        }
    }
    for ((part, utterance), said_at) in &said.pairs {
        let own = file.parts.get(part);
        if file.template(part, utterance).is_none() {
            lacks.extend([format!("part.{part}.{utterance}"), format!("say.{utterance}")]);
            let at = own.map_or(Sources::start_of(file.source), |p| file.place(p.key_span));
            let declared = said.utterances[utterance];
            findings.push(
                Finding::error("E0801", at, format!("`{part}` has no sentence for `{utterance}`"))
                    .related(*said_at, "a method says it here")
                    .related(declared, format!("`{utterance}` is declared here"))
                    .help(format!("add `{utterance} = \"…\"` to [part.{part}], or to [say] for every part")),
            );
        }
    }
    for (utterance, declared) in &said.utterances {
        let named = said.pairs.keys().any(|(_, u)| u == utterance);
        let everywhere =
            || said.parts.iter().filter(|(_, what)| what.item && what.utterances.contains(utterance));
        let own = |part: &Name| file.parts.get(part).is_some_and(|f| f.sentences.contains_key(utterance));
        if !named && !file.say.contains_key(utterance) && !everywhere().all(|(part, _)| own(part)) {
            lacks.insert(format!("say.{utterance}"));
            findings.push(
                Finding::error(
                    "E0801",
                    Sources::start_of(file.source),
                    format!("there is no sentence for `{utterance}`"),
                )
                .related(*declared, format!("`{utterance}` is declared here"))
                .help(format!("add `{utterance} = \"…\"` to [say]")),
            );
        }
    }
    check_phrases(file, said, findings, &mut lacks);
    lacks
}

/// Options and requests without a phrase.
fn check_phrases(
    file: &LanguageFile,
    said: &Said,
    findings: &mut Vec<Finding>,
    lacks: &mut BTreeSet<String>,
) {
    for (option, offered) in &said.options {
        let mute = |(part, what): (&Name, &PartSaid)| {
            let own = file.parts.get(part).is_some_and(|p| p.grammar.contains_key(option));
            what.options.contains(option) && !own
        };
        if !file.grammar.contains_key(option) && said.parts.iter().any(mute) {
            lacks.insert(format!("grammar.{option}"));
            findings.push(
                Finding::error(
                    "E0804",
                    Sources::start_of(file.source),
                    format!("no phrase chooses `{option}`"),
                )
                .related(*offered, "it is offered here")
                .help(format!("add `{option} = [\"…\"]` to [grammar]")),
            );
        }
    }
    for (request, declared) in &said.requests {
        if !file.requests.contains_key(request) {
            lacks.insert(format!("request.{request}"));
            findings.push(
                Finding::error(
                    "E0804",
                    Sources::start_of(file.source),
                    format!("no phrase asks for `{request}`"),
                )
                .related(*declared, "it is declared here")
                .help(format!("add `{request} = [\"…\"]` to [request]")),
            );
        }
    }
}
