//! Signature help: the parameters of a symbol while its arguments are written.

use diagnostics::Place;
use pddl::NameKind;
use project::Project;

use crate::Position;
use crate::applied::applied;
use crate::context::Context;
use crate::describe::comment;
use crate::entity::Entity;

/// A signature and its current parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SignatureHelp {
    /// `(at ?who - person ?where - place)`
    pub label: String,
    /// The range of each parameter in the label, in bytes.
    pub parameters: Vec<std::ops::Range<usize>>,
    /// The current parameter; `None` behind the last.
    pub active: Option<usize>,
    /// The comment at the declaration, as Markdown.
    pub documentation: Option<String>,
}

/// The signature of the symbol whose arguments surround a position.
pub fn signature_help(project: &Project, at: Position) -> Option<SignatureHelp> {
    let context = Context::of(project.source(at.source), at.offset)?;
    let list = context.inner().filter(|list| !list.items.is_empty())?;
    let found = applied(project, at.source, &context)?;
    let mut label = format!("({}", list.head());
    let mut parameters = Vec::with_capacity(found.parameters.len());
    for (name, types) in &found.parameters {
        label.push(' ');
        let start = label.len();
        label += &format!("?{name} - {}", found.type_text(types));
        parameters.push(start..label.len());
    }
    label.push(')');
    let active = Some(list.items.len() - 1).filter(|&i| i < parameters.len());
    let documentation = documentation(project, at, found.kind, list.head());
    Some(SignatureHelp { label, parameters, active, documentation })
}

pub(crate) fn documentation(project: &Project, at: Position, kind: NameKind, name: &str) -> Option<String> {
    let symbol = pddl::Symbol { kind, name: pddl::model::Name::new(name), scope: None };
    let places: Vec<Place> = Entity::of(project, at.source, &symbol).declarations(project);
    comment(project, *places.first()?)
}
