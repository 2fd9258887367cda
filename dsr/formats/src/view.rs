//! The part of a snapshot that is written: all of it, or the surroundings of one node.

use std::collections::BTreeSet;

use dsr::{EdgeKey, Export, Holder, NodeId, NodeView, Snapshot, Value};

/// A set of nodes of a snapshot, with the edges and transforms between them.
#[derive(Debug, Clone)]
pub struct View<'s> {
    pub(crate) snapshot: &'s Snapshot,
    nodes: BTreeSet<NodeId>,
}

impl<'s> View<'s> {
    /// The whole snapshot.
    pub fn whole(snapshot: &'s Snapshot) -> Self {
        Self { snapshot, nodes: snapshot.nodes().map(|node| node.id).collect() }
    }

    /// A node and its neighbours, up to `steps` edges or transforms away in either direction.
    pub fn around(snapshot: &'s Snapshot, node: NodeId, steps: usize) -> Self {
        let mut nodes = BTreeSet::from([node]);
        let mut border = vec![node];
        for _ in 0..steps {
            if border.is_empty() {
                break;
            }
            let near = |id: &NodeId| snapshot.get(*id).map(neighbours).unwrap_or_default();
            border = border.iter().flat_map(near).filter(|id| nodes.insert(*id)).collect();
        }
        Self { snapshot, nodes }
    }

    /// The nodes, by id.
    pub fn nodes(&self) -> impl Iterator<Item = NodeView<'s>> + '_ {
        self.nodes.iter().filter_map(|id| self.snapshot.get(*id))
    }

    /// The edges between them, by start, label and end.
    pub fn edges(&self) -> impl Iterator<Item = EdgeKey> + '_ {
        let edges = self.nodes().flat_map(|node| node.edges());
        edges.map(|edge| edge.key).filter(|key| self.nodes.contains(&key.to))
    }

    /// The transforms between them: parent and child.
    pub(crate) fn transforms(&self) -> impl Iterator<Item = (NodeId, NodeId)> + '_ {
        let hung = self.nodes().filter_map(|node| Some((node.parent()?.0, node.id)));
        hung.filter(|(parent, _)| self.nodes.contains(parent))
    }

    fn name(&self, id: NodeId) -> &'s str {
        self.snapshot.name(id).unwrap_or("")
    }

    pub(crate) fn type_of(&self, node: NodeView<'_>) -> &'s str {
        self.snapshot.vocabulary().type_name(node.node_type()).map_or("", |name| name)
    }

    pub(crate) fn label(&self, key: EdgeKey) -> &'s str {
        self.snapshot.vocabulary().label_name(key.label).map_or("", |name| name)
    }

    /// The attributes of a node or an edge: name and value as text.
    pub(crate) fn attributes(&self, holder: Holder) -> Vec<(&'s str, String)> {
        let views: Vec<_> = match holder {
            Holder::Node(id) => self.snapshot.get(id).map_or(Vec::new(), |node| node.attributes().collect()),
            Holder::Edge(EdgeKey { from, label, to }) => {
                let edge = self.snapshot.edge(from, label, to);
                edge.map_or(Vec::new(), |edge| edge.attributes().collect())
            }
        };
        let shown = views.into_iter().map(|view| {
            let name = self.snapshot.vocabulary().attribute_name(view.attribute).map_or("", |name| name);
            let value = match view.value {
                Value::Number(number) => number.to_string(),
                Value::Text(text) => text.to_string(),
                Value::Bool(truth) => truth.to_string(),
                Value::Node(node) => self.name(*node).to_owned(),
            };
            (name, value)
        });
        shown.collect()
    }

    /// The part as plain data, in the form of [`Snapshot::export`].
    pub fn export(&self) -> Export {
        let mut export = self.snapshot.export();
        let inside = |name: &str| self.snapshot.node(name).is_some_and(|id| self.nodes.contains(&id));
        export.nodes.retain(|node| self.nodes.contains(&node.id));
        export.edges.retain(|edge| inside(&edge.from) && inside(&edge.to));
        export.transforms.retain(|transform| inside(&transform.parent) && inside(&transform.child));
        export
    }

    pub(crate) fn contains(&self, node: NodeId) -> bool {
        self.nodes.contains(&node)
    }
}

fn neighbours(node: NodeView<'_>) -> Vec<NodeId> {
    let ends = node.edges().map(|edge| edge.key.to);
    let starts = node.incoming().map(|key| key.from);
    let parent = node.parent().map(|(parent, ..)| parent);
    ends.chain(starts).chain(parent).chain(node.children().iter().copied()).collect()
}
