//! The contents of folders, and the file near another one that defines a domain.

use crate::files;
use pddl::Source;
use project::{FileKind, Header};
use std::fs;
use std::path::{Path, PathBuf};

/// The file that makes a folder a mission.
pub(crate) const MANIFEST: &str = "mission.toml";

/// Whether a file is checked and formatted when its folder is given. Plans are included only if
/// they are named.
pub(crate) fn is_source(path: &Path) -> bool {
    FileKind::is_definition(&path.to_string_lossy())
}

/// The paths in a folder, in order; empty if the folder cannot be read.
pub(crate) fn entries(folder: &Path) -> Vec<PathBuf> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let mut paths: Vec<PathBuf> =
        fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
    paths.sort();
    paths
}

/// The sources in a file's folder.
pub(crate) fn beside(path: &Path) -> Vec<PathBuf> {
    let folder = path.parent().unwrap_or(Path::new(""));
    entries(folder).into_iter().filter(|path| is_source(path)).collect()
}

/// The file that defines a domain (its name in lower case) for the file at `path`: one beside it, or else one in the
/// robots' folders (`robots/*/`) of a folder above.
pub(crate) fn provider(path: &Path, domain: &str) -> Option<(PathBuf, Source)> {
    nearby(path).find_map(|path| {
        let source = files::read(&path).ok()?;
        Header::of(source.name(), source.text()).defines(domain).then_some((path, source))
    })
}

fn nearby(path: &Path) -> impl Iterator<Item = PathBuf> {
    let absolute = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let above: Vec<PathBuf> = absolute.ancestors().skip(1).map(Path::to_owned).collect();
    let robots = above.into_iter().flat_map(|folder| entries(&folder.join("robots")));
    let theirs = robots.filter(|path| path.is_dir()).flat_map(|robot| entries(&robot));
    beside(path).into_iter().chain(theirs.filter(|path| is_source(path)))
}
