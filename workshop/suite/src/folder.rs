//! The files of a suite, as the caller found them.

use pddl::Source;

/// A file of a suite.
#[derive(Clone, Debug)]
pub struct File {
    /// Its path from the suite's folder, with `/` between folders.
    pub path: String,
    /// Its text, with the name that is shown.
    pub source: Source,
}

/// A folder with an `expected.toml`.
#[derive(Clone, Debug)]
pub struct Folder {
    /// The path that is shown; empty for the current folder.
    pub path: String,
    /// `expected.toml`
    pub expected: Source,
    /// Domains, problems and plans in the folder and below, but for those that belong to a suite further down.
    pub files: Vec<File>,
    /// Domains from other folders that those in this one need.
    pub elsewhere: Vec<Source>,
}

/// A path without its last extension.
pub(crate) fn without_extension(path: &str) -> &str {
    match path.rsplit_once('.') {
        Some((stem, extension)) if !stem.is_empty() && !extension.contains('/') => stem,
        _ => path,
    }
}

/// The last part of a path, without its extension.
pub(crate) fn stem(path: &str) -> &str {
    without_extension(path.rsplit('/').next().unwrap_or(path))
}

/// The last folder of a path.
pub(crate) fn last_folder(path: &str) -> Option<&str> {
    path.rsplit('/').nth(1)
}

/// Whether an author who writes `key` may mean the file at `path`: its path, or the end of it, with or without the
/// extension.
pub(crate) fn names(key: &str, path: &str) -> bool {
    [path, without_extension(path)]
        .into_iter()
        .any(|full| full.strip_suffix(key).is_some_and(|before| before.is_empty() || before.ends_with('/')))
}

#[cfg(test)]
mod tests {
    use super::{last_folder, names, stem, without_extension};

    #[test]
    fn any_end_of_its_path_names_a_file() {
        for key in ["a.b", "a.b.plan", "valid/a.b", "plans/valid/a.b.plan"] {
            assert!(names(key, "plans/valid/a.b.plan"), "{key}");
        }
        for key in ["b", "a", "id/a.b", "plans", "", "/plans/valid/a.b"] {
            assert!(!names(key, "plans/valid/a.b.plan"), "{key}");
        }
    }

    #[test]
    fn parts_of_paths() {
        assert_eq!((stem("x/a.b.plan"), stem("plan"), stem(".plan")), ("a.b", "plan", ".plan"));
        assert_eq!(without_extension("a.b/plan"), "a.b/plan");
        assert_eq!((last_folder("p/valid/x"), last_folder("x")), (Some("valid"), None));
    }
}
