//! Eight threads on one graph, every operation recorded: some order of them explains what each saw, in their versions'
//! order and in one that is found without looking at versions. Graphs that are wrong on purpose are found out.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod history;

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Barrier, Mutex};

use dsr::{
    AgentId, AttributeId, Graph, Kind as ValueKind, Nature, NodeId, Snapshot, Time, Transaction,
    TransactionError, VocabularyBuilder,
};
use history::{Kind, Numbers, Operation, order_of_versions, some_order, sum};

/// What is done with the graph: as it is, or as a mistake would do it.
trait Access: Sync {
    fn read(&self, graph: &Graph) -> Snapshot {
        graph.snapshot()
    }

    /// Whether a write insists on the version that it read.
    fn insists(&self) -> bool {
        true
    }
}

struct Honest;
impl Access for Honest {}

/// Writes without holding what it read against what is there: loses updates.
struct Careless;
impl Access for Careless {
    fn insists(&self) -> bool {
        false
    }
}

/// Readers get what another one read before them.
struct Stale(Mutex<Option<Snapshot>>);
impl Access for Stale {
    fn read(&self, graph: &Graph) -> Snapshot {
        let mut kept = self.0.lock().unwrap();
        kept.replace(graph.snapshot()).unwrap_or_else(|| graph.snapshot())
    }
}

struct Board {
    graph: Graph,
    nodes: [NodeId; 3],
    number: AttributeId,
    ticks: AtomicU64,
}

impl Board {
    fn new() -> Self {
        let mut builder = VocabularyBuilder::new();
        let counter = builder.node_type("counter", None, Nature::Symbolic).unwrap();
        let number = builder.attribute_on_node("number", counter, ValueKind::Number).unwrap();
        let graph = Graph::new(builder.build());
        let names = ["a", "b", "c"];
        graph
            .edit(AgentId::DSR, Time(0), |tx| {
                names.iter().for_each(|name| {
                    tx.add_node(*name, counter).set_attribute(*name, number, 0.0);
                });
            })
            .unwrap();
        let nodes = names.map(|name| graph.snapshot().node(name).unwrap());
        Self { graph, nodes, number, ticks: AtomicU64::new(0) }
    }

    fn tick(&self) -> u64 {
        self.ticks.fetch_add(1, Ordering::SeqCst)
    }

    fn saw(&self, snapshot: &Snapshot) -> Numbers {
        let number = |node| snapshot.attribute(node, self.number).and_then(dsr::Value::as_number);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below 1,000")]
        self.nodes.map(|node| number(node).unwrap() as u32)
    }

    fn look(&self, access: &dyn Access) -> Operation {
        let began = self.tick();
        let snapshot = access.read(&self.graph);
        let ended = self.tick();
        let saw = self.saw(&snapshot);
        Operation { began, ended, version: snapshot.version().0, kind: Kind::Read { saw } }
    }

    fn add(&self, access: &dyn Access, from: usize, to: usize) -> Operation {
        let began = self.tick();
        loop {
            let snapshot = self.graph.snapshot();
            let saw = self.saw(&snapshot);
            let mut tx = Transaction::new(AgentId::DSR);
            tx.set_attribute(self.nodes[to], self.number, f64::from(sum(saw, from, to)));
            if access.insists() {
                tx.expect_version(snapshot.version());
            } else {
                // Time for others, so that the mistake shows.
                std::thread::yield_now();
            }
            match self.graph.commit(&tx, Time(0)) {
                Err(TransactionError::Stale { .. }) => {}
                other => {
                    let version = other.unwrap().version.0;
                    let ended = self.tick();
                    return Operation { began, ended, version, kind: Kind::Add { from, to, saw } };
                }
            }
        }
    }
}

/// Eight threads, half of them mostly readers; each does so many operations. One more holds snapshots for a while.
fn record(access: &dyn Access, each: usize) -> Vec<Operation> {
    let (board, start) = (Board::new(), Barrier::new(8));
    let mut all = Vec::new();
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..8)
            .map(|thread| {
                let (board, start) = (&board, &start);
                scope.spawn(move || {
                    let (mut done, mut held) = (Vec::new(), Vec::new());
                    start.wait();
                    for round in 0..each {
                        let at = thread * 7 + round * 5;
                        let writes = if thread < 4 { !at.is_multiple_of(4) } else { at.is_multiple_of(4) };
                        done.push(if writes {
                            board.add(access, at % 3, (at / 3) % 3)
                        } else {
                            board.look(access)
                        });
                        if at.is_multiple_of(3) {
                            held.push(board.graph.snapshot());
                        } else if held.len() > 4 {
                            held.clear();
                        }
                    }
                    done
                })
            })
            .collect();
        threads.into_iter().for_each(|thread| all.extend(thread.join().unwrap()));
    });
    all
}

