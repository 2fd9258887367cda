//! Reading the languages, and comparing them with the graph and with each other.

use pddl::Span;

use super::loader::Loader;
use crate::content::said::Said;
use crate::content::{Words, file, names, required};
use crate::files::{join, stem};
use crate::layers::Layers;
use crate::manifest::Manifest;
use diagnostics::toml::Reader;
use diagnostics::{Finding, Place, SourceId};

/// The words of every language, by tag.
pub(super) fn read(
    loader: &mut Loader<'_>,
    from: SourceId,
    manifest: &Manifest,
    layers: &Layers,
) -> Vec<Words> {
    let folder = &manifest.paths.content;
    let here = Place { source: from, span: Span::default() };
    let said = Said::new(layers);
    let (mut files, mut lacking) = (Vec::new(), Vec::new());
    let mut words = Vec::new();
    for name in loader.names(folder, ".toml", here) {
        let Some(id) = loader.source(&join(folder, &name), here) else { continue };
        let source = loader.sources.shared(id);
        let (file, findings) = Reader::read(id, &source, |r, root| file::read(r, root, stem(&name)));
        let broken = findings.iter().any(|f| f.code == Some("E0701"));
        loader.findings.extend(findings);
        if broken {
            // A file that is not TOML lacks everything after the mistake; reporting that would not help.
            continue;
        }
        names::check(&file, &said, &mut loader.findings);
        lacking.push(required::check(&file, &said, &mut loader.findings));
        words.push(Words::new(&file, &said));
        files.push(file);
    }
    names::compare(&files, &said, &lacking, &mut loader.findings);
    let default = &manifest.language;
    let all_read = !loader.findings.iter().any(|f| f.code == Some("E0701"));
    if all_read && !words.iter().any(|w| w.tag() == default) {
        let place = Place { source: from, span: manifest.language_span };
        let message = format!("there is no `{folder}/{default}.toml` for the default language");
        loader.findings.push(Finding::error("E0813", place, message));
    }
    words
}
