//! What is found in a folder: other histories, vocabularies and formats, half a file, one that is gone. All of it is named,
//! and what can be read is.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use std::path::Path;

use dsr::{
    AgentId, Damage, Durability, Folder, Graph, Memory, Nature, Recording, RecordingError, Settings,
    Snapshot, Time, Version, VocabularyBuilder,
};
use proptest::prelude::*;

fn bytes(snapshot: &Snapshot) -> String {
    serde_json::to_string(&snapshot.export()).unwrap()
}

fn settings(segment_bytes: u64) -> Settings {
    Settings { durability: Durability::Each, segment_bytes, ..Settings::default() }
}

/// Scores of these times, one commit each; the versions with their times.
fn scores(
    graph: &Graph,
    times: impl IntoIterator<Item = u64>,
    segment_bytes: u64,
) -> (Memory, Vec<(Version, Time)>) {
    let memory = Memory::default();
    let journal = graph.journal(memory.clone(), settings(segment_bytes)).unwrap();
    let score = graph.vocabulary().attribute("score").unwrap();
    let mut versions = vec![(graph.snapshot().version(), graph.snapshot().time())];
    for (round, time) in times.into_iter().enumerate() {
        #[expect(clippy::cast_precision_loss, reason = "small")]
        let value = round as f64 + 0.5;
        let commit =
            graph.edit(AgentId::DSR, Time(time), |tx| _ = tx.set_attribute("barthel", score, value)).unwrap();
        journal.wait(commit.version).unwrap();
        versions.push((commit.version, Time(time)));
    }
    journal.close().unwrap();
    (memory, versions)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    /// Times order nothing: of the versions that are not later than the time asked for, the newest.
    #[test]
    fn a_time_is_answered_by_the_newest_version_that_is_not_later(
        times in prop::collection::vec(0_u64..30, 0..20),
        segment_bytes in prop_oneof![Just(1_u64), Just(60), Just(1 << 20)],
    ) {
        let (memory, versions) = scores(&world::ward(), times, segment_bytes);
        let recording = Recording::read(memory.segments()).unwrap();
        for asked in (0..32).map(Time) {
            let wanted = versions.iter().rfind(|(_, time)| *time <= asked);
            match (recording.at_time(asked), wanted) {
                (Ok(found), Some((version, time))) => {
                    prop_assert_eq!((found.version(), found.time()), (*version, *time));
                    prop_assert_eq!(bytes(&found), bytes(&recording.at(*version).unwrap()));
                }
                (Err(RecordingError::NoTime { earliest, .. }), None) => {
                    prop_assert_eq!(Some(earliest), versions.iter().map(|(_, time)| *time).min());
                }
                (found, wanted) => prop_assert!(false, "{asked:?}: {wanted:?}, but {found:?}"),
            }
        }
    }
}

/// Where the frames of a segment begin, by their headers, and where the last one ends.
fn frames(segment: &[u8]) -> Vec<usize> {
    let mut starts = vec![0];
    while let Some(header) = segment.get(starts[starts.len() - 1]..).filter(|rest| !rest.is_empty()) {
        let length = u32::from_le_bytes(header[8..12].try_into().unwrap());
        starts.push(starts[starts.len() - 1] + 28 + length as usize);
    }
    starts
}

#[test]
fn a_file_that_ends_between_the_frames_of_its_state_is_named() {
    let graph = world::ward();
    let long = "x".repeat(1_100_000);
    let lines = format!(
        "edge barthel is_in bathing\nset-edge barthel is_in feeding says text {long}\n\
        set-edge barthel is_in bathing says text {long}"
    );
    world::commit(&graph, "dsr", &lines).unwrap();
    let (memory, versions) = scores(&graph, [50], 1);
    let segments = memory.segments();
    let (older, newer) = (&segments[0], &segments[1]);
    let starts = frames(newer);
    assert!(starts.len() > 4, "a state of several frames: {starts:?}");
    for &cut in &starts[..starts.len() - 1] {
        for cut in [cut, cut + 1] {
            let found = Recording::read([older.clone(), newer[..cut].to_vec()]);
            let recording = found.unwrap();
            assert_eq!(recording.last(), versions[1]);
            match recording.damage() {
                // No file of a folder is empty without having been one; in memory it was let go of.
                [] => assert_eq!(cut, 0),
                [Damage::Unfinished { segment }] => {
                    assert!(&**segment == "segment 1" && starts.contains(&cut));
                }
                [Damage::Torn { offset, .. }] => assert!(*offset <= cut && !starts.contains(&cut)),
                other => panic!("{cut}: {other:?}"),
            }
        }
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("00000000.dsr"), older).unwrap();
    std::fs::write(folder.path().join("00000001.dsr.part"), "").unwrap();
    let recording = Recording::open(folder.path()).unwrap();
    assert!(matches!(recording.damage(), [Damage::Unfinished { .. }]), "{:?}", recording.damage());
}

