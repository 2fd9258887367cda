//! The journal: every version is read back to the byte, every cut or damage is reported, and no commit waits for a disk.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use std::collections::BTreeMap;
use std::num::NonZeroU64;

use dsr::{
    Damage, Durability, Graph, Memory, Played, Recording, RecordingError, Settings, Snapshot, Version,
    Vocabulary,
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
            // What goes on from an export is the same as what was exported, and so is what its journal begins with.
            let restored = Graph::restore(graph.vocabulary(), &commit.snapshot.export()).unwrap();
            assert_eq!(bytes(&restored.snapshot()), bytes(&commit.snapshot));
            let begun = Memory::default();
            restored.journal(begun.clone(), Settings::default()).unwrap().close().unwrap();
            let read = Recording::read(begun.segments()).unwrap().resume().unwrap();
            assert_eq!(bytes(&read.snapshot()), bytes(&commit.snapshot));
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
fn a_vocabulary_is_plain_data() {
    let vocabulary = world::vocabulary();
    let json = serde_json::to_string(&*vocabulary).unwrap();
    let read: Vocabulary = serde_json::from_str(&json).unwrap();
    assert_eq!(serde_json::to_string(&read).unwrap(), json);
    assert_eq!(format!("{:?}", read.label("is_in")), format!("{:?}", vocabulary.label("is_in")));
    let wrong = json.replacen("\"parent\":3", "\"parent\":300", 1);
    assert!(wrong != json && serde_json::from_str::<Vocabulary>(&wrong).is_err());
}

#[test]
fn a_torn_tail_is_cut_at_every_byte() {
    let (versions, memory) = recorded(&eventful(), settings());
    let whole = memory.segments().remove(0);
    let (mut shortest, mut cuts) = (u64::MAX, 0);
    for length in 0..whole.len() {
        match Recording::read([whole[..length].to_vec()]) {
            Err(RecordingError::Empty | RecordingError::Damaged { .. }) => {
                assert!(length < 4_000, "the state is at the beginning");
            }
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
    let mut corrupt = 0;
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
            other => panic!("byte {at}: {other:?}"),
        }
    }
    assert!(corrupt > 1_000, "{corrupt}");
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