#[test]
fn some_order_explains_short_histories() {
    for _ in 0..40 {
        let history = record(&Honest, 7);
        assert!(some_order([0; 3], &history), "{history:#?}");
        order_of_versions([0; 3], &history).unwrap();
    }
}

#[test]
fn the_order_of_versions_explains_long_histories() {
    for _ in 0..3 {
        order_of_versions([0; 3], &record(&Honest, 2_000)).unwrap();
    }
}

/// Threads may happen to run one after the other, and then no mistake shows: some of many histories must be refused.
fn found_out(access: &dyn Access) {
    let refused = (0..200).any(|_| {
        let history = record(access, 7);
        let (found, claimed) = (some_order([0; 3], &history), order_of_versions([0; 3], &history));
        assert!(found || claimed.is_err(), "an order of versions is an order");
        !found
    });
    assert!(refused, "the mistake was not found");
    let refused = (0..200).any(|_| order_of_versions([0; 3], &record(access, 100)).is_err());
    assert!(refused, "the mistake was not found by versions");
}

#[test]
fn lost_updates_are_found_out() {
    found_out(&Careless);
}

#[test]
fn stale_readers_are_found_out() {
    found_out(&Stale(Mutex::new(None)));
}

/// Two operations written out by hand, so that the checkers' own mistakes show whatever threads do.
#[test]
fn the_checkers_know_right_from_wrong() {
    let add = |began, ended, version, saw| Operation {
        began,
        ended,
        version,
        kind: Kind::Add { from: 0, to: 1, saw },
    };
    let read = |began, ended, version, saw| Operation { began, ended, version, kind: Kind::Read { saw } };
    let both =
        |history: &[Operation]| (some_order([0; 3], history), order_of_versions([0; 3], history).is_ok());
    let one = add(0, 9, 1, [0; 3]);
    assert_eq!(both(&[one.clone(), read(1, 2, 0, [0; 3]), read(3, 4, 1, [0, 1, 0])]), (true, true));
    assert_eq!(both(&[one.clone(), read(1, 2, 1, [0, 1, 0]), read(3, 4, 0, [0; 3])]), (false, false));
    assert_eq!(both(&[one.clone(), add(1, 2, 2, [0; 3])]), (false, false), "a lost update");
    assert_eq!(both(&[one.clone(), add(10, 11, 2, [0, 1, 0])]), (true, true));
    assert_eq!(both(&[one, read(10, 11, 1, [0; 3])]), (false, false), "a read that came too late");
}

/// A closure that panics in the middle of what it writes, and a callback that panics when it is told, change nothing
/// for anybody else.
#[test]
fn a_panic_leaves_the_graph_as_it_was() {
    let board = Board::new();
    let feed = board.graph.subscribe_deltas();
    let told = Arc::new(AtomicU64::new(0));
    let fragile = board.graph.subscribe_deltas();
    fragile.on_wake(|| panic!("a subscriber's mistake"));
    let other = board.graph.subscribe_deltas();
    let counter = Arc::clone(&told);
    other.on_wake(move || _ = counter.fetch_add(1, Ordering::SeqCst));

    let before = serde_json::to_string(&board.graph.snapshot().export()).unwrap();
    let quiet = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| {}));
    let edit = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        board.graph.edit(AgentId::DSR, Time(1), |tx| {
            tx.set_attribute(board.nodes[0], board.number, 7.0);
            panic!("a writer's mistake");
        })
    }));
    let update = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        board.graph.update(AgentId::DSR, Time(1), |_, tx| {
            tx.set_attribute(board.nodes[0], board.number, 7.0);
            panic!("a writer's mistake");
        })
    }));
    assert!(edit.is_err() && update.is_err());
    assert_eq!(serde_json::to_string(&board.graph.snapshot().export()).unwrap(), before);
    assert!(feed.try_recv().is_none());
    board.add(&Honest, 0, 1);
    std::panic::set_hook(quiet);
    assert_eq!(board.saw(&board.graph.snapshot()), [0, 1, 0]);
    assert!(feed.try_recv().is_some() && fragile.try_recv().is_some());
    assert_eq!(told.load(Ordering::SeqCst), 1, "the others are woken");
}
