//! The robots and missions of this repository have no findings, except lints that a comment allows.

use std::path::{Path, PathBuf};

use project::Project;

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("the folder can be read") {
        let path = entry.expect("the folder can be read").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "pddl" || e == "hddl") {
            found.push(path);
        }
    }
}

#[test]
fn nothing_is_to_be_said_of_our_own_files() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut paths = Vec::new();
    ["robots", "domains"].iter().for_each(|folder| sources(&root.join(folder), &mut paths));
    assert!(!paths.is_empty());
    let mut project = Project::new();
    for path in &paths {
        let name =
            path.strip_prefix(&root).expect("it is below the root").to_string_lossy().replace('\\', "/");
        project.set(&name, std::fs::read_to_string(path).expect("the file can be read"));
    }
    let said: String = project
        .ids()
        .flat_map(|id| project.findings(id))
        .map(|finding| project.sources().describe(&finding))
        .collect();
    assert!(said.is_empty(), "{said}");
}
