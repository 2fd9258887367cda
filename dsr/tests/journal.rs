//! The journal: every version comes back to the byte, whatever was cut or damaged is named, nobody waits for a disk.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use std::collections::BTreeMap;
use std::io;
use std::num::NonZeroU64;
use std::sync::mpsc;

use dsr::{
    AgentId, Damage, Dictionary, Durability, Folder, Graph, Memory, Played, Recording, RecordingError,
    Settings, Snapshot, Store, Time, Version,
};
use proptest::prelude::*;

/// What the random transactions are made of; many are refused, as they should be.
const EDITS: [&str; 26] = [
    "node anna person",
    "no-node anna",
    "node bob person",
    "no-node bob",
    "edge anna is_with clarc",
    "no-edge anna is_with clarc",
    "no-edge carlos is_with clarc",
    "edge carlos knows bob",
    "set-edge carlos knows bob since number 4",
    "set-edge carlos knows bob of node anna",
    "edge clarc is speaking",
    "no-edge clarc is speaking",
    "set barthel score number 1.5",
    "set barthel score number -0",
    "clear barthel score",
    "set barthel patient node anna",
    "set barthel urgent bool true",
    "set-edge barthel is_in feeding says text hello",
    "transform clarc anna 1 2 3 0.5",
    "transform world bob 0 0 0 0",
    "no-transform clarc anna",
    "no-transform world carlos",
    "sample clarc bob 3 1 1",
    "sample clarc bob 5 2 1",
    "sample clarc bob 10000000007 2 1",
    "sample world carlos 4 2 1",
];

fn bytes(snapshot: &Snapshot) -> String {
    serde_json::to_string(&snapshot.export()).unwrap()
}

fn settings() -> Settings {
    Settings { durability: Durability::Each, ..Settings::default() }
}

/// A graph with a history, the bytes of each version, and its journal.
fn recorded(history: &[Vec<usize>], settings: Settings) -> (BTreeMap<u64, String>, Memory) {
    let graph = world::ward();
    let memory = Memory::default();
    let mut versions = BTreeMap::from([(graph.snapshot().version().0, bytes(&graph.snapshot()))]);
    let journal = graph.journal(memory.clone(), settings).unwrap();
    for edits in history {
        let lines: Vec<_> = edits.iter().map(|&at| EDITS[at]).collect();
        if let Ok(commit) = world::commit(&graph, "dsr", &lines.join("\n")) {
            versions.insert(commit.version.0, bytes(&commit.snapshot));
            journal.wait(commit.version).unwrap();
        }
    }
    let progress = journal.close().unwrap();
    assert_eq!(progress.durable.0, *versions.keys().last().unwrap());
    assert_eq!(progress.gaps, 0);
    (versions, memory)
}

/// A history in which every kind of edit is accepted.
fn eventful() -> Vec<Vec<usize>> {
    (0..EDITS.len()).chain(0..EDITS.len()).map(|at| vec![at]).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn every_version_comes_back_to_the_byte(
        history in prop::collection::vec(prop::collection::vec(0..EDITS.len(), 1..4), 0..60),
        segment_bytes in prop_oneof![Just(1_u64), Just(200), Just(1 << 20)],
    ) {
        let (versions, memory) = recorded(&history, Settings { segment_bytes, ..settings() });
        let recording = Recording::read(memory.segments()).unwrap();
        prop_assert_eq!(recording.damage(), &[]);
        prop_assert_eq!(recording.first().0.0, *versions.keys().next().unwrap());
        prop_assert_eq!(recording.last().0.0, *versions.keys().last().unwrap());
        for (&version, live) in &versions {
            let found = recording.at(Version(version)).unwrap();
            prop_assert_eq!(&bytes(&found), live);
            let then = recording.at_time(found.time()).unwrap();
            prop_assert_eq!(then.time(), found.time());
        }
        let mut replay = recording.replay().unwrap();
        let mut seen = 1;
        while let Some(played) = replay.next() {
            let Played::Commit(delta) = played.unwrap() else { panic!("no gaps") };
            prop_assert_eq!(delta.version, replay.version());
            prop_assert_eq!(Some(&bytes(&replay.snapshot())), versions.get(&delta.version.0));
            seen += 1;
        }
        prop_assert_eq!(seen, versions.len());
        let resumed = recording.resume().unwrap();
        prop_assert_eq!(Some(&bytes(&resumed.snapshot())), versions.values().last());
    }

    /// Any bytes at all: an error or a recording, never a panic.
    #[test]
    fn any_bytes_are_read(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = Recording::read([bytes]);
    }
}

