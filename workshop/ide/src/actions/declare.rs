//! Declares undeclared names, with types inferred from their uses.

use diagnostics::SourceId;
use pddl::model::ObjectTypes;
use pddl::syntax::{self, Node, Tree};
use pddl::{NameKind, Span, SymbolKind};
use project::{FileKind, Project};

use super::insert::{into_parameters, into_section};
use crate::applied::{applied, domain, type_text};
use crate::context::Context;
use crate::path::{Spot, path};
use crate::{Edits, TextEdit};

/// The edits that declare an unknown name; `None` if its use does not determine a declaration.
pub(super) fn declare(
    project: &Project,
    file: SourceId,
    span: Span,
    symbol: SymbolKind,
) -> Option<(String, Edits)> {
    let source = project.source(file);
    let (tree, _) = syntax::parse(source);
    let name = source.slice(span);
    let home = project.domain_of(file)?;
    let (place, text) = match symbol {
        SymbolKind::Predicate => ((home, ":predicates"), applied_form(project, file, &tree, span)?),
        SymbolKind::Function => {
            ((home, ":functions"), format!("{} - number", applied_form(project, file, &tree, span)?))
        }
        SymbolKind::Type => ((home, ":types"), format!("{name} - object")),
        SymbolKind::Object => {
            let types = wanted(project, file, span)?;
            match project.kind(file) {
                FileKind::Domain => ((home, ":constants"), format!("{name} - {types}")),
                FileKind::Problem => ((file, ":objects"), format!("{name} - {types}")),
                FileKind::Plan => return None,
            }
        }
        SymbolKind::Variable => {
            let types = wanted(project, file, span)?;
            let section = Spot::of(&tree, span)?.section;
            let text = format!("{name} - {types}");
            let title = format!("Add the parameter `{text}`");
            return Some((title, of_one(file, into_parameters(section, &text)?)));
        }
        _ => return None,
    };
    let title = format!("Declare the {symbol} `{text}`");
    Some((title, of_one(place.0, into_section(project.source(place.0), place.1, &text)?)))
}

/// One edit of one file.
pub(super) fn of_one(file: SourceId, edit: TextEdit) -> Edits {
    Edits { files: [(file, vec![edit])].into() }
}

/// `(at ?l - lamp ?x - place)` for the list with the head at `span`: its arguments with their types.
fn applied_form(project: &Project, file: SourceId, tree: &Tree<'_>, span: Span) -> Option<String> {
    let way = path(tree, span.start);
    let list =
        way.iter().rev().find(|n| n.is_list()).filter(|list| list.head().is_some_and(|h| h.span() == span));
    let name = project.source(file).slice(span);
    let Some(list) = list else { return Some(format!("({name})")) };
    let variables = Context::of(project.source(file), span.start)?.variables();
    let mut text = format!("({name}");
    for (number, argument) in (1..).zip(list.children().skip(1)) {
        let known = variables.iter().find(|(variable, _)| argument.is(variable));
        let (parameter, types) = match known {
            Some((variable, types)) => (variable.clone(), either(types)),
            None => (format!("?x{number}"), object_type(project, file, argument)),
        };
        text += &format!(" {parameter} - {types}");
    }
    Some(text + ")")
}

fn either(types: &[String]) -> String {
    match types {
        [one] => one.clone(),
        many => format!("(either {})", many.join(" ")),
    }
}

fn object_type(project: &Project, file: SourceId, argument: Node<'_>) -> String {
    let name = argument.text().to_ascii_lowercase();
    let Some(domain) = domain(project, file) else { return "object".to_owned() };
    let problem = project.problem_of(file).and_then(|problem| project.problem(problem));
    let own = problem.and_then(|problem| Some(&problem.objects[problem.object(&name)?].types));
    let types: Option<&ObjectTypes> = own.or_else(|| Some(&domain.constants[domain.constant(&name)?].types));
    types.map_or_else(|| "object".to_owned(), |types| type_text(&domain.types, types.declared()))
}

/// The type that an argument at `span` must have.
fn wanted(project: &Project, file: SourceId, span: Span) -> Option<String> {
    let context = Context::of(project.source(file), span.start)?;
    let position = context.inner()?.items.len().checked_sub(1)?;
    let found = applied(project, file, &context).filter(|found| found.kind != NameKind::Problem);
    let types =
        found.as_ref().and_then(|found| found.parameters.get(position).map(|(_, t)| found.type_text(t)));
    Some(types.unwrap_or_else(|| "object".to_owned()))
}
