//! A run is journaled, and `pelea dsr` reads the journal: states, history, differences, questions, MCAP, torn and damaged files.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use dsr::{AgentId, Graph, Isometry3, Nature, Reflex, Time, Transaction, VocabularyBuilder};
use pelea::{Console, Exit};
use std::path::Path;

/// The exit code, standard output and standard error of a command.
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
    assert_eq!(exit, Exit::Yes, "{err}");
    let mcap = std::fs::read(at("run.mcap")).unwrap();
    assert!(mcap.starts_with(b"\x89MCAP0\r\n") && mcap.ends_with(b"\x89MCAP0\r\n"));
    let read = mcap::MessageStream::new(&mcap).unwrap().map(|message| message.unwrap());
    let topics: Vec<_> = read.map(|message| message.channel.topic.clone()).collect();
    assert!(err.starts_with(&format!("{} messages", topics.len())), "{err}");
    let count = |topic: &str| topics.iter().filter(|other| *other == topic).count();
    assert_eq!((topics[0].as_str(), count("/dsr/state")), ("/dsr/state", 1));
    assert_eq!((count("/dsr/commit"), count("/dsr/log")), (versions.len(), versions.len()));

    let bytes = std::fs::read(folder.path().join("run/00000000.dsr")).unwrap();
    std::fs::write(at("torn.dsr"), &bytes[..bytes.len() - 3]).unwrap();
    let (exit, shown, err) = pelea(&["dsr", "show", &at("torn.dsr")]);
    assert!(
        exit == Exit::Yes && shown.starts_with("version ") && err.contains("torn record at byte"),
        "{err}"
    );
    // A run at full speed is synced only at its end.
    let mut damaged = bytes.clone();
    let middle = bytes.len() / 2;
    damaged[middle..middle + 4].fill(0xff);
    std::fs::write(at("damaged.dsr"), damaged).unwrap();
    let output = at("damaged.mcap");
    for command in
        [&["show"][..], &["log"], &["diff", "1", "2"], &["query", "(robot ?r)"], &["export", "-o", &output]]
    {
        let path = at("damaged.dsr");
        let arguments: Vec<_> = [&["dsr", command[0], &path], &command[1..]].concat();
        let (exit, _, err) = pelea(&arguments);
        assert_eq!(exit, Exit::Unreadable, "{command:?}: {err}");
        assert!(err.contains("damaged.dsr` is corrupt at byte") && !err.contains("torn"), "{err}");
    }
    std::fs::write(at("other.dsr"), b"something else").unwrap();
    let (exit, _, err) = pelea(&["dsr", "show", &at("other.dsr")]);
    assert!(exit == Exit::Unreadable && err.contains("holds no state of a journal"), "{err}");
}

#[test]
fn a_world_of_cortex_is_taken_over() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("world").display().to_string();
    let world = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dsr/formats/tests/cortex/kitchen.json");
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

