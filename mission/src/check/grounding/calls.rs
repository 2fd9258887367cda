//! The bindings that callers give to tasks and intentions: from the plan's actions and the
//! manifest's tasks down the methods.

use std::collections::{BTreeMap, BTreeSet};

use pddl::model::{DurativeActionId, Idx, Method, SubtaskHead, TaskId, Term, TypeSet, Variables};

use super::bindings::{self, Meter, conjuncts};
use super::classes::{ClassId, Classes};
use super::known::Known;
use super::scope::Scope;
use crate::layers::Layers;

/// The bindings of tasks and intentions so far.
#[derive(Clone, Debug, Default)]
pub(in crate::check) struct Calls {
    pub(in crate::check) tasks: BTreeSet<(TaskId, Vec<ClassId>)>,
    pub(in crate::check) intentions: BTreeMap<DurativeActionId, BTreeSet<Vec<ClassId>>>,
}

impl Calls {
    /// Adds all that may be called from a task with these arguments.
    pub(super) fn add(
        &mut self,
        layers: &Layers,
        classes: &Classes,
        call: (TaskId, Vec<ClassId>),
        known: &Known<'_>,
        meter: &Meter,
    ) {
        let methods = &layers.methods.model;
        let mut open = vec![call];
        while let Some(call) = open.pop() {
            if !self.tasks.insert(call.clone()) {
                continue;
            }
            for (_, method) in methods.methods.enumerate().filter(|(_, m)| m.task == call.0) {
                self.refine(layers, classes, method, &call.1, known, meter, &mut open);
            }
        }
    }

    #[allow(clippy::too_many_arguments, reason = "one step of the loop above")]
    fn refine(
        &mut self,
        layers: &Layers,
        classes: &Classes,
        method: &Method,
        arguments: &[ClassId],
        known: &Known<'_>,
        meter: &Meter,
        open: &mut Vec<(TaskId, Vec<ClassId>)>,
    ) {
        let methods = &layers.methods.model;
        let mut scope = Scope::new(layers, classes, methods, &method.variables);
        if !unify(&mut scope, &method.task_arguments, arguments) {
            return;
        }
        let unbound: Vec<_> =
            method.variables.parameter_ids().filter(|v| scope.binding[v.index()].is_none()).collect();
        let mut conditions = Vec::new();
        conjuncts(&method.precondition, &mut conditions);
        conditions.extend(&method.network.constraints);
        bindings::each(&mut scope, &unbound, &conditions, known, meter, &mut |scope| {
            for subtask in &method.network.subtasks {
                let terms = subtask.arguments.iter().map(|&t| scope.term(t));
                let Some(arguments) = terms.collect::<Option<Vec<_>>>() else { continue };
                match subtask.head {
                    SubtaskHead::Task(task) => {
                        if fits(scope, &methods.tasks[task].variables, &arguments) {
                            open.push((task, arguments));
                        }
                    }
                    SubtaskHead::DurativeAction(id) => {
                        if fits(scope, &methods.durative_actions[id].variables, &arguments) {
                            self.intentions.entry(id).or_default().insert(arguments);
                        }
                    }
                    SubtaskHead::Action(_) => {}
                }
            }
        });
    }
}

/// Whether the arguments have the types of the parameters.
fn fits(scope: &Scope<'_>, variables: &Variables, arguments: &[ClassId]) -> bool {
    let is_a = |class, types: &TypeSet| scope.classes.is_a(class, scope.layers, scope.domain, types);
    variables.parameters().iter().zip(arguments).all(|(p, &class)| is_a(class, &p.types))
}

/// Binds the terms to the arguments; false if they differ.
fn unify(scope: &mut Scope<'_>, terms: &[Term], arguments: &[ClassId]) -> bool {
    terms.iter().zip(arguments).all(|(&term, &class)| match (term, scope.term(term)) {
        (Term::Variable(variable), None) => {
            let types = &scope.variables[variable].types;
            let fits = scope.classes.is_a(class, scope.layers, scope.domain, types);
            scope.binding[variable.index()] = Some(class);
            fits
        }
        (_, bound) => bound == Some(class),
    })
}
