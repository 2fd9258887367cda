//! The mission of these tests: a waiter takes one order. See `tests/tea`.

use std::path::Path;

use mission::{MemoryFiles, Mission};

use crate::disk;

/// Its files.
pub(crate) fn files() -> MemoryFiles {
    let mut files = MemoryFiles::default();
    collect(&disk::root().join("mission/tests/tea"), "tea", &mut files);
    files
}

/// The mission itself.
pub(crate) fn mission() -> Mission {
    Mission::load(&files(), "tea").unwrap_or_else(|errors| panic!("{errors}"))
}

/// The files of a folder, by their paths below `under`.
fn collect(folder: &Path, under: &str, into: &mut MemoryFiles) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = format!("{under}/{}", path.file_name().unwrap().to_str().unwrap());
        if path.is_dir() {
            collect(&path, &name, into);
        } else {
            into.texts.insert(name, std::fs::read_to_string(path).unwrap());
        }
    }
}
