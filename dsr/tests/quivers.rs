//! petgraph on a snapshot finds what it finds on a copy in a graph of its own.

#![allow(clippy::unwrap_used, reason = "a test")]

use std::collections::BTreeSet;

use dsr::{AgentId, Graph, LabelId, Nature, NodeId, Snapshot, Time, TypeId, VocabularyBuilder};
use petgraph::Direction;
use petgraph::algo::{dijkstra, is_cyclic_directed, kosaraju_scc, tarjan_scc};
use petgraph::graphmap::DiGraphMap;
use petgraph::visit::{EdgeCount, EdgeRef, IntoEdgesDirected, IntoNeighborsDirected, NodeCount, Reversed};
use proptest::prelude::*;

const NODES: usize = 8;

/// A node is added and taken away again, so that ids have a gap.
fn graph(edges: &[(usize, usize, bool)]) -> Graph {
    let mut builder = VocabularyBuilder::new();
    let place = builder.node_type("place", None, Nature::Symbolic).unwrap();
    let labels = ["leads", "sees"].map(|name| builder.label(name, place, place).unwrap());
    let graph = Graph::new(builder.build());
    let name = |at: usize| format!("n{at}");
    let write = |edit: &mut dyn FnMut(&mut dsr::Transaction)| {
        graph.edit(AgentId::DSR, Time(0), |tx| edit(tx)).unwrap();
    };
    write(&mut |tx| _ = tx.add_node("gone", place));
    write(&mut |tx| (0..NODES).for_each(|at| _ = tx.add_node(name(at).as_str(), place)));
    write(&mut |tx| _ = tx.remove_node("gone"));
    for &(from, to, second) in edges.iter().filter(|(from, to, _)| from != to) {
        write(&mut |tx| _ = tx.add_edge(name(from).as_str(), labels[usize::from(second)], name(to).as_str()));
    }
    graph
}

fn copy(now: &Snapshot) -> DiGraphMap<NodeId, Vec<LabelId>> {
    let mut copy: DiGraphMap<NodeId, Vec<LabelId>> = DiGraphMap::new();
    now.nodes().for_each(|node| _ = copy.add_node(node.id));
    for edge in now.edges() {
        match copy.edge_weight_mut(edge.key.from, edge.key.to) {
            Some(labels) => labels.push(edge.key.label),
            None => _ = copy.add_edge(edge.key.from, edge.key.to, vec![edge.key.label]),
        }
    }
    copy
}

fn sets(components: Vec<Vec<NodeId>>) -> BTreeSet<BTreeSet<NodeId>> {
    components.into_iter().map(|component| component.into_iter().collect()).collect()
}

proptest! {
    #[test]
    fn algorithms_see_the_symbolic_quiver(
        edges in prop::collection::vec((0..NODES, 0..NODES, any::<bool>()), 0..20),
    ) {
        let now = graph(&edges).snapshot();
        let (quiver, copy) = (now.symbolic_quiver(), copy(&now));
        prop_assert_eq!(quiver.node_count(), copy.node_count());
        prop_assert_eq!(quiver.edge_count(), now.edges().count());
        prop_assert_eq!(sets(kosaraju_scc(quiver)), sets(kosaraju_scc(&copy)));
        prop_assert_eq!(sets(tarjan_scc(quiver)), sets(tarjan_scc(&copy)));
        prop_assert_eq!(is_cyclic_directed(quiver), is_cyclic_directed(&copy));
        let start = now.node("n0").unwrap();
        prop_assert_eq!(dijkstra(quiver, start, None, |_| 1), dijkstra(&copy, start, None, |_| 1));
        prop_assert_eq!(
            dijkstra(Reversed(quiver), start, None, |_| 1),
            dijkstra(Reversed(&copy), start, None, |_| 1)
        );
        for node in now.nodes_of(TypeId::OBJECT) {
            let before: BTreeSet<_> = quiver.neighbors_directed(node, Direction::Incoming).collect();
            let expected: BTreeSet<_> = copy.neighbors_directed(node, Direction::Incoming).collect();
            prop_assert_eq!(before, expected);
            for edge in quiver.edges_directed(node, Direction::Incoming) {
                prop_assert_eq!(edge.target(), node);
                prop_assert!(copy[(edge.source(), node)].contains(edge.weight()));
            }
        }
    }
}
