//! What tests across crates share: running `pelea` in this process and reading what it said.

pub mod crashes;

use cli::{Console, Exit};
use std::path::{Path, PathBuf};

/// What a command said and how it ended.
#[derive(Clone, Debug)]
pub struct Said {
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
    /// The outcome.
    pub exit: Exit,
}

impl Said {
    /// Standard output as one JSON value a line.
    ///
    /// # Panics
    /// If a line is no JSON: that is what a test wants to know.
    pub fn records(&self) -> Vec<serde_json::Value> {
        let parse = |line| serde_json::from_str(line).unwrap_or_else(|e| panic!("no JSON ({e}): {line}"));
        self.out.lines().map(parse).collect()
    }

    /// The last record: the result of a run.
    ///
    /// # Panics
    /// If nothing was said.
    pub fn result(&self) -> serde_json::Value {
        self.records().pop().unwrap_or_else(|| panic!("nothing was said; standard error:\n{}", self.err))
    }
}

/// Runs `pelea` with these arguments.
pub fn pelea(arguments: &[&str]) -> Said {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut console = Console::new(&mut out, &mut err);
    let exit = cli::run(std::iter::once("pelea").chain(arguments.iter().copied()), &mut console);
    drop(console);
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    Said { out: text(out), err: text(err), exit }
}

/// The workspace's root.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// All missions of this repository, with the names of their scenarios.
///
/// # Panics
/// If the folders cannot be listed.
pub fn missions() -> Vec<(PathBuf, Vec<String>)> {
    let list = |folder: &Path| -> Vec<PathBuf> {
        let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
        let mut paths: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
        paths.sort();
        paths
    };
    list(&root().join("domains"))
        .into_iter()
        .filter(|mission| mission.join("mission.toml").is_file())
        .map(|mission| {
            let scenarios = list(&mission.join("scenarios"))
                .iter()
                .filter_map(|path| path.file_stem())
                .map(|stem| stem.to_string_lossy().into_owned())
                .collect();
            (mission, scenarios)
        })
        .collect()
}
