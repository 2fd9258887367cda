//! The source of a mission's texts.
//!
//! Problem: a mission is a folder, but tests, an editor's unsaved buffers and an archive must also be able to hold one.
//! Idea: this crate touches no disk; it reads through a trait of two functions over `/`-separated paths. Invariant: the
//! paths that reach [`Files`] are normal: without `.`, and with `..` only at the front.

use std::collections::BTreeMap;

/// Why a text could not be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FileError {
    /// The file or folder does not exist.
    #[error("no such file or folder")]
    NotFound,
    /// It exists, but cannot be read as UTF-8 text.
    #[error("{reason}")]
    Unreadable {
        /// The error of the file system.
        reason: String,
    },
}

/// Texts by path.
pub trait Files {
    /// The text of a file.
    fn read(&self, path: &str) -> Result<String, FileError>;

    /// The names (not the paths) of the files in a folder, in any order. A missing folder is [`FileError::NotFound`].
    fn list(&self, folder: &str) -> Result<Vec<String>, FileError>;
}

/// Files in memory, for tests and examples.
#[derive(Clone, Debug, Default)]
pub struct MemoryFiles {
    /// Path to text.
    pub texts: BTreeMap<String, String>,
}

impl Files for MemoryFiles {
    fn read(&self, path: &str) -> Result<String, FileError> {
        self.texts.get(path).cloned().ok_or(FileError::NotFound)
    }

    fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
        let prefix = if folder.is_empty() { String::new() } else { format!("{folder}/") };
        let names: Vec<String> = self
            .texts
            .keys()
            .filter_map(|path| path.strip_prefix(&prefix))
            .filter(|rest| !rest.contains('/'))
            .map(str::to_owned)
            .collect();
        if names.is_empty() { Err(FileError::NotFound) } else { Ok(names) }
    }
}

/// `relative` as seen from `folder`, without `.` and with `..` resolved as far as `folder` goes.
pub(crate) fn join(folder: &str, relative: &str) -> String {
    if relative.starts_with('/') {
        return relative.to_owned();
    }
    let mut parts: Vec<&str> = Vec::new();
    for part in folder.split('/').chain(relative.split('/')) {
        match part {
            "." => {}
            // An empty part at the front is the root; elsewhere it has no meaning.
            "" if !parts.is_empty() => {}
            ".." if parts.last().is_some_and(|&last| last != ".." && !last.is_empty()) => {
                parts.pop();
            }
            part => parts.push(part),
        }
    }
    if folder.is_empty() && parts.first() == Some(&"") {
        parts.remove(0);
    }
    parts.join("/")
}

/// The last part of a path without its extension.
pub(crate) fn stem(path: &str) -> &str {
    let name = path.rsplit('/').next().unwrap_or(path);
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

#[cfg(test)]
mod tests {
    use super::{join, stem};

    #[test]
    fn paths_are_normal() {
        assert_eq!(join("domains/a", "../../robots/r"), "robots/r");
        assert_eq!(join("domains/a/", "./x.toml"), "domains/a/x.toml");
        assert_eq!(join(".", "x"), "x");
        assert_eq!(join("", "x"), "x");
        assert_eq!(join("/m", "../../x"), "/../x");
        assert_eq!(join("..", "../x"), "../../x");
        assert_eq!(stem("a/b.c/d.toml"), "d");
    }
}
