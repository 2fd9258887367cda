//! Kinematic chains beside what they cannot be faster than, the products of their isometries alone, and beside tf2
//! with a caller of our own (`peers/tf2.cpp`), in one run. `cargo bench -p pelea-dsr --bench chains`; without Debian's
//! `libtf2-dev` and a C++ compiler the peer is skipped with a word.
#![allow(missing_docs, reason = "a bench has no readers of its documentation")]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a bench that fails says where, and prints")]

use std::hint::black_box;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use dsr::{AgentId, Graph, Isometry3, Nature, Snapshot, Time, VocabularyBuilder};

const DEPTHS: [usize; 3] = [1, 10, 50];

/// How long a batch may take: shorter than a scheduler's slice, so that on a busy machine most are not interrupted.
const BATCH: f64 = 100_000.0;

/// The median of batches, in nanoseconds.
fn median<R>(mut run: impl FnMut() -> R) -> f64 {
    let mut batch = |count: u32| {
        let start = Instant::now();
        for _ in 0..count {
            black_box(run());
        }
        start.elapsed().as_secs_f64() * 1e9 / f64::from(count)
    };
    let once = batch(20).min(batch(20)).min(batch(20));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 10 to 100,000")]
    let count = (BATCH / once).clamp(10.0, 100_000.0) as u32;
    let mut taken: Vec<f64> = (0..1_001).map(|_| batch(count)).collect();
    taken.sort_by(f64::total_cmp);
    taken[taken.len() / 2]
}

fn pose(at: u64) -> Isometry3<f64> {
    #[expect(clippy::cast_precision_loss, reason = "small")]
    let at = at as f64;
    Isometry3::new([0.1 + 0.001 * at, 0.0, 0.0].into(), [0.0, 0.0, 0.1 + 0.001 * at].into())
}

/// Frames f0 … f50 below each other, each with a hundred poses, ten a second.
fn chain() -> Snapshot {
    let mut b = VocabularyBuilder::new();
    let frame = b.node_type("frame", None, Nature::Geometric).unwrap();
    let graph = Graph::new(b.build());
    graph
        .edit(AgentId::DSR, Time(0), |tx| {
            (0..=50).for_each(|at| _ = tx.add_node(format!("f{at}"), frame));
        })
        .unwrap();
    for at in 0..100 {
        graph
            .edit(AgentId::DSR, Time(0), |tx| {
                for child in 1..=50 {
                    let (parent, child) = (format!("f{}", child - 1), format!("f{child}"));
                    tx.sample_transform(parent, child, Time(at * 100_000_000), pose(at));
                }
            })
            .unwrap();
    }
    graph.snapshot()
}

/// What the peer prints, as (what, depth, nanoseconds).
fn tf2() -> Result<Vec<(String, usize, f64)>, String> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers/tf2.cpp");
    let program = std::env::temp_dir().join(format!("pelea-tf2-{}", std::process::id()));
    let built = Command::new("c++")
        .args(["-O2", "-o"])
        .args([&program, &source])
        .args(["-ltf2", "-lrostime", "-lconsole_bridge"])
        .output();
    match built {
        Err(error) => return Err(format!("no C++ compiler: {error}")),
        Ok(built) if !built.status.success() => {
            let said = String::from_utf8_lossy(&built.stderr);
            return Err(format!("no libtf2-dev: {}", said.lines().next().unwrap_or("")));
        }
        Ok(_) => {}
    }
    let ran = Command::new(&program).output();
    _ = std::fs::remove_file(&program);
    let printed = String::from_utf8(ran.map_err(|error| error.to_string())?.stdout).unwrap();
    let row = |line: &str| {
        let mut words = line.split(' ');
        let what = words.next()?.to_owned();
        Some((what, words.next()?.parse().ok()?, words.next()?.parse().ok()?))
    };
    Ok(printed.lines().filter_map(row).collect())
}

fn main() {
    let now = chain();
    let peer = tf2().unwrap_or_else(|why| {
        println!("tf2 is skipped: {why}");
        Vec::new()
    });
    for depth in DEPTHS {
        let name = format!("f{depth}");
        let (root, leaf) = (now.node("f0").unwrap(), now.node(&name).unwrap());
        let poses: Vec<_> = (0..depth).map(|_| pose(99)).collect();
        let alone =
            median(|| black_box(&poses).iter().rev().fold(Isometry3::identity(), |below, p| p * below));
        let by_id = median(|| now.transform(black_box(root), black_box(leaf)));
        let named = |name: &str| now.node(black_box(name)).unwrap();
        let by_name = median(|| now.transform(named("f0"), named(&name)));
        let together = median(|| now.transform_together(named("f0"), named(&name)));
        let time = Time(5_050_000_000);
        let at_id = median(|| now.transform_at(black_box(root), black_box(leaf), time));
        let at = median(|| now.transform_at(named("f0"), named(&name), time));
        println!(
            "depth {depth}: products alone {alone:.0} ns, newest by id {by_id:.0} ns ({:.2} x)",
            by_id / alone
        );
        let beside = |what: &str, ours: f64| {
            let found = peer.iter().find(|(found, at, _)| found == what && *at == depth);
            found.map_or_else(String::new, |(_, _, tf2)| {
                format!("; tf2 {tf2:.0} ns, {:.1} x ours", tf2 / ours)
            })
        };
        println!("  newest by name {by_name:.0} ns{}", beside("latest", by_name));
        println!("  newest common time by name {together:.0} ns{}", beside("latest", together));
        println!("  at a time by id {at_id:.0} ns, by name {at:.0} ns{}", beside("at", at));
    }
}