/// Runs a graph with a journal in a folder for some commits.
fn run(graph: &Graph, folder: &Path, commits: u32) {
    let journal = graph.journal(Folder::new(folder).unwrap(), settings(1)).unwrap();
    for round in 0..commits {
        let score = f64::from(round) + f64::from(commits) / 100.0;
        let commit = world::commit(graph, "dsr", &format!("set barthel score number {score}")).unwrap();
        journal.wait(commit.version).unwrap();
    }
    journal.close().unwrap();
}

#[test]
fn who_begins_anew_in_a_folder_begins_another_history() {
    let folder = tempfile::tempdir().unwrap();
    let yesterday = world::ward();
    run(&yesterday, folder.path(), 5);
    let today = world::ward();
    world::commit(&today, "dsr", "set barthel score number 70").unwrap();
    run(&today, folder.path(), 2);
    let recording = Recording::open(folder.path()).unwrap();
    assert_eq!(bytes(&recording.resume().unwrap().snapshot()), bytes(&today.snapshot()));
    let (first, last) = (recording.first().0, recording.last().0);
    assert_eq!(last.0, first.0 + 2);
    for version in first.0..=last.0 {
        assert_eq!(recording.at(Version(version)).unwrap().version(), Version(version));
    }
    assert!(recording.replay().unwrap().all(|played| matches!(played, Ok(dsr::Played::Commit(_)))));
    let left = recording.damage();
    assert!(left.iter().all(|damage| matches!(damage, Damage::OtherHistory { next, .. } if *next == first)));
    assert!(!left.is_empty() && left.len() <= 6, "{left:?}");
    // And each of the others can be read alone.
    let last = left.iter().filter_map(|damage| match damage {
        Damage::OtherHistory { segment, .. } => Some(Recording::open(&**segment).unwrap().last().0),
        _ => None,
    });
    assert_eq!(last.max(), Some(yesterday.snapshot().version()));
}

#[test]
fn who_goes_on_from_an_older_version_begins_another_history() {
    let folder = tempfile::tempdir().unwrap();
    run(&world::ward(), folder.path(), 5);
    let recording = Recording::open(folder.path()).unwrap();
    let (first, older) = (recording.first().0, Version(recording.last().0.0 - 3));
    let graph = Graph::from_snapshot(&recording.at(older).unwrap());
    run(&graph, folder.path(), 1);
    let recording = Recording::open(folder.path()).unwrap();
    assert_eq!((recording.first().0, recording.last().0.0), (first, older.0 + 1));
    assert_eq!(bytes(&recording.resume().unwrap().snapshot()), bytes(&graph.snapshot()));
    assert_eq!(recording.replay().unwrap().filter_map(Result::ok).count() as u64, older.0 + 1 - first.0);
    assert!(recording.damage().iter().all(|damage| matches!(damage, Damage::OtherHistory { .. })));
    assert!(!recording.damage().is_empty());
}

#[test]
fn copies_with_other_names_are_no_segments() {
    let folder = tempfile::tempdir().unwrap();
    run(&world::ward(), folder.path(), 3);
    for name in ["0.dsr", "+0000009.dsr", "000000000.dsr", "x.dsr", "00000009.DSR"] {
        std::fs::copy(folder.path().join("00000000.dsr"), folder.path().join(name)).unwrap();
    }
    let recording = Recording::open(folder.path()).unwrap();
    assert_eq!(recording.damage(), &[]);
    assert_eq!(recording.replay().unwrap().filter_map(Result::ok).count(), 3);
}

#[test]
fn a_segment_with_another_vocabulary_is_left_out() {
    let (ours, versions) = scores(&world::ward(), [50, 60], 1);
    let theirs = Memory::default();
    Graph::new(VocabularyBuilder::new().build())
        .journal(theirs.clone(), settings(1))
        .unwrap()
        .close()
        .unwrap();
    let foreign = theirs.segments().remove(0);
    let mut segments = ours.segments();
    segments.insert(1, foreign.clone());
    let recording = Recording::read(segments.clone()).unwrap();
    assert!(matches!(recording.damage(), [Damage::OtherVocabulary { segment }] if &**segment == "segment 1"));
    for (version, _) in versions {
        assert!(recording.at(version).is_ok());
    }
    // The newest segment says whose recording it is.
    segments.push(foreign);
    let recording = Recording::read(segments).unwrap();
    assert_eq!(recording.last().0, Version(0));
    assert!(recording.damage().iter().all(|damage| matches!(damage, Damage::OtherVocabulary { .. })));
}

