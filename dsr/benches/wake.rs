//! From a commit to the subscribed task that runs on another thread, beside a bare channel that wakes a parked thread,
//! taken in turns in one run. `cargo bench -p pelea-dsr --bench wake`.
//!
//! Each figure begins right before the call that wakes (a commit with all that belongs to it, or a send), and ends where
//! the woken thread has what it was woken for: for a pattern, the change of its matches. Between two rounds the waker
//! rests, so that the other thread is parked.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a bench that fails says where, and prints")]

mod ward;

use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use dsr::{AgentId, PatternBuilder, Time};
use ward::{toggle, ward};

const ROUNDS: usize = 5_000;

/// Waits without giving the core to anybody, long enough for the other thread to have gone to sleep.
fn rest() {
    let start = Instant::now();
    while start.elapsed() < Duration::from_micros(60) {
        std::hint::spin_loop();
    }
}

fn percentiles(mut times: Vec<Duration>) -> [Duration; 3] {
    times.sort_unstable();
    [50, 90, 99].map(|percent| times[times.len() * percent / 100])
}

fn main() {
    let ward = ward(10_000);
    let vocabulary = ward.graph.vocabulary();
    let place = vocabulary.node_type("place").unwrap();
    let (answer, answers): (Sender<Instant>, Receiver<Instant>) = channel();

    let (send, bare) = channel::<()>();
    let back = answer.clone();
    std::thread::spawn(move || {
        while bare.recv().is_ok() {
            back.send(Instant::now()).unwrap();
        }
    });

    // Each subscriber has a pair of nodes of its own, so that a commit wakes one thread.
    let deltas_pattern = |from: usize, to: usize| {
        let mut pattern = PatternBuilder::new(&vocabulary);
        let between = pattern.variable("between", place);
        let (start, end) = (format!("n{from}"), format!("n{to}"));
        pattern.edge(start.as_str(), ward.label, between).edge(between, ward.label, end.as_str());
        pattern.build().unwrap()
    };
    let mut matches = ward.graph.subscribe(deltas_pattern(5, 10));
    let back = answer.clone();
    std::thread::spawn(move || {
        while matches.recv().is_some() {
            back.send(Instant::now()).unwrap();
        }
    });
    let mut called = ward.graph.subscribe(deltas_pattern(105, 110));
    while called.try_recv().is_some() {}
    called.on_wake(move || _ = answer.send(Instant::now()));
    while answers.recv_timeout(Duration::from_millis(50)).is_ok() {}

    let (mut through_channel, mut through_graph, mut through_callback) = (Vec::new(), Vec::new(), Vec::new());
    let mut commits = Vec::new();
    for round in 0..ROUNDS {
        rest();
        let start = Instant::now();
        send.send(()).unwrap();
        through_channel.push(answers.recv().unwrap() - start);

        rest();
        let transaction = toggle(&ward, (5, 9), round as u64);
        let start = Instant::now();
        ward.graph.commit(&transaction, Time(1)).unwrap();
        through_graph.push(answers.recv().unwrap() - start);

        // The callback runs on the committing thread: what is left is the graph's own part.
        let transaction = toggle(&ward, (105, 109), round as u64);
        let start = Instant::now();
        ward.graph.commit(&transaction, Time(1)).unwrap();
        through_callback.push(answers.recv().unwrap() - start);

        let mut alone = dsr::Transaction::new(AgentId::DSR);
        alone.set_attribute(ward.nodes[500], ward.score, f64::from(u32::try_from(round).unwrap()));
        let start = Instant::now();
        ward.graph.commit(&alone, Time(1)).unwrap();
        commits.push(start.elapsed());
    }
    let channel = percentiles(through_channel);
    println!(
        "bare channel to a parked thread: p50 {:?}, p90 {:?}, p99 {:?}",
        channel[0], channel[1], channel[2]
    );
    for (what, times) in [
        ("commit to the changed matches of a parked subscriber", through_graph),
        ("commit to a callback", through_callback),
        ("commit that concerns nobody", commits),
    ] {
        let [p50, p90, p99] = percentiles(times);
        let ratio = p50.as_secs_f64() / channel[0].as_secs_f64();
        println!("{what}: p50 {p50:?} ({ratio:.2} x the channel), p90 {p90:?}, p99 {p99:?}");
    }
}
