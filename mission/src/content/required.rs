//! What can be said where, and what of it a language lacks.
//!
//! Idea: a method that tells a constant utterance in a part (`(tell ?t ?j introduction)` with
//! `?j - item`) requires a sentence for every part that fits the variable. An offered option requires
//! its text, its sentence and the ways to answer it. What no method names (an utterance that only an
//! intention's variable could reach) must be in `[say]`, or in every item. This errs on the side of
//! asking for more than will be said.

use std::collections::BTreeSet;

use indexmap::IndexMap;
use pddl::Span;
use pddl::model::{Name, ObjectId, Term};

use super::file::LanguageFile;
use super::words::template;
use crate::layers::Layers;
use diagnostics::{Finding, Place, Sources};

/// What is said in one part.
#[derive(Clone, Debug)]
pub(crate) struct PartSaid {
    /// Where the part is declared.
    pub(crate) place: Place,
    /// Whether it is an item, which has answers.
    pub(crate) item: bool,
    /// What could be said here: every utterance but the options that it does not offer.
    pub(crate) utterances: Vec<Name>,
    /// What it offers, by declaration.
    pub(crate) options: Vec<Name>,
}

/// What is said in a mission.
#[derive(Clone, Debug)]
pub(crate) struct Said {
    /// By part, in the order of declaration.
    pub(crate) parts: IndexMap<Name, PartSaid>,
    /// Every utterance, with its declaration.
    pub(crate) utterances: IndexMap<Name, Place>,
    /// Every request, with its declaration.
    pub(crate) requests: IndexMap<Name, Place>,
    /// Every option that some item offers, with the place of its first offer.
    pub(crate) options: IndexMap<Name, Place>,
    /// (part, utterance) pairs that a method says, with the place of the first subtask that does.
    pub(crate) pairs: IndexMap<(Name, Name), Place>,
}

impl Said {
    pub(crate) fn new(layers: &Layers) -> Self {
        let nodes = &layers.graph.model;
        let name = |id: ObjectId| nodes.objects[id].name.clone();
        let of_type = |ty| -> Vec<ObjectId> {
            let fits = |id: &ObjectId| layers.is_a(*id, ty);
            nodes.objects.ids().filter(fits).collect()
        };
        let tokens = &layers.tokens;
        let declared = |ids: Vec<ObjectId>| -> IndexMap<Name, Place> {
            ids.into_iter().map(|id| (name(id), layers.node_place(id))).collect()
        };

        let mut offers: Vec<(ObjectId, ObjectId, Span)> = Vec::new();
        for fact in nodes.init.iter().filter(|f| f.predicate == tokens.offers) {
            if let [item, option] = fact.arguments[..] {
                offers.push((item, option, fact.span));
            }
        }
        offers.sort_by_key(|&(item, option, _)| (item, option));
        let mut options = IndexMap::new();
        for &(_, option, span) in &offers {
            options.entry(name(option)).or_insert(Place { source: layers.graph.source, span });
        }

        let utterances = declared(of_type(tokens.utterances));
        let parts = of_type(tokens.parts).into_iter().map(|part| {
            let offered: Vec<Name> =
                offers.iter().filter(|(item, ..)| *item == part).map(|o| name(o.1)).collect();
            let sayable = |u: &&Name| !options.contains_key(*u) || offered.contains(u);
            let said = PartSaid {
                place: layers.node_place(part),
                item: layers.is_a(part, tokens.items),
                utterances: utterances.keys().filter(sayable).cloned().collect(),
                options: offered,
            };
            (name(part), said)
        });
        let mut said = Self {
            parts: parts.collect(),
            utterances: utterances.clone(),
            requests: declared(of_type(tokens.requests)),
            options,
            pairs: IndexMap::new(),
        };
        said.pairs = said.pairs_of_methods(layers);
        said
    }

    /// Constant utterances of all subtasks, with the parts that may stand beside them.
    fn pairs_of_methods(&self, layers: &Layers) -> IndexMap<(Name, Name), Place> {
        let methods = &layers.methods.model;
        let mut pairs = IndexMap::new();
        for method in &methods.methods {
            for subtask in &method.network.subtasks {
                let place = Place { source: layers.methods.source, span: subtask.span };
                let constant = |t: &Term| match t {
                    Term::Object(id) => Some(&methods.constants[*id].name),
                    Term::Variable(_) => None,
                };
                let utterances: Vec<&Name> = subtask
                    .arguments
                    .iter()
                    .filter_map(constant)
                    .filter(|n| self.utterances.contains_key(*n) && !self.options.contains_key(*n))
                    .collect();
                for utterance in utterances {
                    for part in self.parts.keys() {
                        let beside = subtask.arguments.iter().any(|t| match t {
                            Term::Object(id) => methods.constants[*id].name == *part,
                            Term::Variable(v) => methods.constant(part).is_some_and(|id| {
                                let types = &methods.constants[id].types;
                                methods.types.is_subset(types, &method.variables[*v].types)
                            }),
                        });
                        if beside {
                            pairs.entry((part.clone(), utterance.clone())).or_insert(place);
                        }
                    }
                }
            }
        }
        pairs
    }
}

/// Reports everything that `file` lacks; answers the dotted keys that would mend it.
pub(crate) fn check(file: &LanguageFile, said: &Said, findings: &mut Vec<Finding>) -> BTreeSet<String> {
    let mut lacks = BTreeSet::new();
    for (part, what) in &said.parts {
        let own = file.parts.get(part);
        let at = own.map_or(Sources::start_of(file.source), |p| place(file, p.key_span));
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
        if template(file, own, utterance).is_none() {
            lacks.extend([format!("part.{part}.{utterance}"), format!("say.{utterance}")]);
            let at = own.map_or(Sources::start_of(file.source), |p| place(file, p.key_span));
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

/// Options and requests that cannot be spoken.
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
                    format!("nothing says how `{option}` may be answered"),
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
                    format!("nothing says how to ask for `{request}`"),
                )
                .related(*declared, "it is declared here")
                .help(format!("add `{request} = [\"…\"]` to [request]")),
            );
        }
    }
}

pub(super) fn place(file: &LanguageFile, span: Span) -> Place {
    Place { source: file.source, span }
}
