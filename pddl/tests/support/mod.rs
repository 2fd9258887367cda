//! What several test files share.

use std::path::{Path, PathBuf};

/// All PDDL, HDDL and plan files below a folder, in order of their paths.
pub(crate) fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("the folder can be read") {
            let path = entry.expect("the folder can be read").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "pddl" || e == "hddl" || e == "plan") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}
