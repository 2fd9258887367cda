//! The symbol that a list applies, with its declaration in the drafts.

use diagnostics::SourceId;
use pddl::NameKind;
use pddl::model::{Domain, FunctionValue, TypeId, TypeSet, TypeTable, Variables};
use project::Project;

use crate::context::Context;

/// A declared symbol with its parameters.
pub(crate) struct Applied<'p> {
    pub(crate) kind: NameKind,
    pub(crate) parameters: Vec<(&'p str, &'p TypeSet)>,
    types: &'p TypeTable,
}

impl Applied<'_> {
    pub(crate) fn type_text(&self, types: &TypeSet) -> String {
        type_text(self.types, &types.0)
    }
}

/// `truck`, or `(either truck plane)`.
pub(crate) fn type_text(table: &TypeTable, types: &[TypeId]) -> String {
    match types {
        [] => "object".to_owned(),
        [one] => table[*one].name.to_string(),
        many => {
            let names: Vec<&str> = many.iter().map(|&t| table[t].name.as_str()).collect();
            format!("(either {})", names.join(" "))
        }
    }
}

/// The draft of the domain that provides the names of a file.
pub(crate) fn domain(project: &Project, file: SourceId) -> Option<&Domain> {
    project.domain_of(file).and_then(|domain| project.domain(domain))
}

/// The symbol at the head of the innermost list.
pub(crate) fn applied<'p>(
    project: &'p Project,
    file: SourceId,
    context: &Context<'_>,
) -> Option<Applied<'p>> {
    let domain = domain(project, file)?;
    let name = context.inner()?.head().to_ascii_lowercase();
    let section = context.section().map_or("", |section| section.head());
    let declares = [":predicates", ":functions", ":types", ":objects", ":constants"];
    if name.is_empty() || declares.iter().any(|s| section.eq_ignore_ascii_case(s)) {
        return None;
    }
    let in_network = context.section().is_some_and(|section| {
        [":task", ":subtasks", ":tasks", ":ordered-subtasks", ":ordered-tasks"]
            .iter()
            .any(|key| section.key().eq_ignore_ascii_case(key))
    });
    // In a plan and in a task network the head is an action or a task.
    let (kind, variables) = if in_network || context.open.len() == 1 {
        step(domain, &name)?
    } else if let Some(id) = domain.predicate(&name) {
        (NameKind::Predicate, &domain.predicates[id].variables)
    } else {
        (NameKind::Function, &domain.functions[domain.function(&name)?].variables)
    };
    let parameters = variables.parameters().iter().map(|v| (v.name.as_str(), &v.types)).collect();
    Some(Applied { kind, parameters, types: &domain.types })
}

fn step<'p>(domain: &'p Domain, name: &str) -> Option<(NameKind, &'p Variables)> {
    let action = domain.action(name).map(|id| (NameKind::Action, &domain.actions[id].variables));
    let durative =
        || domain.durative_action(name).map(|id| (NameKind::Action, &domain.durative_actions[id].variables));
    let task = || domain.task(name).map(|id| (NameKind::Task, &domain.tasks[id].variables));
    action.or_else(durative).or_else(task)
}

/// The types of objects that a function yields; `None` for a number.
pub(crate) fn yields<'p>(domain: &'p Domain, name: &str) -> Option<&'p TypeSet> {
    match &domain.functions[domain.function(&name.to_ascii_lowercase())?].value {
        FunctionValue::Number => None,
        FunctionValue::Object(types) => Some(types),
    }
}
