//! Damage is never taken for the torn end of a crash, and a torn end never for damage: any range of bytes is
//! overwritten, or any end cut off, of random journals, also of journals that were never synced while they were
//! written.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use std::time::Duration;

use dsr::{Damage, Durability, Folder, Graph, Memory, Recording, Settings, Snapshot, Version};
use proptest::prelude::*;

/// Frames before the first commit of a segment: the vocabulary and the state, which is small here.
const BEGIN: usize = 2;
/// Bytes of a frame's header.
const HEADER: usize = 28;

/// Like a run at full speed: it is synced where a segment begins and at its end.
fn settings(segment_bytes: u64) -> Settings {
    Settings { durability: Durability::Every(Duration::MAX), segment_bytes, ..Settings::default() }
}

fn bytes(snapshot: &Snapshot) -> String {
    serde_json::to_string(&snapshot.export()).unwrap()
}

/// A journal, and what each version of it is.
struct Recorded {
    versions: BTreeMap<u64, String>,
    segments: Vec<Segment>,
}

struct Segment {
    bytes: Vec<u8>,
    /// Where its frames begin, and where the last one ends.
    frames: Vec<usize>,
    first: u64,
}

impl Segment {
    fn new(bytes: Vec<u8>) -> Self {
        let mut frames = vec![0];
        while let Some(header) = bytes.get(frames[frames.len() - 1]..).filter(|rest| !rest.is_empty()) {
            let length = u32::from_le_bytes(header[8..12].try_into().unwrap());
            frames.push(frames[frames.len() - 1] + HEADER + length as usize);
        }
        let first = Recording::read([bytes.clone()]).unwrap().first().0.0;
        Self { bytes, frames, first }
    }

    /// The frame of a byte.
    fn frame(&self, at: usize) -> usize {
        self.frames.partition_point(|&start| start <= at) - 1
    }

    /// Its versions, if frames up to this one can be read.
    fn versions(&self, frames: usize) -> Range<u64> {
        match frames.checked_sub(BEGIN) {
            Some(commits) => self.first..self.first + 1 + commits as u64,
            None => 0..0,
        }
    }
}

/// Scores, texts and poses; the texts have lengths from none to many.
fn recorded(commits: &[u16], segment_bytes: u64) -> Recorded {
    let graph = world::ward();
    world::commit(&graph, "dsr", "edge barthel is_in feeding").unwrap();
    let memory = Memory::default();
    let mut versions = BTreeMap::from([(graph.snapshot().version().0, bytes(&graph.snapshot()))]);
    let journal = graph.journal(memory.clone(), settings(segment_bytes)).unwrap();
    for (round, &kind) in commits.iter().enumerate() {
        let line = match kind % 3 {
            0 => format!("set barthel score number {kind}.{round}"),
            1 => format!("set-edge barthel is_in feeding says text {}{round}", "x".repeat(kind.into())),
            _ => format!("sample clarc bob {round} {kind} 0"),
        };
        if let Ok(commit) = world::commit(&graph, "dsr", &line) {
            versions.insert(commit.version.0, bytes(&commit.snapshot));
        }
    }
    journal.close().unwrap();
    Recorded { versions, segments: memory.segments().into_iter().map(Segment::new).collect() }
}

impl Recorded {
    /// The journal with other bytes as one of its segments.
    fn with(&self, segment: usize, bytes: Vec<u8>) -> Vec<Vec<u8>> {
        let mut all: Vec<_> = self.segments.iter().map(|segment| segment.bytes.clone()).collect();
        all[segment] = bytes;
        all
    }

    /// Exactly these versions can be read, and are what they were: those of the other segments, and of one
    /// segment those before a frame.
    fn holds(&self, recording: &Recording, damaged: usize, frames: usize) {
        let readable = |version: u64| {
            self.segments.iter().enumerate().any(|(at, segment)| {
                let frames = if at == damaged { frames } else { segment.frames.len() - 1 };
                segment.versions(frames).contains(&version)
            })
        };
        for (&version, live) in &self.versions {
            match recording.at(Version(version)) {
                Ok(found) => assert_eq!((&bytes(&found), readable(version)), (live, true)),
                Err(error) => assert!(!readable(version), "{error}"),
            }
        }
    }
}

/// What is written over bytes.
#[derive(Debug, Clone)]
enum Fill {
    Ones,
    Zeros,
    Flipped(u8),
    Any(Vec<u8>),
}

impl Fill {
    fn over(&self, bytes: &mut [u8]) {
        match self {
            Self::Ones => bytes.fill(0xff),
            Self::Zeros => bytes.fill(0),
            Self::Flipped(bits) => bytes.iter_mut().for_each(|byte| *byte ^= bits),
            Self::Any(any) => bytes.iter_mut().zip(any.iter().cycle()).for_each(|(byte, any)| *byte = *any),
        }
    }
}

fn fills() -> impl Strategy<Value = Fill> {
    prop_oneof![
        Just(Fill::Ones),
        Just(Fill::Zeros),
        (1_u8..).prop_map(Fill::Flipped),
        prop::collection::vec(any::<u8>(), 1..64).prop_map(Fill::Any),
    ]
}

