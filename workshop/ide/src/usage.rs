//! How a declared thing is used: who needs it, adds it, deletes it, changes it.
//!
//! The lists around a name determine its use, not the model, so this works for drafts and for every part of
//! the language that has conditions and effects.

use pddl::syntax::{self, Node};
use pddl::{NameKind, Role, Span};
use project::{FileKind, Project};

use crate::entity::Entity;
use crate::path::Spot;

/// The effect of one use.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Usage {
    Needs,
    Adds,
    Deletes,
    Changes,
    Derives,
    Decomposes,
    Holds,
    Writes,
}

impl Usage {
    /// The words before the list of users.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Needs => "needed by",
            Self::Adds => "added by",
            Self::Deletes => "deleted by",
            Self::Changes => "changed by",
            Self::Derives => "derived",
            Self::Decomposes => "carried out by",
            Self::Holds => "subtask of",
            Self::Writes => "written by",
        }
    }
}

/// The users of a thing by kind of use, each once, in the order of files and places. Only domains count.
pub(crate) fn usages(project: &Project, entity: &Entity) -> Vec<(Usage, Vec<String>)> {
    let mut found: Vec<(Usage, Vec<String>)> = Vec::new();
    let uses = entity.occurrences(project);
    for file in project.ids().filter(|&file| project.kind(file) == FileKind::Domain) {
        let here: Vec<Span> =
            uses.iter().filter(|(f, o)| *f == file && o.role == Role::Use).map(|(_, o)| o.span).collect();
        if here.is_empty() {
            continue;
        }
        let (tree, _) = syntax::parse(project.source(file));
        for span in here {
            let Some((usage, user)) =
                Spot::of(&tree, span).and_then(|spot| usage(&spot, span, entity.symbol.kind))
            else {
                continue;
            };
            match found.iter_mut().find(|(d, _)| *d == usage) {
                Some((_, all)) if all.contains(&user) => {}
                Some((_, all)) => all.push(user),
                None => found.push((usage, vec![user])),
            }
        }
    }
    found.sort_by_key(|(usage, _)| *usage);
    found
}

fn usage(spot: &Spot<'_>, span: Span, kind: NameKind) -> Option<(Usage, String)> {
    let name = || spot.name().map_or_else(String::new, |n| n.text().to_owned());
    let keyword = spot.keyword().to_ascii_lowercase();
    let subtasks = [":subtasks", ":tasks", ":ordered-subtasks", ":ordered-tasks"];
    match keyword.as_str() {
        ":writes" => Some((Usage::Writes, name())),
        ":derived" => {
            let head = spot.section.children().nth(1)?;
            let in_head = head.span().start <= span.start && span.end <= head.span().end;
            let derived = head.head().map_or("", Node::text).to_owned();
            Some((if in_head { Usage::Derives } else { Usage::Needs }, derived))
        }
        ":method" if spot.has_key(":task") => Some((Usage::Decomposes, name())),
        ":method" if subtasks.iter().any(|key| spot.has_key(key)) => Some((Usage::Holds, name())),
        ":action" | ":durative-action" | ":process" | ":event" if spot.has_key(":effect") => {
            Some((effect(&spot.lists, span, kind), name()))
        }
        ":action" | ":durative-action" | ":process" | ":event" | ":method" => Some((Usage::Needs, name())),
        _ => None,
    }
}

/// The use of a name in an effect, by the lists around it.
fn effect(lists: &[Node<'_>], span: Span, kind: NameKind) -> Usage {
    let assigns = ["assign", "increase", "decrease", "scale-up", "scale-down"];
    let mut usage = if kind == NameKind::Predicate { Usage::Adds } else { Usage::Needs };
    for list in lists {
        let first =
            list.children().nth(1).is_some_and(|n| n.span().start <= span.start && span.end <= n.span().end);
        if list.is_headed("when") && first {
            return Usage::Needs;
        }
        if list.is_headed("not") && kind == NameKind::Predicate {
            usage = Usage::Deletes;
        }
        if assigns.iter().any(|word| list.is_headed(word)) {
            usage = if first && kind == NameKind::Function { Usage::Changes } else { Usage::Needs };
        }
    }
    usage
}
