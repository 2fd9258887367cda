//! The seeds of the fuzz target `validate`, read as fuzzing reads them: what was found once stays found.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[path = "support/triple.rs"]
#[expect(unreachable_pub, reason = "public for the fuzz target")]
mod triple;

use std::path::Path;

#[test]
fn every_seed_holds() {
    let seeds = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/fuzz/seeds/validate");
    let mut files: Vec<_> = std::fs::read_dir(seeds).unwrap().map(|file| file.unwrap().path()).collect();
    files.sort();
    assert!(!files.is_empty());
    for path in files {
        println!("{}", path.display());
        triple::check(&std::fs::read(path).unwrap());
    }
}
