//! The file system, as the language server reads it.

use crate::files;
use ::lsp::{Entry, ReadError};
use std::fs::{self, DirEntry};
use std::path::Path;

/// The file system.
pub(super) struct Disk;

impl ::lsp::Disk for Disk {
    fn list(&self, folder: &str) -> Vec<Entry> {
        let mut found: Vec<Entry> = fs::read_dir(folder)
            .into_iter()
            .flatten()
            .flatten()
            .filter_map(|entry| entry_of(&entry))
            .collect();
        found.sort();
        found
    }

    fn read(&self, path: &str, max_bytes: u64) -> Result<String, ReadError> {
        let path = Path::new(path);
        let about = fs::metadata(path).map_err(|error| ReadError::Unreadable(error.to_string()))?;
        if !about.is_file() {
            // Reading a pipe would block.
            return Err(ReadError::Unreadable("it is no file".to_owned()));
        }
        if about.len() > max_bytes {
            return Err(ReadError::TooLarge(max_bytes));
        }
        let source = files::read(path).map_err(|error| ReadError::Unreadable(error.to_string()))?;
        Ok(source.text().to_owned())
    }
}

/// A name that is not Unicode has no URI that every client understands.
fn entry_of(entry: &DirEntry) -> Option<Entry> {
    let name = entry.file_name().into_string().ok()?;
    let kind = entry.file_type().ok()?;
    if kind.is_dir() {
        return Some(Entry::Folder(name));
    }
    let is_file = kind.is_file() || kind.is_symlink() && entry.path().is_file();
    is_file.then_some(Entry::File(name))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test")]
    use super::Disk;
    use ::lsp::{Disk as _, Entry, ReadError};

    #[test]
    fn folders_are_listed_and_files_read() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("b")).unwrap();
        std::fs::write(folder.path().join("a é.pddl"), b"\xef\xbb\xbfcaf\xc3\xa9").unwrap();
        let root = folder.path().to_str().unwrap();
        assert_eq!(Disk.list(root), [Entry::File("a é.pddl".into()), Entry::Folder("b".into())]);
        let file = format!("{root}/a é.pddl");
        assert_eq!(Disk.read(&file, 100), Ok("café".into()));
        assert_eq!(Disk.read(&file, 3), Err(ReadError::TooLarge(3)));
        assert!(matches!(Disk.read(root, 100), Err(ReadError::Unreadable(_))));
        assert_eq!(Disk.list("/no such folder"), []);
    }
}
