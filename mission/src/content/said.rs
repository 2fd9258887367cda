//! What can be said where.
//!
//! Idea: a method that tells a constant utterance in a part (`(tell ?t ?j introduction)` with `?j - item`) says it in
//! every part that has the type of the variable. The result may contain more pairs than a run will say, and never fewer.

use indexmap::IndexMap;
use pddl::Span;
use pddl::model::{Name, ObjectId, Term};

use crate::layers::Layers;
use diagnostics::Place;

/// What can be said in one part.
#[derive(Clone, Debug)]
pub(crate) struct PartSaid {
    /// The place of the part's declaration.
    pub(crate) place: Place,
    /// Whether it is an item, which has answers.
    pub(crate) item: bool,
    /// What could be said here: every utterance except the options that the part does not offer.
    pub(crate) utterances: Vec<Name>,
    /// Its options, in the order of declaration.
    pub(crate) options: Vec<Name>,
}

/// What can be said in a mission.
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
    /// The (part, utterance) pairs that a method says, each with the place of its first subtask.
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

    /// The constant utterances of all subtasks, each with the parts that may be its fellow arguments.
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
                                methods.constants[id].is_of(&method.variables[*v].types, &methods.types)
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
