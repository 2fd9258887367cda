//! An action of the plan, as `"(ask guest drink)"`.

use pddl::model::{ActionId, Name, ObjectId};

use crate::errors::counted;
use crate::layers::Layers;
use crate::manifest::{Mention, symbols};
use diagnostics::Finding;
use diagnostics::did_you_mean;
use diagnostics::toml::{Reader, Text};

/// An action of the plan with its arguments.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// Which action of the planning domain.
    pub action: ActionId,
    /// Its name.
    pub name: Name,
    /// Objects of the planning problem.
    pub arguments: Vec<ObjectId>,
    /// Their names.
    pub names: Vec<Name>,
}

/// Reads `(action argument …)`.
pub(super) fn read(reader: &mut Reader<'_>, layers: &Layers, text: &Text) -> Option<Step> {
    let (domain, problem) = (&layers.steps, &layers.problem.model);
    let mut mentions = symbols(text).into_iter();
    let Some(head) = mentions.next() else {
        reader.error("E0907", text.span, "a step is an action of the plan with its arguments");
        return None;
    };
    let Some(action) = domain.action(&head.name) else {
        let known = domain.actions.enumerate().map(|(_, a)| a.name.as_str());
        unknown(reader, &head, "the planning domain has no action", known);
        return None;
    };
    let parameters = domain.actions[action].variables.parameters();
    let arguments: Vec<Mention> = mentions.collect();
    if arguments.len() != parameters.len() {
        let (takes, given) = (counted(parameters.len(), "argument", "arguments"), arguments.len());
        let message = format!("`{}` takes {takes}, {given} given", head.name);
        reader.error("E0907", text.span, message);
        return None;
    }
    let mut objects = Vec::new();
    for (mention, parameter) in arguments.iter().zip(parameters) {
        let Some(object) = problem.object(&mention.name) else {
            let known = problem.objects.enumerate().map(|(_, o)| o.name.as_str());
            unknown(reader, mention, "the planning problem has no object", known);
            return None;
        };
        if !problem.objects[object].is_of(&parameter.types, &domain.types) {
            let message = format!("`{}` does not fit `?{}` of `{}`", mention.name, parameter.name, head.name);
            reader.error("E0907", mention.span, message);
            return None;
        }
        objects.push(object);
    }
    let names = objects.iter().map(|&o| problem.objects[o].name.clone()).collect();
    Some(Step { action, name: head.name, arguments: objects, names })
}

fn unknown<'a>(
    reader: &mut Reader<'_>,
    mention: &Mention,
    message: &str,
    known: impl Iterator<Item = &'a str>,
) {
    let place = reader.place(mention.span);
    let finding = Finding::error("E0907", place, format!("{message} `{}`", mention.name));
    reader.findings.push(finding.help_if(did_you_mean(&mention.name, known)));
}
