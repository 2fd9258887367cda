//! Every `cases/*.case` edits the mission in `tea/`; the expected findings are in a file beside it.
//!
//! A case is a comment and blocks: `edit PATH` replaces the one occurrence of the text between `<<<<`
//! and `====` by the text between `====` and `>>>>`; `write PATH` writes a file. A scenario `bad.toml`
//! is read once the mission is. `UPDATE_EXPECT=1` writes the `.expected` files.

use std::path::PathBuf;

use expect_test::expect_file;
use mission::{MemoryFiles, Mission, SkillOutcomes};

use crate::{disk, tea};

/// Applies the blocks of a case.
fn apply(case: &str, files: &mut MemoryFiles) {
    let mut lines = case.lines();
    while let Some(line) = lines.next() {
        let Some((verb, path)) = line.split_once(' ').filter(|(verb, _)| *verb != "#") else { continue };
        assert_eq!(lines.next(), Some("<<<<"), "{line}");
        let mut block = |end: &str| -> String {
            let lines: Vec<&str> = lines.by_ref().take_while(|l| *l != end).collect();
            lines.join("\n")
        };
        let (old, new) = (block("===="), block(">>>>"));
        if verb == "write" {
            files.texts.insert(path.to_owned(), new);
            continue;
        }
        let text = files.texts.get_mut(path).unwrap_or_else(|| panic!("no {path}"));
        assert_eq!(text.matches(&old).count(), 1, "{path}: {old}");
        *text = text.replace(&old, &new);
    }
}

/// The skills that the rules of these tests name, with outcomes as those of `pelea-agents`.
pub(crate) fn skills() -> SkillOutcomes {
    [("say", &[][..]), ("listen", &["misheard"])].into()
}

/// The findings of loading, or else of the scenario, or else of the checks.
fn findings(files: &MemoryFiles) -> String {
    let mission = match Mission::load(files, "tea") {
        Ok(mission) => mission,
        Err(errors) => return errors.to_string(),
    };
    if mission.scenarios().any(|name| name == "bad") {
        return match mission.scenario(files, "bad") {
            Ok(_) => "the scenario is good\n".to_owned(),
            Err(errors) => errors.to_string(),
        };
    }
    mission.check(&skills()).iter().map(|f| mission.sources.describe(f)).collect()
}

#[test]
fn cases() {
    let folder = disk::root().join("mission/tests/cases");
    let mut cases: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    cases.retain(|p| p.extension().is_some_and(|e| e == "case"));
    cases.sort();
    assert!(cases.len() >= 25);
    for path in cases {
        let mut files = tea::files();
        apply(&std::fs::read_to_string(&path).unwrap(), &mut files);
        expect_file![path.with_extension("expected")].assert_eq(&findings(&files));
    }
}

#[test]
fn the_mission_that_the_cases_edit_is_good() {
    let files = tea::files();
    assert_eq!(findings(&files), "");
    let mission = Mission::load(&files, "tea/mission.toml").unwrap();
    let scenario = mission.scenario(&files, "plain").unwrap();
    assert_eq!(scenario.title, "Green tea");
    let unknown = mission.scenario(&files, "plian").unwrap_err();
    assert!(unknown.to_string().contains("did you mean `plain`?"), "{unknown}");
}

/// An editor may save half a file: the reader must report it, and must not panic.
#[test]
fn no_truncated_file_panics() {
    let whole = tea::files();
    for (path, text) in &whole.texts {
        for end in (0..text.len()).step_by(11).filter(|&i| text.is_char_boundary(i)) {
            let mut files = whole.clone();
            files.texts.insert(path.clone(), text[..end].to_owned());
            findings(&files);
        }
    }
    let mission = tea::mission();
    let scenario = &whole.texts["tea/scenarios/plain.toml"];
    for end in (0..scenario.len()).filter(|&i| scenario.is_char_boundary(i)) {
        let _ = mission.read_scenario(pddl::Source::new("plain.toml", &scenario[..end]));
    }
}
