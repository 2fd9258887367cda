//! The files of this project have the layout of `pelea fmt`; and the effects of `pelea fmt` on files.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn pelea(folder: &Path, arguments: &[&str], input: &[u8]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_pelea"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(input).unwrap();
    child.wait_with_output().unwrap()
}

#[test]
fn our_own_files_are_laid_out() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let output = pelea(&root, &["fmt", "--check", "robots", "domains"], b"");
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "run `pelea fmt robots domains`:\n{said}");
}

const WRITTEN: &[u8] = b"; caf\xe9\r\n(define (domain d)\r\n(:predicates (p)))";
const FORMATTED: &[u8] = b"; caf\xe9\n(define (domain d)\n  (:predicates (p)))\n";

#[test]
fn only_what_changes_is_written_and_in_its_encoding() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("latin.pddl");
    fs::write(&path, WRITTEN).unwrap();
    fs::write(folder.path().join("good.hddl"), "(define (domain d))\n").unwrap();
    fs::write(folder.path().join("notes.txt"), "(no   pddl)").unwrap();
    let output = pelea(folder.path(), &["fmt", "--check", "."], b"");
    assert_eq!((output.status.code(), &*output.stdout), (Some(1), &b"./latin.pddl: would change\n"[..]));
    assert_eq!(fs::read(&path).unwrap(), WRITTEN);
    let output = pelea(folder.path(), &["fmt", "."], b"");
    assert_eq!((output.status.code(), &*output.stdout), (Some(0), &b"./latin.pddl: formatted\n"[..]));
    assert_eq!(fs::read(&path).unwrap(), FORMATTED);
    assert_eq!(fs::read(folder.path().join("notes.txt")).unwrap(), b"(no   pddl)");
    let output = pelea(folder.path(), &["fmt", "--check", "."], b"");
    assert_eq!((output.status.code(), &*output.stdout), (Some(0), &b""[..]));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3);
}

#[test]
fn standard_input_goes_to_standard_output() {
    let folder = tempfile::tempdir().unwrap();
    let output = pelea(folder.path(), &["fmt", "-"], b"(a\n b)  ;c");
    assert_eq!((output.status.code(), &*output.stdout), (Some(0), &b"(a b)  ;c\n"[..]));
    let output = pelea(folder.path(), &["fmt", "-", "--check"], b"(a\n b)");
    assert_eq!((output.status.code(), &*output.stdout), (Some(1), &b"<standard input>: would change\n"[..]));
    let output = pelea(folder.path(), &["fmt", "-"], b"(a");
    assert_eq!((output.status.code(), &*output.stdout), (Some(2), &b""[..]));
}

#[cfg(unix)]
#[test]
fn links_and_permissions_stay() {
    use std::os::unix::fs::{PermissionsExt as _, symlink};
    let folder = tempfile::tempdir().unwrap();
    let (path, link) = (folder.path().join("d.pddl"), folder.path().join("link.pddl"));
    fs::write(&path, "(define\n(domain d))").unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
    symlink("d.pddl", &link).unwrap();
    assert_eq!(pelea(folder.path(), &["fmt", "link.pddl"], b"").status.code(), Some(0));
    assert!(link.is_symlink());
    assert_eq!(fs::read_to_string(&path).unwrap(), "(define (domain d))\n");
    assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
}