#[test]
fn a_dictionary_is_plain_data() {
    let dictionary = world::dictionary();
    let json = serde_json::to_string(&*dictionary).unwrap();
    let read: Dictionary = serde_json::from_str(&json).unwrap();
    assert_eq!(serde_json::to_string(&read).unwrap(), json);
    assert_eq!(format!("{:?}", read.label("is_in")), format!("{:?}", dictionary.label("is_in")));
    let wrong = json.replacen("\"parent\":3", "\"parent\":300", 1);
    assert!(wrong != json && serde_json::from_str::<Dictionary>(&wrong).is_err());
}

#[test]
fn a_torn_tail_is_cut_at_every_byte() {
    let (versions, memory) = recorded(&eventful(), settings());
    let whole = memory.segments().remove(0);
    let (mut shortest, mut cuts) = (u64::MAX, 0);
    for length in 0..whole.len() {
        match Recording::read([whole[..length].to_vec()]) {
            Err(RecordingError::Empty) => assert!(length < 4_000, "the state is at the beginning"),
            Err(error) => panic!("{error}"),
            Ok(recording) => {
                let last = recording.last().0;
                assert_eq!(bytes(&recording.at(last).unwrap()), versions[&last.0]);
                shortest = shortest.min(last.0);
                match recording.damage() {
                    [] => {}
                    [Damage::Torn { offset, bytes, .. }] => {
                        assert_eq!(offset + bytes, length);
                        cuts += 1;
                    }
                    other => panic!("{other:?}"),
                }
            }
        }
    }
    assert_eq!(shortest, *versions.keys().next().unwrap());
    assert!(cuts > 1_000);
}

#[test]
fn damage_is_named_with_its_offset_and_what_is_before_it_can_be_read() {
    let (versions, memory) = recorded(&eventful(), settings());
    let whole = memory.segments().remove(0);
    let (mut corrupt, mut torn) = (0, 0);
    for at in 0..whole.len() {
        let mut bytes_ = whole.clone();
        bytes_[at] ^= 0x10;
        let Ok(recording) = Recording::read([bytes_]) else { continue };
        let last = recording.last().0;
        assert_eq!(bytes(&recording.at(last).unwrap()), versions[&last.0]);
        match recording.damage() {
            [Damage::Corrupt { offset, .. }] => {
                assert!(*offset <= at);
                corrupt += 1;
            }
            // The last record: nothing behind it says that it was whole.
            [Damage::Torn { offset, .. }] => {
                assert!(*offset <= at);
                torn += 1;
            }
            other => panic!("byte {at}: {other:?}"),
        }
    }
    assert!(corrupt > 10 * torn && torn > 0, "{corrupt} {torn}");
}

#[test]
fn old_segments_are_let_go_of_and_others_stand_alone() {
    let kept = NonZeroU64::new(2);
    let (versions, memory) =
        recorded(&eventful(), Settings { segment_bytes: 1, segments: kept, ..settings() });
    let segments: Vec<_> = memory.segments().into_iter().filter(|segment| !segment.is_empty()).collect();
    assert_eq!(segments.len(), 2);
    let recording = Recording::read(segments).unwrap();
    let newest = *versions.keys().last().unwrap();
    assert_eq!(recording.last().0, Version(newest));
    assert!(recording.first().0.0 >= newest - 2);
    assert!(matches!(recording.at(Version(3)), Err(RecordingError::NoVersion { .. })));
}

#[test]
fn a_segment_that_is_missing_is_a_jump() {
    let (versions, memory) = recorded(&eventful(), Settings { segment_bytes: 1, ..settings() });
    let mut segments = memory.segments();
    assert!(segments.len() > 6);
    segments.drain(2..4);
    let recording = Recording::read(segments).unwrap();
    let jumps =
        recording.replay().unwrap().filter(|played| matches!(played, Ok(Played::Jump { .. }))).count();
    assert_eq!(jumps, 1);
    let lost = versions.keys().filter(|&&v| recording.at(Version(v)).is_err()).count();
    assert!((1..=2).contains(&lost), "{lost}");
}

