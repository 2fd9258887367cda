//! What the journal costs a commit, what it writes, and how long it takes to read back.
//! `cargo bench -p pelea-dsr --bench journal`; writes below the system's folder for temporary files.
#![allow(missing_docs, reason = "a bench has no readers of its documentation")]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a bench that fails says where, and prints")]
#![allow(clippy::cast_precision_loss, reason = "figures for people")]

mod ward;

use std::time::{Duration, Instant};

use dsr::{Durability, Folder, Journal, Memory, Recording, Settings, Time, Version};

const ROUNDS: u64 = 1_000_000;

/// Commits as fast as one thread can; the time of each and of all.
fn commit(ward: &ward::Ward) -> (Vec<Duration>, Duration) {
    let start = Instant::now();
    let times = (0..ROUNDS).map(|round| {
        let transaction = ward::three_edits(ward, round);
        let before = Instant::now();
        ward.graph.commit(&transaction, Time(round)).unwrap();
        before.elapsed()
    });
    (times.collect(), start.elapsed())
}

fn report(what: &str, mut times: Vec<Duration>, took: Duration, journal: Option<Journal>) {
    let start = Instant::now();
    let progress = journal.map(|journal| journal.close().unwrap());
    let rest = start.elapsed();
    times.sort_unstable();
    let at = |part: usize| times[(times.len() * part / 1_000).min(times.len() - 1)].as_nanos();
    println!(
        "{what}: {:.0} commits/s, p50 {} ns, p99 {} ns, p99.9 {} ns, longest {:.1} ms{}",
        times.len() as f64 / took.as_secs_f64(),
        at(500),
        at(990),
        at(999),
        times.last().unwrap().as_secs_f64() * 1e3,
        progress.map_or_else(String::new, |p| format!(
            "; all on the disk {:.2} s later, {} gaps",
            rest.as_secs_f64(),
            p.gaps
        )),
    );
}

/// What waiting for the disk costs whoever does: from the commit to its version on disk, one after the other, with a pause
/// of nothing between them.
fn durable(ward: &ward::Ward, journal: &Journal) {
    let mut times: Vec<_> = (0..2_000)
        .map(|round| {
            let transaction = ward::three_edits(ward, round);
            let before = Instant::now();
            let commit = ward.graph.commit(&transaction, Time(round)).unwrap();
            journal.wait(commit.version).unwrap();
            before.elapsed()
        })
        .collect();
    times.sort_unstable();
    let at = |part: usize| times[(times.len() * part / 1_000).min(times.len() - 1)].as_secs_f64() * 1e3;
    println!("until on disk: p50 {:.2} ms, p99 {:.2} ms, longest {:.1} ms", at(500), at(990), at(1_000));
}

fn main() {
    const NODES: usize = 10_000;
    let folder = std::env::temp_dir().join(format!("pelea-journal-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    let ward = ward::ward(NODES);
    let journal = ward.graph.journal(Folder::new(&folder).unwrap(), Settings::default()).unwrap();
    durable(&ward, &journal);
    journal.close().unwrap();
    std::fs::remove_dir_all(&folder).unwrap();

    let ward = ward::ward(NODES);
    let (times, took) = commit(&ward);
    report("without a journal", times, took, None);

    let ward = ward::ward(NODES);
    let journal = ward.graph.journal(Memory::default(), Settings::default()).unwrap();
    let (times, took) = commit(&ward);
    report("journal in memory", times, took, Some(journal));

    for (what, durability) in [
        ("journal on disk, synced each group", Durability::Each),
        ("journal on disk, synced every 20 ms", Durability::Every(Duration::from_millis(20))),
    ] {
        let folder = std::env::temp_dir().join(format!("pelea-journal-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        let ward = ward::ward(NODES);
        let settings = Settings { durability, ..Settings::default() };
        let journal = ward.graph.journal(Folder::new(&folder).unwrap(), settings).unwrap();
        let (times, took) = commit(&ward);
        report(what, times, took, Some(journal));

        let files: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|file| file.unwrap()).collect();
        let bytes: u64 = files.iter().map(|file| file.metadata().unwrap().len()).sum();
        let start = Instant::now();
        let recording = Recording::open(&folder).unwrap();
        let opened = start.elapsed();
        let mut replay = recording.replay().unwrap();
        let mut commits = 0_u64;
        for played in replay.by_ref() {
            played.unwrap();
            commits += 1;
        }
        let took = start.elapsed();
        let same = replay.snapshot().export() == ward.graph.snapshot().export();
        let start = Instant::now();
        recording.at(Version(recording.last().0.0 - 1)).unwrap();
        println!(
            "  {} segments, {:.0} bytes a commit; checked in {:.2} s, all {commits} commits replayed {:.2} s later, \
             the same: {same}; the last version but one alone in {:.2} s",
            files.len(),
            bytes as f64 / ROUNDS as f64,
            opened.as_secs_f64(),
            (took - opened).as_secs_f64(),
            start.elapsed().as_secs_f64(),
        );
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
