//! Another name for a thing, wherever it stands.

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
    /// Where it stands, without a variable's question mark.
    pub place: Place,
    /// As it is now.
    pub name: String,
}

/// Why a name cannot be changed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RenameError {
    /// No name stands there.
    #[error("there is no name here")]
    NoName,
    /// It is part of the language or of something outside the project.
    #[error("the {kind} `{name}` is not the project's to rename")]
    Foreign {
        /// What it is.
        kind: NameKind,
        /// Which.
        name: String,
    },
    /// The new name is none.
    #[error("`{name}` is not a name")]
    Invalid {
        /// As asked for.
        name: String,
    },
    /// The language has other plans for the new name.
    #[error("`{name}` is a word of the language")]
    Reserved {
        /// As asked for.
        name: String,
    },
    /// There is one already.
    #[error("the {kind} `{name}` exists already")]
    Clash {
        /// What the other one is.
        kind: NameKind,
        /// The name.
        name: String,
        /// Where the other one stands.
        place: Place,
    },
    /// A file in which the name stands has parentheses that do not match: not every occurrence may be known.
    #[error("a file in which it stands is broken: its parentheses do not match")]
    Broken {
        /// Where.
        place: Place,
    },
}

/// Words that are no names where conditions, effects, types or terms stand.
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

/// Gives the thing at a position another name in all files, closed ones and plans included. A variable's name may
/// come with its question mark or without.
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
    // A file that does not name it may still see it.
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
    // Requirements, skills and agents are declared elsewhere, if at all; so is what is only used.
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

/// A file with lists that never end may hold names that were not read.
fn check_whole(project: &Project, file: SourceId) -> Result<(), RenameError> {
    let (_, broken) = syntax::parse(project.source(file));
    match broken.first() {
        Some(diagnostic) => Err(RenameError::Broken { place: Place { source: file, span: diagnostic.span } }),
        None => Ok(()),
    }
}

/// Kinds that share their names with `kind`: what one of them names, no other may.
fn namespace(kind: NameKind) -> &'static [NameKind] {
    match kind {
        NameKind::Action | NameKind::Task | NameKind::Process | NameKind::Event => {
            &[NameKind::Action, NameKind::Task, NameKind::Process, NameKind::Event]
        }
        // A type may be used as a predicate of one argument, a function without arguments as an object.
        NameKind::Type | NameKind::Predicate => &[NameKind::Type, NameKind::Predicate],
        NameKind::Function | NameKind::Object => &[NameKind::Function, NameKind::Object],
        NameKind::Domain => &[NameKind::Domain],
        NameKind::Problem => &[NameKind::Problem],
        NameKind::Requirement => &[NameKind::Requirement],
        NameKind::Variable => &[NameKind::Variable],
        NameKind::Method => &[NameKind::Method],
        NameKind::Subtask => &[NameKind::Subtask],
        NameKind::Preference => &[NameKind::Preference],
        NameKind::Skill => &[NameKind::Skill],
        NameKind::Agent => &[NameKind::Agent],
    }
}

/// Whether the new name means nothing yet where the old one stands.
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
