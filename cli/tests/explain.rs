//! Every code that the sources report has a page, and the examples of a page are examples of it.
//!
//! `pddl` and `lints` run their own examples. Those of missions are parts of files of the mission in `missions/tea`, those
//! of suites of the one in `cases/test-passes/tea`: the part that is right stands there (or is a whole file that is written),
//! and the part that is wrong is put in its place.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Codes without examples, and why.
const WITHOUT_EXAMPLE: [&str; 8] = [
    "C0001", // takes more rules than a page can hold
    "E0901", // is about a file that cannot be read
    "E1006", // takes more objects than a page can hold
    "E1010", // takes rules about devices, which the small mission has not
    "T0107", // is about a folder without files
    "T0305", // takes a domain with processes
    "T0306", // is a bug of ours
    "T0311", // the file's own errors are reported beside it
];

/// One run of the program in this process: its exit code and its records.
fn pelea(arguments: &[&str]) -> Vec<Value> {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut console = pelea::Console::new(&mut out, &mut err);
    pelea::run(std::iter::once("pelea").chain(arguments.iter().copied()), &mut console);
    drop(console);
    String::from_utf8(out).unwrap().lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn texts(page: &Value, key: &str) -> Vec<String> {
    page[key].as_array().unwrap().iter().map(|text| text.as_str().unwrap().to_owned()).collect()
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() {
            copy(&path, &target);
        } else {
            fs::copy(&path, &target).unwrap();
        }
    }
}

/// The text with each line moved to the right.
fn indented(text: &str, by: usize) -> String {
    let line = |line: &str| if line.is_empty() { String::new() } else { " ".repeat(by) + line };
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// Puts `new` where `old` stands in the file of their first line, or else writes it as the whole file.
fn put(folder: &Path, old: Option<&String>, new: &str) {
    let (name, new) = new.split_once('\n').unwrap();
    let path = folder.join(name.trim_start_matches([';', '#', ' ']));
    let text = fs::read_to_string(&path).unwrap_or_default();
    let place = old.filter(|old| old.starts_with(name)).and_then(|old| {
        let old = old.split_once('\n').unwrap().1;
        (0..=24).find_map(|by| {
            let old = indented(old, by);
            (text.matches(&old).count() == 1).then_some((old, by))
        })
    });
    let text = place.map_or_else(|| new.to_owned(), |(old, by)| text.replace(&old, &indented(new, by)));
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, text).unwrap();
}

/// The codes of the errors and warnings about the folder, and what was said.
fn found(command: &str, folder: &Path) -> (BTreeSet<(String, String)>, String) {
    let records = pelea(&[command, "--json", folder.to_str().unwrap()]);
    let diagnostics: Vec<&Value> = records.iter().filter(|r| r["kind"] == "diagnostic").collect();
    let text = |value: &Value| value.as_str().unwrap_or("none").to_owned();
    let codes = diagnostics.iter().map(|d| (text(&d["severity"]), text(&d["code"]))).collect();
    (codes, diagnostics.iter().map(|d| format!("  {} {}\n", d["place"], d["message"])).collect())
}

/// The pages whose examples are parts of missions or suites, with the command that checks them and their folder.
fn executed() -> Vec<(Value, &'static str, PathBuf)> {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let of = |page: &Value| {
        let code = page["code"].as_str().unwrap();
        let number: u32 = code[1..].parse().unwrap();
        match code.as_bytes()[0] {
            b'C' => Some(("check", tests.join("missions/tea"))),
            b'E' if number >= 700 => Some(("check", tests.join("missions/tea"))),
            b'T' if number >= 400 => Some(("test", tests.join("missions/tea"))),
            b'T' => Some(("test", tests.join("cases/test-passes/tea"))),
            _ => None,
        }
    };
    let pages = pelea(&["explain", "--json"]);
    pages.into_iter().filter_map(|page| of(&page).map(|(command, folder)| (page, command, folder))).collect()
}

#[test]
fn wrong_parts_give_their_code_and_no_other_error_and_right_ones_give_none() {
    let pages = executed();
    assert!(pages.len() > 75, "{}", pages.len());
    let mut failed = String::new();
    for (page, command, base) in pages {
        let code = page["code"].as_str().unwrap();
        let (wrong, right) = (texts(&page, "wrong"), texts(&page, "right"));
        assert_eq!(wrong.is_empty(), WITHOUT_EXAMPLE.contains(&code), "{code}");
        let folder = tempfile::tempdir().unwrap();
        let tried = |name: &str, parts: &[String]| {
            let folder = folder.path().join(name);
            copy(&base, &folder);
            for (index, part) in parts.iter().enumerate() {
                put(&folder, right.get(index), part);
            }
            found(command, &folder)
        };
        let (codes, text) = tried("wrong", &wrong);
        let errors: BTreeSet<&str> =
            codes.iter().filter(|(severity, _)| severity == "error").map(|(_, code)| &**code).collect();
        let fits = codes.iter().any(|(_, own)| own == code) && errors.iter().all(|error| *error == code);
        if !fits && !wrong.is_empty() {
            failed += &format!("the wrong example of {code} gives {codes:?}\n{text}");
        }
        let (codes, text) = tried("right", &right);
        if !codes.is_empty() {
            failed += &format!("the right example of {code} gives {codes:?}\n{text}");
        }
    }
    assert!(failed.is_empty(), "{failed}");
}

/// Every text in quotation marks that looks like a code, in the sources below a folder.
fn codes_below(folder: &Path, codes: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        if path.is_dir() {
            if !["target", "tests", "benches", "xtask"].contains(&name) && !name.starts_with('.') {
                codes_below(&path, codes);
            }
        } else if name.ends_with(".rs") && !name.contains("test") {
            let text = fs::read_to_string(&path).unwrap();
            let text = text.split("#[cfg(test)]").next().unwrap();
            let is_code = |word: &&str| {
                word.len() == 5
                    && word.starts_with(['C', 'E', 'T', 'U', 'W'])
                    && word[1..].bytes().all(|b| b.is_ascii_digit())
            };
            codes.extend(text.split('"').filter(is_code).map(str::to_owned));
        }
    }
}

#[test]
fn every_code_in_the_sources_has_a_page() {
    let mut codes = BTreeSet::new();
    codes_below(&Path::new(env!("CARGO_MANIFEST_DIR")).join(".."), &mut codes);
    assert!(codes.len() > 150, "{}", codes.len());
    let pages = pelea(&["explain", "--json"]);
    let explained: BTreeSet<String> =
        pages.iter().map(|page| page["code"].as_str().unwrap().to_owned()).collect();
    assert_eq!(explained.len(), pages.len(), "a code has two pages");
    assert_eq!(codes, explained);
}