/// A store that stands still until it is told to go on.
struct Stalled {
    memory: Memory,
    go_on: mpsc::Receiver<()>,
}

impl Store for Stalled {
    fn begin(&mut self, number: u64) -> io::Result<()> {
        self.memory.begin(number)
    }

    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.memory.append(bytes)
    }

    fn sync(&mut self) -> io::Result<()> {
        let _ = self.go_on.recv();
        Ok(())
    }

    fn forget(&mut self, before: u64) -> io::Result<()> {
        self.memory.forget(before)
    }
}

#[test]
fn a_stalled_disk_slows_no_writer_and_leaves_a_gap() {
    let graph = world::ward();
    let memory = Memory::default();
    let (go_on, gate) = mpsc::channel();
    let store = Stalled { memory: memory.clone(), go_on: gate };
    let journal = graph.journal(store, Settings { waiting_bytes: 2_000, ..settings() }).unwrap();
    let before = graph.snapshot().version();
    for round in 0..1_000 {
        world::commit(&graph, "dsr", &format!("set barthel score number {round}")).unwrap();
    }
    drop(go_on);
    let last = graph.snapshot();
    let progress = journal.wait(last.version()).unwrap();
    assert_eq!((progress.gaps, progress.durable), (1, last.version()));
    world::commit(&graph, "dsr", "set barthel score number -1").unwrap();
    journal.close().unwrap();
    let recording = Recording::read(memory.segments()).unwrap();
    assert_eq!(bytes(&recording.at(last.version()).unwrap()), bytes(&last));
    assert_eq!(recording.last().0.0, last.version().0 + 1);
    assert_eq!(recording.first().0, before);
    let lost = recording.at(Version(last.version().0 - 1)).unwrap_err();
    assert!(matches!(lost, RecordingError::NotRecorded { .. }), "{lost}");
}

/// A store that is full after some bytes.
struct Full(usize);

impl Store for Full {
    fn begin(&mut self, _: u64) -> io::Result<()> {
        Ok(())
    }

    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.0 = self.0.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
        Ok(())
    }

    fn sync(&mut self) -> io::Result<()> {
        Ok(())
    }

    fn forget(&mut self, _: u64) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_told_and_the_graph_goes_on() {
    let graph = world::ward();
    let journal = graph.journal(Full(5_000), settings()).unwrap();
    let mut failed = None;
    for round in 0..1_000 {
        let commit = world::commit(&graph, "dsr", &format!("set barthel score number {round}")).unwrap();
        failed = failed.or(journal.wait(commit.version).err());
    }
    let failed = failed.unwrap();
    assert_eq!(failed.error.kind(), io::ErrorKind::StorageFull);
    assert!(failed.durable < graph.snapshot().version());
    assert!(journal.close().is_err());
}

#[test]
fn a_journal_goes_on_behind_the_one_before_and_outlives_its_graph() {
    let folder = tempfile::tempdir().unwrap();
    let graph = world::ward();
    let journal = graph.journal(Folder::new(folder.path()).unwrap(), Settings::default()).unwrap();
    world::commit(&graph, "dsr", "set barthel score number 1").unwrap();
    let before = bytes(&graph.snapshot());
    // Nobody holds the graph any more; what was committed is written all the same.
    drop(graph);
    journal.close().unwrap();

    let recording = Recording::open(folder.path()).unwrap();
    let graph: Graph = recording.resume().unwrap();
    assert_eq!(bytes(&graph.snapshot()), before);
    let store = Folder::new(folder.path()).unwrap();
    assert!(!store.is_fresh());
    let journal = graph.journal(store, Settings::default()).unwrap();
    let score = graph.dictionary().attribute("score").unwrap();
    graph.edit(AgentId::DSR, Time(9), |tx| _ = tx.set_attribute("barthel", score, 2.0)).unwrap();
    journal.close().unwrap();

    let recording = Recording::open(folder.path()).unwrap();
    assert_eq!(recording.replay().unwrap().filter_map(Result::ok).count(), 2);
    assert_eq!(bytes(&recording.at(recording.last().0).unwrap()), bytes(&graph.snapshot()));
    assert!(matches!(Recording::open(folder.path().join("none")), Err(RecordingError::Unreadable { .. })));
}
