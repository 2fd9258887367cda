//! A run is journaled, and `pelea dsr` looks at it: states, history, differences, questions, MCAP, torn and damaged files.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use pelea::{Console, Exit};
use std::path::Path;

/// What a command says: its exit, standard output and standard error.
fn pelea(arguments: &[&str]) -> (Exit, String, String) {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut console = Console::new(&mut out, &mut err);
    let exit = pelea::run([&["pelea"][..], arguments].concat(), &mut console);
    drop(console);
    (exit, String::from_utf8(out).unwrap(), String::from_utf8(err).unwrap())
}

#[test]
fn a_run_can_be_looked_at_afterwards() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let journal = at("run");
    let mission = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/missions/tea").display().to_string();
    let (_, told, err) = pelea(&["run", &mission, "--speed", "max", "--journal", &journal]);
    assert!(told.contains("mission") && err.is_empty(), "{told}{err}");
    let (again, _, err) = pelea(&["run", &mission, "--speed", "max", "--journal", &journal]);
    assert_eq!(again, Exit::Unwritable);
    assert!(err.contains("there is one already"), "{err}");

    let (exit, log, _) = pelea(&["dsr", "log", &journal, "--json"]);
    assert_eq!(exit, Exit::Yes);
    let commits: Vec<serde_json::Value> =
        log.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert!(commits.iter().all(|commit| commit["kind"] == "commit"));
    let versions: Vec<_> = commits.iter().map(|commit| commit["version"].as_u64().unwrap()).collect();
    assert!(versions.len() > 5 && versions.windows(2).all(|pair| pair[1] == pair[0] + 1), "{versions:?}");
    let last = *versions.last().unwrap();

    // Every version can be shown, and no other.
    let json = |at: u64| pelea(&["dsr", "show", &journal, "--at", &at.to_string(), "--format", "json"]);
    for version in versions[0] - 1..=last {
        let (exit, graph, _) = json(version);
        let graph: serde_json::Value = serde_json::from_str(&graph).unwrap();
        assert_eq!((exit, graph["version"].as_u64()), (Exit::Yes, Some(version)));
    }
    let (exit, said, _) = json(last + 1);
    assert!(exit == Exit::Unreadable && said.contains("no version"), "{said}");
    let (_, text, _) = pelea(&["dsr", "show", &journal]);
    assert!(text.starts_with(&format!("version {last}, at ")), "{text}");
    let (_, svg, _) = pelea(&["dsr", "show", &journal, "--at", "0.1s", "--format", "svg"]);
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"), "{svg}");
    let (exit, _, err) = pelea(&["dsr", "show", &journal, "--around", "nobody-at-all"]);
    assert!(exit == Exit::No && err.contains("no node `nobody-at-all`"), "{err}");

    let first = versions[0].to_string();
    let (exit, difference, _) = pelea(&["dsr", "diff", &journal, &first, &last.to_string()]);
    assert!(exit == Exit::Yes && !difference.is_empty());
    let (_, nothing, _) = pelea(&["dsr", "diff", &journal, &first, &first]);
    assert_eq!(nothing, "");

    let (exit, found, _) = pelea(&["dsr", "query", &journal, "(agent ?who)"]);
    assert!(exit == Exit::Yes && found.contains("?who = dsr"), "{found}");
    let (exit, when, _) = pelea(&["dsr", "query", &journal, "(holds ?who ?what)", "--history"]);
    assert!(exit == Exit::Yes && when.contains("no longer: ?what = "), "{when}");
    // As data the same, and a match is lost in the version that no longer has it.
    let (_, rows, _) = pelea(&["dsr", "query", &journal, "(holds ?who ?what)", "--history", "--json"]);
    let rows: Vec<serde_json::Value> = rows.lines().map(|row| serde_json::from_str(row).unwrap()).collect();
    assert_eq!(rows.len(), when.lines().count());
    for (row, line) in rows.iter().zip(when.lines()) {
        let version = row["version"].as_u64().unwrap();
        assert_eq!(line.split_whitespace().next().unwrap(), version.to_string(), "{line}");
        assert_eq!(row["holds"], !line.contains("no longer: "), "{line}");
        let holds = |at: u64| {
            let at = at.to_string();
            let found = pelea(&["dsr", "query", &journal, "(holds ?who ?what)", "--at", &at, "--json"]).1;
            let mut found = found.lines().map(|row| serde_json::from_str::<serde_json::Value>(row).unwrap());
            found.any(|found| found["bindings"] == row["bindings"])
        };
        assert_eq!(row["holds"], holds(version), "{line}");
        assert!(line.contains("already: ") || row["holds"] != holds(version - 1), "{line}");
    }
    let (exit, _, err) = pelea(&["dsr", "query", &journal, "(holds ?who"]);
    assert!(exit == Exit::Unreadable && err.contains("byte 11"), "{err}");
    assert_eq!(pelea(&["dsr", "query", &journal, "(and (agent ?a) (not (agent ?a)))"]).0, Exit::No);

    let (exit, _, err) = pelea(&["dsr", "export", &journal, "-o", &at("run.mcap")]);
    assert!(exit == Exit::Yes && err.starts_with(&format!("{} messages", versions.len() + 1)), "{err}");
    let mcap = std::fs::read(at("run.mcap")).unwrap();
    assert!(mcap.starts_with(b"\x89MCAP0\r\n") && mcap.ends_with(b"\x89MCAP0\r\n"));
    let read = mcap::MessageStream::new(&mcap).unwrap().map(|message| message.unwrap());
    let topics: Vec<_> = read.map(|message| message.channel.topic.clone()).collect();
    assert_eq!(topics.len(), versions.len() + 1);
    assert_eq!((topics[0].as_str(), topics[1].as_str()), ("/dsr/state", "/dsr/commit"));

    let bytes = std::fs::read(folder.path().join("run/00000000.dsr")).unwrap();
    std::fs::write(at("torn.dsr"), &bytes[..bytes.len() - 3]).unwrap();
    let (exit, shown, err) = pelea(&["dsr", "show", &at("torn.dsr")]);
    assert!(
        exit == Exit::Yes && shown.starts_with("version ") && err.contains("torn record at byte"),
        "{err}"
    );
    std::fs::write(at("other.dsr"), b"something else").unwrap();
    let (exit, _, err) = pelea(&["dsr", "show", &at("other.dsr")]);
    assert!(exit == Exit::Unreadable && err.contains("holds no state of a journal"), "{err}");
}

#[test]
fn a_world_of_cortex_is_taken_over() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("world").display().to_string();
    let world = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dsr/tests/cortex/kitchen.json");
    let world = world.display().to_string();
    let (exit, said, notes) = pelea(&["dsr", "import", &world, "-o", &output]);
    assert!(exit == Exit::Yes && said.starts_with("5 nodes and 1 edges"), "{said}");
    assert_eq!(notes.matches("note: ").count(), 2, "{notes}");
    let (_, shown, _) = pelea(&["dsr", "show", &output, "--around", "shadow"]);
    assert!(shown.contains("  shadow interacting person 7\n"), "{shown}");
    assert_eq!(pelea(&["dsr", "import", &world, "-o", &output]).0, Exit::Unwritable);
    let (exit, _, err) = pelea(&["dsr", "import", file!(), "-o", &output]);
    assert_eq!(exit, Exit::Unreadable, "{err}");
}
