//! Reading a mission folder: one pass over its files, all mistakes collected.
//!
//! The order follows the dependencies: manifest → vocabulary → world, agents, graph → planning domain and problem →
//! perception, methods → words. A file that cannot be read stops only the files that need it.

mod layers;
mod loader;
mod tasks;
mod words;

use std::collections::BTreeMap;

use pddl::Source;

use self::loader::Loader;
use crate::content::Words;
use crate::errors::MissionErrors;
use crate::files::{FileError, Files, join};
use crate::goals;
use crate::manifest::{self, TaskText};
use crate::mission::Mission;
use diagnostics::toml::Reader;
use diagnostics::{Finding, Sources};

impl Mission {
    /// Reads the mission in the folder `path`, or the mission whose `mission.toml` has that path.
    ///
    /// # Errors
    /// Every mistake in every file.
    pub fn load(files: &dyn Files, path: &str) -> Result<Self, MissionErrors> {
        let mut loader = Loader { files, sources: Sources::new(), findings: Vec::new() };
        let mission = load_into(&mut loader, path);
        let errors = loader.findings.iter().any(Finding::is_error);
        match mission {
            Some(mut mission) if !errors => {
                mission.warnings = loader.findings;
                mission.sources = loader.sources;
                Ok(mission)
            }
            _ => {
                loader.findings.sort_by_key(|f| (f.place.source, f.place.span));
                Err(MissionErrors { sources: loader.sources, findings: loader.findings })
            }
        }
    }
}

fn load_into(loader: &mut Loader<'_>, path: &str) -> Option<Mission> {
    let (folder, file) = match path.rsplit_once('/') {
        Some((folder, name)) if name.ends_with(".toml") => (folder.to_owned(), path.to_owned()),
        None if path.ends_with(".toml") => (String::new(), path.to_owned()),
        _ => (join(path, "."), join(path, "mission.toml")),
    };
    let manifest_source = match loader.files.read(&file) {
        Ok(text) => loader.sources.push(Source::new(&file, text)),
        Err(error) => {
            let id = loader.sources.push(Source::new(&file, ""));
            let reason = match error {
                FileError::NotFound => "a mission is a folder with a `mission.toml`".to_owned(),
                FileError::Unreadable { reason } => reason,
            };
            let message = format!("cannot read `{file}`: {reason}");
            loader.findings.push(Finding::error("E0707", Sources::start_of(id), message));
            return None;
        }
    };
    let source = loader.sources.shared(manifest_source);
    let (manifest, findings) =
        Reader::read(manifest_source, &source, |r, root| manifest::read(r, root, &folder));
    loader.findings.extend(findings);
    let manifest = manifest?;
    let layers = layers::read(loader, manifest_source, &manifest)?;
    let words = words::read(loader, manifest_source, &manifest, &layers);
    let mut task = |text: &TaskText| tasks::resolve(loader, manifest_source, text, &layers);
    let fallback = task(&manifest.fallback)?;
    // A mistake in one of them is a finding, which keeps the mission from being loaded.
    let escalation = manifest.escalation.as_ref().and_then(&mut task);
    let meanwhile = manifest.meanwhile.as_ref().and_then(task);
    let mut reader = Reader { source: manifest_source, text: source.text(), findings: Vec::new() };
    let goals = goals::resolve(&mut reader, &manifest.goals, &layers);
    loader.findings.extend(reader.findings);
    let words: BTreeMap<String, Words> = words.into_iter().map(|w| (w.tag().to_owned(), w)).collect();
    // Scenarios are optional.
    let scenarios = match loader.files.list(&manifest.paths.scenarios) {
        Ok(names) => names.iter().filter_map(|n| n.strip_suffix(".toml")).map(str::to_owned).collect(),
        Err(_) => Default::default(),
    };
    Some(Mission {
        folder,
        manifest,
        manifest_source,
        layers,
        words,
        fallback,
        escalation,
        meanwhile,
        goals,
        scenarios,
        warnings: Vec::new(),
        sources: Sources::new(),
    })
}
