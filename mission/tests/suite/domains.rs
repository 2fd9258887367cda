//! Every mission under `domains/` loads in every language with every scenario, and its layers agree.

use mission::{Mission, MissionErrors, SkillOutcomes};

use crate::disk::{self, Disk};

fn load(folder: &str) -> Mission {
    Mission::load(&Disk, folder).unwrap_or_else(|errors| panic!("{errors}"))
}

fn missions() -> Vec<String> {
    let mut folders: Vec<String> = std::fs::read_dir(disk::root().join("domains"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.join("mission.toml").exists())
        .map(|path| format!("domains/{}", path.file_name().unwrap().to_str().unwrap()))
        .collect();
    folders.sort();
    folders
}

#[test]
fn every_mission_loads_with_its_scenarios() {
    assert!(!missions().is_empty());
    for folder in missions() {
        let mission = load(&folder);
        let mut count = 0;
        for name in mission.scenarios() {
            let scenario = mission.scenario(&Disk, name);
            let scenario = scenario.unwrap_or_else(|errors: MissionErrors| panic!("{errors}"));
            assert_eq!(scenario.name, name);
            count += 1;
        }
        assert!(count > 0, "{folder} has no scenario");
    }
}

#[test]
fn no_check_finds_anything() {
    for folder in missions() {
        let mission = load(&folder);
        let findings = mission.check(&SkillOutcomes::default());
        let text: String =
            mission.warnings.iter().chain(&findings).map(|f| mission.sources.describe(f)).collect();
        assert_eq!(text, "", "{folder}");
    }
}

#[test]
fn every_option_can_be_answered_in_every_language() {
    for folder in missions() {
        let mission = load(&folder);
        for language in mission.languages() {
            let words = mission.words(language).unwrap();
            for item in mission.layers.items() {
                let item = mission.layers.name(item);
                let options = words.options(item);
                assert!(options.len() >= 2, "{language} {item}");
                for option in options {
                    for spoken in &option.spoken {
                        assert_eq!(words.understand(item, spoken), Some(&option.option), "{spoken}");
                        assert_eq!(words.spot(spoken), None, "{spoken} is an answer, not a request");
                    }
                    assert!(words.sentence(item, &option.option).unwrap().ends_with(&option.text));
                }
                assert_eq!(words.understand(item, "the blue one"), None);
            }
        }
    }
}