fn lengths() -> impl Strategy<Value = usize> {
    prop_oneof![Just(1), Just(4), 1_usize..40, 1_usize..4_000]
}

fn journals() -> impl Strategy<Value = (Vec<u16>, u64)> {
    let segment_bytes = prop_oneof![Just(1 << 20), Just(1 << 20), Just(400_u64), Just(1)];
    (prop::collection::vec(0_u16..300, 1..30), segment_bytes)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_000))]
    /// Everything before the damage is read, it is named with its file and byte, and it is no torn end if any record
    /// behind it is intact.
    #[test]
    fn overwritten_bytes_are_damage(
        (commits, segment_bytes) in journals(),
        segment in any::<prop::sample::Index>(),
        at in any::<prop::sample::Index>(),
        length in lengths(),
        fill in fills(),
    ) {
        let journal = recorded(&commits, segment_bytes);
        let number = segment.index(journal.segments.len());
        let segment = &journal.segments[number];
        let start = at.index(segment.bytes.len());
        let end = (start + length).min(segment.bytes.len());
        let mut bytes = segment.bytes.clone();
        fill.over(&mut bytes[start..end]);
        let Some(start) = bytes.iter().zip(&segment.bytes).position(|(now, before)| now != before) else {
            return Ok(());
        };
        let frame = segment.frame(start);
        let zeros_at_its_end = bytes.ends_with(&[0; 16]);
        let recording = match Recording::read(journal.with(number, bytes)) {
            Ok(recording) => recording,
            // The only state is gone; that is an error in any case.
            Err(_) => {
                prop_assert!(journal.segments.len() == 1 && frame < BEGIN);
                return Ok(());
            }
        };
        journal.holds(&recording, number, frame);
        let name = format!("segment {number}");
        let behind = segment.frames.iter().filter(|&&frame| frame < segment.bytes.len()).any(|&f| f >= end);
        let is_last = number + 1 == journal.segments.len();
        match recording.damage() {
            [Damage::Corrupt { segment: named, offset, .. }] => {
                prop_assert_eq!((&**named, *offset), (&*name, segment.frames[frame]));
            }
            // Zeros at the end may be blocks that a loss of power left unwritten.
            [Damage::Torn { segment: named, offset, bytes }] => {
                prop_assert!(is_last && !behind && zeros_at_its_end);
                prop_assert_eq!((&**named, *offset), (&*name, segment.frames[frame]));
                prop_assert_eq!(offset + bytes, segment.bytes.len());
            }
            // Nothing is left by which it could be recognised.
            [Damage::Foreign { segment: named }] => prop_assert!(**named == *name && frame == 0 && !behind),
            other => prop_assert!(false, "{other:?}"),
        }
    }

    /// The end of the newest segment may be cut off anywhere, with or without zeros in its place: a torn end, and all
    /// whole records before it. The end of an older segment was synced, so there it is damage.
    #[test]
    fn a_cut_end_is_torn_only_in_the_newest_segment(
        (commits, segment_bytes) in journals(),
        segment in any::<prop::sample::Index>(),
        at in any::<prop::sample::Index>(),
        zeros in prop_oneof![Just(0), Just(0), Just(16), 16_usize..6_000],
    ) {
        let journal = recorded(&commits, segment_bytes);
        let number = segment.index(journal.segments.len());
        let segment = &journal.segments[number];
        let begun = segment.frames[BEGIN];
        let cut = begun + at.index(segment.bytes.len() + 1 - begun);
        let bytes = [&segment.bytes[..cut], &vec![0; zeros]].concat();
        // Its own last bytes may be zeros.
        let cut = bytes.iter().zip(&segment.bytes).take_while(|(now, before)| now == before).count();
        let frame = segment.frame(cut);
        let whole = (zeros == 0 && segment.frames[frame] == cut) || bytes == segment.bytes;
        let recording = Recording::read(journal.with(number, bytes.clone())).unwrap();
        journal.holds(&recording, number, frame);
        let is_last = number + 1 == journal.segments.len();
        match recording.damage() {
            [] => prop_assert!(whole && (is_last || cut == segment.bytes.len())),
            [Damage::Torn { offset, bytes: left, .. }] => {
                prop_assert!(is_last && !whole);
                prop_assert_eq!((*offset, offset + left), (segment.frames[frame], bytes.len()));
            }
            [Damage::Corrupt { offset, .. }] => {
                prop_assert!(!is_last && !whole, "{:?} {zeros}", recording.damage());
                prop_assert_eq!(*offset, segment.frames[frame]);
            }
            // It ends with a whole record, but another segment says that there were more.
            [Damage::Missing { segment: named, offset, .. }] => {
                prop_assert!(!is_last && whole);
                prop_assert_eq!((&**named, *offset), (&*format!("segment {number}"), bytes.len()));
            }
            other => prop_assert!(false, "{other:?}"),
        }
    }
}

