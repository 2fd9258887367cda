//! Mission folders on a disk, and the findings about them.

use crate::console::Console;
use crate::exit::Exit;
use crate::files;
use crate::render;
use diagnostics::{Finding, Sources};
use mission::{FileError, Files};
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

/// The file system.
pub(crate) struct Disk;

impl Files for Disk {
    fn read(&self, path: &str) -> Result<String, FileError> {
        let path = Path::new(path);
        if !path.exists() {
            return Err(FileError::NotFound);
        }
        match files::read(path) {
            Ok(source) => Ok(source.text().to_owned()),
            Err(error) => Err(FileError::Unreadable { reason: error.to_string() }),
        }
    }

    fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
        let entries = fs::read_dir(folder).map_err(|error| match error.kind() {
            ErrorKind::NotFound => FileError::NotFound,
            _ => FileError::Unreadable { reason: error.to_string() },
        })?;
        Ok(entries
            .flatten()
            .filter(|entry| entry.path().is_file())
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .collect())
    }
}

/// Shows all findings at their places. [`Exit::Unreadable`] if there is an error among them.
pub(crate) fn show(sources: &Sources, findings: &[Finding], console: &mut Console<'_>) -> Exit {
    findings.iter().for_each(|finding| render::show(sources, finding, console));
    if findings.iter().any(Finding::is_error) { Exit::Unreadable } else { Exit::Yes }
}
