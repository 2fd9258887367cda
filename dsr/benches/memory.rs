//! What 10^6 nodes cost in memory, and what an old version does: the resident set before and after.
//! `cargo bench -p pelea-dsr --bench memory`; Linux only, elsewhere it says so.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a bench that fails says where, and prints")]

use dsr::{AgentId, Graph, Kind, Nature, Time, VocabularyBuilder};

/// Bytes resident now.
fn resident() -> Option<usize> {
    let statm = std::fs::read_to_string("/proc/self/statm").ok()?;
    Some(statm.split_whitespace().nth(1)?.parse::<usize>().ok()? * 4096)
}

fn main() {
    let Some(before) = resident() else {
        println!("skipped: no /proc/self/statm here");
        return;
    };
    const NODES: usize = 1_000_000;
    let mut b = VocabularyBuilder::new();
    let place = b.node_type("place", None, Nature::Geometric).unwrap();
    let label = b.label("next", place, place).unwrap();
    let numbers: Vec<_> =
        (0..4).map(|at| b.attribute_on_node(&format!("a{at}"), place, Kind::Number).unwrap()).collect();
    let graph = Graph::new(b.build());
    for start in (0..NODES).step_by(1_000) {
        graph
            .edit(AgentId::DSR, Time(0), |tx| {
                for at in start..start + 1_000 {
                    let name = format!("n{at}");
                    tx.add_node(name.as_str(), place);
                    for &number in &numbers {
                        tx.set_attribute(name.as_str(), number, 1.0);
                    }
                    for back in [1, 10, 100].into_iter().filter(|back| *back <= at) {
                        tx.add_edge(name.as_str(), label, format!("n{}", at - back));
                    }
                }
            })
            .unwrap();
    }
    let built = resident().unwrap();
    println!("{} bytes a node with 4 attributes and 3 edges, at {NODES} nodes", (built - before) / NODES);

    let ids: Vec<_> = graph.snapshot().nodes_of(place).collect();
    for (at, &node) in ids.iter().enumerate() {
        #[expect(clippy::cast_precision_loss, reason = "any number will do")]
        let value = at as f64 + 2.0;
        graph.edit(AgentId::DSR, Time(1), |tx| _ = tx.set_attribute(node, numbers[0], value)).unwrap();
    }
    let written = resident().unwrap();
    println!("{} bytes a node when each has been written since, alone", (written - before) / NODES);

    let before = resident().unwrap();
    let mut held = Vec::new();
    for round in 0..10_000_usize {
        let node = ids[round.wrapping_mul(2_654_435_761) % NODES];
        #[expect(clippy::cast_precision_loss, reason = "any number will do")]
        let value = round as f64 + 0.5;
        let commit =
            graph.edit(AgentId::DSR, Time(1), |tx| _ = tx.set_attribute(node, numbers[0], value)).unwrap();
        held.push(commit.snapshot);
    }
    println!(
        "{} bytes an old version of one edit at a random node, {} held",
        (resident().unwrap() - before) / held.len(),
        held.len()
    );
}
