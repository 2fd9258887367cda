//! The thing that a name denotes, over all files.
//!
//! Problem: a predicate's name stands in its domain, in domains that import it, in problems and in plans,
//! and a predicate of another domain may have the same name. Idea: a name denotes the declarations in the
//! files that its own file needs (its *homes*). Two names denote one thing if they share a home. A domain
//! may import two domains that both declare it; those are one thing too, so homes are joined until nothing
//! changes. Cost: a visit to every occurrence of the project.

use std::collections::BTreeSet;

use diagnostics::{Place, SourceId};
use pddl::{NameKind, Occurrence, Role, Span, Symbol};
use project::{FileKind, Project};

use crate::Position;

/// A declared thing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Entity {
    pub(crate) symbol: Symbol,
    /// The files that declare it; empty if it is undeclared.
    pub(crate) homes: BTreeSet<SourceId>,
}

/// The occurrence at a position; if two touch there, the later one.
pub(crate) fn occurrence_at(project: &Project, at: Position) -> Option<&Occurrence> {
    let all = project.reading(at.source)?.occurrences();
    let end = all.partition_point(|o| o.span.start <= at.offset);
    // Occurrences do not overlap, so only the last ones that start before can contain the position.
    all[..end].iter().rev().take(2).find(|o| at.offset <= o.span.end)
}

/// The thing at a position, with its occurrence there.
pub(crate) fn entity_at(project: &Project, at: Position) -> Option<(Entity, &Occurrence)> {
    let occurrence = occurrence_at(project, at)?;
    Some((Entity::of(project, at.source, &occurrence.symbol), occurrence))
}

/// Whether the name is local to its file.
pub(crate) fn is_local(kind: NameKind) -> bool {
    matches!(kind, NameKind::Variable | NameKind::Subtask)
}

/// Whether domains that import a domain inherit it.
fn is_imported(kind: NameKind) -> bool {
    matches!(
        kind,
        NameKind::Type | NameKind::Predicate | NameKind::Function | NameKind::Object | NameKind::Domain
    )
}

/// The files that may declare a name of that kind for `file`: itself and those that it needs.
pub(crate) fn visible_from(project: &Project, file: SourceId, kind: NameKind) -> Vec<SourceId> {
    let mut found = vec![file];
    let mut next = 0;
    while let Some(&at) = found.get(next) {
        next += 1;
        if project.kind(at) == FileKind::Domain && !is_imported(kind) {
            continue;
        }
        for &need in project.needs(at).iter().flatten() {
            if !found.contains(&need) {
                found.push(need);
            }
        }
    }
    found
}

/// The occurrences of a file.
pub(crate) fn occurrences(project: &Project, file: SourceId) -> &[Occurrence] {
    project.reading(file).map_or(&[], |reading| reading.occurrences())
}

fn declares(project: &Project, file: SourceId, symbol: &Symbol) -> bool {
    occurrences(project, file).iter().any(|o| o.role == Role::Declaration && o.symbol == *symbol)
}

fn homes(project: &Project, file: SourceId, symbol: &Symbol) -> BTreeSet<SourceId> {
    let files = visible_from(project, file, symbol.kind).into_iter();
    files.filter(|&other| declares(project, other, symbol)).collect()
}

impl Entity {
    /// The thing that `symbol` denotes in `file`.
    pub(crate) fn of(project: &Project, file: SourceId, symbol: &Symbol) -> Self {
        let mut entity = Self { symbol: symbol.clone(), homes: BTreeSet::new() };
        if is_local(symbol.kind) {
            entity.homes.insert(file);
            return entity;
        }
        entity.homes = homes(project, file, symbol);
        loop {
            let before = entity.homes.len();
            for other in project.ids() {
                let theirs = homes(project, other, symbol);
                if !theirs.is_disjoint(&entity.homes) {
                    entity.homes.extend(theirs);
                }
            }
            if entity.homes.len() == before {
                return entity;
            }
        }
    }

    /// All its occurrences, by file and place.
    pub(crate) fn occurrences<'p>(&self, project: &'p Project) -> Vec<(SourceId, &'p Occurrence)> {
        let mut found = Vec::new();
        for file in project.ids() {
            let mut here = occurrences(project, file).iter().filter(|o| o.symbol == self.symbol).peekable();
            if here.peek().is_some() && self.is_known_in(project, file) {
                found.extend(here.map(|o| (file, o)));
            }
        }
        found
    }

    /// Whether the name denotes it in `file`. An undeclared thing has one identity in all files that use the
    /// name without a declaration.
    pub(crate) fn is_known_in(&self, project: &Project, file: SourceId) -> bool {
        if is_local(self.symbol.kind) {
            return self.homes.contains(&file);
        }
        let theirs = homes(project, file, &self.symbol);
        theirs.is_empty() && self.homes.is_empty() || !theirs.is_disjoint(&self.homes)
    }

    /// Its declarations, by file and place.
    pub(crate) fn declarations(&self, project: &Project) -> Vec<Place> {
        let mut found = Vec::new();
        for &file in &self.homes {
            let all = occurrences(project, file).iter();
            let spans =
                all.filter(|o| o.role == Role::Declaration && o.symbol == self.symbol).map(|o| o.span);
            found.extend(spans.map(|span| Place { source: file, span }));
        }
        found
    }
}

/// The name without a variable's question mark.
pub(crate) fn bare(kind: NameKind, span: Span) -> Span {
    if kind == NameKind::Variable { Span::new((span.start + 1).min(span.end), span.end) } else { span }
}