/// The case that was found: four bytes in the middle of a run that was synced only at its end.
#[test]
fn four_bytes_in_the_middle_are_not_a_torn_end() {
    let journal = recorded(&(0..300).collect::<Vec<_>>(), 1 << 20);
    let segment = &journal.segments[0];
    let mut bytes = segment.bytes.clone();
    let middle = bytes.len() / 2;
    bytes[middle..middle + 4].fill(0xff);
    let recording = Recording::read([bytes]).unwrap();
    let damage = recording.damage();
    assert!(matches!(damage, [Damage::Corrupt { .. }]), "{damage:?}");
    journal.holds(&recording, 0, segment.frame(middle));
    let lost = recording.last().0.0 - segment.first;
    assert!(lost > 100, "what is before the damage is read: {lost}");
}

/// A long garbage tail is no torn end: an append that is interrupted leaves no other bytes than its own. Headers
/// that promise much cost no more than others.
#[test]
fn garbage_behind_the_last_record_is_damage() {
    let journal = recorded(&[1, 2, 3], 1 << 20);
    let segment = &journal.segments[0];
    let longest = segment.frames.windows(2).map(|frame| frame[1] - frame[0]).max().unwrap();
    let garbage: Vec<u8> = (1..=250).cycle().take(100 * longest).collect();
    let mut promise = segment.bytes[segment.frames[BEGIN]..][..HEADER].to_vec();
    promise[8..12].copy_from_slice(&(1_u32 << 29).to_le_bytes());
    let sum = crc32fast::hash(&promise[..24]);
    promise[24..].copy_from_slice(&sum.to_le_bytes());
    for tail in [garbage, promise.repeat(50_000)] {
        let recording = Recording::read([[&segment.bytes[..], &tail].concat()]).unwrap();
        let end = segment.bytes.len();
        match recording.damage() {
            [Damage::Corrupt { offset, bytes, .. }] => assert_eq!((*offset, *bytes), (end, tail.len())),
            other => panic!("{other:?}"),
        }
        journal.holds(&recording, 0, segment.frames.len() - 1);
    }
}

/// Commits some scores to a journal in a folder; the file of its only segment.
fn run(graph: &Graph, folder: &Path, number: u64) -> std::path::PathBuf {
    let journal = graph.journal(Folder::new(folder).unwrap(), settings(1 << 20)).unwrap();
    for round in 0..5 {
        world::commit(graph, "dsr", &format!("set barthel score number {number}.{round}")).unwrap();
    }
    journal.close().unwrap();
    folder.join(format!("{number:08}.dsr"))
}

/// A program that continues after a crash leaves the torn record where it is. If it began behind what can be read, that
/// was read once, and is damaged now.
#[test]
fn the_end_of_an_earlier_run_is_torn_only_if_the_next_one_began_there() {
    for torn in [true, false] {
        let folder = tempfile::tempdir().unwrap();
        let path = run(&world::ward(), folder.path(), 0);
        let whole = std::fs::read(&path).unwrap();
        let cut = &whole[..whole.len() - 3];
        if torn {
            std::fs::write(&path, cut).unwrap();
        }
        let graph = Recording::open(folder.path()).unwrap().resume().unwrap();
        run(&graph, folder.path(), 1);
        std::fs::write(&path, cut).unwrap();
        let recording = Recording::open(folder.path()).unwrap();
        let commits = recording.replay().unwrap().filter_map(Result::ok).count();
        match recording.damage() {
            [Damage::Torn { offset, bytes, .. }] => assert!(torn && offset + bytes == cut.len()),
            [Damage::Corrupt { offset, bytes, .. }] => assert!(!torn && offset + bytes == cut.len()),
            other => panic!("{other:?}"),
        }
        // Four of the first run, and the second one; or a jump between them.
        assert_eq!(commits, if torn { 9 } else { 10 });
        assert_eq!(bytes(&recording.resume().unwrap().snapshot()), bytes(&graph.snapshot()));
        assert_eq!(std::fs::read(&path).unwrap(), cut);
    }
}

/// A file gets the name of a segment when its state is synced.
#[test]
fn a_state_that_is_cut_is_damage_by_the_name_of_its_file() {
    let graph = world::ward();
    for cut in [0, 10, 500] {
        let folder = tempfile::tempdir().unwrap();
        run(&graph, folder.path(), 0);
        let newer = run(&graph, folder.path(), 1);
        let bytes = std::fs::read(&newer).unwrap();
        std::fs::write(&newer, &bytes[..cut]).unwrap();
        let recording = Recording::open(folder.path()).unwrap();
        let damage = recording.damage();
        assert!(matches!(damage, [Damage::Corrupt { .. } | Damage::Short { .. }]), "{cut}: {damage:?}");
        std::fs::rename(&newer, folder.path().join("00000001.dsr.part")).unwrap();
        let recording = Recording::open(folder.path()).unwrap();
        let damage = recording.damage();
        assert!(matches!(damage, [Damage::Torn { .. } | Damage::Unfinished { .. }]), "{cut}: {damage:?}");
    }
}
