//! The nodes of the graph in classes: nodes of the same types that no text names are interchangeable.
//!
//! Problem: a graph of a thousand items has a thousand bindings of each rule, and they differ in nothing. Idea: a node that
//! a rule, a method, perception or a permission names is a class of its own; all others of the same types are one class.

use std::collections::{BTreeMap, BTreeSet};

use pddl::model::{Domain, Name, Object, ObjectId, TypeId, TypeSet};

use super::mentions;
use crate::layers::Layers;

/// The number of a class.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(in crate::check) struct ClassId(u32);

/// All classes.
#[derive(Debug)]
pub(in crate::check) struct Classes {
    /// By class: its nodes, in the order of declaration.
    nodes: Vec<Vec<Name>>,
    /// By class: the node that stands for all of it.
    first: Vec<ObjectId>,
    of: BTreeMap<Name, ClassId>,
}

impl Classes {
    pub(super) fn new(layers: &Layers) -> Self {
        let named = named(layers);
        let mut classes = Self { nodes: Vec::new(), first: Vec::new(), of: BTreeMap::new() };
        let mut anonymous: BTreeMap<Vec<TypeId>, ClassId> = BTreeMap::new();
        for (id, node) in layers.nodes.constants.enumerate() {
            let mut key = node.types.declared().to_vec();
            key.sort_unstable();
            let known = anonymous.get(&key).filter(|_| !named.contains(&node.name));
            let class = known.copied().unwrap_or_else(|| {
                classes.nodes.push(Vec::new());
                classes.first.push(id);
                ClassId(u32::try_from(classes.nodes.len() - 1).expect("a graph has fewer nodes"))
            });
            if !named.contains(&node.name) {
                anonymous.insert(key, class);
            }
            classes.nodes[class.0 as usize].push(node.name.clone());
            classes.of.insert(node.name.clone(), class);
        }
        classes
    }

    /// The class of a node; `None` if the graph has no node of that name.
    pub(in crate::check) fn of(&self, node: &Name) -> Option<ClassId> {
        self.of.get(node).copied()
    }

    /// Its nodes.
    pub(in crate::check) fn nodes(&self, class: ClassId) -> &[Name] {
        &self.nodes[class.0 as usize]
    }

    /// The name of its first node.
    pub(in crate::check) fn name(&self, class: ClassId) -> &Name {
        &self.nodes[class.0 as usize][0]
    }

    /// Whether it stands for one node only.
    pub(super) fn is_single(&self, class: ClassId) -> bool {
        self.nodes(class).len() == 1
    }

    /// The names of its types.
    pub(in crate::check) fn type_names<'l>(&self, class: ClassId, layers: &'l Layers) -> Vec<&'l str> {
        let types = self.first(class, layers).types.declared();
        types.iter().map(|&t| layers.nodes.types[t].name.as_str()).collect()
    }

    /// Whether all its nodes are of these types of `domain`.
    pub(in crate::check) fn is_a(
        &self,
        class: ClassId,
        layers: &Layers,
        domain: &Domain,
        types: &TypeSet,
    ) -> bool {
        let table = &layers.nodes.types;
        let ids = types.0.iter().filter_map(|&t| table.find(&domain.types[t].name));
        let union = TypeSet(ids.collect());
        !union.is_unknown() && self.first(class, layers).is_of(&union, table)
    }

    fn first<'l>(&self, class: ClassId, layers: &'l Layers) -> &'l Object {
        &layers.nodes.constants[self.first[class.0 as usize]]
    }

    /// The classes of these types of `domain`.
    pub(super) fn of_types(&self, layers: &Layers, domain: &Domain, types: &TypeSet) -> Vec<ClassId> {
        let all = (0..self.nodes.len()).map(|i| ClassId(u32::try_from(i).expect("counted above")));
        all.filter(|&class| self.is_a(class, layers, domain, types)).collect()
    }
}

/// The nodes that some text names.
fn named(layers: &Layers) -> BTreeSet<Name> {
    let mut named = BTreeSet::new();
    let mut add = |domain: &Domain, id: ObjectId| {
        named.insert(domain.constants[id].name.clone());
    };
    let agents = layers.agents.iter().map(|agent| &agent.model);
    let safety = layers.safety.iter().map(|layer| &layer.model);
    for domain in
        agents.chain(safety).chain([&layers.methods.model, &layers.perception.model, &layers.domain.model])
    {
        mentions::objects(domain, &mut |id| add(domain, id));
    }
    let vocabulary = &layers.vocabulary.model;
    for pattern in vocabulary.permissions.iter().flat_map(|p| &p.tokens) {
        pattern.arguments.iter().flatten().for_each(|&id| add(vocabulary, id));
    }
    named
}
