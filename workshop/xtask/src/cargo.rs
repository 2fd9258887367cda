//! Calling cargo.

use crate::failure::Failure;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// The workspace's root.
pub(crate) fn root() -> PathBuf {
    let here = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).map_or(here.clone(), PathBuf::from)
}

/// Whether `cargo nextest` answers.
pub(crate) fn has_nextest() -> bool {
    Command::new("cargo")
        .args(["nextest", "--version"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|s| s.success())
}

/// Runs cargo at the root; its output is the user's.
pub(crate) fn run(arguments: &[&str]) -> Result<(), Failure> {
    start(Command::new("cargo").args(arguments), arguments)
}

/// The same with one more environment variable.
pub(crate) fn run_with(arguments: &[&str], variable: &str, value: &str) -> Result<(), Failure> {
    start(Command::new("cargo").args(arguments).env(variable, value), arguments)
}

fn start(command: &mut Command, arguments: &[&str]) -> Result<(), Failure> {
    let shown = format!("cargo {}", arguments.join(" "));
    eprintln!("$ {shown}");
    let status =
        command.current_dir(root()).status().map_err(|error| Failure::NotStarted(shown.clone(), error))?;
    if status.success() { Ok(()) } else { Err(Failure::Command(shown)) }
}
