//! Inserts text into a section, at its end or as a new section.

use pddl::syntax::{self, Node};
use pddl::{Source, Span};

use crate::TextEdit;
use crate::describe::{typed, value_of};

/// Sections in their usual order, declarations before uses.
const ORDER: &[&str] =
    &[":domain", ":requirements", ":import", ":types", ":constants", ":objects", ":predicates", ":functions"];

/// Adds `text` to a section; creates the section at its usual place if the file has none.
pub(super) fn into_section(source: &Source, keyword: &str, text: &str) -> Option<TextEdit> {
    let (tree, _) = syntax::parse(source);
    let define = tree.roots().find(|n| n.is_headed("define"))?;
    let sections: Vec<Node<'_>> = define.children().skip(1).collect();
    if let Some(section) = sections.iter().find(|s| s.is_headed(keyword)) {
        let last = section.children().last()?;
        let own_line = section.children().skip(1).filter(|n| starts_line(source, *n)).last();
        let at = end_of_line_if_comment(source, last.span().end);
        let before = match own_line {
            Some(node) => format!("\n{}", " ".repeat(column(source, node))),
            None if at != last.span().end => format!("\n{}", " ".repeat(column(source, last))),
            None => " ".to_owned(),
        };
        return Some(insertion(at, format!("{before}{}{text}", type_of_those_before(*section, keyword))));
    }
    let rank = |node: &Node<'_>| ORDER.iter().position(|word| node.is_headed(word));
    let own = ORDER.iter().position(|word| *word == keyword)?;
    let earlier = sections.iter().rfind(|s| rank(s).is_some_and(|r| r < own));
    let after = earlier.or(sections.first())?;
    let at = end_of_line_if_comment(source, after.span().end);
    Some(insertion(at, format!("\n  ({keyword} {text})")))
}

/// An untyped last item must not receive the type of the inserted ones.
fn type_of_those_before(section: Node<'_>, keyword: &str) -> &'static str {
    let untyped = typed(section.children().skip(1)).last().is_some_and(|(_, types)| types.is_none());
    match keyword {
        ":functions" if untyped => "- number ",
        ":types" | ":constants" | ":objects" if untyped => "- object ",
        _ => "",
    }
}

/// A new line above a place, with the same indentation.
pub(super) fn before_line(source: &Source, offset: u32, text: &str) -> TextEdit {
    let at = source.line_column(offset);
    let line = source.line(at.line);
    let blank: String = line.chars().take_while(|c| c.is_whitespace()).collect();
    let before = line.chars().take(at.column as usize - 1).map(char::len_utf8).sum::<usize>();
    let start = offset - u32::try_from(before).unwrap_or(0);
    insertion(start, format!("{blank}{text}\n"))
}

/// Adds `text` to the parameters of a section with keys.
pub(super) fn into_parameters(section: Node<'_>, text: &str) -> Option<TextEdit> {
    if let Some(list) = value_of(section, ":parameters").filter(|n| n.is_list()) {
        return Some(match list.children().last() {
            Some(last) => insertion(last.span().end, format!(" {text}")),
            None => insertion(list.span().start + 1, text.to_owned()),
        });
    }
    let keyed = [":action", ":durative-action", ":task", ":method", ":process", ":event", ":invariant"];
    let name = section.children().nth(1).filter(|_| keyed.iter().any(|k| section.is_headed(k)))?;
    Some(insertion(name.span().end, format!("\n    :parameters ({text})")))
}

fn insertion(at: u32, text: String) -> TextEdit {
    TextEdit { span: Span::new(at, at), text }
}

fn column(source: &Source, node: Node<'_>) -> usize {
    source.line_column(node.span().start).column as usize - 1
}

fn starts_line(source: &Source, node: Node<'_>) -> bool {
    let at = source.line_column(node.span().start);
    source.line(at.line).chars().take(at.column as usize - 1).all(char::is_whitespace)
}

/// A comment behind the last item stays behind that item.
fn end_of_line_if_comment(source: &Source, end: u32) -> u32 {
    let rest = source.text().get(end as usize..).unwrap_or("");
    let line = rest.lines().next().unwrap_or("");
    match line.trim_start().starts_with(';') {
        true => end + u32::try_from(line.len()).unwrap_or(0),
        false => end,
    }
}
