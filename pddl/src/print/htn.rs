//! Tasks, methods, networks.

use std::fmt::Write as _;

use super::Printer;
use crate::model::{CompoundTask, Method, Name, Ordering, SubtaskHead, TaskNetwork, Variables};

impl Printer<'_> {
    pub(super) fn task(&mut self, task: &CompoundTask) {
        let _ = write!(self.out, "\n  (:task {}", task.name);
        self.parameters(&task.variables);
        self.push(")");
    }

    pub(super) fn method(&mut self, method: &Method) {
        let v = &method.variables;
        let _ = write!(self.out, "\n  (:method {}", method.name);
        self.parameters(v);
        self.push("\n    :task ");
        let domain = self.domain;
        self.applied(v, &domain.tasks[method.task].name, &method.task_arguments);
        self.push("\n    :precondition ");
        self.condition(v, &method.precondition);
        self.network(v, &method.network);
        self.push(")");
    }

    /// A network whose orderings begin with the whole chain is an ordered one.
    pub(super) fn network(&mut self, v: &Variables, network: &TaskNetwork) {
        let links = network.subtasks.len().saturating_sub(1);
        let chain = (0u32..).map(|before| Ordering { before, after: before + 1 }).take(links);
        let ordered = links > 0 && network.orderings.iter().copied().take(links).eq(chain);
        self.push(if ordered { "\n    :ordered-subtasks " } else { "\n    :subtasks " });
        self.lines("(and", &network.subtasks, |p, subtask| {
            if let Some(id) = &subtask.id {
                let _ = write!(p.out, "({id} ");
            }
            let name = p.head(subtask.head).clone();
            p.applied(v, &name, &subtask.arguments);
            if subtask.id.is_some() {
                p.push(")");
            }
        });
        if !network.constraints.is_empty() {
            self.push("\n    :constraints ");
            self.list("(and", &network.constraints, |p, c| p.condition(v, c));
        }
        let rest = &network.orderings[if ordered { links } else { 0 }..];
        if rest.is_empty() {
            return;
        }
        let id = |i: u32| network.subtasks[i as usize].id.as_deref().unwrap_or("_");
        self.push("\n    :ordering ");
        self.list("(and", rest, |p, o| {
            let _ = write!(p.out, "(< {} {})", id(o.before), id(o.after));
        });
    }

    fn head(&self, head: SubtaskHead) -> &Name {
        match head {
            SubtaskHead::Task(id) => &self.domain.tasks[id].name,
            SubtaskHead::Action(id) => &self.domain.actions[id].name,
            SubtaskHead::DurativeAction(id) => &self.domain.durative_actions[id].name,
        }
    }
}
