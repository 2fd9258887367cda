//! Eight writers and eight readers on one graph, beside a reader that keeps one snapshot for ever, a subscriber that
//! never listens and one whose callback panics. `cargo xtask soak [SECONDS]`; ends with an error if an update was lost.
//!
//! Runs three times: alone, with a reader and a subscriber that stall, and with a callback that panics; prints each. A stall
//! should slow no other thread, and a panic costs its committer the unwinding. Times of single snapshots
//! are as the reader sees them, so the longest have the scheduler's slices in them wherever more threads run than there
//! are cores; how often that happens is what the counts beyond 1 ms say. That a snapshot needs nothing that a writer
//! has is a test's business (`graph.rs`); this one shows it under load.
#![allow(clippy::print_stdout, reason = "an example that prints")]

use std::process::ExitCode;
use std::time::{Duration, Instant};

use dsr::{
    AgentId, AttributeId, Graph, Kind, Nature, NodeId, PatternBuilder, Snapshot, Time, TransactionError,
    Value, VocabularyBuilder, VocabularyError,
};

const THREADS: usize = 8;
const NODES: usize = 10_000;

struct World {
    graph: Graph,
    nodes: Vec<NodeId>,
    count: AttributeId,
}

#[derive(Debug, thiserror::Error)]
enum Failure {
    #[error(transparent)]
    Vocabulary(#[from] VocabularyError),
    #[error(transparent)]
    Transaction(#[from] TransactionError),
    #[error(transparent)]
    Pattern(#[from] dsr::PatternError),
    #[error("{made} increments were committed, {found} are there")]
    Lost { made: u64, found: u64 },
    #[error("a reader saw {0}")]
    Torn(&'static str),
}

fn world() -> Result<World, Failure> {
    let mut builder = VocabularyBuilder::new();
    let place = builder.node_type("place", None, Nature::Symbolic)?;
    let count = builder.attribute_on_node("count", place, Kind::Number)?;
    let graph = Graph::new(builder.build());
    graph.edit(AgentId::DSR, Time(0), |tx| {
        for at in 0..NODES {
            let name = format!("n{at}");
            tx.add_node(name.as_str(), place).set_attribute(name.as_str(), count, 0.0);
        }
    })?;
    let nodes = graph.snapshot().nodes_of(place).collect();
    Ok(World { graph, nodes, count })
}

impl World {
    fn count(&self, snapshot: &Snapshot, node: NodeId) -> f64 {
        snapshot.attribute(node, self.count).and_then(Value::as_number).unwrap_or(f64::NAN)
    }

    /// Adds one to a node that all writers fight for and to one of the writer's own, until the end.
    fn write(&self, thread: usize, end: Instant) -> Result<u64, Failure> {
        let mut made = 0;
        while Instant::now() < end {
            let step = usize::try_from(made).unwrap_or(0).wrapping_mul(2_654_435_761);
            let own = self.nodes[1 + thread + THREADS * (step % (NODES / THREADS - 1))];
            self.graph.update(AgentId::DSR, Time(made), |snapshot, tx| {
                tx.set_attribute(self.nodes[0], self.count, self.count(snapshot, self.nodes[0]) + 1.0);
                tx.set_attribute(own, self.count, self.count(snapshot, own) + 1.0);
            })?;
            made += 1;
        }
        Ok(made)
    }

    /// Takes snapshots and looks at them, and counts how long taking one took.
    fn read(&self, end: Instant) -> Result<Times, Failure> {
        let (mut times, mut last) = (Times::default(), (0, 0.0));
        while Instant::now() < end {
            let start = Instant::now();
            let snapshot = self.graph.snapshot();
            times.add(start.elapsed());
            let seen = (snapshot.version().0, self.count(&snapshot, self.nodes[0]));
            if seen < last {
                return Err(Failure::Torn("an older version after a newer one"));
            }
            last = seen;
        }
        Ok(times)
    }
}

/// How often something took how long, in doublings of a nanosecond.
struct Times {
    buckets: [u64; 40],
    longest: Duration,
}

impl Default for Times {
    fn default() -> Self {
        Self { buckets: [0; 40], longest: Duration::ZERO }
    }
}

impl Times {
    fn add(&mut self, took: Duration) {
        let bucket = (u128::BITS - took.as_nanos().leading_zeros()) as usize;
        self.buckets[bucket.min(39)] += 1;
        self.longest = self.longest.max(took);
    }

    fn join(mut self, other: &Self) -> Self {
        self.buckets.iter_mut().zip(other.buckets).for_each(|(mine, theirs)| *mine += theirs);
        self.longest = self.longest.max(other.longest);
        self
    }

    fn count(&self) -> u64 {
        self.buckets.iter().sum()
    }

    /// An upper bound of the share's time.
    fn share(&self, of_thousand: u64) -> Duration {
        let mut left = self.count() * of_thousand / 1_000;
        let bucket = self.buckets.iter().position(|&count| {
            let found = left < count;
            left = left.saturating_sub(count);
            found
        });
        Duration::from_nanos(1 << bucket.unwrap_or(39))
    }

    fn beyond(&self, limit: Duration) -> u64 {
        let from = (u128::BITS - limit.as_nanos().leading_zeros()) as usize;
        self.buckets[from..].iter().sum()
    }
}

/// Disturbances beside the writers and readers.
#[derive(Clone, Copy)]
enum Beside {
    Nothing,
    Stalled,
    Panicking,
}

fn run(seconds: u64, beside: Beside) -> Result<(), Failure> {
    let world = world()?;
    let vocabulary = world.graph.vocabulary();
    let mut pattern = PatternBuilder::new(&vocabulary);
    let place = pattern.variable("place", vocabulary.node_type("place").unwrap_or(dsr::TypeId::OBJECT));
    pattern.present(place, world.count);
    let pattern = pattern.build()?;
    let stalled = matches!(beside, Beside::Stalled)
        .then(|| (world.graph.snapshot(), world.graph.subscribe(pattern), world.graph.subscribe_deltas()));
    let panicking = matches!(beside, Beside::Panicking).then(|| {
        let fragile = world.graph.subscribe_deltas();
        fragile.on_wake(|| std::panic::resume_unwind(Box::new("a subscriber's mistake")));
        fragile
    });
    let end = Instant::now() + Duration::from_secs(seconds);
    let (made, times) = std::thread::scope(|scope| {
        let world = &world;
        let writers: Vec<_> =
            (0..THREADS).map(|thread| scope.spawn(move || world.write(thread, end))).collect();
        let readers: Vec<_> = (0..THREADS).map(|_| scope.spawn(move || world.read(end))).collect();
        let made = writers
            .into_iter()
            .map(|w| w.join().expect("a writer does not panic"))
            .sum::<Result<u64, _>>()?;
        let times = readers
            .into_iter()
            .map(|r| r.join().expect("a reader does not panic"))
            .try_fold(Times::default(), |all, times| Ok::<_, Failure>(all.join(&times?)))?;
        Ok::<_, Failure>((made, times))
    })?;
    let now = world.graph.snapshot();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let found = |node| world.count(&now, node) as u64;
    let (shared, own) =
        (found(world.nodes[0]), world.nodes[1..].iter().map(|&node| found(node)).sum::<u64>());
    for found in [shared, own] {
        if found != made {
            return Err(Failure::Lost { made, found });
        }
    }
    if let Some((kept, ..)) = &stalled
        && world.nodes.iter().any(|&node| world.count(kept, node) != 0.0)
    {
        return Err(Failure::Torn("an old snapshot change"));
    }
    println!(
        "{}: {} updates/s, none lost; {} snapshots/s, p50 < {:?}, p99.9 < {:?}, {} of {} beyond 1 ms, longest {:?}",
        match beside {
            Beside::Nothing => "no disturbance",
            Beside::Stalled => "a reader and two subscribers that stall",
            Beside::Panicking => "a subscriber that panics",
        },
        made / seconds,
        times.count() / seconds,
        times.share(500),
        times.share(999),
        times.beyond(Duration::from_millis(1)),
        times.count(),
        times.longest,
    );
    drop(panicking);
    Ok(())
}

fn main() -> ExitCode {
    let seconds = std::env::args().nth(1).and_then(|word| word.parse().ok()).unwrap_or(10);
    println!("{THREADS} writers, {THREADS} readers, {NODES} nodes, {seconds} s each");
    let all = [Beside::Nothing, Beside::Stalled, Beside::Panicking];
    match all.into_iter().try_for_each(|beside| run(seconds, beside)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            println!("failed: {failure}");
            ExitCode::FAILURE
        }
    }
}
