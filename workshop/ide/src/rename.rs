//! Renames a declared thing in all files.

use std::collections::BTreeSet;

use diagnostics::{Place, SourceId};
use pddl::syntax::{self, NodeKind};
use pddl::{NameKind, Source, Span, Symbol};
use project::Project;

use crate::entity::{Entity, bare, entity_at, is_local, occurrences, visible_from};
use crate::{Edits, Position, TextEdit};

/// A name that can be changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Renamable {
    /// Its place, without a variable's question mark.
    pub place: Place,
    /// The present name.
    pub name: String,
}

/// Why a name cannot be changed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RenameError {
    /// No name stands at the position.
    #[error("there is no name here")]
    NoName,
    /// It is part of the language or of something outside the project.
    #[error("the {kind} `{name}` is not the project's to rename")]
    Foreign {
        /// Its kind.
        kind: NameKind,
        /// Its name.
        name: String,
    },
    /// The new name is not a valid name.
    #[error("`{name}` is not a name")]
    Invalid {
        /// The new name.
        name: String,
    },
    /// The new name is a reserved word.
    #[error("`{name}` is a word of the language")]
    Reserved {
        /// The new name.
        name: String,
    },
    /// The new name is in use.
    #[error("the {kind} `{name}` exists already")]
    Clash {
        /// The kind of the other thing.
        kind: NameKind,
        /// The name.
        name: String,
        /// The place of the other declaration.
        place: Place,
    },
    /// A file with the name has unbalanced parentheses, so that some occurrences may be unknown.
    #[error("a file in which it stands is broken: its parentheses do not match")]
    Broken {
        /// The place of the name.
        place: Place,
    },
}

/// Reserved words in conditions, effects, types and terms.
const RESERVED: &[&str] = &[
    "and",
    "or",
    "not",
    "imply",
    "forall",
    "exists",
    "when",
    "either",
    "preference",
    "object",
    "number",
    "define",
    "domain",
    "problem",
    "assign",
    "increase",
    "decrease",
    "scale-up",
    "scale-down",
    "undefined",
    "total-time",
    "is-violated",
    "minimize",
    "maximize",
    "duration",
];

/// Whether the name at a position can be changed.
pub fn prepare_rename(project: &Project, at: Position) -> Result<Renamable, RenameError> {
    let (entity, occurrence) = entity_at(project, at).ok_or(RenameError::NoName)?;
    let span = bare(occurrence.symbol.kind, occurrence.span);
    let name = project.source(at.source).slice(span).to_owned();
    check_owned(project, &entity, &name)?;
    Ok(Renamable { place: Place { source: at.source, span }, name })
}

/// Renames the thing at a position in all files, closed ones and plans included. A variable's name may have
/// its question mark or not.
pub fn rename(project: &Project, at: Position, name: &str) -> Result<Edits, RenameError> {
    let (entity, _) = entity_at(project, at).ok_or(RenameError::NoName)?;
    let symbol = &entity.symbol;
    check_owned(project, &entity, &symbol.name)?;
    let name = match symbol.kind {
        NameKind::Variable => name.strip_prefix('?').unwrap_or(name),
        _ => name,
    };
    check_name(symbol.kind, name)?;
    let all = entity.occurrences(project);
    for file in all.iter().map(|(file, _)| *file).collect::<BTreeSet<SourceId>>() {
        check_whole(project, file)?;
    }
    // A file without that name may still see the declaration.
    if !symbol.name.eq_ignore_ascii_case(name) {
        for file in project.ids().filter(|&file| entity.is_known_in(project, file)) {
            check_free(project, file, symbol, name)?;
        }
    }
    let mut edits = Edits::default();
    for (file, occurrence) in all {
        let span = bare(symbol.kind, occurrence.span);
        edits.files.entry(file).or_default().push(TextEdit { span, text: name.to_owned() });
    }
    Ok(edits)
}

fn check_owned(project: &Project, entity: &Entity, name: &str) -> Result<(), RenameError> {
    // Requirements, skills and agents have no declaration in the project; neither has a name with uses only.
    if entity.declarations(project).is_empty() {
        return Err(RenameError::Foreign { kind: entity.symbol.kind, name: name.to_owned() });
    }
    Ok(())
}

fn check_name(kind: NameKind, name: &str) -> Result<(), RenameError> {
    let text = if kind == NameKind::Variable { format!("?{name}") } else { name.to_owned() };
    let source = Source::new("", text);
    let (tree, _) = syntax::parse(&source);
    let wanted = if kind == NameKind::Variable { NodeKind::Variable } else { NodeKind::Name };
    let mut words = tree.roots();
    let whole = words.next().is_some_and(|n| n.kind() == wanted && n.span() == Span::new(0, n.span().end));
    let sound = whole && words.next().is_none() && tree.tokens().count() == 1 && !name.is_empty();
    let odd = |c: char| !(c.is_alphanumeric() || matches!(c, '-' | '_'));
    if !sound || name.contains(odd) {
        return Err(RenameError::Invalid { name: name.to_owned() });
    }
    if kind != NameKind::Variable && RESERVED.iter().any(|word| word.eq_ignore_ascii_case(name)) {
        return Err(RenameError::Reserved { name: name.to_owned() });
    }
    Ok(())
}

/// In a file with unclosed lists, some names may not have been read.
fn check_whole(project: &Project, file: SourceId) -> Result<(), RenameError> {
    let (_, broken) = syntax::parse(project.source(file));
    match broken.first() {
        Some(diagnostic) => Err(RenameError::Broken { place: Place { source: file, span: diagnostic.span } }),
        None => Ok(()),
    }
}

/// The kinds that share a namespace with `kind`.
fn namespace(kind: NameKind) -> &'static [NameKind] {
    match kind {
        NameKind::Action | NameKind::Task | NameKind::Process | NameKind::Event => {
            &[NameKind::Action, NameKind::Task, NameKind::Process, NameKind::Event]
        }
        // A type may be a predicate of one argument, a function without arguments may be an object.
        NameKind::Type | NameKind::Predicate => &[NameKind::Type, NameKind::Predicate],
        NameKind::Function | NameKind::Object => &[NameKind::Function, NameKind::Object],
        NameKind::Domain => &[NameKind::Domain],
        NameKind::Problem => &[NameKind::Problem],
        NameKind::Requirement => &[NameKind::Requirement],
        NameKind::Variable => &[NameKind::Variable],
        NameKind::Method => &[NameKind::Method],
        NameKind::Subtask => &[NameKind::Subtask],
        NameKind::Preference => &[NameKind::Preference],
        NameKind::Invariant => &[NameKind::Invariant],
        NameKind::Skill => &[NameKind::Skill],
        NameKind::Agent => &[NameKind::Agent],
    }
}

/// Whether the new name is free in every scope of the old one.
fn check_free(project: &Project, file: SourceId, symbol: &Symbol, name: &str) -> Result<(), RenameError> {
    let files = if is_local(symbol.kind) { vec![file] } else { visible_from(project, file, symbol.kind) };
    let overlap = |o: &Symbol| match (o.scope, symbol.scope) {
        (Some(a), Some(b)) => a.start < b.end && b.start < a.end,
        _ => true,
    };
    for file in files {
        let taken = occurrences(project, file).iter().find(|o| {
            o.symbol.name.eq_ignore_ascii_case(name)
                && namespace(symbol.kind).contains(&o.symbol.kind)
                && overlap(&o.symbol)
        });
        if let Some(taken) = taken {
            let place = Place { source: file, span: taken.span };
            return Err(RenameError::Clash { kind: taken.symbol.kind, name: name.to_owned(), place });
        }
    }
    Ok(())
}
