//! Stores: disks that stall, fail, panic or fill up slow no commit and are reported; folders keep the configured segments.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use std::io;
use std::num::NonZeroU64;
use std::path::Path;
use std::sync::mpsc;
use std::time::Duration;

use dsr::{
    AgentId, Durability, Folder, Graph, Memory, Recording, RecordingError, Settings, Snapshot, Store, Time,
    Version,
};

fn bytes(snapshot: &Snapshot) -> String {
    serde_json::to_string(&snapshot.export()).unwrap()
}

fn settings() -> Settings {
    Settings { durability: Durability::Each, ..Settings::default() }
}

/// A store that blocks until the test lets it continue.
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

    fn keep(&mut self, newest: NonZeroU64) -> io::Result<()> {
        self.memory.keep(newest)
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

/// A store that only appends, with a hook of the test.
struct Appends<F>(F);

impl<F: FnMut(&[u8]) -> io::Result<()> + Send + 'static> Store for Appends<F> {
    fn begin(&mut self, _: u64) -> io::Result<()> {
        Ok(())
    }

    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        (self.0)(bytes)
    }

    fn sync(&mut self) -> io::Result<()> {
        Ok(())
    }

    fn keep(&mut self, _: NonZeroU64) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_told_and_the_graph_goes_on() {
    let graph = world::ward();
    let mut left = 5_000_usize;
    let full = Appends(move |bytes: &[u8]| {
        left = left.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
        Ok(())
    });
    let journal = graph.journal(full, settings()).unwrap();
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

/// A store whose appends block until the test lets them continue, and which reports each append.
struct Gated {
    memory: Memory,
    came: mpsc::Sender<()>,
    go_on: mpsc::Receiver<()>,
}

impl Store for Gated {
    fn begin(&mut self, number: u64) -> io::Result<()> {
        self.memory.begin(number)
    }

    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        let _ = self.came.send(());
        let _ = self.go_on.recv();
        self.memory.append(bytes)
    }

    fn sync(&mut self) -> io::Result<()> {
        Ok(())
    }

    fn keep(&mut self, newest: NonZeroU64) -> io::Result<()> {
        self.memory.keep(newest)
    }
}

/// The disk stalls at one append after the other: of the commit's frame, and of the vocabulary and the state of the
/// segment that begins behind it.
#[test]
fn commits_that_are_left_out_while_a_segment_ends_or_begins_are_a_gap() {
    for stalled in 0..3 {
        let graph = world::ward();
        let memory = Memory::default();
        let (told, came) = mpsc::channel();
        let (go_on, gate) = mpsc::channel();
        let store = Gated { memory: memory.clone(), came: told, go_on: gate };
        let settings = Settings { waiting_bytes: 2_000, segment_bytes: 1, ..settings() };
        let journal = graph.journal(store, settings).unwrap();
        let pass = |appends| {
            for _ in 0..appends {
                came.recv().unwrap();
                go_on.send(()).unwrap();
            }
        };
        pass(2);
        let first = world::commit(&graph, "dsr", "set barthel score number -1").unwrap().version;
        pass(stalled);
        // The thread has taken that commit, and nothing was lost by then.
        came.recv().unwrap();
        for round in 0..1_000 {
            world::commit(&graph, "dsr", &format!("set barthel score number {round}")).unwrap();
        }
        drop(go_on);
        let last = graph.snapshot();
        let progress = journal.wait(last.version()).unwrap();
        assert_eq!((progress.gaps, progress.durable), (1, last.version()), "append {stalled}");
        journal.close().unwrap();
        let recording = Recording::read(memory.segments()).unwrap();
        assert_eq!(recording.damage(), &[]);
        assert_eq!(bytes(&recording.at(last.version()).unwrap()), bytes(&last));
        assert_eq!(recording.at(first).unwrap().version(), first);
        let lost = recording.at(Version(last.version().0 - 1)).unwrap_err();
        assert!(matches!(lost, RecordingError::NotRecorded { .. }), "{lost}");
    }
}

