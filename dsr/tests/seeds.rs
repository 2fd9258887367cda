//! The seeds of the fuzz targets, read as fuzzing reads them: what was found once stays found.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]
#![allow(clippy::print_stdout, reason = "the last line is the seed that failed")]

#[path = "support/story.rs"]
mod story;

use std::path::{Path, PathBuf};

fn seeds(target: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/fuzz/seeds").join(target)
}

fn files(target: &str) -> impl Iterator<Item = Vec<u8>> {
    let files = std::fs::read_dir(seeds(target)).expect("each target has seeds");
    files.map(|file| {
        let path = file.unwrap().path();
        println!("{}", path.display());
        std::fs::read(path).unwrap()
    })
}

#[test]
fn every_journal_holds() {
    files("journal").for_each(|bytes| story::check(&bytes));
}

/// The first seed is a journal as it is written now; `UPDATE_EXPECT=1` writes it anew.
#[test]
fn the_first_seed_is_a_journal_of_today() {
    let path = seeds("journal").join("world.dsr");
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(&path, story::segment()).unwrap();
    }
    let recording = dsr::Recording::open(&path).unwrap();
    assert_eq!(recording.damage(), &[]);
    assert!(recording.last().0.0 >= 6 && std::fs::read(&path).unwrap() == story::segment());
}

/// Journals from before gaps were recorded, with several commits in a frame, and from before reflexes were.
#[test]
fn journals_of_formats_before_are_read() {
    let today = dsr::Recording::open(seeds("journal").join("world.dsr")).unwrap();
    for older in ["format-2.dsr", "format-3.dsr"] {
        let recording = dsr::Recording::open(seeds("journal").join(older)).unwrap();
        assert_eq!(recording.damage(), &[]);
        let last = |recording: &dsr::Recording| recording.at(recording.last().0).unwrap().export();
        assert_eq!(last(&recording), last(&today));
    }
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(256))]
    /// A little of what fuzzing does for longer.
    #[test]
    fn random_stories_hold(bytes in proptest::collection::vec(proptest::prelude::any::<u8>(), 0..1_000)) {
        story::check(&bytes);
    }
}
