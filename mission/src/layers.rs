//! The PDDL layers of a mission, each with its source, and the tokens that `mission.toml` names.
//!
//! Three files declare the nodes of the initial graph: the vocabulary (its constants), the world and the graph (their
//! objects). Perception, methods and scenarios may name any of them. [`Layers::nodes`] is therefore one more domain: the
//! vocabulary with all nodes as constants, under the ids that they have in `graph.pddl`.

use pddl::model::{Domain, FunctionId, Idx, ObjectId, PredicateId, Problem, TypeId, TypeSet};

use diagnostics::{Place, SourceId};

/// A model and the source it came from.
#[derive(Clone, Debug)]
pub struct Layer<M> {
    /// The source of its spans.
    pub source: SourceId,
    /// The model.
    pub model: M,
}

/// The tokens of `mission.toml`, as ids of the vocabulary.
#[derive(Clone, Copy, Debug)]
pub struct NamedTokens {
    /// The node of the report.
    pub document: ObjectId,
    /// Type of the items.
    pub items: TypeId,
    /// From item to option.
    pub offers: PredicateId,
    /// From option to item.
    pub answer: PredicateId,
    /// From question to item.
    pub unanswered: PredicateId,
    /// Of item and option.
    pub score: FunctionId,
    /// Type of the utterances.
    pub utterances: TypeId,
    /// Type of the parts of a test, in which utterances are said.
    pub parts: TypeId,
    /// Type of a person's requests.
    pub requests: TypeId,
}

/// Everything that is PDDL in a mission.
#[derive(Clone, Debug)]
pub struct Layers {
    /// The robot's vocabulary.
    pub vocabulary: Layer<Domain>,
    /// The world before a person is seen.
    pub world: Layer<Problem>,
    /// The agents' rules, by file name.
    pub agents: Vec<Layer<Domain>>,
    /// The test as nodes and edges; its objects are all nodes of the initial graph.
    pub graph: Layer<Problem>,
    /// The vocabulary with all nodes of the initial graph as constants.
    pub nodes: Domain,
    /// The planning domain.
    pub domain: Layer<Domain>,
    /// The planning domain, in which each durative action is an action too: its conditions at start, and all its
    /// effects. Enough for what may happen at all, and for names and parameters.
    pub steps: Domain,
    /// The planning problem.
    pub problem: Layer<Problem>,
    /// LowToHigh; imports [`Layers::nodes`] and the planning domain.
    pub perception: Layer<Domain>,
    /// HighToLow; imports [`Layers::nodes`].
    pub methods: Layer<Domain>,
    /// Domains of invariants: the robot's, then the test's; each imports [`Layers::nodes`] or a part of it.
    pub safety: Vec<Layer<Domain>>,
    /// The tokens of `mission.toml`.
    pub tokens: NamedTokens,
}

impl Layers {
    /// The place of the declaration of a node of the initial graph.
    pub fn node_place(&self, node: ObjectId) -> Place {
        let constants = self.vocabulary.model.constants.len();
        let source = if node.index() < constants {
            self.vocabulary.source
        } else if node.index() < self.world.model.objects.len() {
            self.world.source
        } else {
            self.graph.source
        };
        Place { source, span: self.graph.model.objects[node].span }
    }

    /// Whether a node of the initial graph has a type.
    pub fn is_a(&self, node: ObjectId, ty: TypeId) -> bool {
        self.graph.model.objects[node].is_of(&TypeSet::one(ty), &self.nodes.types)
    }

    /// The items, in the order of declaration.
    pub fn items(&self) -> Vec<ObjectId> {
        self.graph.model.objects.ids().filter(|&id| self.is_a(id, self.tokens.items)).collect()
    }

    /// The options that an item offers, in the order of declaration.
    pub fn options(&self, item: ObjectId) -> Vec<ObjectId> {
        let facts = self.graph.model.init.iter().filter(|f| f.predicate == self.tokens.offers);
        let mut options: Vec<ObjectId> = facts
            .filter_map(|f| match f.arguments[..] {
                [from, option] if from == item => Some(option),
                _ => None,
            })
            .collect();
        options.sort_unstable();
        options.dedup();
        options
    }

    /// The name of a node.
    pub fn name(&self, node: ObjectId) -> &str {
        &self.graph.model.objects[node].name
    }
}