#[test]
fn a_store_that_panics_is_told_and_the_graph_goes_on() {
    for appends in [0_usize, 2] {
        let graph = world::ward();
        let before = graph.snapshot().version();
        let mut left = appends;
        let panics = Appends(move |_: &[u8]| {
            left = left.checked_sub(1).expect("a fault of the store's author");
            Ok(())
        });
        let journal = graph.journal(panics, settings()).unwrap();
        let commit = world::commit(&graph, "dsr", "set barthel score number 1").unwrap();
        let failed = journal.wait(commit.version).unwrap_err();
        assert_eq!(failed.durable, if appends == 0 { Version(0) } else { before });
        assert!(failed.to_string().contains("panicked"), "{failed}");
        world::commit(&graph, "dsr", "set barthel score number 2").unwrap();
        assert!(journal.progress().is_err() && journal.close().is_err());
    }
}

#[test]
fn a_journal_that_never_has_to_sync_does_when_it_is_asked_to() {
    let graph = world::ward();
    let settings = Settings { durability: Durability::Every(Duration::MAX), ..Settings::default() };
    let journal = graph.journal(Memory::default(), settings).unwrap();
    for round in 0..3 {
        let line = format!("set barthel score number {round}");
        let commit = world::commit(&graph, "dsr", &line).unwrap();
        assert_eq!(journal.wait(commit.version).unwrap().durable, commit.version);
    }
    let commit = world::commit(&graph, "dsr", "set barthel score number 9").unwrap();
    assert_eq!(journal.close().unwrap().durable, commit.version);
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_robot_that_is_restarted_keeps_as_many_segments_as_it_was_told() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    std::fs::write(folder.path().join("7.dsr"), "not a segment's name").unwrap();
    let kept = |segments| Settings { segment_bytes: 1, segments: NonZeroU64::new(segments), ..settings() };
    let day = |graph: &Graph, settings| {
        let journal = graph.journal(Folder::new(folder.path()).unwrap(), settings).unwrap();
        for round in 0..3 {
            let commit = world::commit(graph, "dsr", &format!("set barthel score number {round}")).unwrap();
            journal.wait(commit.version).unwrap();
        }
        journal.close().unwrap();
    };
    let resumed = || Recording::open(folder.path()).unwrap().resume().unwrap();
    let numbers = |range: std::ops::Range<u64>| {
        let names = range.map(|number| format!("{number:08}.dsr"));
        names.chain(["7.dsr".to_owned(), "notes.txt".to_owned()]).collect::<Vec<_>>()
    };
    day(&world::ward(), kept(100));
    let first = names(folder.path()).len() as u64 - 2;
    assert!(first >= 3);
    // The second day begins with all that the first one left, and no more is let go of than asked.
    day(&resumed(), kept(first + 2));
    let second = names(folder.path());
    assert_eq!(second.len() as u64, first + 4);
    let yesterday = world::ward().snapshot().version();
    let oldest = Recording::open(folder.path()).unwrap().first().0;
    assert!(yesterday < oldest && oldest.0 <= yesterday.0 + 3, "some of yesterday is left");
    // On the third there is room for two.
    let (graph, begun) = (resumed(), Recording::open(folder.path()).unwrap().last().0);
    day(&graph, kept(2));
    let third = names(folder.path());
    assert_eq!(third.len(), 4);
    assert_eq!(third[2..], numbers(0..0));
    let recording = Recording::open(folder.path()).unwrap();
    assert!(recording.first().0 > begun && recording.last().0.0 == begun.0 + 3);
    // And one that keeps everything does.
    day(&resumed(), kept(u64::MAX));
    day(&resumed(), Settings { segments: None, ..kept(1) });
    assert!(names(folder.path()).starts_with(&third[..2]));
}

#[test]
fn a_journal_goes_on_behind_the_one_before_and_outlives_its_graph() {
    let folder = tempfile::tempdir().unwrap();
    let graph = world::ward();
    let journal = graph.journal(Folder::new(folder.path()).unwrap(), Settings::default()).unwrap();
    world::commit(&graph, "dsr", "set barthel score number 1").unwrap();
    let before = bytes(&graph.snapshot());
    // All handles of the graph are dropped; what was committed is written all the same.
    drop(graph);
    journal.close().unwrap();

    let recording = Recording::open(folder.path()).unwrap();
    let graph: Graph = recording.resume().unwrap();
    assert_eq!(bytes(&graph.snapshot()), before);
    let store = Folder::new(folder.path()).unwrap();
    assert!(!store.is_fresh());
    let journal = graph.journal(store, Settings::default()).unwrap();
    let score = graph.vocabulary().attribute("score").unwrap();
    graph.edit(AgentId::DSR, Time(9), |tx| _ = tx.set_attribute("barthel", score, 2.0)).unwrap();
    journal.close().unwrap();

    let recording = Recording::open(folder.path()).unwrap();
    assert_eq!(recording.replay().unwrap().filter_map(Result::ok).count(), 2);
    assert_eq!(bytes(&recording.at(recording.last().0).unwrap()), bytes(&graph.snapshot()));
    assert!(matches!(Recording::open(folder.path().join("none")), Err(RecordingError::Unreadable { .. })));
}

