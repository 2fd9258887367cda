//! Reading and writing files.
//!
//! A result is written beside its final place and then renamed: a program that waits for the file
//! never reads a part of it.

use pddl::Source;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A file could not be read or written.
#[derive(Debug, Error)]
pub(crate) enum FileError {
    /// The system's error.
    #[error("cannot read `{}`: {reason}", path.display(), reason = plainly(source))]
    Read { path: PathBuf, source: io::Error },
    /// The text is longer than spans can address.
    #[error("cannot read `{}`: it is larger than 4 GiB", path.display())]
    TooLarge { path: PathBuf },
    /// The system's error.
    #[error("cannot write `{}`: {reason}", path.display(), reason = plainly(source))]
    Write { path: PathBuf, source: io::Error },
}

/// The usual errors in words that do not depend on the system.
fn plainly(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        io::ErrorKind::IsADirectory => "it is a folder".to_owned(),
        _ => error.to_string(),
    }
}

/// Reads a text file; `-` is standard input.
pub(crate) fn read(path: &Path) -> Result<Source, FileError> {
    source(path, read_bytes(path)?)
}

/// Reads the bytes of a file; `-` is standard input.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, FileError> {
    let failed = |source| FileError::Read { path: path.to_owned(), source };
    let mut bytes = Vec::new();
    if path == Path::new("-") {
        io::stdin().lock().read_to_end(&mut bytes).map_err(failed)?;
        return Ok(bytes);
    }
    if path.is_dir() {
        return Err(failed(io::ErrorKind::IsADirectory.into()));
    }
    File::open(path).and_then(|mut file| file.read_to_end(&mut bytes)).map_err(failed)?;
    Ok(bytes)
}

/// Decodes the bytes of a file.
pub(crate) fn source(path: &Path, bytes: Vec<u8>) -> Result<Source, FileError> {
    let name =
        if path == Path::new("-") { "<standard input>".to_owned() } else { path.display().to_string() };
    let text = Source::decode(bytes);
    if text.len() > Source::MAX_BYTES {
        return Err(FileError::TooLarge { path: path.to_owned() });
    }
    Ok(Source::new(name, text))
}

/// Writes all of `text`, or nothing.
pub(crate) fn write(path: &Path, text: &str) -> Result<(), FileError> {
    write_bytes(path, text.as_bytes())
}

/// Writes all of `bytes`, or nothing. Keeps a symbolic link and the permissions of the file.
pub(crate) fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let failed = |source| FileError::Write { path: path.to_owned(), source };
    let existing = fs::metadata(path).ok();
    if existing.as_ref().is_some_and(|m| !m.is_file()) {
        // A device or a pipe must not be replaced by a file.
        return OpenOptions::new()
            .write(true)
            .open(path)
            .and_then(|mut file| file.write_all(bytes))
            .map_err(failed);
    }
    let target = if path.is_symlink() { fs::canonicalize(path).map_err(failed)? } else { path.to_owned() };
    let mut name = target.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.tmp", std::process::id()));
    let beside = target.with_file_name(name);
    let written = File::create(&beside)
        .and_then(|mut file| file.write_all(bytes))
        .and_then(|()| existing.map_or(Ok(()), |m| fs::set_permissions(&beside, m.permissions())))
        .and_then(|()| fs::rename(&beside, &target));
    written.map_err(|source| {
        // The write has failed already; that error is reported even if the remainder cannot be removed.
        let _ = fs::remove_file(&beside);
        failed(source)
    })
}

#[cfg(test)]
mod tests {
    use super::write;

    #[test]
    fn writing_replaces_the_whole_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plan");
        write(&path, "a long first text").unwrap();
        write(&path, "short").unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "short");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
        assert!(write(&folder.path().join("no/such/folder"), "").is_err());
    }
}
