//! A mission: its layers, its words, and where its scenarios are.

use std::collections::{BTreeMap, BTreeSet};

use pddl::Source;
use pddl::model::{Name, TaskId};

use crate::content::Words;
use crate::errors::MissionErrors;
use crate::files::{Files, join};
use crate::layers::Layers;
use crate::manifest::Manifest;
use crate::scenario::{self, Scenario};
use diagnostics::did_you_mean;
use diagnostics::{Finding, Place, SourceId, Sources};

/// What to do when there is no plan.
#[derive(Clone, Debug)]
pub struct Fallback {
    /// The task, of the methods.
    pub task: TaskId,
    /// Its name.
    pub name: Name,
    /// Its arguments: objects of the problem, which are nodes of the same names.
    pub arguments: Vec<Name>,
}

/// A mission folder, read and resolved.
#[derive(Clone, Debug)]
pub struct Mission {
    /// The folder that it came from.
    pub folder: String,
    /// `mission.toml`.
    pub manifest: Manifest,
    /// The source of the manifest.
    pub manifest_source: SourceId,
    /// All that is PDDL.
    pub layers: Layers,
    /// What to do when there is no plan.
    pub fallback: Fallback,
    /// What is worth telling and no error.
    pub warnings: Vec<Finding>,
    /// Every text that was read.
    pub sources: Sources,
    pub(crate) words: BTreeMap<String, Words>,
    pub(crate) scenarios: BTreeSet<String>,
}

impl Mission {
    /// Reads the mission in the folder `path` (or of the `mission.toml` of that path). Every problem of
    /// every file is in the error.
    pub fn load(files: &dyn Files, path: &str) -> Result<Self, MissionErrors> {
        crate::load::load(files, path)
    }

    /// The words of a language, by its tag; `None` if it has none.
    pub fn words(&self, tag: &str) -> Option<&Words> {
        self.words.get(tag)
    }

    /// The words of the language that is spoken unless another is asked for.
    pub fn default_words(&self) -> &Words {
        let tag = &self.manifest.language;
        self.words.get(tag).expect("a mission without its default language is not loaded")
    }

    /// The words of every language, by tag.
    pub fn all_words(&self) -> impl Iterator<Item = &Words> {
        self.words.values()
    }

    /// The tags of all languages, sorted.
    pub fn languages(&self) -> impl Iterator<Item = &str> {
        self.words.keys().map(String::as_str)
    }

    /// The names of the scenarios in the mission's folder, sorted.
    pub fn scenarios(&self) -> impl Iterator<Item = &str> {
        self.scenarios.iter().map(String::as_str)
    }

    /// Reads a scenario of the mission's folder by its name.
    pub fn scenario(&self, files: &dyn Files, name: &str) -> Result<Scenario, MissionErrors> {
        let path = join(&self.manifest.paths.scenarios, &format!("{name}.toml"));
        match files.read(&path) {
            Ok(text) => self.read_scenario(Source::new(path, text)),
            Err(error) => {
                let place = Sources::start_of(self.manifest_source);
                let help = did_you_mean(name, self.scenarios()).or_else(|| {
                    let all: Vec<&str> = self.scenarios().collect();
                    Some(format!("the scenarios are: {}", all.join(", ")))
                });
                let finding = Finding::error("E0901", place, format!("cannot read `{path}`: {error}"));
                Err(MissionErrors { sources: self.sources.clone(), findings: vec![finding.help_if(help)] })
            }
        }
    }

    /// Reads a scenario from anywhere.
    pub fn read_scenario(&self, source: Source) -> Result<Scenario, MissionErrors> {
        scenario::read(self, source)
    }

    /// What the layers do to each other; the list is in the folder `check`.
    pub fn check(&self) -> Vec<Finding> {
        let mut findings = Vec::new();
        for check in crate::check::ALL {
            check(self, &mut findings);
        }
        findings
    }

    /// `path:line:column` of a place in one of its sources.
    pub fn place(&self, place: Place) -> String {
        self.sources.place(place)
    }
}