/// A folder on a disk that is full after some bytes.
struct Filling {
    folder: Folder,
    left: usize,
}

impl Store for Filling {
    fn begin(&mut self, number: u64) -> io::Result<()> {
        self.folder.begin(number)
    }

    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        let fits = bytes.len().min(self.left);
        self.left -= fits;
        self.folder.append(&bytes[..fits])?;
        if fits < bytes.len() { Err(io::ErrorKind::StorageFull.into()) } else { Ok(()) }
    }

    fn sync(&mut self) -> io::Result<()> {
        self.folder.sync()
    }

    fn keep(&mut self, newest: NonZeroU64) -> io::Result<()> {
        self.folder.keep(newest)
    }
}

#[test]
fn starts_that_die_before_their_state_is_written_push_no_history_out() {
    let folder = tempfile::tempdir().unwrap();
    let kept = Settings { segment_bytes: 1, segments: NonZeroU64::new(3), ..settings() };
    let graph = world::ward();
    let journal = graph.journal(Folder::new(folder.path()).unwrap(), kept.clone()).unwrap();
    for round in 0..5 {
        let commit = world::commit(&graph, "dsr", &format!("set barthel score number {round}")).unwrap();
        journal.wait(commit.version).unwrap();
    }
    journal.close().unwrap();
    let before = names(folder.path());
    assert_eq!(before.len(), 3);
    let (first, last) = (Recording::open(folder.path()).unwrap().first(), graph.snapshot());
    for left in [0, 10, 500] {
        let full = Filling { folder: Folder::new(folder.path()).unwrap(), left };
        let failed = graph.journal(full, kept.clone()).unwrap().close().unwrap_err();
        assert_eq!(failed.error.kind(), io::ErrorKind::StorageFull);
        let recording = Recording::open(folder.path()).unwrap();
        assert_eq!((recording.first(), recording.last().0), (first, last.version()));
    }
    assert_eq!(names(folder.path()).len(), 6, "what was begun is named to who reads");
    let cut = Recording::open(folder.path()).unwrap();
    assert_eq!(cut.damage().len(), 3, "{:?}", cut.damage());
    // There is room again.
    graph.journal(Folder::new(folder.path()).unwrap(), kept).unwrap().close().unwrap();
    let after = names(folder.path());
    assert_eq!(after[..2], before[1..]);
    assert_eq!(after.len(), 3);
    let recording = Recording::open(folder.path()).unwrap();
    assert_eq!(recording.damage(), &[]);
    assert_eq!(bytes(&recording.at(last.version()).unwrap()), bytes(&last));
    assert!(recording.first().0 < last.version());
}

#[test]
fn a_state_that_is_there_without_its_name_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let graph = world::ward();
    graph.journal(Folder::new(folder.path()).unwrap(), settings()).unwrap().close().unwrap();
    assert_eq!(names(folder.path()), ["00000000.dsr"]);
    let at = |name| folder.path().join(name);
    std::fs::rename(at("00000000.dsr"), at("00000000.dsr.part")).unwrap();
    let recording = Recording::open(folder.path()).unwrap();
    assert_eq!(recording.damage(), &[]);
    assert_eq!(bytes(&recording.resume().unwrap().snapshot()), bytes(&graph.snapshot()));
    assert!(!Folder::new(folder.path()).unwrap().is_fresh());
}

#[test]
fn two_journals_that_begin_in_a_folder_at_once_do_not_write_over_each_other() {
    let folder = tempfile::tempdir().unwrap();
    let (one, other) = (Folder::new(folder.path()).unwrap(), Folder::new(folder.path()).unwrap());
    let graph = world::ward();
    graph.journal(one, settings()).unwrap().close().unwrap();
    let failed = graph.journal(other, settings()).unwrap().close().unwrap_err();
    assert_eq!(failed.error.kind(), io::ErrorKind::AlreadyExists);
    assert_eq!(names(folder.path()), ["00000000.dsr"]);
}
