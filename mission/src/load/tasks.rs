//! The tasks that the manifest names: what is done without a plan, without progress, without a decision.

use pddl::Span;
use pddl::model::{ObjectId, TypeSet};

use super::loader::Loader;
use crate::errors::counted;
use crate::layers::Layers;
use crate::manifest::TaskText;
use crate::mission::MissionTask;
use diagnostics::{Finding, Place, SourceId};

/// Resolves `KEY = "(task argument …)"`. If the arguments are left out, each is the only object of its type in the
/// problem.
pub(super) fn resolve(
    loader: &mut Loader<'_>,
    source: SourceId,
    text: &TaskText,
    layers: &Layers,
) -> Option<MissionTask> {
    let (methods, problem) = (&layers.methods.model, &layers.problem.model);
    let wanted = &text.task;
    let mut report = |span: Span, message: String| {
        let place = Place { source, span };
        loader.findings.push(Finding::error("E0708", place, message));
        None
    };
    let Some(task) = methods.task(&wanted.name) else {
        return report(wanted.span, format!("the methods have no task `{}`", wanted.name));
    };
    let parameters = methods.tasks[task].variables.parameters();
    let fits = |object: ObjectId, parameter: &pddl::model::Variable| {
        // The parameter's types are those of the methods: by their names they are types of the planning domain.
        let table = &layers.domain.model.types;
        let takes = |name| methods.types.find(name).is_some_and(|t| methods.types.is_in(t, &parameter.types));
        let union = table.enumerate().filter(|(_, of)| takes(&of.name)).map(|(id, _)| id);
        let union = TypeSet(union.collect());
        !union.is_unknown() && problem.objects[object].is_of(&union, table)
    };
    let mut arguments = Vec::new();
    if text.arguments.is_empty() {
        for parameter in parameters {
            let mut fitting = problem.objects.ids().filter(|&o| fits(o, parameter));
            match (fitting.next(), fitting.next()) {
                (Some(object), None) => arguments.push(object),
                _ => {
                    let message = format!(
                        "the problem does not have exactly one object for `?{}` of `{}`; name it: \"({} …)\"",
                        parameter.name, wanted.name, wanted.name
                    );
                    return report(wanted.span, message);
                }
            }
        }
    } else if text.arguments.len() != parameters.len() {
        let takes = counted(parameters.len(), "argument", "arguments");
        let message = format!("`{}` takes {takes}", wanted.name);
        return report(wanted.span, message);
    } else {
        for (mention, parameter) in text.arguments.iter().zip(parameters) {
            match problem.object(&mention.name) {
                Some(object) if fits(object, parameter) => arguments.push(object),
                _ => {
                    let message =
                        format!("`{}` is not an object that fits `?{}`", mention.name, parameter.name);
                    return report(mention.span, message);
                }
            }
        }
    }
    let names = arguments.iter().map(|&o| problem.objects[o].name.clone()).collect();
    Some(MissionTask { task, name: wanted.name.clone(), arguments: names })
}