#[test]
fn a_segment_of_another_format_is_named() {
    let (memory, versions) = scores(&world::ward(), [50, 60], 1);
    let mut segments = memory.segments();
    let first = &mut segments[0];
    let end = frames(first)[1];
    // The number of the format is the first byte of the payload; both checksums follow it.
    first[28] = 99;
    let sum = crc32fast::hash(&first[28..end]);
    first[12..16].copy_from_slice(&sum.to_le_bytes());
    let sum = crc32fast::hash(&first[..24]);
    first[24..28].copy_from_slice(&sum.to_le_bytes());
    let alone = Recording::read([first.clone()]).unwrap_err();
    assert!(
        matches!(alone, RecordingError::Damaged { damage: Damage::Format { format: 99, .. } }),
        "{alone}"
    );
    let recording = Recording::read(segments).unwrap();
    assert!(matches!(recording.damage(), [Damage::Format { format: 99, .. }]));
    assert_eq!(recording.last(), versions[2]);
}

#[test]
fn a_file_that_cannot_be_read_is_named_and_one_that_is_gone_is_not_missed() {
    let folder = tempfile::tempdir().unwrap();
    run(&world::ward(), folder.path(), 3);
    let last = Recording::open(folder.path()).unwrap().last();
    // A folder with the name of a segment: the system refuses to read it.
    std::fs::remove_file(folder.path().join("00000001.dsr")).unwrap();
    std::fs::create_dir(folder.path().join("00000001.dsr")).unwrap();
    let recording = Recording::open(folder.path()).unwrap();
    assert!(matches!(recording.damage(), [Damage::Unreadable { .. }]), "{:?}", recording.damage());
    assert_eq!(recording.last(), last);
    std::fs::remove_dir(folder.path().join("00000001.dsr")).unwrap();
    // A name without a file is what a reader sees whose journal lets go of a segment at that moment.
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("nowhere", folder.path().join("00000001.dsr")).unwrap();
        let recording = Recording::open(folder.path()).unwrap();
        assert_eq!((recording.damage(), recording.last()), (&[][..], last));
    }
}

#[test]
fn any_number_of_starts_without_a_commit_is_gone_through() {
    let memory = Memory::default();
    let mut builder = VocabularyBuilder::new();
    let thing = builder.node_type("thing", None, Nature::Symbolic).unwrap();
    let graph = Graph::new(builder.build());
    graph.journal(memory.clone(), settings(1)).unwrap().close().unwrap();
    let start = memory.segments().remove(0);
    let journal = graph.journal(memory.clone(), settings(1 << 20)).unwrap();
    graph.edit(AgentId::DSR, Time(7), |tx| _ = tx.add_node("thing", thing)).unwrap();
    journal.close().unwrap();
    let last = memory.segments().pop().unwrap();
    let recording = Recording::read(std::iter::repeat_n(start, 20_000).chain([last])).unwrap();
    assert_eq!(recording.damage(), &[]);
    assert_eq!(recording.replay().unwrap().filter_map(Result::ok).count(), 1);
    assert_eq!(recording.at(Version(1)).unwrap().time(), Time(7));
}

#[test]
fn versions_that_meet_by_chance_are_two_histories() {
    for (theirs, ours, same) in [(1, 2, false), (1, 1, true)] {
        let folder = tempfile::tempdir().unwrap();
        for score in [theirs, ours] {
            let graph = world::ward();
            world::commit(&graph, "dsr", &format!("set barthel score number {score}")).unwrap();
            graph.journal(Folder::new(folder.path()).unwrap(), settings(1)).unwrap().close().unwrap();
        }
        let recording = Recording::open(folder.path()).unwrap();
        assert_eq!(recording.first(), recording.last());
        match recording.damage() {
            // The two cannot be distinguished.
            [] => assert!(same),
            [Damage::OtherHistory { last, next, .. }] => assert!(!same && last == next),
            other => panic!("{other:?}"),
        }
    }
}

/// A journal says whether it goes on, so that higher versions do not look like commits that were left out.
#[test]
fn a_history_that_begins_behind_another_one_is_another_one() {
    let folder = tempfile::tempdir().unwrap();
    let yesterday = world::ward();
    run(&yesterday, folder.path(), 2);
    let today = world::ward();
    for round in 0..5 {
        world::commit(&today, "dsr", &format!("set barthel score number {round}")).unwrap();
    }
    run(&today, folder.path(), 1);
    let recording = Recording::open(folder.path()).unwrap();
    assert!(!recording.damage().is_empty());
    for damage in recording.damage() {
        assert!(matches!(damage, Damage::OtherHistory { last, next, .. } if last < next), "{damage}");
    }
    let (first, last) = (recording.first().0, today.snapshot().version());
    assert!(yesterday.snapshot().version() < first && recording.last().0 == last);
    assert!(recording.replay().unwrap().all(|played| matches!(played, Ok(dsr::Played::Commit(_)))));
}
