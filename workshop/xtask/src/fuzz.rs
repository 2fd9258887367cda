//! Fuzzing what is read from files, PDDL, plans, journals and worlds: builds the targets of `tests/fuzz/` and runs them one after
//! the other.
//!
//! Each starts from its seeds, those that read PDDL from the cases of `pddl/test_data` and its words too; what libFuzzer adds
//! goes to `tests/fuzz/corpus`, a finding to `tests/fuzz/artifacts` (both outside of git). Without a sanitizer: the crates forbid `unsafe`, so all that
//! can be found is a panic, an overflow (checked here), a hang or too much memory, and that at twice the speed.

use crate::cargo;
use crate::failure::Failure;
use std::path::Path;

/// The workspace of the targets.
const FOLDER: &str = "tests/fuzz";

/// Seconds for each target if none are named.
const SECONDS: &str = "600";

/// The targets to which PDDL means nothing.
const NO_PDDL: [&str; 2] = ["journal", "cortex"];

/// Runs one target, or all, for that many seconds each.
pub(crate) fn fuzz(arguments: &[String]) -> Result<(), Failure> {
    let is_number = |word: &&String| word.bytes().all(|b| b.is_ascii_digit());
    let seconds = arguments.iter().find(is_number).map_or(SECONDS, String::as_str);
    let wanted = arguments.iter().find(|word| !is_number(word));
    let mut targets = targets(&cargo::root())?;
    targets.retain(|target| wanted.is_none_or(|wanted| wanted == target));
    if targets.is_empty() {
        return Err(Failure::NoTarget(wanted.cloned().unwrap_or_default()));
    }
    let mut build = vec!["fuzz", "build", "--fuzz-dir", FOLDER, "--sanitizer", "none"];
    build.extend(wanted.map(String::as_str));
    cargo::run(&build)?;
    targets.iter().try_for_each(|target| run(&cargo::root(), target, seconds))
}

fn run(root: &Path, target: &str, seconds: &str) -> Result<(), Failure> {
    let corpus = format!("tests/fuzz/corpus/{target}");
    std::fs::create_dir_all(root.join(&corpus)).map_err(|error| Failure::File(corpus.clone(), error))?;
    let (seeds, time) = (format!("tests/fuzz/seeds/{target}"), format!("-max_total_time={seconds}"));
    let reads_pddl = !NO_PDDL.contains(&target);
    let mut command =
        vec!["fuzz", "run", "--fuzz-dir", FOLDER, "--sanitizer", "none", target, &corpus, &seeds];
    if reads_pddl {
        command.extend(["pddl/test_data/ok", "pddl/test_data/err", "pddl/test_data/format"]);
    }
    command.extend(["--", "-max_len=4096", "-timeout=10", "-print_final_stats=1", &time]);
    if reads_pddl {
        command.push("-dict=tests/fuzz/pddl.dict");
    }
    cargo::run(&command)
}

/// The names of the files in `tests/fuzz/targets`.
fn targets(root: &Path) -> Result<Vec<String>, Failure> {
    let files = crate::sources::rust_files(&root.join("tests/fuzz/targets"))?;
    Ok(files.iter().filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned())).collect())
}
