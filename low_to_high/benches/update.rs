//! One delta of the Barthel test (the last option was said, so its item is described), and a derivation from scratch.

use std::path::Path;
use std::sync::Arc;

use criterion::{Criterion, criterion_group, criterion_main};
use dsr::{AgentId, Graph, Time};
use low_to_high::{LowToHigh, Perception};
use pddl::model::{Domain, Problem};
use pddl::{Source, parse_domain, parse_problem};
use vocabulary::Tokens;

fn source(path: &str) -> Source {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    Source::new(path, std::fs::read_to_string(root.join(path)).expect("part of the repository"))
}

fn domain(path: &str, imports: &[&Domain]) -> Domain {
    parse_domain(&source(path), imports).model.expect("the repository's own texts have no errors")
}

fn problem(path: &str, domain: &Domain) -> Problem {
    parse_problem(&source(path), domain).model.expect("the repository's own texts have no errors")
}

fn barthel() -> (Tokens, Arc<Perception>, Graph) {
    let words = domain("robots/clarc/vocabulary.pddl", &[]);
    let planning = domain("domains/barthel/domain.pddl", &[]);
    let perception = domain("domains/barthel/perception.pddl", &[&words, &planning]);
    let world = problem("robots/clarc/world.pddl", &words);
    let test = problem("domains/barthel/graph.pddl", &words);
    let tokens = Tokens::new(&words).expect("fits the graph");
    let perception = Arc::new(Perception::new(&perception, &tokens).expect("made of tokens"));
    let graph = tokens.populate(&[&world, &test], Time(0)).expect("fits the vocabulary");
    (tokens, perception, graph)
}

fn bench(criterion: &mut Criterion) {
    let (tokens, perception, graph) = barthel();
    let label = |name: &str| tokens.label(name).expect("declared");
    let (said, shown) = (label("was_said_in"), label("was_shown_in"));
    graph
        .edit(AgentId::DSR, Time(1), |tx| {
            for part in ["introduction", "option-1", "option-2", "option-3"] {
                tx.add_edge(part, shown, "feeding");
                if part != "option-3" {
                    tx.add_edge(part, said, "feeding");
                }
            }
        })
        .expect("the graph itself may write");
    let before = LowToHigh::new(Arc::clone(&perception), &graph.snapshot());
    let commit = graph
        .edit(AgentId::DSR, Time(2), |tx| {
            tx.add_edge("option-3", said, "feeding");
        })
        .expect("the graph itself may write");
    let undo = graph
        .edit(AgentId::DSR, Time(3), |tx| {
            tx.remove_edge("option-3", said, "feeding");
        })
        .expect("the graph itself may write");

    // Two updates per iteration, there and back, so that each iteration starts from the same facts.
    let mut seen = before.clone();
    criterion.bench_function("low_to_high/two updates (barthel)", |bencher| {
        bencher.iter(|| {
            let come = seen.update(&commit.snapshot, &commit.delta);
            let gone = seen.update(&undo.snapshot, &undo.delta);
            assert_eq!((come.appeared.len(), gone.disappeared.len()), (1, 1));
        });
    });
    criterion.bench_function("low_to_high/from scratch (barthel)", |bencher| {
        bencher.iter(|| LowToHigh::new(Arc::clone(&perception), &commit.snapshot));
    });
}

criterion_group!(benches, bench);
criterion_main!(benches);
