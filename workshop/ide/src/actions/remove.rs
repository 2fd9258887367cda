//! Removes an unused declaration or parameter, if nothing else would have to change.

use diagnostics::SourceId;
use pddl::syntax::{self, Node, Tree};
use pddl::{Role, Span};
use project::{Linted, Project};

use crate::describe::typed;
use crate::entity::entity_at;
use crate::path::{Spot, path};
use crate::{Position, TextEdit};

/// The edit that removes what the finding is about; `None` if other places would have to change.
pub(super) fn remove(project: &Project, file: SourceId, linted: &Linted) -> Option<TextEdit> {
    let span = linted.finding.place.span;
    let (tree, _) = syntax::parse(project.source(file));
    match linted.lint {
        "unused-predicate" => {
            let way = path(&tree, span.start);
            let list = way.iter().rev().find(|n| n.is_list())?;
            let section = way.len().checked_sub(3).map(|i| way[i])?;
            list.head().filter(|h| h.span() == span)?;
            // Facts and goals of problems may still use it.
            if is_used(project, file, span) { None } else { Some(cut(section, list.span(), list.span())) }
        }
        "unused-parameter" => {
            // Every use of the action has an argument for the parameter.
            let name = Spot::of(&tree, span)?.name()?.span();
            if is_used(project, file, name) { None } else { item(&tree, span) }
        }
        _ => None,
    }
}

fn is_used(project: &Project, file: SourceId, name: Span) -> bool {
    let entity = entity_at(project, Position { source: file, offset: name.start });
    entity.is_some_and(|(entity, _)| entity.occurrences(project).iter().any(|(_, o)| o.role == Role::Use))
}

/// An item of a typed list, with its type if it is the only item of that type.
fn item(tree: &Tree<'_>, span: Span) -> Option<TextEdit> {
    let way = path(tree, span.start);
    let list = *way.iter().rev().find(|n| n.is_list())?;
    let items = typed(list.children());
    let (_, types) = items.iter().find(|(item, _)| item.span() == span)?;
    let types = types.map(Node::span);
    let alone = items.iter().filter(|(_, t)| t.map(Node::span) == types).count() == 1;
    let end = types.filter(|_| alone).map_or(span.end, |types| types.end);
    Some(cut(list, span, Span::new(span.start, end)))
}

/// Removes `whole`, which begins with the child at `first`, and the white space before it.
fn cut(list: Node<'_>, first: Span, whole: Span) -> TextEdit {
    let before = list.children().take_while(|n| n.span().start < first.start).last();
    match before {
        Some(before) => TextEdit { span: Span::new(before.span().end, whole.end), text: String::new() },
        None => {
            let next = list.children().find(|n| n.span().start >= whole.end);
            let end = next.map_or(whole.end, |next| next.span().start);
            TextEdit { span: Span::new(whole.start, end), text: String::new() }
        }
    }
}
