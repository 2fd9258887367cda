//! The files that `pelea check` reads: those given, those in given folders, and those that they need.

use crate::files;
use crate::nearby::{MANIFEST, beside, entries, is_source, provider};
use pddl::Source;
use project::{FileKind, Header, Need};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// A file to check, or one that such a file needs.
pub(super) struct Candidate {
    pub(super) path: PathBuf,
    pub(super) source: Source,
    header: Header,
    /// Whether the user named it; the others are read only because a given file needs them.
    pub(super) given: bool,
}

impl Candidate {
    pub(super) fn new(path: PathBuf, source: Source, given: bool) -> Self {
        let header = Header::of(source.name(), source.text());
        Self { path, source, header, given }
    }

    fn defines(&self, domain: &str) -> bool {
        self.header.defines(domain)
    }
}

/// Collects the sources in a folder and below it, in order. A folder with a `mission.toml` goes to `missions` as a whole.
pub(super) fn sources_below(folder: &Path, found: &mut Vec<PathBuf>, missions: &mut Vec<PathBuf>) {
    if folder.join(MANIFEST).is_file() {
        missions.push(folder.to_owned());
        return;
    }
    let (folders, files): (Vec<_>, Vec<_>) = entries(folder).into_iter().partition(|path| path.is_dir());
    found.extend(files.into_iter().filter(|path| is_source(path)));
    for folder in folders.iter().filter(|folder| !folder.is_symlink()) {
        sources_below(folder, found, missions);
    }
}

/// Adds the files that define what the others need, where no given file defines it.
pub(super) fn find_needs(files: &mut Vec<Candidate>) {
    let mut sought = BTreeSet::new();
    let mut next = 0;
    while let Some(file) = files.get(next) {
        let (path, needs, kind) = (file.path.clone(), file.header.needs.clone(), file.header.kind);
        next += 1;
        // A plan does not name its problem, so the files in its folder are candidates.
        if kind == FileKind::Plan {
            for path in beside(&path) {
                if files.iter().all(|file| file.path != path)
                    && let Ok(source) = files::read(&path)
                {
                    files.push(Candidate::new(path, source, false));
                }
            }
        }
        for Need { name, .. } in needs {
            if files.iter().any(|f| f.defines(&name)) || !sought.insert((path.clone(), name.clone())) {
                continue;
            }
            if let Some((path, source)) = provider(&path, &name) {
                files.push(Candidate::new(path, source, false));
            }
        }
    }
}
