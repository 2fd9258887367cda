//! The ranges of a growing selection.

use pddl::{Span, syntax};
use project::Project;

use crate::Position;
use crate::path::path;

/// The ranges that enclose a position, from the word to the whole file; each contains the one before it.
pub fn selection(project: &Project, at: Position) -> Vec<Span> {
    let source = project.source(at.source);
    let (tree, _) = syntax::parse(source);
    let mut spans: Vec<Span> = Vec::new();
    for node in path(&tree, at.offset).into_iter().rev() {
        // The contents of a list come before the list with its parentheses.
        if node.is_list() {
            let inside = node
                .children()
                .fold(None, |all: Option<Span>, n| Some(all.map_or(n.span(), |all| all.to(n.span()))));
            spans.extend(inside);
        }
        spans.push(node.span());
    }
    let end = u32::try_from(source.text().len()).expect("a source is shorter than 4 GiB");
    spans.push(Span::new(0, end));
    let mut nested: Vec<Span> = Vec::with_capacity(spans.len());
    for span in spans {
        let grows = |last: &Span| span.start <= last.start && last.end <= span.end && span != *last;
        let around = span.start <= at.offset && at.offset <= span.end;
        if around && nested.last().is_none_or(grows) {
            nested.push(span);
        }
    }
    nested
}
