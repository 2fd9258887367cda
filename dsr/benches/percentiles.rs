//! Single commits, one by one: what the median and the slow ones cost, of transactions of three edits at random
//! places. `cargo bench -p pelea-dsr --bench percentiles [-- NODES…]`. Each figure includes two readings of the clock.
#![allow(missing_docs, reason = "a bench has no readers of its documentation")]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a bench that fails says where, and prints")]

mod ward;

use std::time::{Duration, Instant};

use dsr::Time;

const ROUNDS: u64 = 300_000;

fn main() {
    let asked: Vec<usize> = std::env::args().filter_map(|word| word.parse().ok()).collect();
    for count in if asked.is_empty() { vec![1_000, 10_000, 100_000, 1_000_000] } else { asked } {
        let ward = ward::ward(count);
        for held in [false, true] {
            let mut last = None;
            let mut times: Vec<_> = (0..ROUNDS)
                .map(|round| {
                    let transaction = ward::three_edits(&ward, round);
                    let start = Instant::now();
                    let commit = ward.graph.commit(&transaction, Time(round)).unwrap();
                    let took = start.elapsed();
                    last = held.then_some(commit.snapshot);
                    took
                })
                .collect();
            drop(last.take());
            times.sort_unstable();
            let at = |percent: usize| Duration::as_nanos(&times[times.len() * percent / 100]);
            let what = if held { "the state before is held" } else { "no snapshot is held" };
            println!("{count:>9} nodes, {what}: p50 {} ns, p90 {} ns, p99 {} ns", at(50), at(90), at(99));
        }
    }
}
