//! Suites on a disk.

use crate::files::{self, FileError};
use crate::nearby::{MANIFEST as MISSION, entries, provider};
use pddl::Source;
use project::{FileKind, Header};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use suite::{File, Folder};

/// The file that makes a folder a suite.
pub(super) const EXPECTED: &str = "expected.toml";

/// The folders with an `expected.toml` at or below a folder, in order. Skips hidden folders and
/// `target`.
pub(super) fn folders(folder: &Path, found: &mut Vec<PathBuf>) {
    folders_with(EXPECTED, folder, found);
}

/// The folders of missions at or below a folder, in order; skips the same ones.
pub(super) fn missions(folder: &Path, found: &mut Vec<PathBuf>) {
    folders_with(MISSION, folder, found);
}

fn folders_with(file: &str, folder: &Path, found: &mut Vec<PathBuf>) {
    if folder.join(file).is_file() {
        found.push(folder.to_owned());
    }
    for below in folders_in(folder) {
        folders_with(file, &below, found);
    }
}

fn folders_in(folder: &Path) -> Vec<PathBuf> {
    let mut below = entries(folder);
    below.retain(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        path.is_dir() && !path.is_symlink() && !name.starts_with('.') && name != "target"
    });
    below
}

/// Reads the files of a suite.
pub(super) fn read(folder: &Path) -> Result<Folder, FileError> {
    let expected = files::read(&folder.join(EXPECTED))?;
    read_with(folder, &expected)
}

/// Reads the files of a suite, with `expected` in place of the `expected.toml` on the disk.
pub(super) fn read_with(folder: &Path, expected: &Source) -> Result<Folder, FileError> {
    let expected = Source::new(shown(&folder.join(EXPECTED)), expected.text());
    let mut files = Vec::new();
    files_below(folder, folder, &mut files)?;
    let elsewhere = elsewhere(folder, &files);
    Ok(Folder { path: shown(folder), expected, files, elsewhere })
}

fn files_below(root: &Path, folder: &Path, found: &mut Vec<File>) -> Result<(), FileError> {
    for path in entries(folder) {
        let relative = with_slashes(path.strip_prefix(root).unwrap_or(&path));
        if path.is_file() && FileKind::is_source(&relative) {
            let source = files::read(&path)?;
            found.push(File { path: relative, source: Source::new(shown(&path), source.text()) });
        }
    }
    for below in folders_in(folder) {
        if !below.join(EXPECTED).is_file() && !below.join(MISSION).is_file() {
            files_below(root, &below, found)?;
        }
    }
    Ok(())
}

/// Files elsewhere that define the names that the suite's files need but do not define.
fn elsewhere(folder: &Path, files: &[File]) -> Vec<Source> {
    let headers: Vec<Header> = files.iter().map(|file| Header::of(&file.path, file.source.text())).collect();
    let mut needed: Vec<String> =
        headers.iter().flat_map(|h| h.needs.iter().map(|need| need.name.clone())).collect();
    let mut defined: BTreeSet<String> =
        headers.iter().filter(|h| h.kind == FileKind::Domain).map(|h| h.name.clone()).collect();
    let mut found = Vec::new();
    // A file that is found may need others in turn; each name is looked for once.
    while let Some(name) = needed.pop() {
        if !defined.insert(name.clone()) {
            continue;
        }
        let folders = [Some(folder), folder.parent()];
        let mut near = folders.into_iter().flatten().map(|folder| folder.join(EXPECTED));
        if let Some((_, source)) = near.find_map(|beside| provider(&beside, &name)) {
            let header = Header::of(source.name(), source.text());
            needed.extend(header.needs.into_iter().map(|need| need.name));
            found.push(source);
        }
    }
    found
}

/// A path for display: `/` between folders, and no `./` before it.
pub(super) fn shown(path: &Path) -> String {
    with_slashes(path.strip_prefix(".").unwrap_or(path))
}

fn with_slashes(path: &Path) -> String {
    path.display().to_string().replace(std::path::MAIN_SEPARATOR, "/")
}
