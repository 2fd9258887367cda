//! The graph that the benches write to and read from.
#![allow(dead_code, reason = "each bench uses its own part of the ward")]
#![allow(clippy::unwrap_used, reason = "a bench that fails says where")]

use dsr::{
    AgentId, AttributeId, Graph, HolderRef, Isometry3, Kind, LabelId, Nature, NodeId, Time, Transaction,
    VocabularyBuilder,
};

pub(crate) struct Ward {
    pub(crate) graph: Graph,
    pub(crate) label: LabelId,
    pub(crate) score: AttributeId,
    pub(crate) says: AttributeId,
    pub(crate) nodes: Vec<NodeId>,
}

/// `count` nodes in a chain of edges, the first fifty also in a chain of transforms.
pub(crate) fn ward(count: usize) -> Ward {
    let mut b = VocabularyBuilder::new();
    let place = b.node_type("place", None, Nature::Geometric).unwrap();
    let label = b.label("next", place, place).unwrap();
    let score = b.attribute_on_node("score", place, Kind::Number).unwrap();
    let says = b.attribute_on_edge("says", label, (place, place), Kind::Text).unwrap();
    let graph = Graph::new(b.build());
    let names: Vec<String> = (0..count).map(|at| format!("n{at}")).collect();
    for start in (0..count).step_by(10_000) {
        graph
            .edit(AgentId::DSR, Time(0), |tx| {
                for at in start..count.min(start + 10_000) {
                    tx.add_node(names[at].as_str(), place).set_attribute(names[at].as_str(), score, 0.0);
                    if at > 0 {
                        tx.add_edge(names[at - 1].as_str(), label, names[at].as_str());
                    }
                }
            })
            .unwrap();
    }
    graph
        .edit(AgentId::DSR, Time(0), |tx| {
            for at in 1..=50 {
                let step = Isometry3::new([0.1, 0.2, 0.3].into(), [0.1, 0.0, 0.2].into());
                tx.set_transform(names[at - 1].as_str(), names[at].as_str(), step);
            }
        })
        .unwrap();
    let nodes = graph.snapshot().nodes_of(place).collect();
    Ward { graph, label, score, says, nodes }
}

/// An edge, its attribute and a node's attribute: what a typical agent writes at once.
pub(crate) fn three_edits(ward: &Ward, round: u64) -> Transaction {
    let at = usize::try_from(round.wrapping_mul(2_654_435_761) % (ward.nodes.len() as u64 - 1)).unwrap();
    let (a, b) = (ward.nodes[at], ward.nodes[at + 1]);
    let mut tx = Transaction::new(AgentId::DSR);
    let far = ward.nodes[(at + 7) % ward.nodes.len()];
    if round.is_multiple_of(2) {
        tx.add_edge(a, ward.label, far)
    } else {
        tx.remove_edge(a, ward.label, far)
    };
    #[expect(clippy::cast_precision_loss, reason = "any number will do")]
    tx.set_attribute(a, ward.score, round as f64);
    let text = if round.is_multiple_of(2) { "yyy" } else { "xxx" };
    tx.set_attribute(HolderRef::edge(a, ward.label, b), ward.says, text);
    tx
}

/// Adds an edge and takes it away, in turns.
pub(crate) fn toggle(ward: &Ward, (from, to): (usize, usize), round: u64) -> Transaction {
    let (from, to) = (ward.nodes[from], ward.nodes[to]);
    let mut tx = Transaction::new(AgentId::DSR);
    if round.is_multiple_of(2) {
        tx.add_edge(from, ward.label, to)
    } else {
        tx.remove_edge(from, ward.label, to)
    };
    tx
}
