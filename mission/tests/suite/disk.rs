//! The workspace's files, by their paths from its root.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use mission::{FileError, Files};

/// The workspace's folder.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned()
}

/// Reads from the disk.
pub(crate) struct Disk;

fn error(error: &std::io::Error) -> FileError {
    match error.kind() {
        ErrorKind::NotFound => FileError::NotFound,
        _ => FileError::Unreadable { reason: error.to_string() },
    }
}

impl Files for Disk {
    fn read(&self, path: &str) -> Result<String, FileError> {
        std::fs::read_to_string(root().join(path)).map_err(|e| error(&e))
    }

    fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
        let entries = std::fs::read_dir(root().join(folder)).map_err(|e| error(&e))?;
        Ok(entries.map(|e| e.unwrap().file_name().to_str().unwrap().to_owned()).collect())
    }
}
