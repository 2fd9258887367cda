//! The declarations of a name.

use diagnostics::Place;
use pddl::syntax;
use project::Project;

use crate::Position;
use crate::entity::entity_at;
use crate::path::path;

/// The declarations of a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definition {
    /// The name in question.
    pub origin: Place,
    /// Its declarations: several if imported domains declare it, or a problem repeats a constant.
    pub targets: Vec<Target>,
}

/// A declaration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Target {
    /// The whole declaration.
    pub full: Place,
    /// The name in it.
    pub name: Place,
}

/// The declarations of the name at a position; `None` if no name stands there or nothing declares it.
pub fn definition(project: &Project, at: Position) -> Option<Definition> {
    let (entity, occurrence) = entity_at(project, at)?;
    let targets: Vec<Target> = entity
        .declarations(project)
        .into_iter()
        .map(|name| Target { full: full(project, name), name })
        .collect();
    let origin = Place { source: at.source, span: occurrence.span };
    (!targets.is_empty()).then_some(Definition { origin, targets })
}

/// The whole declaration of a name: the list that it opens, or the name itself in a list of names.
pub(crate) fn full(project: &Project, name: Place) -> Place {
    let (tree, _) = syntax::parse(project.source(name.source));
    let way = path(&tree, name.span.start);
    let lists: Vec<_> = way.iter().rev().filter(|n| n.is_list()).collect();
    let sections =
        [":action", ":durative-action", ":task", ":method", ":process", ":event", ":invariant", "preference"];
    let opens = lists.first().and_then(|list| {
        // `(at ?x)`, `(:action go …)`, and `(define (domain hall) …)`.
        let head = list.head()?;
        let own = head.span() == name.span || sections.iter().any(|word| head.is(word));
        let title = head.is("domain") || head.is("problem");
        if own { Some(list) } else { lists.get(1).filter(|_| title) }
    });
    Place { span: opens.map_or(name.span, |list| list.span()), ..name }
}
