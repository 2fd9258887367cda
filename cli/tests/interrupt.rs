//! Ctrl-C during a run: what there is by then is reported, and the journal can be read.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test")]

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Command, Stdio};

#[test]
fn an_interrupted_run_reports_what_there_is_and_leaves_a_journal_that_reads() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let journal = Path::new(env!("CARGO_TARGET_TMPDIR")).join("interrupted");
    if journal.exists() {
        std::fs::remove_dir_all(&journal).unwrap();
    }
    let mut run = Command::new(env!("CARGO_BIN_EXE_pelea"))
        .current_dir(&root)
        .args(["run", "domains/barthel", "--speed", "20", "--journal"])
        .arg(&journal)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut output = BufReader::new(run.stdout.take().unwrap());
    let mut line = String::new();
    while !line.contains("was told in opening") {
        line.clear();
        assert!(output.read_line(&mut line).unwrap() > 0, "the run ended by itself");
    }
    let killed = Command::new("kill").args(["-INT", &run.id().to_string()]).status().unwrap();
    assert!(killed.success());
    let mut rest = String::new();
    output.read_to_string(&mut rest).unwrap();
    assert_eq!(run.wait().unwrap().code(), Some(130), "{rest}");
    assert!(rest.contains("mission interrupted after"), "{rest}");
    let log = Command::new(env!("CARGO_BIN_EXE_pelea")).args(["dsr", "log"]).arg(&journal).output().unwrap();
    assert_eq!(log.status.code(), Some(0));
    assert!(String::from_utf8_lossy(&log.stdout).contains("greeting was told in opening"));
    let resume = Command::new(env!("CARGO_BIN_EXE_pelea"))
        .current_dir(&root)
        .args(["run", "domains/barthel", "--speed", "max", "--resume"])
        .arg(&journal)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&resume.stdout).into_owned();
    assert_eq!(resume.status.code(), Some(0), "{said}");
    assert!(said.contains("mission accomplished") && !said.contains("(greet person)"), "{said}");
}
