//! `(:requirements :strips …)`. An unknown flag is a warning; a missing one is accepted.

use super::header::Header;
use super::sink::Sink;
use crate::diagnostic::{DiagnosticKind, SymbolKind};
use crate::model::{Requirement, Requirements};
use crate::occurrence::NameKind;

pub(crate) fn requirements(sink: &mut Sink, header: &Header<'_>) -> Requirements {
    let mut flags = Requirements::default();
    for section in header.all(":requirements") {
        for node in section.children().skip(1) {
            if !node.is_list() {
                sink.mention(NameKind::Requirement, node, None);
            }
            let known = Requirement::ALL.iter().copied().find(|r| node.is(r.as_str()));
            let synonym = || Requirement::SYNONYMS.iter().find(|(text, _)| node.is(text)).map(|(_, r)| *r);
            match known.or_else(synonym) {
                Some(flag) => {
                    flags.0.insert(flag);
                }
                None if node.is_list() => sink.unexpected(node, "a flag such as `:typing`"),
                None => {
                    let name = node.text().to_owned();
                    let suggestion = sink.suggest(&name, Requirement::ALL.iter().map(|r| r.as_str()));
                    let symbol = SymbolKind::Requirement;
                    sink.report(node.span(), DiagnosticKind::Unknown { symbol, name, suggestion });
                }
            }
        }
    }
    flags
}
