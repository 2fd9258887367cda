//! The graph in the paper's own sentences: "robot is speaking".

use std::fmt::Write as _;
use std::sync::Arc;

use crate::delta::{Change, Delta};
use crate::id::{EdgeKey, Holder, NodeId};
use crate::pose::Pose;
use crate::snapshot::{AttributeView, Snapshot};
use crate::value::Value;
use crate::vocabulary::Vocabulary;

impl Snapshot {
    /// An edge as a sentence, with underscores as spaces; `None` if it does not exist.
    pub fn sentence(&self, edge: EdgeKey) -> Option<String> {
        self.edge(edge.from, edge.label, edge.to)?;
        Some(Teller { snapshot: self, gone: &[] }.edge(edge))
    }

    /// The attributes of a node or an edge as sentences: "barthel: score 3".
    pub fn attribute_sentences(&self, holder: Holder) -> Vec<String> {
        let teller = Teller { snapshot: self, gone: &[] };
        let say = |view: AttributeView<'_>| {
            format!("{} {}", teller.attribute(holder, view.attribute), teller.value(view.value))
        };
        match holder {
            Holder::Node(id) => self.get(id).map_or(Vec::new(), |node| node.attributes().map(say).collect()),
            Holder::Edge(EdgeKey { from, label, to }) => {
                self.edge(from, label, to).map_or(Vec::new(), |edge| edge.attributes().map(say).collect())
            }
        }
    }

    /// The place of a node in its parent, as a sentence; `None` without a parent.
    pub fn place_sentence(&self, child: NodeId) -> Option<String> {
        let (parent, pose, _) = self.get(child)?.parent()?;
        Some(Teller { snapshot: self, gone: &[] }.place(parent, child, pose))
    }

    /// All edges as sentences, in the order of [`Snapshot::edges`].
    pub fn sentences(&self) -> Vec<String> {
        let teller = Teller { snapshot: self, gone: &[] };
        self.edges().map(|edge| teller.edge(edge.key)).collect()
    }
}

impl Delta {
    /// One sentence for each change. `after` is the state after the delta. A removal begins with "no longer": "no
    /// longer: robot is speaking".
    pub fn sentences(&self, after: &Snapshot) -> Vec<String> {
        let gone: Vec<_> = self
            .changes
            .iter()
            .filter_map(|change| match change {
                Change::NodeRemoved { node, name, .. } => Some((*node, name.clone())),
                _ => None,
            })
            .collect();
        let teller = Teller { snapshot: after, gone: &gone };
        self.changes.iter().map(|change| teller.change(change)).collect()
    }
}

struct Teller<'a> {
    snapshot: &'a Snapshot,
    /// Names of nodes that the snapshot no longer has.
    gone: &'a [(NodeId, Arc<str>)],
}

impl Teller<'_> {
    fn vocabulary(&self) -> &Vocabulary {
        self.snapshot.vocabulary()
    }

    fn node(&self, id: NodeId) -> String {
        let gone = || self.gone.iter().find(|(node, _)| *node == id).map(|(_, name)| &**name);
        self.snapshot.name(id).or_else(gone).map_or_else(|| id.to_string(), spaced)
    }

    fn edge(&self, key: EdgeKey) -> String {
        let label =
            self.vocabulary().label_name(key.label).map_or_else(|| key.label.to_string(), |l| spaced(l));
        format!("{} {label} {}", self.node(key.from), self.node(key.to))
    }

    fn holder(&self, holder: Holder) -> String {
        match holder {
            Holder::Node(node) => self.node(node),
            Holder::Edge(key) => self.edge(key),
        }
    }

    fn attribute(&self, holder: Holder, attribute: crate::id::AttributeId) -> String {
        let name = self.vocabulary().attribute_name(attribute);
        format!(
            "{}: {}",
            self.holder(holder),
            name.map_or_else(|| attribute.to_string(), |name| spaced(name))
        )
    }

    fn value(&self, value: &Value) -> String {
        match value {
            Value::Number(number) => number.to_string(),
            Value::Text(text) => format!("“{text}”"),
            Value::Bool(truth) => truth.to_string(),
            Value::Node(node) => self.node(*node),
        }
    }

    fn place(&self, parent: NodeId, child: NodeId, pose: &Pose) -> String {
        let at = pose.transform.translation.vector;
        format!("{} at ({:.3}, {:.3}, {:.3}) in {}", self.node(child), at.x, at.y, at.z, self.node(parent))
    }

    fn change(&self, change: &Change) -> String {
        let mut line = String::new();
        // Writing to a string cannot fail.
        let _ = match change {
            Change::NodeAdded { name, .. } => write!(line, "there is {}", spaced(name)),
            Change::NodeRemoved { name, .. } => write!(line, "no longer: there is {}", spaced(name)),
            Change::EdgeAdded { edge } => write!(line, "{}", self.edge(*edge)),
            Change::EdgeRemoved { edge } => write!(line, "no longer: {}", self.edge(*edge)),
            Change::AttributeAdded { holder, attribute, new }
            | Change::AttributeChanged { holder, attribute, new, .. } => {
                write!(line, "{} {}", self.attribute(*holder, *attribute), self.value(new))
            }
            Change::AttributeRemoved { holder, attribute, old } => {
                write!(line, "no longer: {} {}", self.attribute(*holder, *attribute), self.value(old))
            }
            Change::TransformAdded { parent, child, new, .. }
            | Change::TransformSampled { parent, child, new, .. }
            | Change::TransformChanged { parent, child, new, .. } => {
                write!(line, "{}", self.place(*parent, *child, new))
            }
            Change::TransformRemoved { parent, child, .. } => {
                write!(line, "no longer: {} in {}", self.node(*child), self.node(*parent))
            }
        };
        line
    }
}

fn spaced(name: &str) -> String {
    name.replace('_', " ")
}
