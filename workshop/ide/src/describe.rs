//! Declarations in words: signature and comment, from the text.
//!
//! They come from the text and not from the model, since the text is there while the model is not, and since
//! it is what the author wrote. The comments of a declaration are those on lines of their own directly above
//! it (if it starts its line), and the one behind it on the same line.

use diagnostics::Place;
use pddl::syntax::{self, Node, NodeKind, Tree};
use pddl::{NameKind, Source, Span};
use project::Project;

use crate::path::{Spot, path};

/// A node on one line, without comments.
pub(crate) fn flat(node: Node<'_>) -> String {
    if !node.is_list() {
        return node.text().to_owned();
    }
    let parts: Vec<String> = node.children().map(flat).collect();
    format!("({})", parts.join(" "))
}

/// The type of each word of a typed list; `None` for an untyped word.
pub(crate) fn typed<'t>(nodes: impl Iterator<Item = Node<'t>>) -> Vec<(Node<'t>, Option<Node<'t>>)> {
    let mut items: Vec<(Node<'t>, Option<Node<'t>>)> = Vec::new();
    let mut from = 0;
    let mut nodes = nodes.peekable();
    while let Some(node) = nodes.next() {
        if !node.is("-") {
            items.push((node, None));
            continue;
        }
        let types = nodes.next_if(|n| n.is_list() || n.is_name() && !n.is("-"));
        for item in &mut items[from..] {
            item.1 = types;
        }
        from = items.len();
    }
    items
}

/// The value of a section's key.
pub(crate) fn value_of<'t>(section: Node<'t>, key: &str) -> Option<Node<'t>> {
    let mut nodes = section.children().skip_while(|n| !n.is(key)).skip(1);
    nodes.next().filter(|n| n.kind() != NodeKind::Keyword)
}

/// `(go ?from ?to - room)` for `(:action go :parameters (?from ?to - room) …)`.
pub(crate) fn section_signature(section: Node<'_>) -> String {
    let name = section.children().nth(1).filter(|n| n.is_name()).map_or("", Node::text);
    let parameters = value_of(section, ":parameters").filter(|n| n.is_list());
    let parts = parameters.into_iter().flat_map(Node::children).map(flat);
    let all: Vec<String> = std::iter::once(name.to_owned()).chain(parts).collect();
    format!("({})", all.join(" "))
}

/// The declaration of a name on one line.
pub(crate) fn signature(tree: &Tree<'_>, span: Span, kind: NameKind) -> Option<String> {
    let way = path(tree, span.start);
    let name = *way.last().filter(|n| n.span() == span)?;
    let around = way.len().checked_sub(2).map(|i| way[i])?;
    let types = || {
        let item = typed(around.children()).into_iter().find(|(item, _)| item.span() == span);
        item.and_then(|(_, types)| types).map(flat)
    };
    Some(match kind {
        NameKind::Predicate => flat(around),
        NameKind::Function => {
            let section = way.len().checked_sub(3).map(|i| way[i]).filter(|_| around.is_headed(name.text()));
            let (whole, list) = section.map_or((name, around), |section| (around, section));
            let value = typed(list.children()).into_iter().find(|(item, _)| item.span() == whole.span());
            let value = value.and_then(|(_, types)| types).map_or_else(|| "number".to_owned(), flat);
            format!("{} - {value}", flat(whole))
        }
        NameKind::Type | NameKind::Object => {
            format!("{} - {}", name.text(), types().unwrap_or_else(|| "object".to_owned()))
        }
        NameKind::Variable => format!("{} - {}", name.text(), types().unwrap_or_else(|| "object".to_owned())),
        NameKind::Action | NameKind::Task | NameKind::Process | NameKind::Event | NameKind::Invariant => {
            section_signature(around)
        }
        NameKind::Method => {
            let task = value_of(around, ":task").map(|task| format!(" for {}", flat(task)));
            format!("{}{}", section_signature(around), task.unwrap_or_default())
        }
        NameKind::Subtask | NameKind::Preference => flat(around),
        NameKind::Domain | NameKind::Problem => format!("({kind} {})", name.text()),
        NameKind::Requirement | NameKind::Skill | NameKind::Agent => name.text().to_owned(),
    })
}

/// The same for a declaration in some file.
pub(crate) fn signature_at(project: &Project, place: Place, kind: NameKind) -> Option<String> {
    let (tree, _) = syntax::parse(project.source(place.source));
    signature(&tree, place.span, kind)
}

/// The comment that belongs to the declaration of a name, without semicolons.
pub(crate) fn comment(project: &Project, name: Place) -> Option<String> {
    let source = project.source(name.source);
    let (tree, _) = syntax::parse(source);
    let whole = crate::definition::full(project, name).span;
    let in_section = Spot::of(&tree, name.span).is_some_and(|spot| spot.section.span() == whole);
    let mut lines = above(source, whole);
    // A section's own comment stands behind its head, that of other declarations behind their end.
    let behind = if in_section { name.span.end } else { whole.end };
    lines.extend(after(source, behind));
    lines.retain(|line| !line.starts_with("allow("));
    let text = lines.join("\n").trim().to_owned();
    (!text.is_empty()).then_some(text)
}

/// The comments on the lines directly above a place that starts its line.
fn above(source: &Source, whole: Span) -> Vec<String> {
    let at = source.line_column(whole.start);
    let before: String = source.line(at.line).chars().take(at.column as usize - 1).collect();
    let mut lines = Vec::new();
    if before.trim().is_empty() {
        let comments =
            (1..at.line).rev().map(|line| source.line(line).trim()).take_while(|l| l.starts_with(';'));
        lines.extend(comments.map(text_of));
        lines.reverse();
    }
    lines
}

/// The comment behind a place, if only parentheses stand between.
fn after(source: &Source, end: u32) -> Option<String> {
    let rest = source.text().get(end as usize..)?.lines().next()?;
    let comment = rest.trim_start_matches(|c: char| c.is_whitespace() || c == ')');
    comment.starts_with(';').then(|| text_of(comment))
}

fn text_of(comment: &str) -> String {
    comment.trim_start_matches(';').trim().to_owned()
}
