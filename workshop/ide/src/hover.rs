//! Hover: the meaning of a name, a word or a finding.

use std::fmt::Write as _;

use diagnostics::{Place, SourceId};
use pddl::model::{Domain, TypeId};
use pddl::syntax::{self, NodeKind};
use pddl::{NameKind, Span};
use project::Project;

use crate::Position;
use crate::describe::{comment, signature_at};
use crate::entity::{Entity, entity_at};
use crate::path::{Spot, path};
use crate::usage::{Usage, usages};
use crate::words::meaning;

/// The contents of a hover.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hover {
    /// The place that it is about.
    pub place: Place,
    /// The text, as Markdown.
    pub markdown: String,
}

/// The hover for a position. It shows a name with its signature, comment and usage, or a word of the
/// language, and the meaning of the findings there. Lints count only if they have run.
pub fn hover(project: &Project, at: Position) -> Option<Hover> {
    let (mut span, mut parts) = (None, Vec::new());
    if let Some((entity, occurrence)) = entity_at(project, at) {
        span = Some(occurrence.span);
        parts.extend(of_name(project, at.source, &entity));
    } else if let Some((word, text)) = of_word(project, at) {
        span = Some(word);
        parts.push(text);
    }
    // Lints may be slow, so only cached findings are shown.
    let lints = project.cached_lint_findings(at.source).iter().map(|linted| &linted.finding);
    for finding in project.language_findings(at.source).iter().chain(lints) {
        let place = finding.place.span;
        let around = place.start <= at.offset && at.offset <= place.end;
        // A finding over several lines is not about the word.
        if !around || project.source(at.source).slice(place).contains('\n') {
            continue;
        }
        let explanation = finding.code.and_then(|code| {
            pddl::explain(code).or_else(|| lints::find(code).map(|lint| &*lint.explanation))
        });
        if let Some(explanation) = explanation {
            span.get_or_insert(place);
            parts.push(format!("**{}** {}: {}", explanation.code, explanation.title, explanation.meaning));
        }
    }
    let place = Place { source: at.source, span: span? };
    (!parts.is_empty()).then(|| Hover { place, markdown: parts.join("\n\n---\n\n") })
}

fn of_word(project: &Project, at: Position) -> Option<(Span, String)> {
    let (tree, _) = syntax::parse(project.source(at.source));
    let word = *path(&tree, at.offset).last().filter(|n| n.kind() != NodeKind::List)?;
    let meaning = meaning(word.text())?;
    Some((word.span(), format!("`{}`\n\n{meaning}", word.text())))
}

fn of_name(project: &Project, file: SourceId, entity: &Entity) -> Option<String> {
    let symbol = &entity.symbol;
    if symbol.kind == NameKind::Requirement || entity.declarations(project).is_empty() {
        return undeclared(entity);
    }
    let declarations = entity.declarations(project);
    // The nearest declaration: the file's own, else the first.
    let place = *declarations.iter().find(|place| place.source == file).or(declarations.first())?;
    let signature = signature_at(project, place, symbol.kind)?;
    let mut text = format!("```pddl\n{signature}\n```\n{}", of_kind(project, place, symbol.kind));
    if place.source != file {
        let _ = write!(text, ", declared in `{}`", project.path(place.source));
    }
    if let Some(comment) = comment(project, place) {
        let _ = write!(text, "\n\n{comment}");
    }
    let domain = project.domain_of(file).and_then(|domain| project.domain(domain));
    if let Some(domain) = domain {
        for line in hierarchy(project, file, domain, entity) {
            let _ = write!(text, "\n\n{line}");
        }
    }
    if matches!(symbol.kind, NameKind::Predicate | NameKind::Function | NameKind::Action | NameKind::Task) {
        for (usage, users) in usages(project, entity) {
            let names: Vec<String> = users.iter().map(|name| format!("`{name}`")).collect();
            let names = if usage == Usage::Derives { "by an axiom".to_owned() } else { names.join(", ") };
            let _ = write!(text, "\n\n*{}* {names}", usage.words());
        }
    }
    Some(text)
}

/// A word that names something outside of all files, or an undeclared name.
fn undeclared(entity: &Entity) -> Option<String> {
    let symbol = &entity.symbol;
    let name = format!("`{}`", symbol.name);
    match symbol.kind {
        NameKind::Requirement => Some(format!("{name}\n\n{}", meaning(&symbol.name)?)),
        NameKind::Type if &*symbol.name == "object" => Some(format!("{name}\n\n{}", meaning("object")?)),
        NameKind::Skill => Some(format!("{name}\n\nskill: what an agent can do on a device")),
        NameKind::Agent => Some(format!("{name}\n\nagent")),
        _ => None,
    }
}

/// `predicate`, `parameter of action go`, `bound by forall`.
fn of_kind(project: &Project, place: Place, kind: NameKind) -> String {
    if kind != NameKind::Variable {
        return kind.to_string();
    }
    let (tree, _) = syntax::parse(project.source(place.source));
    let Some(spot) = Spot::of(&tree, place.span) else { return kind.to_string() };
    let quantifier = spot.lists.iter().rev().find(|n| n.is_headed("forall") || n.is_headed("exists"));
    match (quantifier.and_then(|n| n.head()), spot.name()) {
        (Some(word), _) => format!("variable, bound by `{}`", word.text()),
        (None, Some(name)) if spot.has_key(":results") => format!("variable, result of `{}`", name.text()),
        (None, Some(name)) => format!("variable, parameter of `{}`", name.text()),
        (None, None) => kind.to_string(),
    }
}

/// The position of a type or an object in the hierarchy.
fn hierarchy(project: &Project, file: SourceId, domain: &Domain, entity: &Entity) -> Vec<String> {
    let name = entity.symbol.name.as_str();
    match entity.symbol.kind {
        NameKind::Type => {
            let Some(id) = domain.types.find(name) else { return Vec::new() };
            let below: Vec<String> = domain
                .types
                .enumerate()
                .filter(|(_, t)| t.parents.contains(&id))
                .map(|(_, t)| format!("`{}`", t.name))
                .collect();
            let mut lines = vec![chain(domain, id)];
            if !below.is_empty() {
                lines.push(format!("*above* {}", below.join(", ")));
            }
            lines
        }
        NameKind::Object => {
            let problem = project.problem_of(file).and_then(|problem| project.problem(problem));
            let own = problem.and_then(|problem| Some(&problem.objects[problem.object(name)?]));
            let object = own.or_else(|| Some(&domain.constants[domain.constant(name)?]));
            object.map_or_else(Vec::new, |o| o.types.declared().iter().map(|&t| chain(domain, t)).collect())
        }
        _ => Vec::new(),
    }
}

/// `truck → vehicle → object`; several parents with a slash.
fn chain(domain: &Domain, id: TypeId) -> String {
    let mut text = format!("`{}`", domain.types[id].name);
    let mut level = vec![id];
    let mut seen = level.clone();
    loop {
        let mut next: Vec<TypeId> = Vec::new();
        for parent in level.iter().flat_map(|&t| &domain.types[t].parents) {
            if !seen.contains(parent) {
                seen.push(*parent);
                next.push(*parent);
            }
        }
        if next.is_empty() {
            return text;
        }
        let names: Vec<String> = next.iter().map(|&t| format!("`{}`", domain.types[t].name)).collect();
        let _ = write!(text, " → {}", names.join(" / "));
        level = next;
    }
}
