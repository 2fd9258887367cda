//! A mission: its layers, its words, and the names of its scenarios.

use std::collections::{BTreeMap, BTreeSet};

use pddl::model::{Name, TaskId};

use crate::content::Words;
use crate::goals::MissionGoal;
use crate::layers::Layers;
use crate::manifest::Manifest;
use diagnostics::{Finding, Place, SourceId, Sources};

/// A task that the manifest names, to be executed outside any plan.
#[derive(Clone, Debug)]
pub struct MissionTask {
    /// The task, of the methods.
    pub task: TaskId,
    /// Its name.
    pub name: Name,
    /// Its arguments: objects of the problem, which are also nodes of the same names.
    pub arguments: Vec<Name>,
}

/// A mission folder, read and resolved.
#[derive(Clone, Debug)]
pub struct Mission {
    /// Its folder.
    pub folder: String,
    /// `mission.toml`.
    pub manifest: Manifest,
    /// The source of the manifest.
    pub(crate) manifest_source: SourceId,
    /// Its PDDL.
    pub layers: Layers,
    /// The task to execute when there is no plan.
    pub fallback: MissionTask,
    /// The task to execute when the mission does not get on, if it is another.
    pub escalation: Option<MissionTask>,
    /// The task to execute while a decision takes its time.
    pub meanwhile: Option<MissionTask>,
    /// The goals; empty if the problem's goal is the only one.
    pub goals: Vec<MissionGoal>,
    /// The findings that are not errors.
    pub warnings: Vec<Finding>,
    /// Every text of the mission.
    pub sources: Sources,
    pub(crate) words: BTreeMap<String, Words>,
    pub(crate) scenarios: BTreeSet<String>,
}

impl Mission {
    /// The source of `mission.toml`.
    pub fn manifest_source(&self) -> SourceId {
        self.manifest_source
    }

    /// The words of a language, by its tag; `None` if the mission does not have the language.
    pub fn words(&self, tag: &str) -> Option<&Words> {
        self.words.get(tag)
    }

    /// The words of the default language.
    pub fn default_words(&self) -> &Words {
        let tag = &self.manifest.language;
        self.words.get(tag).expect("a mission without its default language is not loaded")
    }

    /// The words of every language, by tag.
    pub(crate) fn all_words(&self) -> impl Iterator<Item = &Words> {
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

    /// `path:line:column` of a place in one of its sources.
    pub fn place(&self, place: Place) -> String {
        self.sources.place(place)
    }
}
