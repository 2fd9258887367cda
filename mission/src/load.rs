//! Reading a mission folder: one pass over its files, all mistakes collected.
//!
//! The order follows the dependencies: manifest → vocabulary → world, agents, graph → planning domain and problem →
//! perception, methods → words. A file that cannot be read stops only the files that need it.

mod layers;
mod loader;
mod words;

use std::collections::BTreeMap;

use pddl::model::ObjectId;
use pddl::{Source, Span};

use self::loader::Loader;
use crate::content::Words;
use crate::errors::MissionErrors;
use crate::files::{FileError, Files, join};
use crate::manifest::{self, Manifest};
use crate::mission::{Fallback, Mission};
use diagnostics::toml::Reader;
use diagnostics::{Finding, Place, SourceId, Sources};

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
    let fallback = fallback(loader, manifest_source, &manifest, &layers)?;
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
        scenarios,
        warnings: Vec::new(),
        sources: Sources::new(),
    })
}

/// Resolves `fallback = "(task argument …)"`. If the arguments are left out, each is the only object of its type in the
/// problem.
fn fallback(
    loader: &mut Loader<'_>,
    source: SourceId,
    manifest: &Manifest,
    layers: &crate::layers::Layers,
) -> Option<Fallback> {
    let (methods, problem) = (&layers.methods.model, &layers.problem.model);
    let wanted = &manifest.fallback;
    let mut report = |span: Span, message: String| {
        let place = Place { source, span };
        loader.findings.push(Finding::error("E0708", place, message));
        None
    };
    let Some(task) = methods.task(&wanted.name) else {
        return report(wanted.span, format!("the methods have no task `{}`", wanted.name));
    };
    let parameters = methods.tasks[task].variables.parameters();
    let fits = |object: ObjectId, parameter: &pddl::model::Variable| {
        let types = &problem.objects[object].types;
        types.0.iter().all(|&t| {
            let name = &layers.domain.model.types[t].name;
            methods.types.find(name).is_some_and(|t| methods.types.is_in(t, &parameter.types))
        })
    };
    let mut arguments = Vec::new();
    if manifest.fallback_arguments.is_empty() {
        for parameter in parameters {
            let mut fitting = problem.objects.ids().filter(|&o| fits(o, parameter));
            match (fitting.next(), fitting.next()) {
                (Some(object), None) => arguments.push(object),
                _ => {
                    let message = format!(
                        "the problem does not have exactly one object for `?{}` of `{}`; name it: \"({} …)\"",
                        parameter.name, wanted.name, wanted.name
                    );
                    return report(wanted.span, message);
                }
            }
        }
    } else if manifest.fallback_arguments.len() != parameters.len() {
        let message = format!("`{}` takes {} arguments", wanted.name, parameters.len());
        return report(wanted.span, message);
    } else {
        for (mention, parameter) in manifest.fallback_arguments.iter().zip(parameters) {
            match problem.object(&mention.name) {
                Some(object) if fits(object, parameter) => arguments.push(object),
                _ => {
                    let message =
                        format!("`{}` is not an object that fits `?{}`", mention.name, parameter.name);
                    return report(mention.span, message);
                }
            }
        }
    }
    let names = arguments.iter().map(|&o| problem.objects[o].name.clone()).collect();
    Some(Fallback { task, name: wanted.name.clone(), arguments: names })
}