#[test]
fn what_no_change_shows_is_told_and_foxglove_gets_what_it_knows() {
    let mut builder = VocabularyBuilder::new();
    let place = builder.node_type("place", None, Nature::Geometric).unwrap();
    let speech = builder.agent("speech").unwrap();
    let graph = Graph::new(builder.build());
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let store = dsr::Folder::new(folder.path().join("run")).unwrap();
    let journal = graph.journal(store, dsr::Settings::default()).unwrap();
    let moved = |x: f64| Isometry3::translation(x, 0.0, 0.0);
    let mut tx = Transaction::new(AgentId::DSR);
    tx.add_node("room", place).add_node("robot", place).add_node("cup", place);
    tx.set_transform("room", "robot", moved(1.0)).sample_transform(
        "robot",
        "cup",
        Time(1_500_000_000),
        moved(0.1),
    );
    graph.commit(&tx, Time(2_000_000_000)).unwrap();
    let mut tx = Transaction::new(AgentId::DSR);
    tx.set_transform("room", "robot", moved(3.0)).sample_transform(
        "robot",
        "cup",
        Time(2_500_000_000),
        moved(0.2),
    );
    graph.commit(&tx, Time(3_000_000_000)).unwrap();
    let mut tx = Transaction::new(speech);
    let reflex = Reflex { owner: speech, keep: Vec::new(), on_break: Vec::new(), leases: Vec::new() };
    let reflex = graph.commit(tx.guard(reflex), Time(4_000_000_000)).unwrap().guards[0];
    let mut tx = Transaction::new(AgentId::DSR);
    tx.push(dsr::Edit::Expire { agent: speech });
    let fired = graph.commit(&tx, Time(5_000_000_000)).unwrap().delta;
    assert!(fired.changes.is_empty() && fired.reflexes == [reflex]);
    journal.close().unwrap();

    // A commit in which nothing changed but a reflex fired.
    let told = format!("dsr: reflex {} fired", reflex.0);
    let (_, log, _) = pelea(&["dsr", "log", &at("run"), "--about", "fired"]);
    assert!(log.lines().count() == 1 && log.trim_end().ends_with(&told), "{log}");
    let (_, log, _) = pelea(&["dsr", "log", &at("run"), "--json"]);
    let last: serde_json::Value = serde_json::from_str(log.lines().last().unwrap()).unwrap();
    assert_eq!(last["reflexes"], serde_json::json!([reflex.0]));

    let (exit, _, err) = pelea(&["dsr", "export", &at("run"), "-o", &at("run.mcap")]);
    assert_eq!(exit, Exit::Yes, "{err}");
    let mcap = std::fs::read(at("run.mcap")).unwrap();
    let mut frames = Vec::new();
    for message in mcap::MessageStream::new(&mcap).unwrap().map(|message| message.unwrap()) {
        let schema = message.channel.schema.clone().unwrap();
        let data: serde_json::Value = serde_json::from_slice(&message.data).unwrap();
        match (message.channel.topic.as_str(), schema.name.as_str()) {
            ("/dsr/commit", "dsr.Commit") if data["version"] == fired.version.0 => {
                assert_eq!(data["reflexes"], serde_json::json!([reflex.0]));
            }
            ("/dsr/log", "foxglove.Log") if data["timestamp"]["sec"] == 5 => {
                assert_eq!((data["level"].as_u64(), data["name"].as_str()), (Some(3), Some("dsr")));
                assert_eq!(data["message"], format!("reflex {} fired", reflex.0));
            }
            ("/tf", "foxglove.FrameTransforms") => {
                for frame in data["transforms"].as_array().unwrap() {
                    assert_eq!(
                        frame["rotation"],
                        serde_json::json!({"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0})
                    );
                    let stamp = &frame["timestamp"];
                    let time =
                        stamp["sec"].as_u64().unwrap() * 1_000_000_000 + stamp["nsec"].as_u64().unwrap();
                    let name = |key: &str| frame[key].as_str().unwrap().to_owned();
                    let x = frame["translation"]["x"].as_f64().unwrap();
                    frames.push((time, name("parent_frame_id"), name("child_frame_id"), x));
                }
            }
            ("/dsr/state", "dsr.State") | ("/dsr/commit", "dsr.Commit") | ("/dsr/log", "foxglove.Log") => {}
            other => panic!("{other:?}"),
        }
    }
    // A jump must not be interpolated, so the pose before it is written once more.
    // Sampled poses have the times of their samples.
    let frame = |time, parent: &str, child: &str, x| (time, parent.to_owned(), child.to_owned(), x);
    let wanted = [
        frame(2_000_000_000, "room", "robot", 1.0),
        frame(1_500_000_000, "robot", "cup", 0.1),
        frame(2_999_999_999, "room", "robot", 1.0),
        frame(3_000_000_000, "room", "robot", 3.0),
        frame(2_500_000_000, "robot", "cup", 0.2),
    ];
    assert_eq!(frames, wanted);
}

#[test]
fn segments_of_another_history_are_noted_and_damaged_ones_are_errors() {
    let folder = tempfile::tempdir().unwrap();
    let mut builder = VocabularyBuilder::new();
    let place = builder.node_type("place", None, Nature::Symbolic).unwrap();
    let vocabulary = builder.build();
    // Times that fall: versions order, not they.
    for times in [[0, 10, 20], [0, 10, 5]] {
        let graph = Graph::new(vocabulary.clone());
        let store = dsr::Folder::new(folder.path()).unwrap();
        let journal = graph.journal(store, dsr::Settings::default()).unwrap();
        for seconds in times {
            let name = format!("place {seconds}");
            let time = Time(seconds * 1_000_000_000);
            graph.edit(AgentId::DSR, time, |tx| _ = tx.add_node(name.as_str(), place)).unwrap();
        }
        journal.close().unwrap();
    }
    let journal = folder.path().display().to_string();
    let (exit, then, err) = pelea(&["dsr", "show", &journal, "--at", "7s"]);
    assert!(exit == Exit::Yes && then.starts_with("version 3, at "), "{then}");
    assert!(err.contains("note: ") && err.contains("of another history"), "{err}");
    let (exit, _, err) = pelea(&["dsr", "show", &folder.path().join("00000000.dsr").display().to_string()]);
    assert_eq!((exit, err.as_str()), (Exit::Yes, ""));
    std::fs::create_dir(folder.path().join("00000002.dsr")).unwrap();
    let (exit, now, err) = pelea(&["dsr", "show", &journal]);
    assert!(exit == Exit::Unreadable && now.starts_with("version 3, at "), "{now}");
    assert!(err.contains("cannot read"), "{err}");
    // With nothing left to show, the damage is why.
    let alone = folder.path().join("00000000.dsr");
    let mut bytes = std::fs::read(&alone).unwrap();
    bytes[40] ^= 1;
    std::fs::write(&alone, bytes).unwrap();
    let (exit, _, err) = pelea(&["dsr", "show", &alone.display().to_string()]);
    assert_eq!(exit, Exit::Unreadable);
    assert!(err.contains("00000000.dsr` is corrupt at byte 0") && err.contains("no state"), "{err}");
}
